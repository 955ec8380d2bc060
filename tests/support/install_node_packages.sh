#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs packages from npm's registry that tests alone use, as the package-lock.json of each directory
# pins them, into build/<its name>, for all builds of this tree: what recordings are read with (mcap), the
# console's protocol is spoken with (foxglove) and its page is driven with (console). Where there is no npm
# (deploy/packages.sh names the packages) those tests are skipped, and with CI=true they fail.
set -eu
cd "$(dirname "$0")/../.."
for from in tests/system/mcap tests/system/foxglove tests/console; do
  there=build/$(basename "$from")
  mkdir -p "$there"
  cp "$from/package.json" "$from/package-lock.json" "$there"
  (cd "$there" && npm ci --no-audit --no-fund --loglevel=error)
done
