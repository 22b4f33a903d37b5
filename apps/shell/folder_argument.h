#pragma once

#include <string>

namespace fathom::app {

/// For an argument that may name the folder of `file` in place of this file.
/// Fails    InputError if the folder contains the file.
void refuse_folder_of(const char* file, const std::string& argument);

}  // namespace fathom::app
