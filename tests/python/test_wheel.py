"""The wheel: made of what is built, installed in a new virtual environment, used from another folder."""

import os
import pathlib
import re
import subprocess
import sys

import fathom

source = pathlib.Path(os.environ["FATHOM_SOURCE"])


def test_a_wheel_is_installed_and_runs(tmp_path):
    built = pathlib.Path(fathom.__file__).parent.parent
    environment = {**os.environ, "FATHOM_BUILT_MODULE": str(built), "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    environment.pop("PYTHONPATH")
    clone = tmp_path / "clone"  # building writes beside its sources
    clone.mkdir()
    for name in ("pyproject.toml", "setup.py", "CMakeLists.txt", "LICENSE", "lib"):
        (clone / name).symlink_to(source / name)
    pip = [sys.executable, "-m", "pip", "--quiet"]
    subprocess.run([*pip, "wheel", "--no-build-isolation", "--no-deps", "--no-index", "-w", tmp_path, clone], check=True,
                   env=environment, capture_output=True, text=True)
    wheel, = tmp_path.glob("*.whl")
    assert re.fullmatch(r"fathom_depth-\d+\.\d+\.\d+-cp3\d+-cp3\d+-linux_\w+\.whl", wheel.name)

    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv"], check=True)
    python = tmp_path / "venv/bin/python"
    subprocess.run([python, "-m", "pip", "--quiet", "install", "--no-index", wheel], check=True, env=environment)
    code = ("import fathom, numpy as np; camera = fathom.Camera.look_at((0, 0, 3), size=(64, 48));"
            "scene = fathom.Scene(); scene.add_mesh([(-1, -1, 0), (1, -1, 0), (0, 1, 0)], [(0, 1, 2)]);"
            "print(fathom.__file__, scene.render(camera)['Z'][24, 32])")
    told = subprocess.run([python, "-c", code], check=True, capture_output=True, text=True, env=environment,
                          cwd=tmp_path).stdout.split()
    assert told[0].startswith(str(tmp_path / "venv")) and told[1] == "3.0"
