"""Scenes drawn at random, with what goes wrong where pixels are decided in several places: triangles of all sizes, on a
coarse grid, so that there are shared edges, ties and coplanar layers; equal triangles, also in two files."""

import json
import math
import random
import struct


class RandomScene:
    def __init__(self, seed, folder):
        self.random = random.Random(seed)
        self.folder = folder
        files = [self.mesh(i) for i in range(self.random.randint(1, 3))]
        if self.random.random() < 0.3:
            files.append(files[0])
        self.arguments = [*files, *self.view()]

    def mesh(self, i):
        triangles = [self.triangle() for _ in range(self.random.choice([1, 2, 30, 300, 3000]))]
        triangles += self.random.choices(triangles, k=len(triangles) // 8)
        if self.random.random() < 0.5:
            return self.write_stl(self.folder / f"mesh{i}.stl", triangles)
        return self.write_obj(self.folder / f"mesh{i}.obj", triangles)

    def triangle(self):
        size = self.random.choice([1, 1, 1, 4, 16])
        corner = [self.random.randint(-16, 16) / 4 for _ in range(3)]
        flat = self.random.random() < 0.5
        return [
            tuple(c + (0 if flat and axis == 2 else self.random.randint(-size, size) / 4) for axis, c in enumerate(corner))
            for _ in range(3)
        ]

    @staticmethod
    def write_obj(path, triangles):
        """Vertices are shared by all triangles that have them, as readers of OBJ know."""
        numbers = {}
        faces = [[numbers.setdefault(corner, len(numbers) + 1) for corner in triangle] for triangle in triangles]
        lines = [f"v {x} {y} {z}" for x, y, z in numbers]
        for i, face in enumerate(faces):
            if i % 100 == 0:
                lines.append(f"g group{i % 300}")
            lines.append("f {} {} {}".format(*face))
        path.write_text("\n".join(lines) + "\n")
        return path

    @staticmethod
    def write_stl(path, triangles):
        records = [struct.pack("<12fH", 0, 0, 0, *sum(triangle, ()), 0) for triangle in triangles]
        path.write_bytes(bytes(80) + struct.pack("<I", len(records)) + b"".join(records))
        return path

    def view(self):
        draw = self.random
        size = draw.choice(["1x1", "7x5", "64x64", "65x129", "200x150", "333x77"])
        if draw.random() < 0.25:
            return ["--camera", self.write_camera(self.folder / "camera.json", *map(int, size.split("x")))]
        view = ["--view", f"{draw.randint(-180, 180)},{draw.randint(-80, 80)}", "--size", size]
        if draw.random() < 0.3:
            view += ["--orthographic", draw.choice([4, 10])]
        if draw.random() < 0.3:
            view += ["--near", draw.choice([2, 8, 12])]
        if draw.random() < 0.3:
            view += ["--cull", draw.choice(["back", "front"])]
        return view

    def write_camera(self, path, width, height):
        """An ordinary view whose depths, focal lengths, near and far have any exponents, also subnormal."""
        depth, *across = (self.random.randint(-1074, 1000) for _ in range(3))
        focal = [math.ldexp(width, min(1000, max(-1074, depth - each))) for each in across]
        camera = {"width": width, "height": height, "fx": focal[0], "fy": focal[1], "cx": width / 2, "cy": height / 2,
                  "pixel_centre": 0.5, "world_to_camera": [[math.ldexp(1, across[0]), 0, 0, 0],
                                                           [0, math.ldexp(1, across[1]), 0, 0],
                                                           [0, 0, math.ldexp(1, depth), math.ldexp(self.random.choice([0, 5, 20]), depth)]]}
        ends = sorted(math.ldexp(self.random.uniform(1, 2), self.random.choice([depth + 3, depth + 4, self.random.randint(-1074, 1023)]))
                      for _ in range(2))
        if ends[0] < ends[1] and self.random.random() < 0.8:
            camera["near"], camera["far"] = ends
        path.write_text(json.dumps(camera))
        return path
