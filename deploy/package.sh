#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The Debian packages, in build/release/package, of the programs in build/release, which are built
# where they are not up to date. The same source gives the same bytes, wherever it lies and whenever it
# is packed: every date is the commit's.
#   deploy/package.sh [--release N]   the Debian revision, 1 without it
#   deploy/package.sh --reproduce     instead: builds and packs two copies elsewhere, and compares them
set -eu
cd "$(dirname "$0")/.."
. deploy/packages.sh
release=1
reproduce=false
while [ $# -gt 0 ]; do
  case $1 in
    --release) release=$2; shift ;;
    --reproduce) reproduce=true ;;
    *) say "$1: no such option"; exit 2 ;;
  esac
  shift
done
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH LC_ALL=C TZ=UTC
umask 022
packages=build/release/package

changelog() {
  printf 'lodesman (%s) unstable; urgency=medium\n\n  * What is new is told by the commits.\n\n' "$1"
  printf ' -- Lodesman maintainers <maintainers@lodesman.invalid>  %s\n' \
    "$(date -R -d "@$SOURCE_DATE_EPOCH")"
}

# CPack 3.25 lists the sums of debug symbols by the build's own paths, and gives them no documents: the
# sums are listed anew, and the documents are those of the package that the symbols are of.
mend_symbols() {
  for file in $packages/*.ddeb; do
    tree=$(mktemp -d)
    name=$(dpkg-deb -f "$file" Package)
    dpkg-deb -R "$file" "$tree/all"
    (cd "$tree/all" && find usr -type f -exec chmod 644 {} + &&
      find usr -type f -exec md5sum {} + | sort -k 2 >DEBIAN/md5sums &&
      mkdir -p usr/share/doc && ln -s "${name%-dbgsym}" "usr/share/doc/$name")
    dpkg-deb --root-owner-group -b "$tree/all" "$file" >/dev/null
    rm -rf "$tree"
  done
}

pack() {
  rm -rf $packages/man-* $packages/*.deb $packages/*.ddeb $packages/_CPack_Packages
  deploy/package/man_pages.sh build/release/bin $packages/man-runtime $packages/man-bench
  changelog "$(build/release/bin/lodesman --version)-$release" | gzip -9n >$packages/changelog.Debian.gz
  (cd build/release && quietly cpack -G DEB -D CPACK_DEBIAN_PACKAGE_RELEASE="$release")
  rm -rf $packages/_CPack_Packages
  mend_symbols
}

# Two copies of the newest commit, in places of different names and depths. A compiler's cache is no
# proof, and may write paths of its own.
compare_copies() {
  place=$(mktemp -d)
  trap 'rm -rf "$place"' EXIT
  for copy in one deeper/another; do
    git clone --quiet . "$place/$copy"
    (cd "$place/$copy" && CCACHE_DISABLE=1 deploy/package.sh --release "$release")
  done
  (cd "$place/one/$packages" && sha256sum -- *.deb *.ddeb) >"$place/sums"
  (cd "$place/deeper/another/$packages" && sha256sum --check "$place/sums")
}

install_packages $build_packages $package_packages
if $reproduce; then
  compare_copies
  exit
fi
quietly cmake --preset release
quietly cmake --build --preset release --target lodesman lodesman-low lodesman-high lodesman-recorder lodesman-console \
  lodesman-bench lodesman-devices
pack
say "packages: $(cd $packages && echo *.deb *.ddeb)"
