#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs what tests/system/console.cpp speaks to the console with, for all builds of this tree: the
# protocol's own client from npm, as package-lock.json pins it. Where there is no npm that test is skipped,
# and with CI=true it fails.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
there=$here/../../../build/foxglove
mkdir -p "$there"
cp "$here/package.json" "$here/package-lock.json" "$there"
cd "$there"
exec npm ci --no-audit --no-fund --loglevel=error
