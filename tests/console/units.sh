#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The tests of the page's pure parts, by node's own runner (18 or newer). Without node they are skipped,
# and with CI=true they fail, unless LODESMAN_WITHOUT_NPM says that .ci/run could not have it.
set -eu
cd "$(dirname "$0")"
if ! command -v node >/dev/null; then
  echo "skipped: no node"
  [ "${CI:-}" != true ] || [ -n "${LODESMAN_WITHOUT_NPM:-}" ] || exit 1
  exit 77
fi
exec node --test ./*.test.mjs
