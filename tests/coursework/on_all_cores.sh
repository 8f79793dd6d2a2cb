#!/usr/bin/env bash
# Runs a test program in parts, several for each core: on_all_cores.sh PROGRAM ARGUMENTS...
set -euo pipefail
parts=$((6 * $(nproc)))
seq 0 $((parts - 1)) |
  GTEST_TOTAL_SHARDS=$parts xargs -P "$(nproc)" -I PART env GTEST_SHARD_INDEX=PART "$@" --gtest_brief=1
