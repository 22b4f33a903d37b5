#!/usr/bin/env bash
# The maps of a data set, by an array of Slurm jobs; in the folder of the data set:
#   ./slurm-array.sh
# submits the array, and a last job behind it. The same command, given again when they have ended, goes on where they
# were interrupted. docs/farms.md says more.
#SBATCH --job-name=maps
#SBATCH --cpus-per-task=4
#SBATCH --time=1:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail

# What to change, beside the lines above. The data set, as one command would make it,
dataset=(fathom dataset maps cameras.json --mesh room.ply -o maps)
# and in how many parts.
shards=8

case ${1-submit} in
  submit)
    array=$(sbatch --parsable --array="1-$shards" "$0" shard) # "1-$shards%4": four at a time
    # Whatever becomes of the shards: what they leave is made by the last job.
    sbatch --dependency="afterany:${array%%;*}" "$0" close
    ;;
  shard)
    "${dataset[@]}" --threads "$SLURM_CPUS_PER_TASK" --shard "$SLURM_ARRAY_TASK_ID/$shards"
    ;;
  close)
    # Without --shard: looks at all maps, makes those that are missing, and writes the lists and the manifest.
    "${dataset[@]}" --threads "$SLURM_CPUS_PER_TASK"
    ;;
esac
