#!/usr/bin/python3
"""Whether Open3D's ray caster meets Open3D's own box: rays at the middles of its faces, beside fathom's answer.

    apt-get install python3-open3d
    scripts/python apps/bench/open3d_box.py
"""

import numpy as np
import open3d

import fathom

box = open3d.geometry.TriangleMesh.create_box(1, 1, 1)
scene = open3d.t.geometry.RaycastingScene()
scene.add_triangles(open3d.t.geometry.TriangleMesh.from_legacy(box))
rays = [[0.3, 0.4, -5, 0, 0, 1], [-5, 0.3, 0.4, 1, 0, 0], [0.4, -5, 0.3, 0, 1, 0]]
met = scene.cast_rays(open3d.core.Tensor(np.array(rays, np.float32)))["t_hit"].numpy()
print(f"Open3D {open3d.__version__}: {met}")

# Straight down the z axis, as the first ray: pixel (3, 4) of ten.
pose = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 5]]
camera = fathom.Camera(10, 10, 10, 10, 0, 0, world_to_camera=pose, pixel_centre=0, projection="orthographic")
ours = fathom.Scene()
ours.add_mesh(np.asarray(box.vertices), np.asarray(box.triangles))
print(f"fathom: {ours.render(camera)['Z'][4, 3]}")
