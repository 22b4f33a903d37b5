#pragma once

#include <string>
#include <vector>

#include "fathom/camera/camera.h"

namespace fathom::app {

/// The name of a file for each camera, by a pattern: {index} is the camera's number from 0 on,
/// {index:04} the same with leading zeros, {name} its name, {stem} the last part of its name
/// without the suffix; {{ and }} are braces. A pattern without a field is for a single camera.
/// Fails    UsageError, naming the option, where the pattern has another field or a single brace,
///          or two cameras would share a name;
///          InputError where a camera has no name, or {name} would leave the folder.
std::vector<std::string> names_of_outputs(const char* option, const std::string& pattern,
                                          const std::vector<Camera>& cameras);

/// A name as a place below a folder: "images/1.jpg". Fails with InputError, beginning with `where`,
/// where it is absolute, has a part "..", or has none that names a file.
std::string require_within_folder(const std::string& where, const std::string& name);

}  // namespace fathom::app
