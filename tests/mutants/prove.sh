#!/usr/bin/env bash
# Proves that `crosscheck regress` detects defects in mysim: runs each mutation of mutations.txt, and unmodified mysim,
# against the shipped baselines. Exits with 1 if a defect is not detected, or if unmodified mysim fails.
#
#   tests/mutants/prove.sh [NAME]...     without names, all mutations, which takes 40 minutes
#
# Environment: FILTER: glob of the cases to run, as in `regress --filter`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

cmake --preset release >/dev/null
cmake --build build/release --target crosscheck_mutants >/dev/null
mapfile -t all < <(sed -n 's/^== //p' tests/mutants/mutations.txt)
[ $# -gt 0 ] || set -- "${all[@]}"
for name; do
  grep -qx "== $name" tests/mutants/mutations.txt || { printf 'prove.sh: %s: no such mutation in mutations.txt\n' "$name" >&2; exit 2; }
done

caught() { # NAME: true if regress fails
  local status=0
  CROSSCHECK_MUTANT=$1 build/release/crosscheck-mutants regress --figures 0 --filter "${FILTER:-*}" \
    --out out/mutants >out/mutants.txt || status=$?
  [ "$status" -le 1 ] || { printf 'prove.sh: %s: no verdict\n' "$1" >&2; exit 2; }
  [ "$status" -eq 1 ]
}

mkdir -p out
escaped=0
for name; do
  if caught "$name"; then
    printf 'caught   %-32s %s\n' "$name" "$(grep -m1 ' quantities: ' out/mutants.txt)"
  else
    printf 'ESCAPED  %s\n' "$name"
    escaped=$((escaped + 1))
  fi
done
if caught none; then
  printf 'CAUGHT   unmodified mysim\n'
  escaped=$((escaped + 1))
fi
printf '%d of %d mutations caught\n' "$(($# - escaped))" "$#"
[ "$escaped" -eq 0 ]
