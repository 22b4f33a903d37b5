#!/usr/bin/python3
"""Accuracy and completeness of a room by published protocols and by fathom.evaluate().

    compare_protocols.py [--points N] [--seeds N]

The truth is a room of 4 m × 3 m × 2.5 m with a cupboard in it, in triangles of 5 cm. It is evaluated against itself, and
against a reconstruction that is off by a known amount where it is seen and has a floater behind the cupboard, which none of the
cameras sees. Lengths are printed in centimetres; each protocol is run with several seeds.
"""

import argparse

import fathom
import numpy as np
from scipy.spatial import cKDTree

WIDTH, HEIGHT, FOCAL = 320, 240, 200


def box(lower, upper, step):
    """The surface of a box in squares of about `step`, cut in halves."""
    vertices, triangles = [], []
    for axis in range(3):
        a, b = (axis + 1) % 3, (axis + 2) % 3
        na, nb = (max(1, round((upper[k] - lower[k]) / step)) for k in (a, b))
        for end in (lower[axis], upper[axis]):
            first = sum(map(len, vertices))
            grid = np.empty(((na + 1) * (nb + 1), 3))
            grid[:, axis] = end
            grid[:, a] = np.repeat(np.linspace(lower[a], upper[a], na + 1), nb + 1)
            grid[:, b] = np.tile(np.linspace(lower[b], upper[b], nb + 1), na + 1)
            vertices.append(grid)
            i, j = np.meshgrid(np.arange(na), np.arange(nb), indexing="ij")
            p = first + (i * (nb + 1) + j).ravel()
            triangles += [np.stack([p, p + 1, p + nb + 2], 1), np.stack([p, p + nb + 2, p + nb + 1], 1)]
    return np.concatenate(vertices), np.concatenate(triangles)


def together(*meshes):
    counts = np.cumsum([0] + [len(vertices) for vertices, _ in meshes])
    return (np.concatenate([vertices for vertices, _ in meshes]),
            np.concatenate([triangles + first for (_, triangles), first in zip(meshes, counts)]))


def room():
    return together(box((0, 0, 0), (4, 3, 2.5), 0.05), box((2.6, 1.0, 0), (3.0, 2.0, 2.2), 0.05))


def reconstruction():
    """2 mm too large, and something behind the cupboard that is not there."""
    return together(box((-0.002, -0.002, -0.002), (4.002, 3.002, 2.502), 0.05),
                    box((2.598, 0.998, -0.002), (3.002, 2.002, 2.202), 0.05), box((3.25, 1.3, 0.6), (3.45, 1.7, 1.4), 0.05))


def scene_of(mesh):
    scene = fathom.Scene()
    scene.add_mesh(*mesh)
    return scene


def cameras():
    """Views of the room from its other end: none sees what is behind the cupboard."""
    eyes = [(0.4, y, 1.3) for y in np.linspace(0.8, 2.2, 8)]
    return [fathom.Camera.look_at(eye, target=(4, y, 1.2), up="z", size=(WIDTH, HEIGHT), focal=FOCAL)
            for eye in eyes for y in (0.2, 1.5, 2.8)]


def seen_vertices(mesh, occlusion):
    """Those that a camera sees, as the protocols decide it; `occlusion`: None, or the slack of the depth test."""
    vertices, _ = mesh
    scene, seen = scene_of(mesh), np.zeros(len(vertices), bool)
    for camera in cameras():
        p = vertices @ camera.world_to_camera[:3, :3].T + camera.world_to_camera[:3, 3]
        z = p[:, 2] + 1e-8
        # The first pixel's centre is 0 to these programs.
        x, y = FOCAL * p[:, 0] / z + camera.cx - 0.5, FOCAL * p[:, 1] / z + camera.cy - 0.5
        inside = (z > 0) & (x >= 0) & (x <= WIDTH - 1) & (y >= 0) & (y <= HEIGHT - 1)
        if occlusion is not None:
            depth = scene.render(camera)["Z"]
            depth = np.where(np.isfinite(depth), depth, 0)
            at = depth[np.clip(y, 0, HEIGHT - 1).astype(int), np.clip(x, 0, WIDTH - 1).astype(int)]
            inside &= z < at + occlusion
        seen |= inside
    return seen


def culled(mesh, protocol):
    vertices, triangles = mesh
    if protocol == "not culled":
        return mesh
    seen = seen_vertices(mesh, 0.03 if protocol == "frustum and depth" else None)
    return vertices, triangles[seen[triangles].any(axis=1)]


def random_points(mesh, count, random):
    vertices, triangles = mesh
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    which = random.choice(len(triangles), count, p=areas / areas.sum())
    u, v = random.random((2, count, 1))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    return a[which] + u * (b - a)[which] + v * (c - a)[which]


def by_points(made, truth, protocol, points, seed):
    """Accuracy, completion, completion ratio at 5 cm."""
    random = np.random.default_rng(seed)
    on_made, on_truth = (random_points(culled(mesh, protocol), points, random) for mesh in (made, truth))
    accuracy = cKDTree(on_truth).query(on_made)[0]
    completion = cKDTree(on_made).query(on_truth)[0]
    return 100 * accuracy.mean(), 100 * completion.mean(), 100 * (completion < 0.05).mean()


def exactly(made, truth, views, points):
    found = fathom.evaluate(scene_of(made), scene_of(truth), views, within=[0.05], points=points)
    return 100 * found.accuracy.mean, 100 * found.completeness.mean, 100 * found.completeness.shares[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=int, default=200_000, help="on each surface (default 200000)")
    parser.add_argument("--seeds", type=int, default=3, help="how often points are drawn (default 3)")
    asked = parser.parse_args()
    truth = room()
    for title, made in (("The room against itself", truth), ("A reconstruction of the room", reconstruction())):
        print(f"{title}\n  {'':24}{'accuracy, cm':>22}{'completion, cm':>22}{'below 5 cm, %':>22}")
        for protocol in ("not culled", "frustum", "frustum and depth"):
            found = np.array([by_points(made, truth, protocol, asked.points, seed) for seed in range(asked.seeds)])
            spans = [f"{low:.4f} to {high:.4f}" for low, high in zip(found.min(axis=0), found.max(axis=0))]
            print(f"  {'points, ' + protocol:24}" + "".join(f"{span:>22}" for span in spans))
        for name, views in (("evaluate, whole", ()), ("evaluate, seen", cameras())):
            print(f"  {name:24}" + "".join(f"{figure:>22.4f}" for figure in exactly(made, truth, views, asked.points)))


if __name__ == "__main__":
    main()
