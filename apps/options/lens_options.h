#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "fathom/camera/camera_making.h"

namespace fathom::app {

/// `--size --fov --focal --orthographic --near --far`: what a made camera looks through.
struct LensOptions {
  std::string size = "1280x720", fov, focal, orthographic, near, far;

  void add_to(CLI::App& command);
  [[nodiscard]] Lens get() const;
};

}  // namespace fathom::app
