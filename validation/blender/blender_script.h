#pragma once

namespace fathom::validation {

/// The script that Blender runs: it reads scene.json, points.bin (binary32) and triangles.bin
/// beside it, renders with Cycles on the processor and writes depth.exr. One sample per pixel, the
/// narrowest filter.
inline constexpr const char* blender_script = R"(import array, json, os, sys
import bpy
from mathutils import Matrix

folder = os.path.dirname(os.path.abspath(__file__))
scene_file = json.load(open(os.path.join(folder, "scene.json")))

def numbers(name, kind):
    values = array.array(kind)
    with open(os.path.join(folder, name), "rb") as file:
        values.frombytes(file.read())
    return values

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
points, corners = numbers("points.bin", "f"), numbers("triangles.bin", "i")
mesh = bpy.data.meshes.new("mesh")
mesh.vertices.add(len(points) // 3)
mesh.vertices.foreach_set("co", points)
mesh.loops.add(len(corners))
mesh.loops.foreach_set("vertex_index", corners)
count = len(corners) // 3
mesh.polygons.add(count)
mesh.polygons.foreach_set("loop_start", range(0, 3 * count, 3))
mesh.polygons.foreach_set("loop_total", [3] * count)
mesh.update()
scene.collection.objects.link(bpy.data.objects.new("mesh", mesh))

given = scene_file["camera"]
camera = bpy.data.cameras.new("camera")
camera.type = "PANO" if given["panorama"] else "PERSP" if given["perspective"] else "ORTHO"
camera.sensor_fit = "HORIZONTAL"
camera.sensor_width = 36.0
if given["panorama"]:
    camera.sensor_height = camera.sensor_width * given["height"] / given["width"]
    camera.cycles.panorama_type = given["panorama"]
    camera.cycles.fisheye_fov = given["fisheye_fov"]
    camera.cycles.fisheye_lens = given["fisheye_lens"]
elif given["perspective"]:
    camera.lens = given["lens"]
else:
    camera.ortho_scale = given["ortho_scale"]
camera.shift_x, camera.shift_y = given["shift_x"], given["shift_y"]
camera.clip_start, camera.clip_end = given["near"], given["far"]
holder = bpy.data.objects.new("camera", camera)
holder.matrix_world = Matrix(given["world_from_camera"])
scene.collection.objects.link(holder)
scene.camera = holder

render = scene.render
render.engine = "CYCLES"
render.resolution_x, render.resolution_y = given["width"], given["height"]
render.resolution_percentage = 100
render.pixel_aspect_x, render.pixel_aspect_y = given["aspect_x"], given["aspect_y"]
render.threads_mode, render.threads = "FIXED", 1
scene.cycles.device = "CPU"
scene.cycles.samples = 1
scene.cycles.use_adaptive_sampling = False
scene.cycles.use_denoising = False
# A box filter is one pixel wide whatever filter_width says.
scene.cycles.pixel_filter_type = "BLACKMAN_HARRIS"
scene.cycles.filter_width = 0.01
scene.cycles.max_bounces = 0
layer = scene.view_layers[0]
layer.use_pass_z = True
layer.use_pass_combined = False
layer.use_pass_normal = True
layer.use_pass_position = True
render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
render.image_settings.color_depth = "32"
render.filepath = os.path.join(folder, "depth.exr")
bpy.ops.render.render(write_still=True)
)";

}  // namespace fathom::validation
