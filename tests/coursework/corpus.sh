#!/usr/bin/env bash
# Tests the corpus of all assignments, then all cheats: corpus.sh BUILD. All mistakes with 20 seeds and all odd programs
# take an hour; CORPUS_SEEDS and ODD_PROGRAMS set these numbers.
set -euo pipefail
build=$(realpath "${1:?expected the folder of a build, as build/release}")
export CROSSCHECK_CACHE=$build/cache
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cmake --build "$build" --target coursework_corpus
CORPUS_SEEDS=${CORPUS_SEEDS:-20} CORPUS_MISTAKES=1000 ODD_PROGRAMS=${ODD_PROGRAMS:-1000} "$here/on_all_cores.sh" "$build/tests/coursework/coursework_corpus"
"$here/cheats/run.sh" "$build"
