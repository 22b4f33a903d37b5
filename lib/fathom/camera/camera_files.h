#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/camera/camera.h"

namespace fathom {

/// Reads a camera file: one camera, or a list of them (a camera path).
/// Fails    InputError, naming the key; unknown keys are errors.
std::vector<Camera> read_cameras(const std::filesystem::path& file);
/// The same of a file's text; `name` is the file's name for messages.
std::vector<Camera> read_cameras(std::string_view text, const std::string& name);

/// The JSON of camera files with every number to 17 significant digits, so that reading it back
/// gives the same camera bit for bit. Ends without a newline.
std::string to_json(const Camera& camera);
/// A list of cameras; a single one is written as an object.
std::string to_json(const std::vector<Camera>& cameras);

}  // namespace fathom
