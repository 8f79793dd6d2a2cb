#!/usr/bin/env bash
# Cross-compiles the C++ hand-outs for Windows with MinGW-w64, and runs their `check` under Wine, on Debian 12.
#
#   experiments/ci/windows.sh [ASSIGNMENT]...      all assignments by default
#
# The untouched starter must compile, run to the end and earn less than all points; the official solution must pass all
# public tests. The hand-outs lie in a folder whose name is not ASCII, and lines of their texts end in CR LF.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(sudo)
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends cmake ninja-build \
  g++-mingw-w64-x86-64-posix wine64 >/dev/null
[ $# -gt 0 ] || set -- a1-steppers a2-pendulum a3-cloth a4-collision a5-stiff a6-solvers m1-misconceptions classic

work=$(mktemp -d)
export WINEPREFIX=$work/wine WINEDEBUG=-all PATH=$PATH:/usr/lib/wine
trap 'wineserver -k || true; rm -rf "$work"' EXIT

check() { # FOLDER STATUS: builds and runs `check`, which must end with the status; prints the sum of points
  local log=$1/check.log status=0
  cmake --build "$1/build" >"$log" || { cat "$log"; return 1; }
  (cd "$1" && wine64 build/check.exe) >"$log" 2>&1 || status=$?
  if [ "$status" -ne "$2" ] || ! grep -a '^Total: ' "$log" | tr -d '\r'; then
    tail -n 40 "$log"
    printf 'check.exe: expected status %d and a sum of points, got status %d\n' "$2" "$status"
    return 1
  fi
}

failed=()
for name; do
  printf '== %s\n' "$name"
  folder=$work/作业/hand-out # the same folder for all assignments, so that a compiler cache finds the files that they share
  rm -rf "$folder"
  ./crosscheck assignment "$name" --out "$folder" >/dev/null
  sed -i 's/$/\r/' "$folder"/check/*.txt
  cmake -S "$folder" -B "$folder/build" -G Ninja -DCMAKE_SYSTEM_NAME=Windows -DCMAKE_CXX_FLAGS=-Werror \
    -DCMAKE_CXX_COMPILER=x86_64-w64-mingw32-g++-posix -DCMAKE_EXE_LINKER_FLAGS=-static >/dev/null
  check "$folder" 1 || failed+=("$name (starter)")
  cp "tests/coursework/$name/solution/"* "$folder"
  check "$folder" 0 || failed+=("$name (solution)")
done
[ ${#failed[@]} -eq 0 ] || { printf 'failed: %s\n' "${failed[@]}"; exit 1; }
