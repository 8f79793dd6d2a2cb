#!/usr/bin/env bash
# Makes crosscheck.deb and python3-crosscheck.deb of this tree in build/release, in a Debian of nothing but its minimum
# too.
set -euo pipefail
cd "$(dirname "$0")/../.."
export CI=1
# the wrapper installs what its commands need: with this one the module of the page's lab is built as well
./crosscheck lab pendulum -o build/lab.html
as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(sudo)
# git names the commit in the package
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends dpkg-dev file git gzip \
  >/dev/null
cmake --build build/release --target products
cd build/release
cpack -G DEB
cpack --config ../../report/python/deb.cmake
