#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds the bench of the path finder and runs a short one on fresh random frames: fails where two
# planners disagree on a cost, or where a step is less than 120 times as fast as the reference A* at
# the median. Six such runs gave 249 to 311: the slack is for busy machines and for few frames.
set -eu
cd "$(dirname "$0")/../.."
. deploy/packages.sh

install_packages $build_packages $test_packages $bench_packages
say "bench (build/release)"
quietly cmake --preset release -DLODESMAN_BENCH=ON
quietly cmake --build --preset release --target bench_path
exec build/release/bin/bench_path --frames 5 --repetitions 3 --gate 120
