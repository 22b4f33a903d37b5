#!/usr/bin/python3
"""The Python call beside the C++ call, VTK from Python, and Embree: arrays in, arrays out.

    scripts/python apps/bench/python_bench.py [--rounds N] [--scenes 20k,200k,2m]

Spheres at 1920×1080. fathom and VTK are called with arrays and give an array, each time from nothing: VTK builds its
data, draws and reads its depth buffer back. The C++ call and Embree (building its hierarchy, then tracing) are as
`scripts/fathom bench` drives them, with the same mesh and camera. Rounds take turns, and each renderer draws for a
while before it is timed, as the program has it; medians are told. Then 1,000 cameras of 640×480, in one call and in a
call for each, every time in a process of its own, so that both have to be given their memory. VTK draws in a window of
Xvfb.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import fathom

root = pathlib.Path(__file__).resolve().parent.parent.parent
size = (1920, 1080)
# What is built already may be named.
program = [os.environ["FATHOM_PROGRAM"]] if "FATHOM_PROGRAM" in os.environ else [root / "scripts/fathom"]


def sphere(triangles):
    """As `fathom bench` has it: 4, 8, 12, … vertices on the rings from each pole to the equator."""
    n = round((triangles / 8) ** 0.5)
    sizes = np.array([max(1, 4 * min(ring, 2 * n - ring)) for ring in range(2 * n + 1)])
    first = np.concatenate([[0], np.cumsum(sizes)])
    ring = np.repeat(np.arange(2 * n + 1), sizes)
    polar, around = np.pi * ring / (2 * n), 2 * np.pi * (np.arange(first[-1]) - first[ring]) / sizes[ring]
    vertices = np.stack([np.sin(polar) * np.sin(around), np.cos(polar), np.sin(polar) * np.cos(around)], -1)
    return np.ascontiguousarray(vertices), np.concatenate([belt(first, sizes, k, n) for k in range(2 * n)])


def belt(first, sizes, ring, n):
    """The triangles between a ring and the next one, facing outwards."""
    inner, outer = (ring, ring + 1) if ring < n else (ring + 1, ring)  # the one nearer to its pole has fewer vertices
    steps = sizes[outer] // 4
    quarter, step = (each.ravel() for each in np.meshgrid(np.arange(4), np.arange(steps), indexing="ij"))
    on_inner = lambda s: first[inner] + (quarter * (steps - 1) + s) % sizes[inner]  # noqa: E731
    on_outer = lambda s: first[outer] + (quarter * steps + s) % sizes[outer]  # noqa: E731
    wide = np.stack([on_inner(step), on_outer(step), on_outer(step + 1)], -1)
    narrow = np.stack([on_inner(step), on_outer(step + 1), on_inner(step + 1)], -1)[step < steps - 1]
    faces = np.concatenate([wide, narrow]).astype(np.uint32)
    return faces if ring < n else faces[:, ::-1]


def write_ply(file, vertices, faces):
    rows = np.empty(len(faces), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    rows["count"] = 3
    rows["corners"] = faces
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty double x\n"
              f"property double y\nproperty double z\nelement face {len(faces)}\n"
              "property list uchar int vertex_indices\nend_header\n")
    file.write_bytes(header.encode() + vertices.tobytes() + rows.tobytes())


class Vtk:
    """VTK from arrays to an array, with a window that is kept."""

    def __init__(self, camera):
        import vtkmodules.vtkRenderingOpenGL2  # noqa: F401: the window's implementation
        from vtkmodules.vtkRenderingCore import vtkActor, vtkCamera, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

        self.actor, self.mapper_of = vtkActor, vtkPolyDataMapper
        self.window, self.renderer = vtkRenderWindow(), vtkRenderer()
        self.window.SetOffScreenRendering(True)
        self.window.SetSize(*size)
        self.window.SetMultiSamples(0)
        self.window.AddRenderer(self.renderer)
        pose = camera.camera_to_world
        view = vtkCamera()
        eye = pose[:3, 3]
        view.SetPosition(*eye)
        view.SetFocalPoint(*(eye + pose[:3, 2]))
        view.SetViewUp(*-pose[:3, 1])
        view.SetViewAngle(float(np.degrees(2 * np.arctan(size[1] / 2 / camera.fy))))
        view.SetClippingRange(0.1, 10)
        self.renderer.SetActiveCamera(view)

    def __call__(self, vertices, faces):
        from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
        from vtkmodules.vtkCommonCore import vtkFloatArray, vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

        points, cells, data = vtkPoints(), vtkCellArray(), vtkPolyData()
        points.SetData(numpy_to_vtk(vertices))
        offsets = np.arange(0, 3 * len(faces) + 1, 3, dtype=np.int64)
        corners = faces.astype(np.int64).ravel()
        cells.SetData(numpy_to_vtkIdTypeArray(offsets), numpy_to_vtkIdTypeArray(corners))
        data.SetPoints(points)
        data.SetPolys(cells)
        mapper, actor = self.mapper_of(), self.actor()
        mapper.SetInputData(data)
        actor.SetMapper(mapper)
        self.renderer.AddActor(actor)
        self.window.Render()
        depths = vtkFloatArray()
        self.window.GetZbufferData(0, 0, size[0] - 1, size[1] - 1, depths)
        self.renderer.RemoveActor(actor)
        return vtk_to_numpy(depths).reshape(size[::-1])


def milliseconds(call):
    start = time.perf_counter()
    result = call()
    return (time.perf_counter() - start) * 1e3, result


def timed(call, frames, warm_up=0.3):
    """Milliseconds of each frame, after some that are not counted: threads have to find their processors."""
    end = time.perf_counter() + warm_up
    while time.perf_counter() < end:
        call()
    return [milliseconds(call)[0] for _ in range(frames)]


def program_times(mesh, renderers):
    """Medians of `fathom bench`, by renderer."""
    told = subprocess.run([*program, "bench", "--scene", mesh, "--size", f"{size[0]}x{size[1]}",
                           "--peers", renderers, "--json", "-"], check=True, capture_output=True, text=True).stdout
    return {each["renderer"]: each["median_ms"] for each in json.loads(told)["results"]}


def compare(name, triangles, rounds, folder):
    vertices, faces = sphere(triangles)
    mesh = folder / f"sphere-{name}.ply"
    write_ply(mesh, vertices, faces)
    scene = fathom.Scene()
    scene.add_mesh(vertices, faces)
    camera = fathom.Camera.frame(scene, size=size)
    K, T = camera.K, camera.world_to_camera

    def ours(out=None):
        return fathom.render(vertices, faces, K, T, size, pixel_centre=0.5, out=out)

    vtk = Vtk(camera)
    covered = np.isfinite(ours()["Z"]).sum()
    assert abs((vtk(vertices, faces) < 1).sum() / covered - 1) < 0.01, "VTK draws the same"
    kept = ours()
    times = {"python": [], "python, out=": [], "VTK": [], "C++": [], "Embree": []}
    for _ in range(rounds):
        times["python"] += timed(ours, 9)
        times["python, out="] += timed(lambda: ours(kept), 9)
        times["VTK"] += timed(lambda: vtk(vertices, faces), 3)
        told = program_times(mesh, "embree")
        times["C++"].append(told["fast"])
        times["Embree"].append(told["embree"] + told["embree-build"])
    medians = {key: statistics.median(values) for key, values in times.items()}
    print(f"| sphere-{name} | {len(faces):,} | {medians['python']:.1f} | {medians['python, out=']:.1f} | "
          + " | ".join(f"{medians[key]:.1f} ({medians[key] / medians['python']:.2f})" for key in ("C++", "VTK", "Embree"))
          + " |", flush=True)


stack_program = """
import sys, time, fathom
scene = fathom.Scene.read(sys.argv[1])
cameras = fathom.Camera.orbit_scene(scene, int(sys.argv[2]), size=(640, 480))
scene.render(cameras[:20]), [scene.render(camera) for camera in cameras[:20]]
start = time.perf_counter()
maps = scene.render(cameras) if sys.argv[3] == "one call" else [scene.render(camera) for camera in cameras]
print(time.perf_counter() - start)
"""


def compare_stacks(count, rounds):
    times = {"one call": [], "a call each": []}
    for _ in range(rounds):
        for how, seconds in times.items():
            seconds.append(float(subprocess.run(
                [sys.executable, "-c", stack_program, root / "data/meshes/spot.obj", str(count), how],
                check=True, capture_output=True, text=True).stdout))
    ratios = [one / each for one, each in zip(*times.values())]
    print(f"{count} cameras of 640×480: {statistics.median(times['one call']):.2f} s in one call, "
          f"{statistics.median(ratios):.2f} of the time of {count} calls whose maps are kept "
          f"(median of {rounds}; {min(ratios):.2f} to {max(ratios):.2f})")


def import_times(rounds):
    times = [milliseconds(lambda: subprocess.run([sys.executable, "-c", code], check=True))[0]
             for _ in range(rounds) for code in ("pass", "import numpy", "import fathom")]
    bare, numpy, ours = (statistics.median(times[i::3]) for i in range(3))
    print(f"python3: {bare:.0f} ms; import numpy: {numpy - bare:.0f} ms; import fathom, NumPy included: {ours - bare:.0f} ms")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--scenes", default="20k,200k,2m")
    parser.add_argument("--cameras", type=int, default=1000)
    arguments = parser.parse_args()
    import_times(9)
    print("| scene | triangles | python, ms | into an array kept | C++ call (ratio) | VTK | Embree |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    sizes = {"20k": 20_000, "200k": 200_000, "2m": 2_000_000}
    with tempfile.TemporaryDirectory() as folder:
        for name in arguments.scenes.split(","):
            compare(name, sizes[name], arguments.rounds, pathlib.Path(folder))
    compare_stacks(arguments.cameras, arguments.rounds)


main()
