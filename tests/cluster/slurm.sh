#!/usr/bin/env bash
# A cluster of two nodes on this one machine: Slurm's own daemons, with all their files in a scratch folder. An array job
# renders a film in parts and computes a sweep in shares; one task is killed midway and queued again. What is joined must
# have the bytes of what one process makes.
# usage: slurm.sh CHAINREEL; ends with 77 where Slurm is not installed, or nobody is root.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
chainreel=$(realpath "$1")

export PATH=$PATH:/usr/sbin:/sbin
for program in munged slurmctld slurmd sbatch scontrol squeue; do
  command -v "$program" >/dev/null || { echo "skipped: there is no $program (packages.txt, section cluster)"; exit 77; }
done
[[ $(id -u) -eq 0 ]] || { echo "skipped: slurmd is for root"; exit 77; }

folder=$(mktemp -d /tmp/chainreel-cluster.XXXXXX)
chmod 755 "$folder"
pids=()
end() {
  local pid
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
  for pid in "${pids[@]}"; do wait "$pid" 2>/dev/null || true; done
  rm -rf "$folder"
}
trap end EXIT
fail() {
  echo "failed: $*" >&2
  tail -n 20 "$folder"/*.log >&2
  exit 1
}
# Waits for what the words say, for a minute at most.
until_true() {
  local k
  for ((k = 0; k < 600; ++k)); do
    if "$@"; then return 0; fi
    sleep 0.1
  done
  fail "waited for: $*"
}

# Three ports that nobody listens on.
port=$((20000 + $$ % 20000))
while ss -ltn 2>/dev/null | grep -Eq ":($port|$((port + 1))|$((port + 2))) "; do port=$((port + 3)); done

dd if=/dev/urandom of="$folder/munge.key" bs=1024 count=1 status=none
chmod 600 "$folder/munge.key"
munged --foreground --force --socket="$folder/munge.socket" --key-file="$folder/munge.key" --pid-file="$folder/munge.pid" \
  --log-file="$folder/munge.log" --seed-file="$folder/munge.seed" >"$folder/munged.log" 2>&1 &
pids+=($!)
until_true test -S "$folder/munge.socket"

host=$(hostname -s)
cat >"$folder/slurm.conf" <<CONF
ClusterName=chainreel
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool.%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.%n.pid
SlurmctldPort=$port
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=1,batch_sched_delay=0
ReturnToService=2
KillWait=1
NodeName=n0 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 State=UNKNOWN
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 State=UNKNOWN
PartitionName=main Nodes=n0,n1 Default=YES State=UP
CONF
export SLURM_CONF=$folder/slurm.conf
mkdir "$folder/state" "$folder/work"
slurmctld -D >"$folder/ctld.out.log" 2>&1 &
pids+=($!)
for node in n0 n1; do
  mkdir "$folder/spool.$node"
  slurmd -D -N "$node" >"$folder/$node.out.log" 2>&1 &
  pids+=($!)
done
nodes_are_idle() { [[ $(sinfo -h -t idle -o %D 2>/dev/null) == 2 ]]; }
until_true nodes_are_idle

cd "$folder/work"
film=("$source/assets/scenes/rr_ellipse.yaml" --set duration=16 --set video.width=1280 --set video.height=720)
grid=("$source/assets/scenes/rr_free.yaml" --over start.q.1=0:1.5:20 --over start.q.2=0:1.5:20 --set duration=0.3)
"$chainreel" render "${film[@]}" -o whole/film.mp4 --quiet
"$chainreel" sweep "${grid[@]}" -o whole/grid.csv --quiet

export CHAINREEL=$chainreel
render=$(sbatch --parsable --array=1-2 "$source/assets/cluster/array.sbatch" render "${film[@]}" -o parts/film.mp4 --resume --force)
# Killed when its first chunk is kept, by losing its node's processes as a crash would.
has_chunk() { ls parts/.film.part-1-of-2.mp4.resume 2>/dev/null | grep -q chunk; }
until_true has_chunk
scontrol requeue "${render}_1" || fail "the task was over before it could be killed"
sweep=$(sbatch --parsable --array=1-3 "$source/assets/cluster/array.sbatch" sweep "${grid[@]}" -o parts/grid.csv)
is_waiting() { scontrol show job "${render}_1" | grep -q JobState=PENDING; }
until_true is_waiting
# Slurm would wait for two minutes; within the second of the kill nodes take the task for the dead one.
until_true scontrol update "JobId=${render}_1" StartTime=now+2
is_over() { [[ -z $(squeue -h -j "$render,$sweep" 2>/dev/null) ]]; }
until_true is_over
scontrol show job "${render}_1" | grep -q Restarts=1 || fail "the task was not queued again"

"$chainreel" join parts/film.part-*.mp4 -o parts/film.mp4 --quiet || fail "join of the film"
"$chainreel" join parts/grid.part-*.csv -o parts/grid.csv --quiet || fail "join of the table"
for file in film.mp4 film.txt grid.csv; do cmp "whole/$file" "parts/$file" || fail "$file differs"; done
[[ -z $(find parts -name '.*' ! -name .) ]] || fail "something is left behind: $(find parts -name '.*')"
echo "joined film and table are those of one process; a task was killed and queued again"
