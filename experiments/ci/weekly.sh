#!/usr/bin/env bash
# Slow tests that rarely fail. `./crosscheck test` and CI leave them out. Run all of them once a week and, before you
# finish a change, the parts that it affects:
#
#   experiments/ci/weekly.sh [PART]...     builds, then runs these parts; without arguments, all of them
#   experiments/ci/weekly.sh --tests       prints the regular expression of the tests that other runs leave out
#
#   regress     regress --full: the cases that take more than half a second, too
#   mutants     defects in mysim, each of which regress must detect
#   builds      regress on builds with other compilers and options
#   truth       reference solutions of many random scenes, and the sensitivity of every shipped scene
#   corpus      coursework: all solutions, styles, mistakes, mutants, cheats and odd programs, and all messages of classic
#   kill        reports under kill -9 at ten moments, and on a full disk
#   rehearsals  a new stepper, term, scene, engine and experiment, added as CONTRIBUTING.md describes
#   node        external engines and the lab's module in Node.js, Jolt from npm, the lab's longer tests in a browser
#   engines     adapters of other engines from Debian and npm, and a report of all of them
#   latex       a paper with a set of figures
#   sanitizers  the fast tests under address and undefined-behaviour sanitizers
#   arm64       mysim and its tests, cross-compiled, under qemu-user
#   windows     hand-outs of the coursework, cross-compiled, under Wine
#   debian-13   the README's commands in a bare Debian 13
#   testing     build, run, report, figures and the fast tests in a bare Debian testing
#
# Environment: CORPUS_SEEDS (2) and ODD_PROGRAMS (5) set how much of the corpus runs; 20 and 1000 take an hour.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

parts=(regress mutants builds truth corpus kill rehearsals node engines latex sanitizers arm64 windows debian-13 testing)
declare -A tests=( # names as ctest knows them; a part without tests runs something else
  [mutants]='CliRegress\.MutantsAreCaught'
  [truth]='ContactTruth\.BarsCoverThirty|FloorDrop\.TruthCovers|Scenes\.PerturbationsGrow'
  [corpus]='All/(EachCheat|OddPrograms|UnusualPrograms)\.|All/Corpus\..*/classic|Mutants\.LosePointsAtTheirPart'
  [kill]='OutputOfReport\.(KilledAtTenMoments|AFullDisk)'
  [rehearsals]='NewTerm\.|Adding\.'
  [node]='LabModule\.(AFinger|GivesTheNativeBits|GuidedExperimentsGoToTheirEndInEnglish|ScenesChangedByHand|SlidersChangeTheir)|ProtocolKit\.TheExampleInJavaScript|Both/Jolt\..*/npm'
  [engines]='ForPeople/Documents\.CommandsPrintWhatIsShown/engines'
  [latex]='FigureSet\.APaperWithTheSetCompiles'
)
tests[corpus]+='|All/Corpus\.(Known|Two).*/(a2_pendulum|a5_stiff|a6_solvers|m1_misconceptions)'
tests[corpus]+='|All/PythonPrograms\.WithAMistake.*/a2_pendulum|coursework\.cheats\.uid|HandoutCheck\.SaysOfAWholeProgram'
tests[corpus]+='|Classic\.(EveryWay|WhatKeeps)'
tests[node]+='|LabModule\.(ChangedScenes|MarksAre|BurstsAbove|NoFrame|KeysOf|DroppedFiles|StandsAs)'
declare -A packages=(
  [node]="nodejs chromium"
  [engines]="libmujoco-dev libsimbody-dev libode-dev nodejs npm esbuild"
  [latex]="texlive-latex-base"
)
expression() { # PARTS...: the tests of these parts
  local part joined=
  for part; do joined+=${tests[$part]:+|${tests[$part]}}; done
  printf '^(%s)' "${joined#|}"
}
if [ "${1:-}" = --tests ]; then
  expression "${parts[@]}"
  exit
fi
for part; do
  [[ " ${parts[*]} " = *" $part "* ]] || { sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$0" >&2; exit 2; }
done
[ $# -eq 0 ] || parts=("$@")

as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(sudo)
build=$PWD/build/release
failed=()
for part in "${parts[@]}"; do
  printf '== %s\n' "$part"
  begin=$SECONDS status=0
  if [ -n "${packages[$part]:-}" ]; then
    # shellcheck disable=SC2086  # several names
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends ${packages[$part]} >/dev/null
    rm -f "$build/build.ninja" # the earlier configuration did not find these packages
  fi
  case $part in
    regress) ./crosscheck regress --full --out out/regress || status=$? ;;
    mutants) tests/mutants/prove.sh || status=$? ;;
    builds) tests/mutants/builds.sh || status=$? ;;
    sanitizers) CROSSCHECK_PRESET=asan ./crosscheck test --fast || status=$? ;;
    engines)
      for engine in mujoco simbody ode cannon rapier mujoco3 jolt; do
        ./crosscheck engine "$engine" || status=$?
      done
      ./crosscheck report --engines all --quick --out out/engines || status=$?
      ;;
    arm64) experiments/ci/arm64.sh || status=$? ;;
    windows) experiments/ci/windows.sh || status=$? ;;
    debian-13) BARE_SUITE=trixie .ci/bare-root sh -exc './crosscheck report; ./crosscheck test' || status=$? ;;
    testing)
      BARE_SUITE=testing .ci/bare-root sh -exc './crosscheck run chain; ./crosscheck report --quick
        ./crosscheck figures chain; ./crosscheck test --fast' || status=$?
      ;;
  esac
  [ -z "${tests[$part]:-}" ] || ./crosscheck test --only "$(expression "$part")" || status=$?
  if [ "$part" = corpus ]; then
    CORPUS_SEEDS=${CORPUS_SEEDS:-2} ODD_PROGRAMS=${ODD_PROGRAMS:-5} tests/coursework/corpus.sh "$build" || status=$?
  fi
  [ "$status" -eq 0 ] || failed+=("$part")
  printf '== %s: %s after %d min\n' "$part" "$([ "$status" -eq 0 ] && echo passed || echo FAILED)" $(((SECONDS - begin + 30) / 60))
done
[ ${#failed[@]} -eq 0 ] || { printf 'failed: %s\n' "${failed[*]}"; exit 1; }
