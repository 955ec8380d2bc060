# SPDX-License-Identifier: Apache-2.0
# A virtual machine (qemu, its processor emulated) with a Debian of its own, three USB adapters to what
# lodesman-devices has on this machine, and a network of the test's own around it. To be sourced by bash
# behind booted_machine.sh, with a directory of the run's in `place`, the package in it as lodesman.deb, and
# the place of the machine's disk in `image`; wants root. Whoever sources this calls drop_network at the
# end, whatever the end is. nsenter is called as it is, and not in_net, where something is left running:
# `$!` is then the program's own.

# In this network no port is taken. The boat and the shore see each other beyond loopback: the shore's is
# an address for documentation (RFC 5737); 10.0.2.2 is what the machine knows as its host.
network=lodesman-vm-$$
shore=192.0.2.1
host=10.0.2.2
sonar_port=4040
command_port=7447
# The first process of a machine as slow as this one, on a busy host, may not run for ten seconds.
watchdog_s=30
machine=
events=
declare -A cables=()

make_network() {
  ip netns add "$network"
  ip -n "$network" link set lo up
  ip -n "$network" address add $shore/32 dev lo
}
drop_network() {
  [ -z "$machine" ] || power_cut
  ip netns del "$network" 2>/dev/null || true
}

in_net() {
  nsenter --net="/run/netns/$network" "$@"
}
# inside <command...>: in the machine, as its root, by its shell. One session for all.
inside() {
  in_net ssh -q -i "$image/key" -o StrictHostKeyChecking=no -o UserKnownHostsFile=/dev/null \
    -o ConnectTimeout=20 -o ServerAliveInterval=5 -o ControlMaster=auto -o ControlPersist=60 \
    -o "ControlPath=$place/ssh" "root@$shore" "$@"
}
# Of a machine that is gone.
end_session() {
  ssh -q -o "ControlPath=$place/ssh" -O exit "root@$shore" 2>/dev/null || true
  rm -f "$place/ssh"
}

# No drivers for what it does not have, and an initrd of what it needs until its disk is there.
make_image() {
  local root=$place/root kind
  [ ! -f "$image/disk" ] || return 0
  mkdir -p "$image"
  rm -f "$image"/key*
  ssh-keygen -q -t ed25519 -N '' -f "$image/key"
  for kind in gpu net/ethernet net/wireless infiniband scsi iio; do
    root_options+=("--dpkgopt=path-exclude=*/lib/modules/*/kernel/drivers/$kind/*")
  done
  # shellcheck disable=SC2016  # the hooks have a shell of their own
  root_options+=(
    --setup-hook='mkdir -p "$1"/etc/initramfs-tools/conf.d "$1"/usr/share/initramfs-tools/modules.d'
    --setup-hook='printf "MODULES=list\nCOMPRESS=zstd\n" >"$1"/etc/initramfs-tools/conf.d/small'
    --setup-hook='printf "virtio_pci\nvirtio_blk\next4\ni6300esb\n" >"$1"/usr/share/initramfs-tools/modules.d/vm')
  # shellcheck disable=SC2046  # names of packages
  make_root "$root" systemd-sysv udev dbus kmod zstd iproute2 openssh-server linux-image-amd64 \
    $(needs_of "$place/lodesman.deb") || fail "no root directory of Debian could be made"
  furnish "$root"
  cp "$root"/boot/vmlinuz-* "$image/vmlinuz"
  cp "$root"/boot/initrd.img-* "$image/initrd"
  truncate -s 1200M "$image/disk.part"
  mke2fs -q -t ext4 -d "$root" "$image/disk.part"
  mv "$image/disk.part" "$image/disk"
  rm -rf "$root"
}
furnish() { # furnish <root directory>
  echo "/dev/vda / ext4 defaults,errors=remount-ro 0 1" >"$1/etc/fstab"
  install -d -m 700 "$1/root/.ssh"
  cp "$image/key.pub" "$1/root/.ssh/authorized_keys"
  printf '[Match]\nMACAddress=52:54:00:12:34:56\n[Network]\nAddress=10.0.2.15/24\nGateway=%s\n' $host \
    >"$1/etc/systemd/network/10-vm.network"
  mkdir -p "$1/etc/systemd/system.conf.d"
  printf '[Manager]\nRuntimeWatchdogSec=%ds\n' $watchdog_s >"$1/etc/systemd/system.conf.d/watchdog.conf"
  chroot "$1" systemctl -q enable systemd-networkd
  chroot "$1" systemctl -q mask apt-daily.timer apt-daily-upgrade.timer
}

# adapter <name> <port>: a USB serial adapter, plugged in exactly while its socket has a client.
adapter() {
  adapters+=(-chardev "socket,id=$1,path=$place/$1.sock,server=on,wait=off"
    -device "usb-serial,chardev=$1,bus=xhci.0,port=$2,id=usb-$1,serial=${1^^}")
}

switch_on() {
  local adapters=() forwards=hostfwd=tcp:$shore:22-:22
  forwards+=,hostfwd=tcp:$shore:$command_port-:$command_port,hostfwd=udp:127.0.0.1:$sonar_port-:$sonar_port
  rm -f "$place"/*.sock "$place/qmp"
  adapter ahrs 1
  adapter position 2
  adapter thrusters 3
  nsenter --net="/run/netns/$network" setsid nice -n 5 \
    qemu-system-x86_64 -nodefaults -no-user-config -display none -machine q35 \
    -accel tcg,thread=multi,tb-size=256 -cpu max -smp 2 -m 512 \
    -kernel "$image/vmlinuz" -initrd "$image/initrd" \
    -append "root=/dev/vda rw console=ttyS0 quiet loglevel=4 mitigations=off systemd.show_status=0" \
    -drive "file=$place/run.qcow2,if=virtio,format=qcow2,cache=writeback" \
    -netdev "user,id=n0,$forwards" \
    -device virtio-net-pci,netdev=n0,romfile=,mac=52:54:00:12:34:56 \
    -object rng-random,filename=/dev/urandom,id=rng0 -device virtio-rng-pci,rng=rng0 \
    -chardev "file,id=con,path=$place/console.log,append=on" -device isa-serial,chardev=con \
    -qmp "unix:$place/qmp,server=on,wait=off" \
    -device qemu-xhci,id=xhci "${adapters[@]}" \
    -device i6300esb -action watchdog=reset </dev/null >>"$place/qemu.log" 2>&1 &
  machine=$!
  wait_until 20 test -S "$place/qmp" || fail "qemu does not start: $(cat "$place/qemu.log")"
  # What the machine's hardware tells, the watchdog's bite among it.
  echo '{"execute":"qmp_capabilities"}' |
    socat STDIO,ignoreeof "UNIX-CONNECT:$place/qmp" >>"$place/events" 2>/dev/null &
  events=$!
}
# power_cut: at once, with all its cables.
power_cut() {
  kill -9 "$machine" 2>/dev/null || true
  wait "$machine" 2>/dev/null || true
  machine=
  [ -z "$events" ] || { kill "$events" 2>/dev/null && wait "$events" 2>/dev/null; } || true
  events=
  end_session
  local name
  for name in "${!cables[@]}"; do unplug "$name"; done
}
# plug <name>: a device's cable. The speed is that of emulated AHRS and receiver when they are switched on:
# what the machine sets in an adapter of qemu's goes no further.
plug() {
  socat "UNIX-CONNECT:$place/$1.sock" "OPEN:$(readlink -f "$place/ports/$1"),raw,echo=0,b38400" \
    2>>"$place/cables.log" &
  cables[$1]=$!
}
unplug() {
  kill "${cables[$1]}" 2>/dev/null || true
  wait "${cables[$1]}" 2>/dev/null || true
  unset "cables[$1]"
}
plug_all() {
  local name
  for name in ahrs position thrusters; do plug $name; done
}

boot_of() { # which boot of the machine it is
  inside cat /proc/sys/kernel/random/boot_id
}
is_up() { # is_up <the boot before>: and it is another one
  [ "$(boot_of)" != "$1" ] && inside systemctl is-system-running --wait | grep -q -E 'running|degraded'
}
services_are_up() { # both: of several that it is asked for, one is enough for systemctl
  inside 'systemctl --quiet is-active lodesman-low && systemctl --quiet is-active lodesman-high'
}
