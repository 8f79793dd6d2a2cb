#!/usr/bin/env bash
# Proves the job-array form of sweeps against a real Slurm on this machine: munge, slurmctld and slurmd on loopback, and
# an array of four tasks, one of which is killed and requeued. The joined tables must equal those of one plain run. Run
# it as root in a built tree, with Debian's slurmctld, slurmd, slurm-client and munge. Not part of the test suite.
set -euo pipefail

source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=$source/build/release/crosscheck
names=(order engines stiffness spring circle chain pendulum bounce cloth-hang)
work=$(mktemp -d)
say() { printf 'slurm: %s\n' "$*"; }
die() { say "$*" >&2; tail -n 20 "$work"/*.log "$work"/slurm-*.out >&2 2>/dev/null; exit 1; }
for tool in slurmctld slurmd sbatch scontrol squeue munged; do
  command -v "$tool" >/dev/null || { say "missing: $tool (apt-get install --no-install-recommends slurmctld slurmd slurm-client munge)"; exit 2; }
done
[ -x "$program" ] || { say "not built: ./crosscheck doctor"; exit 2; }

finish() {
  [ -f "$work/slurmd.pid" ] && kill "$(cat "$work/slurmd.pid")" 2>/dev/null
  [ -f "$work/slurmctld.pid" ] && kill "$(cat "$work/slurmctld.pid")" 2>/dev/null
  [ -n "${munge_pid:-}" ] && kill "$munge_pid" 2>/dev/null
  # the daemons write to this folder until they have ended
  for _ in $(seq 50); do rm -rf "$work" 2>/dev/null && return; sleep 0.2; done
}
trap finish EXIT

# the daemons
host=$(hostname -s)
mkdir -p "$work/spool" "$work/state" /run/munge
[ -s /etc/munge/munge.key ] || { dd if=/dev/urandom of=/etc/munge/munge.key bs=1024 count=1 status=none; chmod 400 /etc/munge/munge.key; chown munge: /etc/munge/munge.key; }
chown munge: /run/munge
if ! munge -n >/dev/null 2>&1; then
  runuser -u munge -- munged --foreground --force >"$work/munged.log" 2>&1 &
  munge_pid=$!
fi
cat >"$work/slurm.conf" <<CONF
ClusterName=proof
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
ProctrackType=proctrack/linuxproc
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
TaskPlugin=task/none
ReturnToService=2
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmdSpoolDir=$work/spool
StateSaveLocation=$work/state
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
MpiDefault=none
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
# a requeued task may start again at once
RequeueExit=
SchedulerParameters=batch_sched_delay=0,sched_interval=1
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
sed -i '/^RequeueExit=$/d' "$work/slurm.conf"
export SLURM_CONF=$work/slurm.conf
slurmctld -f "$SLURM_CONF" || die "slurmctld did not start"
slurmd -f "$SLURM_CONF" || die "slurmd did not start"
for _ in $(seq 50); do sinfo -h -o %t 2>/dev/null | grep -q idle && break; sleep 0.2; done
sinfo -h -o %t | grep -q idle || die "the node is not idle: $(sinfo -h)"
say "$(sinfo --version), one node, 2 CPUs"

# one plain run, then the array, each with its own cache, so that both compute
cd "$source"
CROSSCHECK_CACHE=$work/cache "$program" experiment "${names[@]}" --out "$work/plain" >"$work/plain.log" 2>&1 || die "the plain run failed"
job=$(CROSSCHECK_CACHE=$work/cache-array sbatch --parsable --array=1-4 --output="$work/slurm-%a.out" experiments/sweep/array.sbatch "$work/array" "${names[@]}")
say "array $job of 4 tasks"

# kills one task that has finished some of its points, but not all
state() { squeue -h -r -j "$job" -o '%K %t' 2>/dev/null; }
victim=
for _ in $(seq 600); do
  for part in 1 2; do
    done_points=$(ls "$work/array/part-$part/points" 2>/dev/null | grep -c '\.json$' || true)
    if [ "$done_points" -ge 1 ] && state | grep -q "^$part R"; then victim=$part; break 2; fi
  done
  sleep 0.05
done
[ -n "$victim" ] || die "no running task with a finished point was seen"
pkill -KILL -f -- "--shard $victim/4" || die "nothing to kill"
finished=$(ls "$work/array/part-$victim/points" | grep '\.json$' | sort)
times=$(cd "$work/array/part-$victim/points" && stat -c '%n %Y %i' $finished)
say "killed task $victim with $(wc -l <<<"$finished") finished points; requeued"
for _ in $(seq 50); do
  scontrol requeue "${job}_$victim" 2>/dev/null && break
  sleep 0.1
done

for _ in $(seq 1200); do [ -z "$(state)" ] && break; sleep 0.25; done
[ -z "$(state)" ] || die "the array did not end: $(state)"
again=$(cd "$work/array/part-$victim/points" && stat -c '%n %Y %i' $finished)
[ "$times" = "$again" ] || die "a finished point was computed again"

"$program" merge "$work"/array/part-* --out "$work/merged" >"$work/merge.log" 2>&1 || die "merge failed: $(cat "$work/merge.log")"
compared=0
for table in "$work"/plain/*.csv; do
  name=$(basename "$table")
  case $name in *-cost.csv) continue ;; esac
  cmp <(grep -v '^#' "$table") <(grep -v '^#' "$work/merged/$name") || die "$name differs"
  compared=$((compared + 1))
done
[ "$compared" -gt 5 ] || die "only $compared tables compared"
say "$compared tables of the array equal those of the plain run, byte for byte"
