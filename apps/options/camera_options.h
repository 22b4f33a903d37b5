#pragma once

#include <string>
#include <vector>

#include "apps/options/lens_options.h"
#include "apps/shell/command.h"
#include "apps/shell/console.h"
#include "fathom/camera/camera.h"
#include "fathom/camera/camera_making.h"
#include "fathom/scene/scene.h"

namespace fathom::app {

/// `--camera FILE`, or the camera that frames the scene with
/// `--view --up --size --fov --focal --orthographic --near --far`.
class CameraOptions {
 public:
  void add_to(Command& command);
  /// Whether the cameras come from a file.
  [[nodiscard]] bool from_file() const { return !file_.empty(); }
  /// Warnings of the file go to the console.
  /// Fails with InputError where the file holds no camera, or the scene no triangle to frame.
  [[nodiscard]] std::vector<Camera> get(const Scene& scene, const Console& console) const;
  /// For a command that takes no path of cameras. Fails with UsageError where there is one.
  [[nodiscard]] Camera get_one(const Scene& scene, const char* command,
                               const Console& console) const;

 private:
  std::string file_;
  View view_;
  Lens lens_;
};

/// The cameras of a file, each without fault; its warnings go to the console. Fails with InputError.
std::vector<Camera> read_camera_file(const std::string& file, const Console& console);

}  // namespace fathom::app
