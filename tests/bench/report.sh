#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Measures the path finder beside others on fresh random frames, as built for any x86-64 and as built
# for this very processor, and writes the tables of docs/performance.md.
set -eu
cd "$(dirname "$0")/../.."
. deploy/packages.sh

# With OMPL's column: the bench can do without, its tables should not.
install_packages $build_packages $test_packages $bench_packages libompl-dev
say "bench (build/release)"
quietly cmake --preset release -DLODESMAN_BENCH=ON
quietly cmake --build --preset release --target bench_path bench_path_native
seed=$(od -An -N4 -tu4 /dev/urandom | tr -d ' ')
build/release/bin/bench_path --seed "$seed" --markdown docs/performance.md
build/release/bin/bench_path_native --seed "$seed" --brief --markdown docs/performance.md
