#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fathom/camera/camera_import.h"
#include "fathom/camera/data_set_cameras.h"
#include "fathom/failures/errors.h"

namespace fathom::text {
class JsonValue;
}

/// The imports of camera_import.h from text and streams that are already open, for their own files,
/// tests and fuzzers. `name` is the file's name for messages.
namespace fathom::camera {

/// A stream with its name.
struct NamedStream {
  std::istream& stream;
  std::string name;
};

/// A camera as `read` fills it in, or with a fault if `read` fails. `where` is the place for faults
/// of the camera as a whole.
template <class Read>
ImportedCamera imported_camera(std::string name, const std::string& where, const Read& read) {
  ImportedCamera result;
  try {
    read(result);
    const bool has_camera = result.fault.empty() && result.absence.empty();
    if (const auto fault = has_camera ? find_fault(result.camera) : std::nullopt)
      result.fault = where + ": " + *fault;
  } catch (const InputError& error) {
    result.fault = error.what();
  }
  result.camera.name = std::move(name);
  return result;
}

/// Both streams must be seekable.
std::vector<ImportedCamera> parse_colmap_binary(NamedStream cameras, NamedStream images);
std::vector<ImportedCamera> parse_colmap_text(NamedStream cameras, NamedStream images);
std::vector<ImportedCamera> parse_nerf(std::string_view text, const std::string& name,
                                       std::uint32_t width, std::uint32_t height,
                                       Warnings& warnings);
std::vector<ImportedCamera> parse_bop(std::string_view text, const std::string& name,
                                      std::uint32_t width, std::uint32_t height);
/// The same of a document that has been parsed.
std::vector<ImportedCamera> parse_bop(const text::JsonValue& root, std::uint32_t width,
                                      std::uint32_t height);
std::vector<ImportedCamera> parse_blender(std::string_view text, const std::string& name);
std::vector<ImportedCamera> parse_opengl(std::string_view text, const std::string& name);
std::vector<ImportedCamera> parse_gltf_cameras(std::string_view bytes, const std::string& name,
                                               std::uint32_t width, std::uint32_t height);
/// The scene_camera.json of the folder of a scene. Fails with InputError if it is missing.
std::filesystem::path bop_camera_file(const std::filesystem::path& folder);
/// The image size of the scenes in a folder, as the camera.json of their data set has it, unless
/// one is given. Fails with InputError.
std::pair<std::uint32_t, std::uint32_t> bop_image_size(const std::filesystem::path& folder,
                                                       std::uint32_t width, std::uint32_t height);
/// The image size of a camera.json of BOP.
std::pair<std::uint32_t, std::uint32_t> parse_bop_size(std::string_view text,
                                                       const std::string& name);

// Imports of data_set_cameras.h. A file that is optional there is an empty text here.

/// `stem` is the name of the pose of a file with a single one.
std::vector<NamedPose> parse_poses(std::string_view text, const std::string& name,
                                   const std::string& stem);
std::vector<IntrinsicMatrix> parse_intrinsic_matrices(std::string_view text,
                                                      const std::string& name);

/// A text with the name of its file.
struct NamedText {
  std::string_view text;
  std::string name;
};

std::vector<ImportedCamera> parse_tum(const NamedText& trajectory,
                                      const std::optional<NamedText>& images,
                                      const ImportedCamera& lens);
/// A frame of 7-Scenes.
ImportedCamera parse_7scenes(const NamedText& pose, const std::string& frame,
                             const GivenLens& given);
/// ScanNet's matrix of a stream, whose upper left 3×3 part is K.
IntrinsicMatrix parse_scannet_intrinsics(const NamedText& file);
/// A frame of ScanNet.
ImportedCamera parse_scannet(const NamedText& pose, const std::string& frame, const Camera& lens);
std::vector<ImportedCamera> parse_scannetpp(const NamedText& file, const GivenLens& given);
std::vector<ImportedCamera> parse_replica(const NamedText& trajectory,
                                          const std::optional<NamedText>& parameters,
                                          const GivenLens& given);
std::vector<ImportedCamera> parse_kitti(const NamedText& calibration,
                                        const std::optional<NamedText>& poses,
                                        std::optional<std::uint32_t> number,
                                        const GivenLens& given);
std::vector<ImportedCamera> parse_sfm_data(const NamedText& file);
/// `poses` and `rig` go together.
std::vector<ImportedCamera> parse_kitti360(const NamedText& json, const GivenLens& given,
                                           const std::optional<NamedText>& poses,
                                           const std::optional<NamedText>& rig);

}  // namespace fathom::camera
