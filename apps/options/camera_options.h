#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/camera/camera_making.h"
#include "fathom/scene/scene.h"

namespace fathom::app {

/// `--view --up`: where a camera stands as seen from what it looks at.
struct ViewOptions {
  std::string view;
  std::string up = "y";

  void add_to(CLI::App& command);
  [[nodiscard]] View get() const;
};

/// `--camera FILE`, or the camera that frames the scene with
/// `--view --up --size --fov --near --far`.
class CameraOptions {
 public:
  void add_to(CLI::App& command);
  /// Whether the cameras come from a file.
  [[nodiscard]] bool from_file() const { return !file_.empty(); }
  /// Fails with InputError where the scene has no triangle to frame.
  [[nodiscard]] std::vector<Camera> get(const Scene& scene) const;
  /// For a command that takes no path of cameras. Fails with UsageError where there is one.
  [[nodiscard]] Camera get_one(const Scene& scene, const char* command) const;
  /// The options' own faults, before any work.
  void check() const {
    (void)lens();
    (void)view_.get();
  }

 private:
  [[nodiscard]] Lens lens() const;

  std::string file_;
  ViewOptions view_;
  std::string size_ = "1280x720";
  std::string fov_ = "40";
  std::string near_, far_;
};

}  // namespace fathom::app
