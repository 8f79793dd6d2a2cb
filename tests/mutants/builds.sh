#!/usr/bin/env bash
# Proves that `crosscheck regress` raises no false alarm for builds that differ only in rounding. Builds Crosscheck with
# other compilers and options (in build/builds/, five to ten minutes each the first time) and runs each build against
# the shipped baselines. Exits with 1 if one of them fails.
#
#   tests/mutants/builds.sh [NAME]...     without names, all builds
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# without optimisation everything takes up to 350 times as long, and all scenes would take an hour
small='!(cloth*|flag*|jelly*)'
# name|compiler|build type|flags|filter; without a compiler: build/release with the C library's unfused sin, exp and pow
builds=(
  'gcc-O3|g++|Release|-O3 -DNDEBUG|*'
  'gcc-O2|g++|Release|-O2 -DNDEBUG|*'
  'gcc-assert|g++|Debug|-O2|*'
  "gcc-debug|g++|Debug|-g|$small"
  'clang-O3|clang++|Release|-O3 -DNDEBUG|*'
  'clang-O2|clang++|Release|-O2 -DNDEBUG|*'
  "clang-debug|clang++|Debug|-g|$small"
  'gcc-O3-avx2|g++|Release|-O3 -DNDEBUG -march=x86-64-v3|*' # Eigen fuses multiply-adds regardless of -ffp-contract
  'no-fma||||*'
)

fused() { grep -q '^flags.* avx2 ' /proc/cpuinfo && grep -q '^flags.* fma ' /proc/cpuinfo; }
mkdir -p out
wrong=0
for build in "${builds[@]}"; do
  IFS='|' read -r name compiler type flags filter <<<"$build"
  [ $# -eq 0 ] || [[ " $* " == *" $name "* ]] || continue
  case $name in
    gcc-O3-avx2 | no-fma) fused || { printf 'not here  %s: a processor with AVX2 and fused multiply-adds\n' "$name"; continue; } ;;
  esac
  folder=build/release environment=()
  if [ -z "$compiler" ]; then
    cmake --preset release >/dev/null
    environment=("GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F")
  else
    command -v "$compiler" >/dev/null || { printf 'not here  %s: %s\n' "$name" "$compiler"; continue; }
    folder=build/builds/$name
    cmake -S . -B "$folder" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE="$type" \
      -DCMAKE_CXX_FLAGS_"${type^^}"="$flags" >/dev/null
  fi
  cmake --build "$folder" --target crosscheck bullet32_engine >/dev/null
  state=passed
  env "${environment[@]}" "$folder/crosscheck" regress --figures 0 --filter "$filter" --out out/builds \
    >out/builds.txt || { state=FAILED wrong=1; }
  printf '%-9s %-12s %s\n' "$state" "$name" "$(grep -m1 ' quantities: ' out/builds.txt)"
done
exit "$wrong"
