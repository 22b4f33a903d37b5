#!/usr/bin/env bash
# The maps of a data set, by GNU parallel; in the folder of the data set:
#   ./parallel.sh
# The same command, given again, goes on where it was interrupted. docs/farms.md says more.
set -euo pipefail

# What to change. The data set, as one command would make it,
dataset=(fathom dataset maps cameras.json --mesh room.ply -o maps)
# and in how many parts: a few for each process, so that none waits long for the last.
shards=4
# Processes at a time on each machine, and the threads of each: together as many as it has processors.
jobs=2
threads=$((($(nproc) + jobs - 1) / jobs))
# Machines, as in render1,render2: by ssh, and with folder and program at the same paths as here. ":" is this one.
machines=:

printf -v command '%q ' "${dataset[@]}" --threads "$threads" --shard # quoted for the shell that parallel starts
parallel --sshlogin "$machines" --filter-hosts --workdir . --jobs "$jobs" --retries 2 --tagstring "shard {}:" \
  "$command{}/$shards" ::: $(seq "$shards") || {
  echo "parallel.sh: not all shards are finished; the same command goes on from there" >&2
  exit 1
}

# Without --shard: looks at all maps, and writes the lists and the manifest.
"${dataset[@]}"
