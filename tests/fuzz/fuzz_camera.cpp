#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/data_set_cameras.h"
#include "fathom/failures/errors.h"
#include "fathom/scene/read_scene.h"

namespace {

using namespace fathom;
using namespace fathom::camera;

/// The text up to a line of ---, and what follows it: a second file, which may be missing.
std::pair<std::string, std::optional<std::string>> two_files(const std::string& text) {
  const std::string line = "---\n";
  const std::size_t at = text.find(line);
  if (at == std::string::npos) return {text, std::nullopt};
  return {text.substr(0, at), text.substr(at + line.size())};
}

constexpr const char* rig_of_fuzzer = "image_02: 1 0 0 0.5 0 0 1 0.75 0 -1 0 1.25\n";

std::vector<ImportedCamera> parse_data_set(char format, const std::string& text) {
  const auto [first, second] = two_files(text);
  const NamedText file{first, "first"};
  const std::optional<NamedText> other =
      second ? std::optional(NamedText{*second, "second"}) : std::nullopt;
  switch (format) {
    case 'm': {
      const MatrixConvention convention{PoseDirection::camera_to_world, CameraAxes::opengl, 0};
      return import_matrices(
          parse_poses(first, "first", "stem"),
          parse_intrinsic_matrices(second.value_or("1 0 2 0 3 4 0 0 1"), "second"), convention, 8,
          6, "first");
    }
    case 't':
      return parse_tum(file, other, *tum_lens("ros"));
    case '7':
      return {parse_7scenes(file, "frame-000000", {})};
    case 's': {
      Camera lens;
      lens.width = lens.height = 8;
      if (other) parse_scannet_intrinsics(*other);
      return {parse_scannet(file, "0", lens)};
    }
    case 'p':
      return parse_scannetpp(file, {});
    case 'r':
      return parse_replica(file, other, {.width = 8, .height = 6});
    case 'q':
      return parse_kitti360(file, {}, other,
                            other ? std::optional(NamedText{rig_of_fuzzer, "rig"}) : std::nullopt);
    default:
      return parse_kitti(file, other, 2, {.width = 8, .height = 6});
  }
}

/// The first byte says which format the rest is in.
std::vector<ImportedCamera> parse(char format, const std::string& text) {
  Warnings warnings;
  switch (format) {
    case 'j': {
      std::vector<ImportedCamera> cameras;
      for (const Camera& camera : read_cameras(text, "input")) cameras.push_back({camera, {}, {}});
      return cameras;
    }
    case 'n':
      return parse_nerf(text, "input", 640, 480, warnings);
    case 'b':
      return parse_bop(text, "input", 640, 480);
    case 'o':
      return parse_opengl(text, "input");
    case 'g':
      return parse_gltf_cameras(text, "input", 640, 480);
    case 'v':
      return cameras_of_opencv(text, "input", {});
    case 'w':
      return cameras_of_ros(text, "input", {});
    case 'l':
      return cameras_of_kalibr(text, "input", {});
    case 'i':
      return cameras_of_aria(text, "input", {});
    case 'e':
      return parse_blender(text, "input");
    case 'a':
      return parse_sfm_data({text, "input"});
    case 'm':
    case 't':
    case '7':
    case 's':
    case 'p':
    case 'r':
    case 'k':
    case 'q':
      return parse_data_set(format, text);
    default: {
      // COLMAP: two files, the first as long as the next byte says, times four.
      if (text.empty()) return {};
      const std::size_t length = 4 * static_cast<std::size_t>(static_cast<unsigned char>(text[0]));
      if (length + 1 > text.size()) return {};
      std::istringstream cameras(text.substr(1, length)), images(text.substr(1 + length));
      return format == 'c' ? parse_colmap_text({cameras, "cameras.txt"}, {images, "images.txt"})
                           : parse_colmap_binary({cameras, "cameras.bin"}, {images, "images.bin"});
    }
  }
}

}  // namespace

/// Any bytes as cameras: an InputError of one line, or cameras without fault that their own text
/// gives again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    const auto cameras = parse(static_cast<char>(data[0]), std::string(data + 1, data + size));
    for (const ImportedCamera& imported : cameras) {
      for (const std::string& reason : {imported.fault, imported.absence, imported.distortion})
        if (reason.find('\n') != std::string::npos) std::abort();
      if (!imported.fault.empty() || !imported.absence.empty()) continue;
      if (find_fault(imported.camera)) std::abort();
      const std::string text = to_json(imported.camera);
      if (to_json(read_cameras(text, "again")) != text) std::abort();
    }
  } catch (const InputError& e) {
    if (std::string(e.what()).find('\n') != std::string::npos) std::abort();
  }
  return 0;
}
