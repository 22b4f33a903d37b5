#pragma once

#include <filesystem>

#include "fathom/text/json_value.h"

namespace fathom::mesh_files {

/// The file that a relative URI names, looked for from the folder of an asset. Percent signs are
/// decoded. A backslash, which some exporters write for a slash, is one if no file has it in its
/// name.
///
/// Unless `outside_files`, the path must stay in the folder: "../x", "%2e%2e/x" and "/etc/passwd"
/// are refused without a look at the file system. Where symbolic links lead is not looked at here;
/// see files::Boundary.
/// Fails    InputError: no relative URI, or one that leaves the folder.
/// Source   [GLTF20] 2.8 (URIs)
std::filesystem::path file_of_uri(const text::JsonValue& uri, const std::filesystem::path& folder,
                                  bool outside_files);

}  // namespace fathom::mesh_files
