#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fathom/camera/camera.h"

namespace fathom::camera {

/// read_cameras on a file's text; `name` is the file's name for messages. For tests and fuzzers.
std::vector<Camera> parse_cameras(std::string_view text, const std::string& name);

}  // namespace fathom::camera
