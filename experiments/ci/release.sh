#!/usr/bin/env bash
# Makes the files of a release: Debian packages for both supported releases, the Python package, a sample report and the
# lab as single pages, and the checksums of all these files.
#
#   experiments/ci/release.sh [OUT]      OUT is out/release by default
#
# Runs on Debian 12 as root (.ci/bare-root provides Debian 13). Packages the commit that is checked out; refuses
# uncommitted changes, and versions that differ between the files that state them.
set -euo pipefail
cd "$(dirname "$0")/../.."
out=$(realpath -m "${1:-out/release}")

version=$(sed -nE 's/^project\(crosscheck VERSION ([0-9.]+) .*/\1/p' CMakeLists.txt)
for stated in CITATION.cff:"version: $version" report/python/pyproject.toml:"version = \"$version\"" \
  CHANGELOG.md:"## $version"; do
  grep -qxF -- "${stated#*:}" "${stated%%:*}" || { echo "${stated%%:*}: expected the line '${stated#*:}'"; exit 1; }
done
[ -z "$(git status --porcelain)" ] || { echo "uncommitted changes: commit them first"; exit 1; }

rm -rf "$out"
mkdir -p "$out"
export CI=1
echo "== Debian 12"
experiments/ci/make-package.sh
cp build/release/crosscheck.deb "$out/crosscheck_${version}_debian12_amd64.deb"
cp build/release/python3-crosscheck.deb "$out/python3-crosscheck_${version}_all.deb"

echo "== Debian 13"
# the bare root is removed when the command ends, so the package is written to standard output
BARE_SUITE=trixie .ci/bare-root sh -ec 'experiments/ci/make-package.sh >&2; cat build/release/crosscheck.deb' \
  >"$out/crosscheck_${version}_debian13_amd64.deb"
dpkg-deb --field "$out/crosscheck_${version}_debian13_amd64.deb" Version | grep -qF "$version"

echo "== Python package"
DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends python3-pip python3-setuptools python3-wheel \
  >/dev/null
/usr/bin/python3 -m pip wheel --quiet --no-deps --no-build-isolation --wheel-dir "$out" report/python

echo "== sample report and lab"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
./crosscheck report --quick --out "$work/report"
cp "$work/report/index.html" "$out/crosscheck-report-$version.html"
./crosscheck lab cloth-hang -o "$out/crosscheck-lab-$version.html"

cd "$out"
sha256sum -- * >SHA256SUMS
ls -l
