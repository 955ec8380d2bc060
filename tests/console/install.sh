#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs what tests/console/page.mjs drives a browser with, for all builds of this tree: npm's packages as
# package-lock.json pins them. The browser is Debian's (chromium), or the one that CHROMIUM names.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
there=$here/../../build/console
mkdir -p "$there"
cp "$here/package.json" "$here/package-lock.json" "$there"
cd "$there"
exec npm ci --no-audit --no-fund --loglevel=error
