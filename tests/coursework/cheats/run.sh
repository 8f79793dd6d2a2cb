#!/usr/bin/env bash
# Runs the whole cheat corpus in both sandboxes: no trick may earn a point, harm another part, or leave anything behind.
# cheats/run.sh BUILD: BUILD is the folder of a build, which the script first brings up to date.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$(realpath "${1:?expected the folder of a build, as build/release}")
cmake --build "$build" --target coursework_cheats no_namespaces
programs=$build/tests/coursework
export CROSSCHECK_CACHE=$build/cache

echo "== sandbox bwrap, and archives"
"$here/on_all_cores.sh" "$programs/coursework_cheats" --gtest_filter='-*/uid_*'

echo "== sandbox uid, in a container that forbids namespaces"
if [ "$(id -u)" -ne 0 ]; then
  echo "not run: only root can become another user" >&2
  exit 1
fi
"$here/on_all_cores.sh" "$programs/no_namespaces" "$programs/coursework_cheats" --gtest_filter='*/uid_*'
