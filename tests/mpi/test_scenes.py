"""Any number of ranks, with any partition of the tiles, writes the same file as one process, byte
for byte: every channel, and what the file says of itself. Here scenes of data/."""

import pytest

from mpi_runs import channels, combinations, expect_same_for, is_long, source

data = source / "data"
meshes = sorted(path for path in (data / "meshes").iterdir() if path.is_file())
scenes = sorted((data / "scenes").glob("*.json"))
hard = sorted((data / "scenes/hard").glob("*.obj"))
#: In every change; all of them in scripts/check-long.
representative = ["cube.stl", "cube-big-endian.ply", "house.glb", "pair.json", "coplanar-crowd.obj", "equal-triangles.obj",
                  "stacked-coins.obj", "through-the-camera-plane.obj"]


@pytest.mark.parametrize("scene", [path for path in meshes + scenes + hard if is_long or path.name in representative],
                         ids=lambda path: path.name)
def test_scenes_of_data(tmp_path, scene):
    camera = scene.with_suffix(".camera.json")
    view = ["--camera", camera] if camera.exists() else ["--size", "300x200", "--view", "20,10"]
    for combination in combinations(scene.name):
        expect_same_for(combination, tmp_path, scene, *view, "--channels", channels)
