#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/failures/errors.h"
#include "fathom/mesh_files/read_options.h"
#include "fathom/scene/scene.h"

namespace fathom {

/// An instance of a model in an image of BOP: [cam_R_m2c | cam_t_m2c], lengths in millimetres.
struct BopInstance {
  std::uint32_t model = 0;
  Pose pose{};
};

/// An image of a BOP scene. The world is the camera's frame, in which the file has its poses.
struct BopImage {
  std::uint64_t id = 0;
  /// The camera; its name is the name of the image's files: "000017".
  Camera camera;
  /// The unit of its depth image in millimetres.
  double depth_scale = 1;
  /// The instances in the order of the file.
  std::vector<BopInstance> instances;
};

/// The images that are in both scene_camera.json and scene_gt.json of a folder, in the order of
/// their ids. `width` and `height` are in pixels; 0: the size in the data set's camera.json
/// (import_bop()).
/// Fails    InputError, one line that names the file and the key.
std::vector<BopImage> read_bop_images(const std::filesystem::path& folder, std::uint32_t width,
                                      std::uint32_t height);

/// The models obj_000001.ply and so on that images show, from a folder. Lengths are as in the
/// files.
/// Fails    InputError, also if a model is missing.
class BopModels {
 public:
  BopModels(const std::filesystem::path& folder, const std::vector<BopImage>& images,
            const ReadOptions& options, Warnings& warnings);

  /// The scene of some instances: an object for each, in their order. Valid until the next call.
  const Scene& scene_of(std::span<const BopInstance> instances);
  [[nodiscard]] const std::vector<Source>& sources() const { return scene_.sources; }

 private:
  Scene scene_;
  /// The objects of the models' files, and the numbers of the models.
  std::vector<Object> models_;
  std::vector<std::uint32_t> numbers_;
};

}  // namespace fathom
