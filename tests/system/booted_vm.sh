#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The whole boat in a virtual machine (qemu, whose processor is emulated): Debian with a kernel of its
# own, the package installed, the machine started anew, and the boat commanded over the network from
# ashore. Its AHRS, satellite receiver and thruster box are behind USB adapters whose other ends, and the
# sonar's program, are lodesman-devices on this machine. A mission in real time; cables that are pulled
# under way; the power cut under way and behind an emergency stop; a kernel that panics under way, and a
# hardware watchdog. Prints a table of times, and fails at the first thing that is not as it should be.
# Wants root, and packages as deploy/packages.sh names them.
#   tests/system/booted_vm.sh [--keep DIR] [--cuts N]
# DIR: where the machine's disk is kept for the next run, which then need not make it. N: how often the power
# is cut under way, once where it is not said. On two busy cores all of it takes a quarter of an hour, and
# three minutes more for each further cut.
set -euo pipefail
cd "$(dirname "$0")/../.."
. deploy/packages.sh
. tests/system/booted_machine.sh

bin=build/release/bin
kept=
cuts=1
while [ $# -gt 0 ]; do
  case $1 in
    --keep) kept=$(realpath -m "$2") ;;
    --cuts) cuts=$2 ;;
    *) fail "$1: no such option" ;;
  esac
  shift 2
done
place=$(mktemp -d)
image=${kept:-$place/image}
segment=lodesman-vm-$$
state=/var/lib/lodesman
by_id=/dev/serial/by-id/usb-QEMU_QEMU_USB_SERIAL
. tests/system/virtual_machine.sh
devices=
propellers=
lost_of_recordings=()

clean_up() {
  local process
  drop_network
  for process in $propellers $devices; do
    { kill "$process" && wait "$process"; } 2>/dev/null || true
  done
  rm -rf "$place"
}
trap clean_up EXIT
trap 'exit 130' INT TERM HUP

# ashore <word> [option...]: what the operator says, from outside and by the boat's token.
ashore() {
  local word=$1
  shift
  in_net $bin/lodesman "$word" --host $shore --port $command_port --token-file "$place/boat.token" "$@"
}
boat_says() {
  ashore status --json 2>/dev/null | tr -d ' \n'
}
what_it_says() {
  ashore status --json 2>&1 || true
  inside "systemctl --no-pager status lodesman-low lodesman-high; journalctl --no-pager -b \
    -u lodesman-low -u lodesman-high -o short-monotonic | tail -n 60" 2>&1 || true
}
give_up() { # as `fail`, with what the boat says
  what_it_says >&2
  fail "$@"
}

start_devices() {
  make_network
  mkdir "$place/ports"
  nsenter --net="/run/netns/$network" $bin/lodesman-devices --scenario paper-static --segment "$segment" \
    --ports "$place/ports" --sonar-port $sonar_port 2>"$place/devices.log" &
  devices=$!
  wait_until 20 test -e "$place/ports/thrusters" || fail "lodesman-devices does not start: $(cat "$place/devices.log")"
  $bin/propellers "$segment" >"$place/propellers" &
  propellers=$!
}

# are_turning, and first_after <milliseconds> <still or turning>: when the bench's propellers were so,
# from then on.
are_turning() {
  tail -n 1 "$place/propellers" | grep -q turning
}
first_after() {
  awk -v from="$1" -v how="$2" '$1 >= from && $2 == how { print $1; found = 1; exit }
    END { exit !found }' "$place/propellers"
}
# still_row <what> <milliseconds>: of the table, how soon after that the propellers stood still.
still_row() {
  wait_until 20 first_after "$2" still || give_up "$1: the propellers go on"
  row "$1, until the propellers stand still" $(($(first_after "$2" still) - $2))
}

install_it() {
  inside 'cat >/srv/lodesman.deb' <"$place/lodesman.deb"
  local start
  start=$(now_ms)
  inside dpkg -i /srv/lodesman.deb >"$place/install.log" 2>&1 || fail "dpkg -i: $(cat "$place/install.log")"
  wait_until 120 services_are_up || give_up "the services are not up after dpkg -i"
  row "\`dpkg -i\`, until both services are up" $(($(now_ms) - start))
}

# As the documents have it: a token for the shore, the AHRS by the number of its adapter in a copy of the
# package's rules, the other two ports by the names that udev gives them.
configure() {
  inside lodesman token --new /etc/lodesman/boat.token >/dev/null
  inside cat /etc/lodesman/boat.token >"$place/boat.token"
  chmod 600 "$place/boat.token"
  {
    boat_toml $sonar_port $host "/dev/lodesman/ahrs?baud=38400" "${by_id}_POSITION-if00-port0" \
      "${by_id}_THRUSTERS-if00-port0"
    printf '\n[command_socket]\naddress = "0.0.0.0"\ntoken_file = "/etc/lodesman/boat.token"\n'
    printf '\n[recorder]\nfree_floor_mib = 64\n'  # of a disk with hardly more than the system
  } | inside 'cat >/etc/lodesman/boat.toml'
  inside 'sed "s/^ENV{ID_VENDOR_ID}==\"0403\", /&ENV{ID_SERIAL_SHORT}==\"AHRS\", /" \
    /usr/lib/udev/rules.d/60-lodesman.rules >/etc/udev/rules.d/60-lodesman.rules'
  inside lodesman check /etc/lodesman/boat.toml >/dev/null || fail "boat.toml is refused"
}

# comes_back <the boot before> <milliseconds> <what>: by itself, disarmed, with no mission.
comes_back() {
  wait_until 400 is_up "$1" || fail "$3: the machine does not come up: $(tail -n 20 "$place/console.log")"
  wait_until 120 services_are_up || give_up "$3: the services do not start by themselves"
  row "$3, until the services are up" $(($(now_ms) - $2))
  wait_until 120 boat_says || give_up "$3: the boat does not answer"
  wait_until 60 is_disarmed || give_up "$3: the thrusters are not disarmed, or the boat answers no more"
  wait_until 60 mission_is idle || give_up "$3: a mission is there, or the boat answers no more"
}
is_disarmed() {
  boat_says | grep -q -E '"thrust":\{[^}]*"state":"(disarmed|stopped)"'
}
devices_work() { # devices_work <what> <milliseconds>
  local device
  for device in heading sonar position thrusters; do
    wait_until 120 device_is $device '"status":"working"' || give_up "$1: $device does not work"
  done
  row "$1, until four devices work" $(($(now_ms) - $2))
}

arm_it() {
  wait_until 60 ready_to_arm || give_up "it cannot be armed"
  ashore arm >/dev/null || give_up "it does not arm"
}
starts() { # starts <goal> <speed>
  printf 'goal_m = [%s]\nspeed_m_s = %s\n' "$1" "$2" >"$place/mission.toml"
  ashore start --mission "$place/mission.toml"
}
sail() {
  local start from
  arm_it
  wait_until 30 starts "0.0, 16.0" 0.74 || give_up "it does not start: $(starts "0.0, 16.0" 0.74 2>&1)"
  start=$(now_ms)
  from=$(wc -l <"$place/propellers")
  wait_until 240 mission_is reached || give_up "it does not arrive"
  row "a mission of 16 m past a rock, at 0.74 m/s, started from ashore" $(($(now_ms) - start))
  tail -n "+$((from + 1))" "$place/propellers" | awk '{ if (least == "" || $6 < least) least = $6 }
    END { print "the hull came no nearer to the rock than " least " m"; exit !(least > 0) }' || fail "it hit the rock"
  judge_tasks
}
# The tasks have their priorities, which is more than a machine of systemd-nspawn may be able to show; and
# how late they were on this slow processor, which is shown and not judged.
judge_tasks() {
  inside 'ps -eLo cls,rtprio,comm' | grep -q -E 'FF +70 thruster' || give_up "the tasks have no real-time priorities"
  inside runuser -u lodesman -- lodesman watch --once | sed -n '/^  task/,$p'
}
# Far from everything, and for minutes.
get_under_way() {
  mission_is under_way || wait_until 30 starts "-40.0, 10.0" 0.22 || give_up "it does not start"
  wait_until 60 are_turning || give_up "it is under way and does not move"
}

pull_ahrs() {
  local pulled back
  get_under_way
  pulled=$(now_ms)
  unplug ahrs
  still_row "the AHRS's USB cable pulled" "$pulled"
  wait_until 30 device_is heading '"fault":"unplugged"' || give_up "nobody says that the AHRS is unplugged"
  row "the AHRS's USB cable pulled, until \`status\` says so" $(($(now_ms) - pulled))
  back=$(now_ms)
  plug ahrs
  wait_until 60 device_is heading '"status":"working"' || give_up "the AHRS does not come back"
  row "the AHRS plugged in again, until it works" $(($(now_ms) - back))
  wait_until 60 first_after "$back" turning || give_up "with its AHRS back it does not sail on"
  row "the AHRS plugged in again, until it sails on by itself" $(($(first_after "$back" turning) - back))
  mission_is under_way || give_up "the mission has ended"
}

# For longer than its absence is forgiven: it is disarmed, and the mission is over.
pull_thrusters() {
  local pulled back
  get_under_way
  pulled=$(now_ms)
  unplug thrusters
  still_row "the thruster box's USB cable pulled" "$pulled"
  wait_until 30 device_is thrusters '"fault":"unplugged"' || give_up "nobody says that the thruster box is unplugged"
  row "the thruster box's USB cable pulled, until \`status\` says so" $(($(now_ms) - pulled))
  wait_until 30 device_is thrust '"cause":"box_lost"' || give_up "it stays armed without a thruster box"
  back=$(now_ms)
  plug thrusters
  wait_until 60 device_is thrusters '"status":"working"' || give_up "the thruster box does not come back"
  row "the thruster box plugged in again, until it works" $(($(now_ms) - back))
  sleep 2
  ! first_after "$back" turning || give_up "the propellers turn though nobody has armed them"
  wait_until 30 mission_is aborted || give_up "the mission is not over without thrusters"
  arm_it
  get_under_way
}

# At some moment between two chunks of the recording.
cut_power_under_way() {
  local before cut part up_s asked lost_ms
  get_under_way
  before=$(boot_of)
  part=$(inside "ls -t $state/recordings/*.part | head -n 1")
  sleep "1.$((RANDOM % 10))"
  up_s=$(inside cut -d "' '" -f 1 /proc/uptime)
  asked=$(now_ms)
  power_cut
  cut=$(now_ms)
  still_row "the power cut under way" "$cut"
  lost_ms=$(awk "BEGIN { printf \"%d\", $up_s * 1000 + $cut - $asked }")
  cut=$(now_ms)
  switch_on
  plug_all
  comes_back "$before" "$cut" "power on after the cut"
  judge_disk
  [ "$(inside ls $state)" = recordings ] || fail "the state is not as it was: $(inside ls -la $state)"
  judge_recording "$part" "$lost_ms"
  devices_work "power on after the cut" "$cut"
  ! first_after "$cut" turning || give_up "the propellers turned after the power cut"
}
# judge_recording <file> <milliseconds since its machine's start at the cut>: all of it can be had but for
# the last second.
judge_recording() {
  local said lost_ms
  said=$(inside lodesman recover --json "$1") || fail "the recording cannot be recovered: $said"
  lost_ms=$(awk -v cut="$2" 'match($0, /"last_s":[0-9.]+/) {
    printf "%d", cut - 1000 * substr($0, RSTART + 9, RLENGTH - 9) }' <<<"$said")
  if [ -z "$lost_ms" ] || [ "$lost_ms" -ge 1000 ]; then fail "the recording ends $lost_ms ms before the cut: $said"; fi
  lost_of_recordings+=("$lost_ms")
  inside rm "$1" "${1%.part}"  # the next one judged is not this one again
}

# Its word is on the disk a moment after it is confirmed.
cut_power_when_stopped() {
  local before cut
  arm_it
  get_under_way
  ashore estop >/dev/null || give_up "it does not stop"
  sleep 1
  before=$(boot_of)
  power_cut
  cut=$(now_ms)
  switch_on
  plug_all
  comes_back "$before" "$cut" "power on after an emergency stop"
  judge_disk
  device_is thrust '"state":"stopped"' || give_up "the emergency stop is forgotten"
  [ "$(inside "cat $state/*.latch")" = stopped ] || fail "the latch is not whole"
  devices_work "power on after an emergency stop" "$cut"
  ashore estop --release >/dev/null || give_up "the emergency stop is not released"
}
judge_disk() {
  inside "touch $state/probe && rm $state/probe" || fail "the disk is not writable after a power cut"
  inside 'journalctl --no-pager -k -b | grep -i -E "EXT4-fs error|I/O error"' && fail "the disk is damaged"
  inside dpkg -V lodesman | grep -v ' c /etc/' && fail "what is installed is not whole after a power cut"
  return 0
}

panic() {
  local before start bite
  arm_it
  get_under_way
  before=$(boot_of)
  : >"$place/events"
  inside 'echo 1 >/proc/sys/kernel/sysrq; (sleep 0.2; echo c >/proc/sysrq-trigger) >/dev/null 2>&1 &' || true
  wait_until 20 grep -q "Kernel panic" "$place/console.log" || fail "the kernel does not panic"
  start=$(now_ms)
  wait_until 90 grep -q WATCHDOG "$place/events" || fail "the watchdog does not bite"
  end_session
  bite=$(now_ms)
  row "the kernel panics under way, until the hardware watchdog resets" $((bite - start))
  still_row "the kernel panics under way" "$start"
  comes_back "$before" "$bite" "reset by the watchdog"
  judge_disk
  devices_work "reset by the watchdog" "$bite"
  ! first_after "$bite" turning || give_up "the propellers turned after the reset"
}

[ "$(id -u)" -eq 0 ] || fail "wants root"
install_packages $package_packages $vm_packages
deploy/package.sh
cp build/release/package/lodesman_*.deb "$place/lodesman.deb"
quietly cmake --build --preset release --target propellers
start=$(now_ms)
make_image
row "a disk with Debian" $(($(now_ms) - start))
qemu-img create -q -f qcow2 -b "$image/disk" -F raw "$place/run.qcow2"
start_devices
start=$(now_ms)
switch_on
wait_until 400 is_up none || fail "the machine does not come up: $(tail -n 20 "$place/console.log" "$place/qemu.log")"
row "boot, to \`multi-user.target\`" $(($(now_ms) - start))
install_it
configure
before=$(boot_of)
start=$(now_ms)
inside systemctl reboot || true
plug_all
comes_back "$before" "$start" "reboot"
devices_work "reboot" "$start"
sail
pull_ahrs
pull_thrusters
for ((i = 1; i <= cuts; i++)); do
  [ "$i" -eq 1 ] || arm_it
  cut_power_under_way
done
row "the power cut under way, what of the recording is lost" "${lost_of_recordings[@]}"
cut_power_when_stopped
panic
print_table "in the virtual machine"
say "the boat in a virtual machine: all as it should be"
