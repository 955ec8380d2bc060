#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs what tests/system/recorder.cpp reads recordings with, into a build: npm's packages as
# package-lock.json pins them. Where there is no npm nothing is installed, and those tests are skipped.
#   tests/system/mcap/install.sh [BUILD_DIRECTORY]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
there=${1:-build/release}/tests/system/mcap
if ! command -v npm >/dev/null; then
  echo "lodesman: no npm: recordings are not read by other people's libraries" >&2
  exit 0
fi
mkdir -p "$there"
cp "$here/package.json" "$here/package-lock.json" "$here/read.js" "$there"
cd "$there"
npm ci --no-audit --no-fund --loglevel=error >/dev/null
