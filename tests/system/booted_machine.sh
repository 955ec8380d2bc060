# SPDX-License-Identifier: Apache-2.0
# A Debian of the boat's own, for what boots it: its root directory, the boat's configuration on emulated
# devices, what the boat says of itself, the table of times, and a machine of it under systemd-nspawn. To
# be sourced by bash, with a directory of the run's in `place`; wants root.

# fail <word...>: what went wrong, and the end.
fail() {
  echo "booted: $*" >&2
  exit 1
}

# needs_of <package file...>: the packages that they depend on and are not among them, one a line.
needs_of() {
  local file
  for file in "$@"; do
    dpkg-deb -f "$file" Depends | tr ',' '\n' | sed 's/|.*//; s/(.*//; s/ //g'
  done | grep -v '^lodesman' | sort -u
}

# make_root <directory> <package...>: this machine's own release of Debian with these packages, from
# this machine's own sources, of which it keeps none: it is offline. mmdebstrap is given `root_options`
# too, where there are any.
root_options=()
make_root() {
  local root=$1 sources=/etc/apt/sources.list.d/debian.sources
  shift
  [ -f "$sources" ] || sources=/etc/apt/sources.list
  # shellcheck disable=SC2016  # the hook has a shell of its own
  mmdebstrap --quiet --mode=root --variant=minbase --format=directory \
    --aptopt='APT::Install-Recommends "false"' --include="$(IFS=, && echo "$*")" "${root_options[@]}" \
    --customize-hook='rm -rf "$1"/etc/apt/sources.list "$1"/etc/apt/sources.list.d/*' \
    "$(. /etc/os-release && echo "$VERSION_CODENAME")" "$root" - <"$sources"
}

# boat_toml <port> [<host> [<ahrs> <position> <thrusters>]]: the boat's configuration on the devices of
# lodesman-devices. Real drivers all of them; the sonar's program is on that host, without it this
# computer, and sends to that port; the serial ports are those, or the names in /dev/lodesman.
boat_toml() {
  cat <<END
[boat]
name = "booted"

[devices]
heading = "nav440:${3:-/dev/lodesman/ahrs}"
sonar = "delta_t:${2:-127.0.0.1}?port=$1"
position = "nmea:${4:-/dev/lodesman/gps}?baud=38400"
thrusters = "maestro:${5:-/dev/lodesman/thrusters}"
END
}

# boot <root> <network namespace> <log> <bind...>: until it is up; <bind> as nspawn takes it. Leaves
# its first process in `machine`, and nspawn's in `nspawn`.
boot() {
  local root=$1 network=$2 log=$3 bind binds=()
  shift 3
  for bind in "$@"; do
    binds+=("--bind=$bind")
  done
  # CAP_BPF and the call: without them the units' lists of devices are not enforced, and nobody says so.
  UNIFIED_CGROUP_HIERARCHY=1 setsid systemd-nspawn --register=no --keep-unit --quiet -M lodesman-booted \
    --network-namespace-path="/run/netns/$network" --capability=CAP_BPF,CAP_SYS_ADMIN --system-call-filter=bpf \
    -b -D "$root" "${binds[@]}" --console=pipe systemd.unit=multi-user.target </dev/null >"$log" 2>&1 &
  nspawn=$!
  machine=
  wait_until 30 has_first_process || { cat "$log" >&2; fail "systemd-nspawn boots nothing here"; }
  wait_until 60 inside systemctl --quiet is-active multi-user.target || {
    cat "$log" >&2
    fail "the machine does not come up"
  }
}

has_first_process() {
  machine=$(pgrep -P "$nspawn" -x systemd)
}

# inside <command...>: in the booted machine, as its root.
inside() {
  nsenter -t "$machine" -m -u -i -n -p -C -- "$@"
}

# power_off: an orderly end. nspawn itself is never killed: what it booted would live on.
power_off() {
  [ -n "${machine:-}" ] || return 0
  kill -RTMIN+4 "$machine" 2>/dev/null || true
  wait "$nspawn" 2>/dev/null || true
  machine=
  # Where systemd is not this machine's own, nspawn leaves empty control groups.
  [ -d /run/systemd/system ] ||
    find /sys/fs/cgroup/unified /sys/fs/cgroup/systemd -mindepth 1 -depth -type d -empty \
      -exec rmdir {} \; 2>/dev/null || true
}

# row <what> <milliseconds...>: of the table; what has been there before becomes one row with that.
row() {
  local what=$1
  shift
  printf '%s\t%s\n' "$what" "$1" >>"$place/table"
  [ $# -eq 1 ] || row "$what" "${@:2}"
}

# print_table <where>: of all rows: how often, the median and the worst.
print_table() {
  local what
  printf '\n| %s | times | median s | worst s |\n|---|---|---|---|\n' "$1"
  awk -F '\t' '!seen[$1]++ { print $1 }' "$place/table" | while IFS= read -r what; do
    awk -F '\t' -v what="$what" '$1 == what { print $2 }' "$place/table" | sort -n |
      awk -v what="$what" '{ v[NR] = $1 / 1000 }
        END { printf "| %s | %d | %.2f | %.2f |\n", what, NR, v[int((NR + 1) / 2)], v[NR] }'
  done
}

# Of what `boat_says`, which whoever sources this file defines: `lodesman status --json` on one line.
mission_is() {
  [ "$(boat_says | grep -o '"state":"[a-z_]*"' | head -n 1)" = "\"state\":\"$1\"" ]
}
device_is() { # device_is <device> <words in what is said of it>
  boat_says | grep -q "\"$1\":{[^}]*$2"
}
# Nothing is missing for a start but the arming.
ready_to_arm() {
  boat_says | grep -q '"against_arming":\[\]'
}

# now_ms, and wait_until <seconds> <command...>: true as soon as the command is.
now_ms() {
  date +%s%3N
}
wait_until() {
  local end=$(($(now_ms) + $1 * 1000))
  shift
  until "$@" >/dev/null 2>&1; do
    [ "$(now_ms)" -lt $end ] || return 1
    sleep 0.05
  done
}
