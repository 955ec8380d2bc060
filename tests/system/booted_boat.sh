#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The package in a booted machine (systemd-nspawn): installed, its services up with real drivers on
# emulated devices, a mission sailed from another network, both programs killed and frozen and a task of
# each made to hang, an upgrade refused under way and done when held, and nothing left by a purge. Prints a table of times, and fails at the first thing that
# is not as it should be. Wants root, and packages as deploy/packages.sh names them.
#   tests/system/booted_boat.sh [KILLS]     of each program, 20 without it
set -euo pipefail
cd "$(dirname "$0")/../.."
. deploy/packages.sh
. tests/system/booted_machine.sh
unshare --mount --pid --fork --mount-proc true 2>/dev/null || {
  say "NOT TRIED: this machine makes no namespaces, so that nothing can be booted in it"
  exit 0
}
kills=${1:-20}
sonar_port=4040
place=$(mktemp -d)
network=lodesman-$$
shore=$network-shore
# Of a network that is kept for examples (RFC 5737).
boat_address=192.0.2.1
shore_address=192.0.2.2
devices=

clean_up() {
  power_off
  [ -z "$devices" ] || { kill "$devices" 2>/dev/null && wait "$devices" 2>/dev/null; } || true
  ip netns del "$network" 2>/dev/null || true
  ip netns del "$shore" 2>/dev/null || true
  rm -rf "$place"
}
trap clean_up EXIT
trap 'exit 130' INT TERM HUP

# boat_says: all that `lodesman status` has, on one line; nothing where the boat does not answer.
boat_says() {
  inside lodesman status --json 2>/dev/null | tr -d ' \n'
}
ready_to_start() {
  inside lodesman status --json | tr -d ' \n' | grep -q '"not_ready":\[\]'
}
can_start() {
  inside lodesman goto "$1" --speed "$2"
}

process_of() {
  inside systemctl show -P MainPID "lodesman-$1"
}
is_back() { # is_back <low or high> <the process before>
  local now
  now=$(process_of "$1")
  [ "$now" != 0 ] && [ "$now" != "$2" ] && inside systemctl --quiet is-active "lodesman-$1"
}
# Armed anew where the program was away for longer than it is remembered.
under_way() {
  mission_is under_way || {
    ready_to_start || inside lodesman arm
    can_start -30,0 0.22
  }
}

# The boat's network, and the shore's, which knows of the boat nothing but an address.
join_networks() {
  ip netns add "$network"
  ip netns add "$shore"
  ip -n "$shore" link add boat type veth peer name shore netns "$network"
  ip -n "$network" addr add $boat_address/30 dev shore
  ip -n "$shore" addr add $shore_address/30 dev boat
  ip -n "$network" link set lo up
  ip -n "$network" link set shore up
  ip -n "$shore" link set boat up
}
# ashore <word> <option...>: the operator's command of this machine, to the boat over that network.
ashore() {
  timeout 120 nsenter --net="/run/netns/$shore" build/release/bin/lodesman "$@" --host $boat_address
}

start_devices() {
  mkdir "$place/ports"
  nsenter --net="/run/netns/$network" build/release/bin/lodesman-devices --scenario paper-static \
    --segment "lodesman-booted-$$" --ports "$place/ports" --sonar-port $sonar_port 2>"$place/devices.log" &
  devices=$!
  wait_until 20 test -e "$place/ports/thrusters" || fail "lodesman-devices does not start: $(cat "$place/devices.log")"
  local port
  for port in ahrs position thrusters; do
    chgrp dialout "$(readlink -f "$place/ports/$port")"
    chmod 660 "$(readlink -f "$place/ports/$port")"
  done
}

bring_up() {
  join_networks
  start_devices
  local start
  start=$(now_ms)
  boot "$place/root" "$network" "$place/boot.log" \
    "$(readlink -f "$place/ports/ahrs"):/dev/lodesman/ahrs" \
    "$(readlink -f "$place/ports/position"):/dev/lodesman/gps" \
    "$(readlink -f "$place/ports/thrusters"):/dev/lodesman/thrusters"
  row "boot, to multi-user.target" $(($(now_ms) - start))
}

# What stands on the machine's disk, but for what dpkg and systemd keep of themselves.
everything() {
  inside find / -xdev -not -type d | grep -v -E '^/(proc|sys|dev|run|tmp|srv/package|var/(lib/(dpkg|systemd)|log|cache|tmp))' |
    grep -v -E '^/etc/(passwd|group|shadow|gshadow|subuid|subgid)-$|^/etc/\.(pwd|updated)' | sort
}

install_it() {
  everything >"$place/before"
  local start
  start=$(now_ms)
  inside dpkg -i /srv/package/1.deb >"$place/install.log" 2>&1 || fail "dpkg -i: $(cat "$place/install.log")"
  local program
  for program in low high; do
    wait_until 20 inside systemctl --quiet is-active "lodesman-$program" ||
      fail "lodesman-$program is not up: $(inside journalctl -u "lodesman-$program" -o cat --no-pager)"
  done
  row "dpkg -i, until both services are up" $(($(now_ms) - start))
  [ "$(inside stat -c %U:%a /var/lib/lodesman)" = lodesman:750 ] || fail "/var/lib/lodesman is not the boat's alone"
  inside sh -c 'dpkg -V lodesman' || fail "what is installed is not what was packed"
}

# As the units stand, the ports of this machine, which are ptys, are none of the boat's.
meet_devices() {
  inside lodesman token --new /etc/lodesman/boat.token >/dev/null || fail "no token is made"
  [ "$(inside stat -c %G:%a /etc/lodesman/boat.token)" = lodesman:640 ] || fail "the token is not the boat's to read"
  install -m 600 "$place/root/etc/lodesman/boat.token" "$place/boat.token"
  {
    boat_toml $sonar_port
    printf '\n[command_socket]\naddress = "0.0.0.0"\ntoken_file = "/etc/lodesman/boat.token"\n'
  } >"$place/root/etc/lodesman/boat.toml"
  inside lodesman check /etc/lodesman/boat.toml >/dev/null || fail "boat.toml is refused"
  inside systemctl restart lodesman.target
  wait_until 20 device_is heading no_permission || fail "a port that is not on the list of the unit was opened: $(inside lodesman status 2>&1; inside systemctl status --no-pager lodesman-low lodesman-high; inside journalctl --no-pager -o cat -u lodesman-low -u lodesman-high | tail -30)"
  inside mkdir -p /etc/systemd/system/lodesman-low.service.d
  printf '[Service]\nDeviceAllow=char-pts rw\n' \
    >"$place/root/etc/systemd/system/lodesman-low.service.d/bench.conf"
  inside systemctl daemon-reload
  inside systemctl restart lodesman.target
  local device start
  start=$(now_ms)
  for device in heading sonar position thrusters; do
    wait_until 40 device_is $device '"status":"working"' ||
      fail "$device does not work: $(inside lodesman status --json)"
  done
  wait_until 20 ready_to_arm || fail "it cannot be armed: $(inside lodesman status --json)"
  row "restart, until four devices work and it may be armed" $(($(now_ms) - start))
  # A machine whose own root may raise no limit gives none to a service.
  if inside sh -c 'ulimit -r 70 && ulimit -l unlimited' 2>/dev/null; then
    inside journalctl -u lodesman-low -o cat --no-pager | grep "no real-time rights" &&
      fail "the service has no real-time rights"
  else
    say "this machine lets nobody raise limits: that the services have real-time rights was not seen"
  fi
  inside journalctl LODESMAN_DEVICE=heading LODESMAN_FAULT=no_permission -o cat --no-pager | grep -q heading ||
    fail "the journal does not name device and fault"
}

# From the shore, which arms too, and which has to hold the boat's own token for it.
sail() {
  build/release/bin/lodesman token --new "$place/strange.token" >/dev/null
  ashore arm >"$place/said" 2>&1 && fail "it is armed from another network without a token"
  ashore arm --token-file "$place/strange.token" >"$place/said" 2>&1 && fail "it is armed by another boat's token"
  ashore arm --token-file "$place/boat.token" >"$place/said" 2>&1 || fail "it does not arm: $(cat "$place/said")"
  wait_until 20 ready_to_start || fail "it is not ready: $(inside lodesman status --json)"
  printf 'goal_m = [0.0, 16.0]\nspeed_m_s = 0.74\n' >"$place/pond.toml"
  local start
  start=$(now_ms)
  ashore start --mission "$place/pond.toml" --follow --token-file "$place/boat.token" >"$place/said" 2>&1 ||
    fail "it does not arrive: $(cat "$place/said"; inside lodesman status --json)"
  row "\`lodesman start --host\` from another network, until that says it is reached: 16 m past a rock, 0.74 m/s" \
    $(($(now_ms) - start))
}

# interrupt <signal> <low or high> <times> <title>
interrupt() {
  local i start before up=() whole=()
  for ((i = 0; i < $3; i++)); do
    wait_until 20 under_way || fail "it does not sail again: $(inside lodesman status --json 2>&1)"
    before=$(process_of "$2")
    start=$(now_ms)
    inside sh -c "kill -$1 $before"
    wait_until 20 is_back "$2" "$before" || fail "lodesman-$2 does not come back after SIG$1"
    up+=($(($(now_ms) - start)))
    if [ "$2" = low ]; then
      wait_until 20 device_is thrusters '"status":"working"' || fail "the thrusters do not come back"
    else
      wait_until 20 inside lodesman status || fail "the command socket does not come back"
    fi
    whole+=($(($(now_ms) - start)))
  done
  row "$4, until the service is up" "${up[@]}"
  row "$4, until $([ "$2" = low ] && echo 'its thruster box works' || echo 'it answers')" "${whole[@]}"
}

# hang <low or high> <task>: one task of a program whose others go on.
hang() {
  local before start holder watchdogs
  wait_until 20 under_way || fail "it does not sail again: $(inside lodesman status --json 2>&1)"
  before=$(process_of "$1")
  watchdogs=$(watchdogs_of "$1")
  inside /srv/package/hang_task "$before" "$2" >"$place/hang" 2>&1 &
  holder=$!
  wait_until 5 grep -q "hangs\|not permitted" "$place/hang" || fail "no task hangs: $(cat "$place/hang")"
  if grep -q "not permitted" "$place/hang"; then
    say "this machine lets nobody hold a thread: a task of lodesman-$1 that hangs was not seen"
    return
  fi
  start=$(now_ms)
  sleep 1
  [ "$(process_of "$1")" = "$before" ] || fail "lodesman-$1 does not live while its task hangs"
  wait_until 20 is_back "$1" "$before" || fail "lodesman-$1 does not come back after a task that hangs"
  row "task \`$2\` of \`lodesman-$1\` hangs, until the service is up" $(($(now_ms) - start))
  wait "$holder" || fail "the task did not hang until the end"
  [ "$(watchdogs_of "$1")" -gt "$watchdogs" ] || fail "it was not the watchdog that ended lodesman-$1"
  grep -q "$2 hangs" <<<"$(inside journalctl -u "lodesman-$1" -o cat --no-pager)" || fail "nobody says which task hangs"
}
watchdogs_of() {
  inside journalctl -u "lodesman-$1" -o cat --no-pager | grep -c "Watchdog timeout" || true
}

# Pages and completion say what the programs say: each word has its page, with each of its options.
judge_words() {
  local words word option page
  words=$(inside lodesman --help | awk '/^Subcommands:/ { on = 1; next } on && /^  [a-z]/ { print $1 }')
  [ -n "$words" ] || fail "lodesman --help lists no words"
  for word in $words; do
    case $word in sim | hil | segment | plot | replay) continue ;; esac  # lodesman-bench has them
    page=$(gunzip -c "$place/root/usr/share/man/man1/lodesman-$word.1.gz" | sed 's/\\f.//g; s/\\-/-/g') ||
      fail "lodesman $word has no page"
    for option in $(inside lodesman "$word" --help | grep -o -- '--[a-z][a-z-]*' | sort -u); do
      grep -q -- "$option" <<<"$page" || fail "the page of lodesman $word does not have $option"
    done
  done
  completes "start status" lodesman st
  completes "--help --host" lodesman status --h
}
completes() { # completes <what> <words so far...>
  local wanted=$1 said
  shift
  # shellcheck disable=SC2016  # the words are the inner shell's
  said=$(inside bash -c '. /usr/share/bash-completion/completions/lodesman
    COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _lodesman; echo "${COMPREPLY[*]}"' bash "$@")
  [ "$said" = "$wanted" ] || fail "the completion of \"$*\" is \"$said\""
}

judge_exposure() {
  local program
  for program in low high recorder console; do
    inside systemd-analyze security --no-pager "lodesman-$program.service" >"$place/exposure" || true
    grep -o "Overall.*: [0-9.]*" "$place/exposure"
    inside systemd-analyze security --no-pager --threshold=20 "lodesman-$program.service" >/dev/null ||
      fail "the exposure of lodesman-$program: $(cat "$place/exposure")"
  done
}

# The console answers its own machine, tells a stranger nothing of the boat, and another host nothing.
judge_console() {
  local said
  # shellcheck disable=SC2016  # the words are the inner shell's
  said=$(inside bash -c 'for host in localhost another.example; do
      exec 3<>/dev/tcp/127.0.0.1/8765
      printf "GET /session HTTP/1.1\r\nHost: %s\r\nConnection: close\r\n\r\n" "$host" >&3
      cat <&3
      echo
    done')
  grep -q '"scope":null' <<<"$said" || fail "the console does not answer: $said"
  grep -q "^HTTP/1.1 421" <<<"$said" || fail "the console answers by any name: $said"
}

# The black box is closed by a stop, and every one is the boat's alone.
judge_recordings() {
  local news
  inside systemctl stop lodesman-recorder
  news=$(inside journalctl -u lodesman-recorder -o cat --no-pager)
  grep -q "^recorded [1-9][0-9]* publications" <<<"$news" || fail "nothing was recorded: $news"
  grep "^recorded " <<<"$news"
  inside sh -c 'ls /var/lib/lodesman/recordings/*.mcap && ! ls /var/lib/lodesman/recordings/*.part' >/dev/null 2>&1 ||
    fail "a recording was not closed: $news"
  [ "$(inside sh -c 'stat -c %U:%a /var/lib/lodesman/recordings/*.mcap' | sort -u)" = lodesman:640 ] ||
    fail "the recordings are not the boat's alone"
  inside systemctl start lodesman-recorder
}

upgrade_it() {
  wait_until 20 under_way || fail "it does not sail before the upgrade"
  inside dpkg --force-confold -i /srv/package/2.deb >"$place/upgrade.log" 2>&1 && fail "an upgrade was done under way"
  grep -q "under way" "$place/upgrade.log" || fail "the upgrade was refused for another reason: $(cat "$place/upgrade.log")"
  mission_is under_way || fail "the refused upgrade ended the mission"
  inside dpkg -r lodesman >"$place/remove.log" 2>&1 && fail "it was removed under way"
  mission_is under_way || fail "the refused removal ended the mission"
  inside lodesman hold >/dev/null
  local start
  start=$(now_ms)
  inside dpkg --force-confold -i /srv/package/2.deb >"$place/upgrade.log" 2>&1 || fail "upgrade: $(cat "$place/upgrade.log")"
  wait_until 20 inside lodesman status || fail "it does not answer after the upgrade"
  row "an upgrade of a boat that holds, until it answers" $(($(now_ms) - start))
  [ "$(inside dpkg-query -W -f '${Version}' lodesman)" = "$version-2" ] || fail "the version is not the new one"
  grep -q booted "$place/root/etc/lodesman/boat.toml" || fail "the upgrade replaced boat.toml"
}

# A test's own drop-in is the test's to take away.
purge_it() {
  inside lodesman abort >/dev/null || true
  inside rm -r /etc/systemd/system/lodesman-low.service.d
  local start
  start=$(now_ms)
  inside dpkg -r lodesman >"$place/remove.log" 2>&1 || fail "remove: $(cat "$place/remove.log")"
  inside test -f /etc/lodesman/boat.toml || fail "a removal takes boat.toml"
  inside dpkg --purge lodesman >"$place/remove.log" 2>&1 || fail "purge: $(cat "$place/remove.log")"
  row "remove and purge" $(($(now_ms) - start))
  everything >"$place/after"
  diff "$place/before" "$place/after" >&2 || fail "a purge does not leave what was there before"
  inside sh -c 'test -z "$(ls /dev/shm /run/lodesman 2>/dev/null | grep -v :)"' || fail "something is left in /dev/shm or /run"
  inside sh -c '! getent passwd lodesman && ! getent group lodesman' || fail "the user is left"
  # systemd forgets a unit whose file is gone when it has nothing else to do.
  wait_until 5 inside sh -c '! systemctl --no-legend list-units --all "lodesman*" | grep -q .' ||
    fail "units are left: $(inside systemctl --no-legend list-units --all "lodesman*")"
}

[ "$(id -u)" -eq 0 ] || fail "wants root"
install_packages $package_packages $booted_packages
unshare --net ip link add boat type veth peer name shore || {
  say "NOT TRIED: this machine joins no networks, so that nothing can be commanded from outside"
  exit 0
}
quietly cmake --preset release -DBUILD_TESTING=ON
quietly cmake --build --preset release --target hang_task
deploy/package.sh --release 2
cp build/release/package/lodesman_*-2_*.deb "$place/2.deb"
deploy/package.sh
cp build/release/package/lodesman_*-1_*.deb "$place/1.deb"
version=$(build/release/bin/lodesman --version)
lintian --allow-root --fail-on error,warning --tag-display-limit 0 build/release/package/*.deb build/release/package/*.ddeb ||
  fail "lintian"

start=$(now_ms)
# shellcheck disable=SC2046  # names of packages
make_root "$place/root" systemd-sysv dbus $(needs_of "$place/1.deb") || fail "no root directory of Debian could be made"
row "a root directory of Debian" $(($(now_ms) - start))
mkdir "$place/root/srv/package"
cp "$place"/[12].deb build/release/bin/hang_task "$place/root/srv/package/"
bring_up
install_it
judge_words
judge_exposure
judge_console
meet_devices
sail
interrupt KILL high "$kills" "lodesman-high killed"
interrupt KILL low "$kills" "lodesman-low killed"
interrupt STOP high 1 "lodesman-high frozen"
interrupt STOP low 1 "lodesman-low frozen"
hang high planner
hang low delta_t
wait_until 20 device_is sonar '"status":"working"' || fail "the sonar does not come back"
judge_recordings
upgrade_it
purge_it
print_table "in the booted machine"
say "the boat in a booted machine: all as it should be"
