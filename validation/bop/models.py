"""Models in millimetres, of the meshes of this repository, and PLY as BOP has it."""

import pathlib

import numpy as np
import fathom

meshes = pathlib.Path(__file__).resolve().parents[2] / "data/meshes"

# obj_id: mesh, and how many millimetres its unit is along x, y, z.
MODELS = {
    1: ("spot.obj", (100, 100, 100)),
    2: ("teapot.obj", (30, 30, 30)),
    3: ("cube.obj", (40, 30, 55)),
    4: ("l-shape.obj", (40, 40, 25)),
    5: ("cube.obj", (70, 50, 4)),
}


def scaled_mesh(obj_id):
    """Vertices, N×3 in millimetres, rounded to the four decimals that the file has, and faces, M×3."""
    name, scale = MODELS[obj_id]
    mesh = fathom.Scene.read(meshes / name)
    return np.round(mesh.vertices() * scale, 4), mesh.faces()


def write_ply(file, vertices, faces):
    """ASCII, binary32 by declaration: what a reader makes of a coordinate is the decimal, rounded as it likes."""
    lines = ["ply", "format ascii 1.0", f"element vertex {len(vertices)}",
             "property float x", "property float y", "property float z",
             f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    lines += [f"{x:.4f} {y:.4f} {z:.4f}" for x, y, z in vertices]
    lines += [f"3 {a} {b} {c}" for a, b, c in faces]
    pathlib.Path(file).write_text("\n".join(lines) + "\n", encoding="utf-8")


def diameter(vertices):
    """The largest distance between two vertices, as models_info.json has it."""
    return max(float(np.linalg.norm(vertices - point, axis=1).max()) for point in vertices)
