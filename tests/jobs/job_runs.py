"""A job of `fathom dataset`, run as users run it, and what it leaves in its folder."""
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
MESH = ROOT / "data/meshes/spot.obj"
MANIFEST = "fathom-manifest.jsonl"


def make_cameras(program, folder, count, size):
    """A camera file with that many views of the mesh."""
    file = folder / "cameras.json"
    subprocess.run([program, "camera", "orbit", MESH, "--views", str(count), "--size", size, "-o", file], check=True)
    return file


def command(program, cameras, out):
    return [str(part) for part in (program, "dataset", "maps", cameras, "--mesh", MESH, "--out", out, "--name",
                                   "maps/{index:05}.npy")]


def run(program, cameras, out):
    subprocess.run(command(program, cameras, out), check=True, stdout=subprocess.DEVNULL)


def content(folder):
    """Every file below a folder, by its name: its bytes."""
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


def is_part(name):
    """Whether it is a file that was being written; the next run removes it."""
    name = pathlib.PurePath(name).name
    return name.startswith(".fathom-") and name.endswith(".part")


def is_manifest(name):
    """Whether it is the manifest, or that of a shard."""
    return name == MANIFEST or name.startswith("fathom-manifest-") and name.endswith(".jsonl")


def half_written(there, whole):
    """Names of outputs whose bytes are not those of an undisturbed run. Manifests grow line by line."""
    return [name for name, data in there.items()
            if not is_manifest(name) and not is_part(name) and data != whole.get(name)]
