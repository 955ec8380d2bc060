#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The page in a browser, on a simulated boat of the programs in $1 (page.mjs). Needs node 18, what
# install_node_packages.sh brings, and a chromium; without one of them it is skipped, and with CI=true it fails, unless
# LODESMAN_WITHOUT_NPM says that npm's registry is out of reach. Further arguments are page.mjs's.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
packages=$here/../../build/console
skip() {
  echo "skipped: no $1"
  [ "${CI:-}" != true ] || [ -n "${LODESMAN_WITHOUT_NPM:-}" ] || exit 1
  exit 77
}
node -e 'process.exit(Number(process.versions.node.split(".")[0]) < 18 ? 1 : 0)' 2>/dev/null || skip "node 18"
[ -d "$packages/node_modules/playwright-core" ] || skip "playwright-core (tests/support/install_node_packages.sh)"
[ -x "${CHROMIUM:-/usr/bin/chromium}" ] || skip chromium
bin=$1
shift
[ -x "$bin/lodesman-console" ] || skip "lodesman-console in $bin"
exec node "$here/page.mjs" "$packages" --bin "$bin" --page "$here/../../deploy/operator/console/page" "$@"
