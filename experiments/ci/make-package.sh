#!/usr/bin/env bash
# Builds crosscheck.deb and python3-crosscheck.deb of this tree in build/release. Works in a minimal Debian, too.
set -euo pipefail
cd "$(dirname "$0")/../.."
export CI=1
# the wrapper `crosscheck` installs the packages that a command needs; this command also builds the module for the
# page's lab
./crosscheck lab pendulum -o build/lab.html
as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(sudo)
# the version of the package contains the commit, which is read with git
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends dpkg-dev file git gzip \
  >/dev/null
cmake --build build/release --target products
cd build/release
cpack -G DEB
cpack --config ../../report/python/deb.cmake
