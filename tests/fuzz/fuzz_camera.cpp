#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_import_internal.h"
#include "fathom/numeric/errors.h"
#include "fathom/scene/read_scene.h"

namespace {

using namespace fathom;
using namespace fathom::camera;

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
      if (!imported.fault.empty()) continue;
      if (find_fault(imported.camera)) std::abort();
      const std::string text = to_json(imported.camera);
      if (to_json(read_cameras(text, "again")) != text) std::abort();
    }
  } catch (const InputError& e) {
    if (std::string(e.what()).find('\n') != std::string::npos) std::abort();
  }
  return 0;
}
