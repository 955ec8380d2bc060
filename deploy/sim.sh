#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# From a bare Debian to a boat that avoids an obstacle: installs the packages, builds, and sails the
# paper's scenario in real time. Run it again and it goes straight to sailing.
set -eu
cd "$(dirname "$0")/.."
. deploy/packages.sh

install_packages $build_packages
say "building (build/release)"
quietly cmake --preset release -DBUILD_TESTING=OFF
quietly cmake --build --preset release
say "sailing paper-static in real time, about 100 s; Ctrl-C ends it"
exec build/release/bin/lodesman sim paper-static --profile paper "$@"
