"""Every function, method and property of the Python module computes the same in each floating-point mode, which it leaves
as it was. They are found in the module: a new one fails until it has a call here."""

import dataclasses
import inspect
import json
import os
import pathlib
import re
import sys
import unittest.mock
from types import SimpleNamespace

import fathom
import fathom.compat
import fathom.pipeline
import fathom.studies
import fathom.testing
import numpy as np
import pytest
from floating_point_modes import in_every_mode

pytestmark = pytest.mark.filterwarnings("ignore::fathom.ViewWarning")
source = pathlib.Path(os.environ["FATHOM_SOURCE"])
K = [(8.1, 0.1, 4), (0, 7.9, 3), (0, 0, 1)]
lens = {"size": (8, 6), "fov": 41.3}
turned = np.array([(0.1, 0.9, 0, 2.3), (-0.8, 0, 0.3, 1 / 3), (0, 0.1, 1.1, 4), (0, 0, 0, 1)])


class Given:
    """Scenes, cameras, maps and files, made in the standard mode."""

    def __init__(self, folder):
        self.folder = folder
        self.vertices = np.array([(-2, -2, 3), (2, -2.1, 5), (0, 2, 4.1), (0, 0, 5e-324)])
        self.faces = np.array([(0, 1, 2), (0, 1, 3)])
        self.narrow = np.array([(-2, -2, 3), (2, -2.1, 5), (0, 2, 4.1), (0, 0, 1e-44)], np.float32)
        self.scene = fathom.Scene()
        self.scene.add_mesh(self.vertices, self.faces, name="it")
        self.other = fathom.Scene()
        self.other.add_mesh(self.vertices + 0.013, self.faces)
        self.camera = fathom.Camera(8, 6, 8.1, 7.9, 4, 3, skew=0.1, pixel_centre=0.5, near=0.3,
                                    world_to_camera=np.eye(4) + 5e-324 * (np.arange(4) < 3)[:, None])
        self.map = self.scene.render(self.camera, channels=("Z", "A", "id", "N", "P", "distance"))
        self.near_map = self.map["Z"] * np.float32(1.01)
        self.codes = self.scene.render(self.camera, dtype=np.uint16, scale=1000.1)
        self.deep = fathom.render_deep(self.scene, self.camera)
        self.format = fathom.DepthFormat("reversed", "float32", near=0.1, far=77.7)
        self.depths = np.array([0.1, 0.3, 5.1, 77.7])
        self.validation = fathom.validate(self.map["Z"], self.scene, self.camera, "float32-ray")
        self.map_file = self.write("map.exr", lambda file: self.map.write(file))
        self.camera_file = self.write("camera.json", lambda file: self.camera.write(file))
        self.mesh_file = self.text("mesh.obj", "v -2.1 -2 3\nv 2 -2.3 5\nv 0 2 4.1\nv 0 0 5e-324\nf 1 2 3\nf 1 2 4\n")
        rows = "".join(" ".join(map(repr, row)) + "\n" for row in turned.tolist())
        line = " ".join(map(repr, turned.ravel().tolist())) + "\n"
        self.path = self.text("path.txt", "0 5e-324 0.1 0 0 0 0 1\n1 2.1 3.3 4 0.1 0.5 0 0.7\n")
        self.lidar = self.text("lidar.json", json.dumps({
            "data_format": {"pixels_per_column": 2, "columns_per_frame": 3}, "lidar_mode": "3x1",
            "beam_altitude_angles": [10.1, -7.3], "beam_azimuth_angles": [1.3, 5e-324], "lidar_origin_to_beam_origin_mm": 15.8,
            "lidar_to_sensor_transform": [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36.1, 0, 0, 0, 1]}))
        self.tum = self.text("groundtruth.txt", "1.5 2.1 3.3 4 0.1 0.5 0 0.7\n")
        self.seven = self.text("seq/frame-000007.pose.txt", rows).parent
        self.text("scannet/pose/0.txt", rows)
        self.text("scannet/intrinsic/intrinsic_depth.txt", "577.1 0 319.5 0\n0 577.3 239.5 0\n0 0 1 0\n0 0 0 1\n")
        self.replica = self.text("room/traj.txt", line).parent
        self.text("cam_params.json", json.dumps({"camera": dict(w=1200, h=680, fx=600.1, fy=600, cx=599.5, cy=339.5)}))
        self.iphone = self.text("pose.json", json.dumps({"frame_0": {"intrinsic": K, "aligned_pose": turned.tolist()}}))
        self.kitti = self.text("calib.txt", "P2: 500.1 0 320 50.3 0 510.3 240 0.1 0 0 1 0.003\n")
        self.poses = self.text("00.txt", " ".join(line.split()[:12]) + "\n")
        node = {"name": "eye", "camera": 0, "translation": [1.1, 2, 3], "rotation": [0.1, 0.2, 0.3, 0.9]}
        orthographic = {"type": "orthographic", "orthographic": dict(xmag=4.1, ymag=3.075, znear=0, zfar=9)}
        self.gltf = self.text("a.gltf", json.dumps({"asset": {"version": "2.0"}, "cameras": [orthographic], "nodes": [node]}))
        self.sfm = self.text("a.sfm", json.dumps({
            "version": ["1", "2", "0"],
            "views": [{"viewId": "1", "poseId": "1", "intrinsicId": "1", "path": "/a/b.jpg"}],
            "intrinsics": [{"intrinsicId": "1", "width": "640", "height": "480", "type": "pinhole",
                            "pxFocalLength": ["500.1", "510.3"], "principalPoint": ["320.2", "240"]}],
            "poses": [{"poseId": "1", "pose": {"transform": {
                "rotation": ["1", "0", "0", "0", "0.6", "-0.8", "0", "0.8", "0.6"], "center": ["0.1", "0.3", "2"]}}}]}))

    def text(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def write(self, name, work):
        work(self.folder / name)
        return self.folder / name

    def written(self, name, work):
        """What a call writes."""
        return self.write(name, work).read_bytes()

    def files(self, name, work):
        work(self.folder / name)
        return {str(path.relative_to(self.folder / name)): path.read_bytes() for path in sorted((self.folder / name).rglob("*"))
                if path.is_file()}


def numbers_of(rays):
    return rays.origins, rays.directions


def changed(given):
    scene = fathom.Scene()
    scene.add_mesh(given.narrow, given.faces, pose=turned)
    return scene


def placed(given):
    scene = changed(given)
    scene.add_instance(0, turned)
    return scene.bounds


def with_mattes(given):
    copy = given.map.copy()
    copy.add_cryptomatte(given.scene)
    return copy


def open3d_scene(given):
    scene = RaycastingScene()
    scene.add_triangles(given.vertices, given.faces)
    return scene


def trimesh_rays(given):
    return RayMeshIntersector(SimpleNamespace(vertices=given.vertices, faces=given.faces))


def refused(call):
    with pytest.raises(NotImplementedError):
        call([(0, 0, 0)])


def judged(given):
    return fathom.testing.assert_depth(given.map["Z"], given.scene, given.camera, model="float32-ray")


def lit(given, **more):
    return fathom.areas(given.scene, directions=[(0.1, 0.2, -1), (0.1, 0.3, -0.7)], by="triangle", **more)


def dataframe(given):
    """With a dict in place of a DataFrame: pandas may be missing."""
    with unittest.mock.patch.dict(sys.modules, pandas=SimpleNamespace(DataFrame=dict)):
        return lit(given).to_dataframe()


Camera, Map, Scene = fathom.Camera, fathom.Map, fathom.Scene
RaycastingScene, RayMeshIntersector = fathom.compat.RaycastingScene, fathom.compat.RayMeshIntersector
rays_of_six = [(0.1, 0.2, 0, 0.01, 0, 1.1), (0.1, 0.2, 5e-324, 0, 0, 5e-324), (0.3, 0, 1, 0.3, 0, 1)]
three_and_three = np.array(rays_of_six)[:, :3], np.array(rays_of_six)[:, 3:]
calls = {
    "render": lambda g: fathom.render(g.vertices, g.faces, K, turned, (8, 6), pixel_centre=0.5, channels=("Z", "A", "N")),
    "render_deep": lambda g: fathom.render_deep(g.scene, g.camera),
    "validate": lambda g: fathom.validate(g.map["Z"], g.scene, g.camera),
    "doctor": lambda g: fathom.doctor(g.scene, g.camera, g.map["Z"]).report(),
    "Diagnosis.report": lambda g: fathom.doctor(g.scene, g.camera, g.map["Z"]).report(),
    "Diagnosis.correct": lambda g: fathom.doctor(g.scene, g.camera, g.map["Z"]).correct(g.camera, g.map["Z"]),
    "verify": lambda g: fathom.verify(g.map, g.scene),
    "visible": lambda g: fathom.visible(g.scene, g.camera),
    "areas": lambda g: {name: value for name, value in vars(lit(g)).items() if not name.startswith("_")},
    "Areas.exact": lambda g: lit(g).exact(0, 0),
    "Areas.to_dataframe": dataframe,
    "draw": lambda g: g.written("w.svg", lambda file: fathom.draw(g.scene, g.camera, file)),
    "probe": lambda g: fathom.probe(g.scene, g.camera, 3, 2),
    "evaluate": lambda g: fathom.evaluate(g.other, g.scene, g.camera, within=[0.01, 0.1], points=500, keep_points=True),
    "compare": lambda g: fathom.compare(g.map["Z"], g.near_map, metrics="channel"),
    "clip": lambda g: fathom.clip([[(0, 0), (4.1, 0), (0, 3.3)]], [[(1, 1), (9, 0.7), (1, 5)]], "intersection"),
    "read_map": lambda g: fathom.read_map(g.map_file),
    "read_cameras": lambda g: fathom.read_cameras(g.camera_file),
    "write_cameras": lambda g: g.written("w.json", lambda file: fathom.write_cameras(file, [g.camera])),
    "scan": lambda g: fathom.scan("edge-values", triangle=[(0.1, 0.3), (7.1, 1.7), (2.3, 6.9)], width=8, height=8, arithmetic="float64"),
    "scanning.scan": lambda g: fathom.scan("bresenham", line=(0, 0, 8, 3), trace=True),
    "scanning.algorithms": lambda g: fathom.scanning.algorithms(),
    "pipeline.render": lambda g: fathom.pipeline.render(g.scene, g.camera),
    "pipeline.trace": lambda g: fathom.pipeline.trace(g.scene, g.camera, pixel=(3, 3)),
    "pipeline.stages": lambda g: fathom.pipeline.stages(),
    "pipeline.run": lambda g: fathom.pipeline.run("perspective-division", {"clip": [(3, 1, 2, 8.1)]}, precision="binary64"),
    "studies.names": lambda g: fathom.studies.names(),
    "studies.run": lambda g: fathom.studies.run("depth-resolution", near=0.3, far=77.7, samples=20),
    "studies.Study.write": lambda g: g.files("study", fathom.studies.run("depth-resolution", near=0.3, samples=20).write),
    "testing.assert_depth": judged,
    "testing.keep_report": lambda g: g.files("kept", lambda folder: fathom.testing.keep_report(folder, g.map["Z"], g.camera, g.validation)),
    "Camera.from_opencv": lambda g: Camera.from_opencv(K, turned, (8, 6), pixel_centre=0),
    "Camera.from_directions": lambda g: Camera.from_directions(np.linspace(0.1, 0.9, 8 * 6 * 3).reshape(6, 8, 3), world_to_camera=turned),
    "Camera.directions": lambda g: g.camera.directions(),
    "Camera.from_opengl": lambda g: Camera.from_opengl(
        np.diag([1.1, 1.3, -1.2, 0]) + np.eye(4, k=1) * -0.3 - np.eye(4, k=-1) * (np.arange(4) == 2),
        np.diag([1.0, 1, 1, 1]), (8, 6)),
    "Camera.look_at": lambda g: Camera.look_at((1, 0.2, 0.3), (0.1, 0.7, 9), **lens),
    "Camera.orbit": lambda g: Camera.orbit(3, centre=(0.1, 0.2, 0.3), distance=7.7, **lens),
    "Camera.frame": lambda g: Camera.frame(g.scene, azimuth=35, elevation=20.1, **lens),
    "Camera.orbit_scene": lambda g: Camera.orbit_scene(g.scene, 3, **lens),
    "Camera.from_json": lambda g: Camera.from_json(g.camera_file.read_text()),
    "Camera.read": lambda g: Camera.read(g.camera_file),
    "Camera.to_json": lambda g: g.camera.to_json(),
    "Camera.write": lambda g: g.written("w.json", g.camera.write),
    "Camera.project": lambda g: g.camera.project(g.vertices),
    "Camera.unproject": lambda g: g.camera.unproject(g.vertices[:, :2], g.vertices[:, 2]),
    "Camera.rays": lambda g: g.camera.rays(),
    "Camera.scaled": lambda g: g.camera.scaled(0.3),
    "Camera.with_size": lambda g: g.camera.with_size(16, 12),
    "Camera.from_colmap": lambda g: Camera.from_colmap(source / "data/cameras/colmap"),
    "Camera.from_nerf": lambda g: Camera.from_nerf(source / "data/cameras/transforms.json"),
    "Camera.from_bop": lambda g: Camera.from_bop(source / "data/cameras/scene_camera.json", (640, 480)),
    "Camera.from_sfm_data": lambda g: Camera.from_sfm_data(g.sfm),
    "Camera.from_gltf": lambda g: Camera.from_gltf(g.gltf, (640, 480)),
    "Camera.from_matrices": lambda g: Camera.from_matrices(K, [turned], (8, 6), direction="camera-to-world", axes="opengl", pixel_centre=0),
    "Camera.from_tum": lambda g: Camera.from_tum(g.tum, "ros"),
    "Camera.from_7scenes": lambda g: Camera.from_7scenes(g.seven),
    "Camera.from_scannet": lambda g: Camera.from_scannet(g.folder / "scannet"),
    "Camera.from_scannetpp": lambda g: Camera.from_scannetpp(g.iphone),
    "Camera.from_replica": lambda g: Camera.from_replica(g.replica),
    "Camera.from_kitti": lambda g: Camera.from_kitti(g.kitti, poses=g.poses, camera=2, size=(1241, 376)),
    "DeepMap.at": lambda g: g.deep.at(3, 2),
    "DeepMap.read": lambda g: fathom.DeepMap.read(g.write("deep.exr", g.deep.write)),
    "DeepMap.write": lambda g: g.written("deep.exr", g.deep.write),
    "DepthFormat.encode": lambda g: g.format.encode(g.depths),
    "DepthFormat.decode": lambda g: g.format.decode(g.format.encode(g.depths)),
    "DepthFormat.values": lambda g: g.format.values(g.format.encode(g.depths)),
    "DepthFormat.resolution": lambda g: g.format.resolution(g.depths),
    "DepthFormat.separation_behind": lambda g: g.format.separation_behind(g.depths),
    "DepthFormat.bin_width": lambda g: g.format.bin_width(g.depths),
    "DepthFormat.codes_between": lambda g: g.format.codes_between(0.3, 7.7),
    "Map.copy": lambda g: g.map.copy(),
    "Map.read": lambda g: Map.read(g.map_file),
    "Map.write": lambda g: [g.written("w" + suffix, lambda file: g.map.write(file, channel=channel))
                            for suffix, channel in ((".exr", ""), (".npz", ""), (".pfm", "Z"), (".npy", "A"))]
    + [g.written("w.png", g.codes.write), *(path.read_bytes() for path in sorted(g.folder.glob("w.png*")))],
    "Map.preview": lambda g: [g.map.preview(), g.map.preview(channel="N"), g.written("w.png", lambda file: g.map.preview(file, unit="m"))],
    "MapComparison.preview": lambda g: fathom.compare(g.map, g.near_map, channel="Z").preview(by="relative"),
    "Map.view": lambda g: fathom.render(g.vertices, g.faces, K, np.stack([turned, np.eye(4)]), (8, 6), pixel_centre=0.5).view(1),
    "Map.mask": lambda g: g.scene.render(g.camera, background=0.1).mask(),
    "Map.to_distance": lambda g: g.scene.render(g.camera).to_distance(),
    "Map.to_depth": lambda g: g.scene.render(g.camera, channels=("distance",)).to_depth(),
    "Map.to_disparity": lambda g: g.map.to_disparity(0.13, doffs=0.01),
    "Map.stored_as": lambda g: g.map.stored_as(np.uint16, channel="Z", scale=999.9),
    "Map.points": lambda g: g.scene.render(g.camera).points(),
    "Map.write_mask": lambda g: g.written("w.png", g.map.write_mask),
    "Map.write_points": lambda g: g.written("w.ply", g.map.write_points),
    "Map.add_cryptomatte": with_mattes,
    "Scene.read": lambda g: Scene.read(g.mesh_file).vertices(),
    "Scene.add_mesh": lambda g: changed(g).bounds,
    "Scene.add_instance": placed,
    "Scene.vertices": lambda g: g.scene.vertices(),
    "Scene.faces": lambda g: g.scene.faces(),
    "Scene.origin": lambda g: g.scene.origin(1),
    "Scene.render": lambda g: g.scene.render(g.camera, background=0.1),
    "Scene.cast": lambda g: [g.scene.cast((0.1, 0.2, 0), [(0.01, 0, 1.1), (0, 0, 5e-324), (0.3, 0, 1)], dtype=dtype, mode=mode,
                                          channels=("t", "id", "distance", "P", "bary", "N"))
                             for dtype in ("float32", "float64") for mode in ("nearest", "all")],
    "Scene.occluded": lambda g: g.scene.occluded((0.1, 0.2, 0), [(0.01, 0, 1.1), (0, 0, 5e-324)]),
    "Scene.count": lambda g: g.scene.count((0.1, 0.2, 0), [(0.01, 0, 1.1), (0, 0, 5e-324)]),
    "Scene.contains": lambda g: g.scene.contains([(0.1, 0.2, 0), (5e-324, 0.3, 4.1)]),
    "Scene.sees": lambda g: [g.scene.sees((0.1, 0.2, 0), points, edges=edges) for edges in ("closed", "generic")
                             for points in (fathom.SurfacePoints([0, 1], [(0.1, 5e-324), (0.3, 0.2)]), (0, 5e-324, 9.1))],
    "Scene.seen_by": lambda g: g.scene.seen_by([(0, 0.1, 5e-324), (5e-324, 0.3, 4.1)], g.camera),
    "Validation.report": lambda g: g.validation.report(),
    "Rays.from_camera": lambda g: [g.scene.cast(fathom.Rays.from_camera(g.camera), channels=("t", "id", "P")),
                                   g.scene.cast(fathom.Rays.from_camera(g.camera), mode="all")],
    "Rays.read": lambda g: g.scene.cast(fathom.Rays.read(g.text("rays.csv", "x,y,z,dx,dy,dz\n0.1,5e-324,0.2,0.01,0,1.1\n"))),
    "Rays.lidar": lambda g: numbers_of(fathom.Rays.lidar(g.lidar, g.path, start=0.1)),
    "Rays.shutter": lambda g: numbers_of(fathom.Rays.shutter(g.camera, g.path, 0.3, start=0.1)),
    "compat.RaycastingScene.add_triangles": lambda g: open3d_scene(g).count_intersections(rays_of_six),
    "compat.RaycastingScene.cast_rays": lambda g: dict(open3d_scene(g).cast_rays(rays_of_six)),
    "compat.RaycastingScene.test_occlusions": lambda g: open3d_scene(g).test_occlusions(rays_of_six, tfar=3.1),
    "compat.RaycastingScene.count_intersections": lambda g: open3d_scene(g).count_intersections(rays_of_six),
    "compat.RaycastingScene.list_intersections": lambda g: dict(open3d_scene(g).list_intersections(rays_of_six)),
    "compat.RaycastingScene.compute_occupancy": lambda g: open3d_scene(g).compute_occupancy([(0.1, 0.2, 0), (5e-324, 0.3, 4.1)]),
    "compat.RaycastingScene.compute_closest_points": lambda g: refused(open3d_scene(g).compute_closest_points),
    "compat.RaycastingScene.compute_distance": lambda g: refused(open3d_scene(g).compute_distance),
    "compat.RaycastingScene.compute_signed_distance": lambda g: refused(open3d_scene(g).compute_signed_distance),
    "compat.RaycastingScene.create_rays_pinhole": lambda g: [
        RaycastingScene.create_rays_pinhole(K, turned, 8, 6),
        RaycastingScene.create_rays_pinhole(41.3, (0.1, 0.7, 9), (1, 0.2, 0.3), (0, 1, 0.1), 8, 6)],
    "compat.RayMeshIntersector.intersects_id": lambda g: trimesh_rays(g).intersects_id(*three_and_three, return_locations=True),
    "compat.RayMeshIntersector.intersects_location": lambda g: trimesh_rays(g).intersects_location(*three_and_three),
    "compat.RayMeshIntersector.intersects_first": lambda g: trimesh_rays(g).intersects_first(*three_and_three),
    "compat.RayMeshIntersector.intersects_any": lambda g: trimesh_rays(g).intersects_any(*three_and_three),
    "compat.RayMeshIntersector.contains_points": lambda g: trimesh_rays(g).contains_points([(0.1, 0.2, 0), (5e-324, 0.3, 4.1)]),
    "compat.Tensor.numpy": lambda g: open3d_scene(g).cast_rays(rays_of_six)["t_hit"].numpy(),
    "compat.Tensor.cpu": lambda g: open3d_scene(g).cast_rays(rays_of_six)["t_hit"].cpu(),
}
#: An object of each class whose properties are looked at.
of_class = {"Areas": lambda g: fathom.areas(g.scene, camera=g.camera), "Camera": lambda g: g.camera, "DeepMap": lambda g: g.deep,
            "DepthFormat": lambda g: g.format,
            "Diagnosis": lambda g: fathom.doctor(g.scene, g.camera, g.map["Z"]),
            "MapComparison": lambda g: fathom.compare(g.map, g.near_map, channel="Z"),
            "Map": lambda g: g.scene.render(g.camera, background=0.1), "Scene": lambda g: g.scene,
            "Rays": lambda g: fathom.Rays(*three_and_three),
            "Validation": lambda g: g.validation, "studies.Study": lambda g: fathom.studies.run("depth-resolution", samples=20)}


def members():
    """(name, member) of everything public that is called or looked at."""
    modules = {"": (fathom, fathom.__all__), "compat.": (fathom.compat, None), "pipeline.": (fathom.pipeline, None),
               "scanning.": (fathom.scanning, None), "studies.": (fathom.studies, None), "testing.": (fathom.testing, None)}
    for prefix, (module, names) in modules.items():
        own = [name for name, value in vars(module).items() if not name.startswith("_") and (
            getattr(value, "__module__", None) == module.__name__)]
        for name in own if names is None else names:
            value = getattr(module, name)
            if inspect.isclass(value) and not issubclass(value, (Exception, tuple)):
                classes = [each for each in value.__mro__ if each.__module__.startswith("fathom")]
                for attribute in {attribute: None for each in classes for attribute in vars(each)}:
                    member = inspect.getattr_static(value, attribute)
                    if not attribute.startswith("_") and (callable(member) or isinstance(member, (property, classmethod, staticmethod))):
                        yield f"{prefix}{name}.{attribute}", member
            elif inspect.isroutine(value):
                yield prefix + name, value


functions = sorted(name for name, member in members() if not isinstance(member, property) and not name.startswith("testing.pytest_")
                   and not name.endswith("_fixture"))
properties = sorted(name for name, member in members() if isinstance(member, property))


def bits(value):
    """What a value consists of, to be compared in the standard mode."""
    if isinstance(value, np.ndarray):
        return (value.dtype.str, value.shape, value.tobytes() if value.dtype != object else bits(value.tolist()))
    if isinstance(value, (float, np.floating)):
        return float(value).hex()
    if isinstance(value, fathom.Map):
        return [bits(dict(value)), dict(value.metadata), bits(value.background)]
    if isinstance(value, dict):
        return {str(key): bits(each) for key, each in value.items()}
    if isinstance(value, (tuple, list)):
        return [bits(each) for each in value]
    if isinstance(value, fathom.Camera):
        return [bits(getattr(value, name)) for name in ("size", "projection", "near", "far", "pixel_centre", "K", "world_to_camera")]
    if isinstance(value, (fathom.DeepMap, fathom.Validation, fathom.studies.Study)):
        names = [*getattr(type(value), "__slots__", ()), *getattr(value, "__dict__", ())]
        return {name: bits(getattr(value, name)) for name in names if not name.startswith("_")}
    if dataclasses.is_dataclass(value):
        return bits(dataclasses.asdict(value))
    return re.sub(r" at 0x[0-9a-f]+", "", repr(value))


@pytest.fixture(scope="module")
def given(tmp_path_factory):
    return Given(tmp_path_factory.mktemp("python"))


def expect_the_same(call):
    outcomes = {mode: bits(outcome) for mode, outcome in in_every_mode(call)}
    for mode, outcome in outcomes.items():
        assert outcome == outcomes["standard"], mode


def test_every_function_has_a_call():
    assert set(calls) == set(functions)
    assert {name.rpartition(".")[0] for name in properties} <= set(of_class)


@pytest.mark.parametrize("name", functions)
def test_every_mode_gives_the_same(name, given):
    expect_the_same(lambda: calls[name](given))


@pytest.mark.parametrize("name", properties)
def test_every_property_is_the_same(name, given):
    kind, _, attribute = name.rpartition(".")
    owner = of_class[kind](given)
    expect_the_same(lambda: getattr(owner, attribute))


def test_bindings_go_through_the_guard():
    """What defines functions and classes of the extension modules is entry_points.h; module.cpp makes exceptions."""
    for path in (source / "lib/python/core").iterdir():
        text = path.read_text(encoding="utf-8")
        if path.name not in ("entry_points.h", "module.cpp"):
            assert not re.search(r"class_<|module_&|cpp_function|\benum_<", text), path
