# The share of one task. Above stand `directory`, `tasks` and `run`.

tiles() { find "$directory/tiles" -maxdepth 1 -name '*.tile' 2>/dev/null | wc -l; }

before=$(tiles)
child=
ended=
interrupted=
stop() {
    ended=$1
    interrupted=yes
    if [ -n "$child" ]; then kill -TERM "$child" 2>/dev/null; fi
}
# Slurm sends USR1 a minute before the time limit, TERM when the task is cancelled or makes way for another.
trap 'stop time' USR1
trap 'stop asked' TERM INT

"${run[@]}" --shard "$SLURM_ARRAY_TASK_ID/$tasks" &
child=$!
if [ -n "$ended" ]; then kill -TERM "$child" 2>/dev/null; fi
while
    interrupted=
    wait "$child"
    code=$?
    # A signal ends `wait`, but not yet the run.
    [ -n "$interrupted" ]
do :; done

if [ "$code" -ne 0 ] && [ "$ended" = time ]; then
    # Every requeue has cost a tile, so they come to an end.
    if [ "$(tiles)" -gt "$before" ]; then
        echo "the time limit is near; the task goes on in a new one" >&2
        scontrol requeue "$SLURM_JOB_ID"
    else
        echo "error: no tile was done within the time limit; submit again with a longer --time or more --cpus" >&2
    fi
fi
exit "$code"
