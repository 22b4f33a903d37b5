#!/usr/bin/python3
"""Whether Open3D's ray caster and fathom.compat's agree: random rays, and rays from inside a closed mesh at its vertices.

    apt-get install python3-open3d
    cc -shared -fPIC apps/bench/embree_masks.c -o masks.so -ldl     # for Debian's 0.16.1, which misses everything else
    LD_PRELOAD=./masks.so scripts/python apps/bench/open3d_rays.py
"""

import numpy as np
import open3d

import fathom
from fathom.compat import RaycastingScene

spot = fathom.Scene.read("data/meshes/spot.obj")
vertices, triangles = spot.vertices().astype(np.float32), np.array(spot.faces())
theirs, ours = open3d.t.geometry.RaycastingScene(), RaycastingScene()
theirs.add_triangles(open3d.core.Tensor(vertices), open3d.core.Tensor(triangles))
ours.add_triangles(vertices, triangles)

random = np.random.default_rng(1)
origins = random.uniform(-2, 2, (200_000, 3))
rays = np.concatenate([origins, random.uniform(-1, 1, origins.shape) - origins], axis=1).astype(np.float32)
tensor = open3d.core.Tensor(rays)
their_hits, hits = {name: each.numpy() for name, each in theirs.cast_rays(tensor).items()}, ours.cast_rays(rays)
met = hits["geometry_ids"] == 0
print(f"Open3D {open3d.__version__}: {len(rays)} random rays, {met.sum()} hits; different: "
      f"{(hits['primitive_ids'] != their_hits['primitive_ids']).sum()} triangles, "
      f"{(ours.count_intersections(rays) != theirs.count_intersections(tensor).numpy()).sum()} counts")
for name in ("t_hit", "primitive_uvs", "primitive_normals"):
    assert hits[name].dtype == their_hits[name].dtype and hits[name].shape == their_hits[name].shape
    print(f"  greatest difference of {name}: {np.abs(hits[name][met] - their_hits[name][met]).max():.2g}")

at_vertices = np.concatenate([np.zeros_like(vertices), vertices], axis=1)
even = [(counts % 2 == 0).sum() for counts in (theirs.count_intersections(open3d.core.Tensor(at_vertices)).numpy(),
                                               ours.count_intersections(at_vertices))]
print(f"{len(vertices)} rays from inside at the vertices: an even number of hits for {even[0]} by Open3D, {even[1]} by fathom")
