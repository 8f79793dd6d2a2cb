#!/usr/bin/env bash
# Checks an engine, for CI: invariants that need no reference solution, then a comparison with its blessed results.
#
#   check-engine.sh ENGINE OUT [SCENE]...     ENGINE is a program of the engine protocol; OUT gets check/ and regress/,
#                                             with a page each; the default scenes are the small ones pendulum, chain
#
# Environment: PREPARE, a shell command to run first, such as the build of the engine; BASELINES, the folder of blessed
# results (crosscheck-baselines). Exit status: 0 nothing is broken or changed; 1 something is; 2 bad usage.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0" >&2; exit 2; }
engine=$1 out=$2
shift 2
scenes=("$@")
[ ${#scenes[@]} -gt 0 ] || scenes=(pendulum chain)
baselines=${BASELINES:-crosscheck-baselines}
[ -z "${PREPARE:-}" ] || bash -euxc "$PREPARE"

status=0
step() { # NAME COMMAND...: runs the command; status 1 is a negative answer, a higher status ends the script
  local name=$1 ended=0
  shift
  printf '== %s\n' "$*"
  "$@" || ended=$?
  [ "$ended" -le 1 ] || exit "$ended"
  [ "$ended" -eq 0 ] || status=1
  [ -z "${GITHUB_STEP_SUMMARY:-}" ] || printf -- '- %s: %s\n' "$name" "$([ "$ended" -eq 0 ] && echo passed || echo FAILED)" >>"$GITHUB_STEP_SUMMARY"
}

step check crosscheck check "exec:$engine" "${scenes[@]}" --out "$out/check"
if [ -d "$baselines" ]; then
  step regress crosscheck regress "${scenes[@]}" --method "exec:$engine" --baselines "$baselines" --out "$out/regress"
else
  printf 'no results are blessed yet; once you trust the engine, commit the folder that this command writes:\n  %s\n' \
    "crosscheck regress ${scenes[*]} --method exec:$engine --baselines $baselines --bless --reason \"first results\""
fi
exit "$status"
