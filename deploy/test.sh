#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# From a bare Debian to a tested build: installs the packages, builds everything, runs every test.
set -eu
cd "$(dirname "$0")/.."
. deploy/packages.sh

install_packages $build_packages $test_packages
say "building (build/release)"
quietly cmake --preset release -DBUILD_TESTING=ON
quietly cmake --build --preset release
say "testing"
exec ctest --preset release "$@"
