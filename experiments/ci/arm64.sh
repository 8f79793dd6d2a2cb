#!/usr/bin/env bash
# Cross-compiles mysim and its unit tests for ARM64. Runs the fast tests under qemu-user, and the golden hashes and
# projections, which must equal those of x86-64 (reference/baselines/golden-hashes.csv, implicit-projections.csv).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(sudo)
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends cmake ninja-build \
  g++-aarch64-linux-gnu qemu-user-static libgtest-dev libeigen3-dev libfmt-dev nlohmann-json3-dev libtomlplusplus-dev \
  >/dev/null
cmake --preset arm64 >/dev/null
cmake --build build/arm64 --target unit_mysim unit_mysim_slow
ctest --test-dir build/arm64 -j "$(nproc)" --output-on-failure -R "^Golden" -L slow
# these four tests search /proc for killed processes, where qemu-user itself appears
ctest --test-dir build/arm64 -j "$(nproc)" --output-on-failure -L fast -E "^TemporaryFolders\.(ThoseOf|FilesOf|Nothing|What)"
