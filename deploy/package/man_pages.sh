#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# A manual page for each program and each word of `lodesman`, made from what they say of themselves with
# --help, so that page and program agree.
#   deploy/package/man_pages.sh PROGRAMS RUNTIME_PAGES BENCH_PAGES
set -eu
programs=$1
runtime=$2
bench=$3
mkdir -p "$runtime" "$bench"
version=$("$programs/lodesman" --version)

# page <directory> <name> <program> [word]: the first line of its help says in a sentence what it is.
page() {
  said=$("$programs/$3" ${4:+"$4"} --help)
  help2man --no-info --section=1 --version-string="$version" --source="Lodesman $version" \
    --manual="Lodesman" --name="$(printf '%s\n' "$said" | grep -m 1 .)" \
    "$programs/$3${4:+ $4}" |
    sed "s/^\.TH .* \"1\"/.TH $(printf '%s' "$2" | tr '[:lower:]' '[:upper:]') \"1\"/
      /^\.SH NAME/ { n; s/.* \\\\-/$2 \\\\-/ }" |
    gzip -9n >"$1/$2.1.gz"
}

page "$runtime" lodesman lodesman
page "$runtime" lodesman-low lodesman-low
page "$runtime" lodesman-high lodesman-high
page "$runtime" lodesman-recorder lodesman-recorder
page "$runtime" lodesman-console lodesman-console
page "$bench" lodesman-bench lodesman-bench
page "$bench" lodesman-devices lodesman-devices
for word in $("$programs/lodesman" --help | awk '/^Subcommands:/ { on = 1; next } on && /^  [a-z]/ { print $1 }'); do
  case $word in
    sim | hil | segment | plot | replay) page "$bench" "lodesman-$word" lodesman "$word" ;;
    *) page "$runtime" "lodesman-$word" lodesman "$word" ;;
  esac
done
