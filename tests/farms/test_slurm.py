"""docs/farms/slurm-array.sh, with a stand-in for sbatch that runs each job at once."""

import pytest

from farm_runs import source

SCRIPT = source / "docs/farms/slurm-array.sh"
# Jobs have what sbatch gives them: a copy of the script under another name, SLURM_…, and a file for what they print.
SBATCH = """#!/usr/bin/env bash
set -euo pipefail
tasks=none
while [[ $1 == --* ]]; do
  case $1 in
    --parsable | --dependency=afterany:7) ;;
    --array=1-*) tasks=$(seq "${1#--array=1-}") ;;
    *) echo "sbatch: what is $1?" >&2; exit 1 ;;
  esac
  shift
done
cp "$1" slurm_script
export SLURM_JOB_ID=7 SLURM_CPUS_PER_TASK=2
for task in $tasks; do
  if [[ $task != none ]]; then export SLURM_ARRAY_TASK_ID=$task; fi
  bash slurm_script "${@:2}" >>"slurm-$task.out" 2>&1 || echo "exit status $?" >>"slurm-$task.out"
done
echo "7;cluster"
"""


@pytest.fixture
def cluster(farm):
    farm.put("sbatch", SBATCH)
    return farm


def told_by(cluster, task):
    return (cluster.folder / f"slurm-{task}.out").read_text(encoding="utf-8")


def test_the_shards_make_the_bytes_of_one_undisturbed_run(cluster):
    cluster.run(SCRIPT)
    assert [told_by(cluster, task).count("made now, of 12 in 8 shards") for task in range(1, 9)] == [1] * 8
    assert told_by(cluster, "none") == "maps: 12 maps, 0 made now\n"
    cluster.assert_whole()


def test_what_killed_shards_have_not_made_is_made_by_the_last_job(cluster):
    cluster.kill(2)
    cluster.run(SCRIPT)
    assert told_by(cluster, 2).endswith("exit status 137\n")
    made = int(told_by(cluster, "none").split()[3])
    assert told_by(cluster, "none") == f"maps: 12 maps, {made} made now\n" and 0 < made <= 2
    cluster.assert_whole()


def test_a_failure_is_told_by_the_last_job_too_and_the_same_command_goes_on(cluster):
    mesh = cluster.mesh.read_bytes()
    cluster.mesh.unlink()
    cluster.run(SCRIPT)
    line = "fathom: error: room.ply: cannot be opened: No such file or directory\nexit status 3\n"
    assert told_by(cluster, 5) == line and told_by(cluster, "none") == line
    assert not (cluster.folder / "maps").exists()
    cluster.mesh.write_bytes(mesh)
    cluster.run(SCRIPT)
    cluster.assert_whole()
