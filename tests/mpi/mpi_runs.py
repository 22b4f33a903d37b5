"""Runs fathom, and fathom-mpi by mpirun."""

import itertools
import os
import pathlib
import random
import subprocess

source = pathlib.Path(os.environ["FATHOM_SOURCE"])
one_program = os.environ["FATHOM_PROGRAM"]
mpi_program = os.environ["FATHOM_MPI_PROGRAM"]
#: Set by scripts/check-long: everything, instead of what represents it.
is_long = bool(os.environ.get("FATHOM_MPI_LONG"))

ranks = [1, 2, 3, 5, 8]
partitions = ["load", "rows", "round-robin"]

#: More processes than processors, and as root, as in containers.
mpirun = ["mpirun", "--oversubscribe", "--allow-run-as-root", "--bind-to", "none"]
#: Output of a run without the lines that mpirun adds when a process fails.
ours = "fathom: "


def environment():
    # Ranks that wait leave the processor to other tests.
    return {**os.environ, "OMPI_MCA_btl_base_warn_component_unused": "0", "OMPI_MCA_mpi_yield_when_idle": "1"}


def run(command, **options):
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, env=environment(), timeout=300, **options)


def render_alone(*arguments):
    outcome = run([one_program, "render", *arguments, "--threads", 2, "--quiet"])
    assert outcome.returncode == 0, outcome.stderr


def render_by(count, *arguments):
    outcome = run([*mpirun, "-n", count, mpi_program, "render", *arguments, "--threads", 1, "--quiet"])
    assert outcome.returncode == 0, outcome.stderr


def said(outcome):
    """The lines that the ranks have said on standard error."""
    return [line for line in outcome.stderr.splitlines() if line.startswith(ours)]

#: Of every surface; what its triangles are called is more, and wants whole files.
channels = "Z,A,Zlow,distance,id,face,object,N,P,bary,Nc"
segments = ",material,group,part,label"


def combinations(seed):
    """Numbers of ranks with partitions: all in check-long, else a random pair."""
    every = list(itertools.product(ranks, partitions))
    return every if is_long else [random.Random(seed).choice(every)]


def expect_same_for(combination, folder, *arguments, suffix="exr", of_ranks=()):
    """The same files, byte by byte, for every camera; where they are not, which channels differ. `of_ranks`: options that
    only the ranks have."""
    count, partition = combination
    if not list(folder.glob("one*")):
        render_alone(*arguments, "-o", folder / f"one{{index}}.{suffix}")
    render_by(count, *arguments, "--partition", partition, *of_ranks, "-o", folder / f"several{{index}}.{suffix}")
    expected = sorted(folder.glob("one*"))
    assert expected
    for one in expected:
        several = one.with_name(one.name.replace("one", "several"))
        if one.read_bytes() != several.read_bytes():
            difference = run([one_program, "compare", one, several])
            raise AssertionError(f"{several.name} has other bytes\n{difference.stdout}{difference.stderr}")
