#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs what tests/system/recorder.cpp reads recordings with, for all builds of this tree: npm's
# packages as package-lock.json pins them. Where there is no npm (deploy/packages.sh names the packages)
# those tests are skipped, and with CI=true they fail.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
there=$here/../../../build/mcap
mkdir -p "$there"
cp "$here/package.json" "$here/package-lock.json" "$there"
cd "$there"
exec npm ci --no-audit --no-fund --loglevel=error
