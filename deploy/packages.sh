# SPDX-License-Identifier: Apache-2.0
# Debian packages, and how the set-up scripts install those that are missing. To be sourced.

build_packages="g++ cmake ninja-build pkg-config libeigen3-dev libboost-dev libspdlog-dev
  libopencv-core-dev libopencv-imgproc-dev libpng-dev libturbojpeg0-dev libtomlplusplus-dev
  libcli11-dev nlohmann-json3-dev libgeographiclib-dev libxxhash-dev libserialport-dev
  libusb-1.0-0-dev libsodium-dev libsystemd-dev libzstd-dev zlib1g-dev gnuplot-nox
  libjs-dygraphs"
test_packages="catch2"
# For tests/bench, which is built with -DLODESMAN_BENCH=ON.
bench_packages="libbenchmark-dev"
# For the presets asan, tsan, fuzz and tidy, and for the layout of the sources.
clang_packages="clang lld libclang-rt-14-dev clang-tidy clang-format-14"
# For tests/system/gpsd.cpp and, with gpsfake, gpsd_tracks.cpp, which are skipped without them. No
# part of test_packages: gpsd's udev rules hand USB serial adapters to it, which it probes, on
# whatever machine it is installed.
gpsd_packages="gpsd gpsd-clients"
# For deploy/package.sh, and for tests/system/booted_boat.sh, which boots what was packed.
package_packages="dpkg-dev file help2man"
booted_packages="iproute2 lintian mmdebstrap systemd-container"
# For tests/system/booted_vm.sh, which boots it in a virtual machine.
vm_packages="e2fsprogs iproute2 mmdebstrap openssh-client qemu-system-x86 qemu-utils socat"
# For tests/system/recorder.cpp, which reads recordings with npm's packages too, where
# tests/support/install_node_packages.sh has installed them.
recording_packages="nodejs npm"
# For tests/console/page.mjs: a browser for the page.
page_packages="chromium"
# For lodesman rt-test (its load, and cyclictest beside it) and for what is measured under load.
load_packages="stress-ng rt-tests"
# For tests/measure/perception.sh: what the judge of the shared real frames is written with.
perception_packages="python3-numpy python3-opencv"

say() { echo "lodesman: $*" >&2; }

# Runs a command as root: as it is, or through sudo.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

# Installs what is missing of the packages named; says nothing and asks nobody when none is.
install_packages() {
  missing=""
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q "ok installed" ||
      missing="$missing $package"
  done
  [ -z "$missing" ] && return 0
  say "installing$missing"
  as_root apt-get update -qq
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq -o Dpkg::Use-Pty=0 --no-install-recommends $missing >/dev/null
}

# Runs a command quietly; its output is shown only when it fails.
quietly() {
  log=$(mktemp)
  if ! "$@" >"$log" 2>&1; then
    cat "$log" >&2
    rm -f "$log"
    return 1
  fi
  rm -f "$log"
}
