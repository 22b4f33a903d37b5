#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/failures/errors.h"

/// Cameras of other programs, converted to Fathom's; docs/conventions.md has the formulas. A lens
/// with distortion is taken over where there is a model for it (lens.h); otherwise an import
/// reports the distortion that it leaves out, unless all its parameters are exactly 0. Entries that
/// follow from a formula (quaternions, inverses, projection matrices, focal lengths of angles) are
/// the exact numbers, rounded to binary64 once (docs/conventions.md#rounding).
///
/// All fail with InputError, one line that names the file and the line or key, if the file as a
/// whole is invalid. The fault of a single camera is stored with that camera, so that it matters
/// only if that camera is chosen (chosen_cameras()).
namespace fathom {

struct ImportedCamera {
  /// Its name is the image's in the other program: COLMAP's NAME, NeRF's file_path, BOP's image id.
  /// Passes find_fault() if there is neither an `absence` nor a `fault`.
  Camera camera;
  /// Set if `camera` is only the pinhole part of a lens without a model here, or without valid
  /// numbers: the file and the lens.
  std::string distortion;
  /// Why there is no camera to take: the image was not tracked or not reconstructed, or its lens
  /// has no pinhole part.
  std::string absence;
  /// Why there is no camera though there should be: the message of an InputError.
  std::string fault;
};

struct CameraChoice {
  /// Only the camera of this image; empty: all cameras.
  std::string image;
  /// Takes the pinhole part of all lenses with distortion; cameras whose lens has none, such as
  /// fisheyes, are left out.
  bool ignore_distortion = false;
};

/// The chosen cameras, in order. Cameras with a `distortion` are left out with a
/// warning that counts them, unless distortion is ignored; so are images without a camera. `input`
/// is the file's name for messages.
/// Fails    InputError if a chosen camera has a fault, if the chosen image is missing, has no
///          camera or a lens with distortion, or if no camera is left.
std::vector<Camera> chosen_cameras(const std::vector<ImportedCamera>& imported,
                                   const std::string& input, const CameraChoice& choice,
                                   Warnings& warnings);

/// A COLMAP model: the folder with cameras and images, .bin (preferred where both exist) or .txt.
/// Sorted by image name. Rigs and frames (COLMAP 3.12) are not needed: images has the pose of each
/// image. A folder that has models in folders below it (sparse/0) is refused with their names.
std::vector<ImportedCamera> import_colmap(const std::filesystem::path& folder);
/// Whether a folder has the files of a COLMAP model.
bool is_colmap_model(const std::filesystem::path& folder);

/// NeRF's transforms.json (also Nerfstudio's, instant-ngp's and ScanNet++'s), in the order of its
/// frames; test_frames follow. Camera to world, OpenGL axes, the image's corner at 0. Intrinsics
/// for all frames or each: fl_x, fl_y, cx, cy, w, h, or camera_angle_x with an image size.
/// `width` and `height` are used where the file has no w and h (the original NeRF data); 0: none.
/// Warns of keys that other programs use to change the geometry on loading (scale, offset, …).
std::vector<ImportedCamera> import_nerf(const std::filesystem::path& file, std::uint32_t width,
                                        std::uint32_t height, Warnings& warnings);

/// BOP's scene_camera.json, or the folder of a scene with it, in the order of image ids. A BOP data
/// set keeps the image size in the camera.json of its root: it is searched next to the file and in
/// the two folders above, unless the caller gives a size (0: none). Without cam_R_w2c and cam_t_w2c
/// the world is the camera frame, which is the frame of the poses in scene_gt.json. Lengths are as
/// in the file (millimetres).
std::vector<ImportedCamera> import_bop(const std::filesystem::path& input, std::uint32_t width,
                                       std::uint32_t height);

/// The cameras of a glTF scene (.gltf, .glb), one for each node that has one, in the order of the
/// nodes, with the node's name, else the camera's. glTF has no image size; if a camera has an
/// aspect ratio, the size must have the same ratio. Cameras use the same node transforms as meshes
/// (gltf/); the scale is ignored, as glTF requires: the axes are scaled to length 1. Each entry of
/// the inverse is rounded once. Lengths are as in the file (metres).
std::vector<ImportedCamera> import_gltf(const std::filesystem::path& file, std::uint32_t width,
                                        std::uint32_t height);

/// Cameras of Blender, as docs/blender/export_cameras.py writes them: the properties of each camera
/// and of the render, with angles in degrees. Perspective, orthographic and Cycles' panoramas
/// except the cubemap's face; the scale of an object is ignored, as in Cycles.
std::vector<ImportedCamera> import_blender(const std::filesystem::path& file);

/// OpenGL matrices: a JSON object, or a list of them, with
///   "projection"            4×4, a list of rows, or a flat list of 16 in OpenGL's column order
///   "modelview" or "view"   the same; the identity where it is missing
///   "viewport"              [width, height] or [x, y, width, height]; the image is the viewport
///   "clip_depth"            "minus-one-one" (OpenGL, the default), "zero-one", or "none": near and
///                           far are not imported
///   "name"                  optional
/// Takes perspective and orthographic projections without rotation, including skewed, off-centre
/// and depth-reversed ones and those with an infinite far plane.
std::vector<ImportedCamera> import_opengl(const std::filesystem::path& file);

/// The same of matrices at hand, each 4×4, row by row; with OpenGL's own clip depths, −1 and 1, and
/// a viewport of width × height.
Camera camera_from_opengl(const std::array<double, 16>& projection,
                          const std::array<double, 16>& modelview, std::uint32_t width,
                          std::uint32_t height);

}  // namespace fathom
