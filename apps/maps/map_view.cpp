#include "apps/maps/map_view.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "fathom/camera/camera_files.h"
#include "fathom/numeric/errors.h"
#include "fathom/scene/read_scene.h"

namespace fathom::app {
namespace {

/// A file in memory, for readers that take a path.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& text) : descriptor_(::memfd_create("text", MFD_CLOEXEC)) {
    const auto size = static_cast<ssize_t>(text.size());
    if (descriptor_ < 0 || ::write(descriptor_, text.data(), text.size()) != size) {
      throw OutputError("no room for a file in memory");
    }
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(descriptor_); }
  [[nodiscard]] std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
  int descriptor_;
};

}  // namespace

std::optional<Camera> camera_of(const DepthMap& map, const std::filesystem::path& file) {
  const auto text = map.texts.find("fathom.camera");
  if (text == map.texts.end()) return std::nullopt;
  const MemoryFile memory(text->second);
  std::vector<Camera> cameras;
  try {
    cameras = read_cameras(memory.path());
  } catch (const InputError& error) {
    std::string message = error.what();
    if (message.starts_with(memory.path())) message.erase(0, memory.path().size());
    throw InputError(file.string() + ": fathom.camera" + message);
  }
  if (cameras.size() != 1) throw InputError(file.string() + ": fathom.camera holds no one camera");
  return cameras[0];
}

MapView view_of(const Camera& camera) {
  MapView view;
  view.orthographic = camera.projection == Projection::orthographic;
  view.fx = camera.fx;
  view.fy = camera.fy;
  view.cx = camera.cx;
  view.cy = camera.cy;
  view.skew = camera.skew;
  view.pixel_centre = camera.pixel_centre;
  view.world_to_camera = camera.world_to_camera;
  return view;
}

}  // namespace fathom::app
