#!/usr/bin/env bash
# `squealmap submit` on a real Slurm: one controller and two nodes on the loopback address. In the middle of a tile one
# node is killed, and the task on the other is told that its time limit is near. Both tasks are queued again, and the
# merged tiles and the table have to be those of a single process, byte for byte.
#
#     .ci/slurm.sh PROGRAM
#
# Ends with 0 when all of that holds, with 3 where Slurm cannot be installed or does not come up, else with 1.
#
# Needs root and packages of Debian, which it installs. Takes about three minutes: a task whose node has failed waits
# two of them. All it makes is in a temporary directory; all it starts works in there and ends with it.
set -euo pipefail
program=$(realpath "$1")

# Until the cluster is up nothing has been tested.
verdict=3
fail() {
    echo "slurm.sh: $*" >&2
    exit "$verdict"
}

for tool in munged slurmctld slurmd sbatch pgrep; do
    command -v "$tool" >/dev/null && continue
    export DEBIAN_FRONTEND=noninteractive
    timeout 120 apt-get update -qq || fail "the distribution's mirror does not answer"
    timeout 240 apt-get install -y -qq --no-install-recommends munge slurmctld slurmd slurm-client procps >/dev/null ||
        fail "the distribution's mirror does not give munge, slurmctld, slurmd and slurm-client"
    break
done

top=$(mktemp -d)
chmod 755 "$top"

# The processes that work in a directory.
inside() {
    for process in /proc/[0-9]*; do
        case $(readlink "$process/cwd" || true) in "$1" | "$1"/*) echo "${process#/proc/}" ;; esac
    done
}

# Some processes and all that they have started.
with_children() {
    for one in "$@"; do
        echo "$one"
        # shellcheck disable=SC2046
        with_children $(pgrep -P "$one")
    done
}

# Kills what works in a directory, at once, as a node that loses its power.
destroy() {
    # shellcheck disable=SC2046
    kill -KILL $(with_children $(inside "$1")) 2>/dev/null || true
}

# This script works in there, too, until here.
trap 'cd /; destroy "$top"; sleep 1; rm -rf "$top"' EXIT

# Waits at most so many seconds until a command succeeds; what fails then is said in words.
wait_for() {
    local seconds=$1 words=$2 end
    shift 2
    end=$((SECONDS + seconds))
    until "$@"; do
        if [ "$SECONDS" -ge "$end" ]; then
            tail -n 20 "$top"/*/*.log >&2 || true
            fail "$words within $seconds s"
        fi
        sleep 0.2
    done
}

# A cluster of its own: key, socket, ports, state.
mkdir "$top"/{munge,controller,n1,n2}
chmod 700 "$top/munge"
head -c 1024 /dev/urandom >"$top/munge/key"
chmod 600 "$top/munge/key"
host=$(hostname -s)
cat >"$top/slurm.conf" <<CONF
ClusterName=loopback
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$top/munge.socket
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SlurmctldPort=17817
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
AccountingStorageType=accounting_storage/none
StateSaveLocation=$top/controller
SlurmdSpoolDir=$top/%n
SlurmctldPidFile=$top/controller/pid
SlurmdPidFile=$top/%n/pid
SlurmctldLogFile=$top/controller/slurmctld.log
SlurmdLogFile=$top/%n/slurmd.log
SlurmdTimeout=15
KillWait=5
NodeName=n1 NodeAddr=127.0.0.1 NodeHostname=$host Port=17821 CPUs=1
NodeName=n2 NodeAddr=127.0.0.1 NodeHostname=$host Port=17822 CPUs=1
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE
CONF
export SLURM_CONF=$top/slurm.conf
# Later versions look for control groups, which a container may not have, even where nothing uses them.
version=$(slurmd -V)
version=${version##* }
if [ "${version%%.*}" -ge 24 ]; then echo "CgroupPlugin=disabled" >"$top/cgroup.conf"; fi
(cd "$top/munge" && exec munged --foreground --force --key-file="$top/munge/key" --socket="$top/munge.socket" \
    --pid-file="$top/munge/pid" --log-file="$top/munge/munged.log" --seed-file="$top/munge/seed") &>"$top/munge/out.log" &
wait_for 20 "munged does not open its socket" test -S "$top/munge.socket"
(cd "$top/controller" && exec slurmctld -D) &>"$top/controller/out.log" &
for node in n1 n2; do (cd "$top/$node" && exec slurmd -D -N "$node") &>"$top/$node/out.log" & done
# Else the shell tells of each that is killed.
disown -a
idle() { [ "$(timeout 5 sinfo -h -N -t idle -o %N 2>/dev/null | wc -l)" -eq 2 ]; }
wait_for 60 "the two nodes do not come up" idle
verdict=1

# Ten tiles of some seconds, in a directory that has to be quoted; what one process makes of them is beside it.
work="$top/it's a \$sweep"
mkdir "$work"
cd "$work"
cat >sweep.toml <<TOML
title = "Slurm"
[friction]
mu_s = 0.4
[axes]
mu_d = { from = 0.1, to = 0.4, points = 100 }
belt_velocity = { from = 1, to = 8, points = 20 }
[response]
settle = "9000 periods"
measure = "100 periods"
TOML
options=(--backend cpu --tile 200)
"$program" run sweep.toml -o alone --threads 2 "${options[@]}" >/dev/null
"$program" submit sweep.toml --slurm --tasks 2 --at-once 2 -o shared -- "${options[@]}"

running() { [ "$(squeue -h -t R -o %N | sort | paste -sd,)" = n1,n2 ]; }
# One done, and one of each task in work.
on_its_way() {
    [ "$(find shared/tiles -name '*.tile' 2>/dev/null | wc -l)" -ge 2 ] &&
        [ "$(find shared/tiles -name '*.tile.part' 2>/dev/null | wc -l)" -ge 2 ]
}
wait_for 60 "the two tasks do not start" running
wait_for 120 "the two tasks do not compute" on_its_way
task=$(squeue -h -w n2 -o %A)
destroy "$top/n1"
scancel --batch --signal=USR1 "$task"
done_then=$(find shared/tiles -name '*.tile' | wc -l)
[ "$done_then" -lt 10 ] || fail "all tiles were there before the node was killed"
requeued() { [ "$(squeue -h -t PD -r -o %A | wc -l)" -eq 3 ]; }
wait_for 90 "the two tasks are not queued again beside the merge job" requeued
echo "node n1 killed and the task on n2 ended with $done_then of 10 tiles; both tasks are queued again"
wait_for 300 "the tasks do not come to their end" test -s shared/manifest.json
over() { [ -z "$(squeue -h)" ]; }
wait_for 20 "the merge job does not come to its end" over

same() { cmp -s "$1/map.csv" "$2/map.csv" && diff -rq "$1/tiles" "$2/tiles" >/dev/null; }
same alone shared || fail "the map of the cluster is not that of one process"
grep -q '"complete": true' shared/manifest.json || fail "the manifest does not say that the map is complete"
# The comparison sees a fault: one byte of one tile, one of the table.
cp -r shared spoilt
tile=$(find spoilt/tiles -name '*.tile' | head -n 1)
printf 'X' | dd of="$tile" bs=1 seek=200 conv=notrunc status=none
! same alone spoilt || fail "a planted fault in a tile was not seen"
rm -r spoilt && cp -r shared spoilt
sed -i '7s/,ok$/,no/' spoilt/map.csv
! same alone spoilt || fail "a planted fault in the table was not seen"
echo "the tiles and the table of the cluster are those of one process ($SECONDS s)"
