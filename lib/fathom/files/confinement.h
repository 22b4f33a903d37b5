#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fathom/files/descriptor.h"

/// Which files another file may name: a scene file its meshes, a glTF asset its buffers.
namespace fathom::files {

/// A folder that files named by other files must lie in, at whatever depth.
struct Boundary {
  std::filesystem::path folder;
  /// Ends the message of a refusal: "FILE: lies outside FOLDER, RULE".
  std::string rule;
};

/// The boundary of every file that another file names, where `folder` confines them; none where it
/// is empty.
std::vector<Boundary> boundaries_of(const std::filesystem::path& folder);

/// Opens a file that another file names, for reading. It must be a regular
/// file: no pipe, no device, which are not even opened to find out. It must lie in the
/// folder of every boundary where all symbolic links have led: the file that is opened is the one
/// that is examined, even if someone exchanges a link meanwhile.
/// Fails    InputError "PATH: …": as above, missing or not readable; with boundaries, also where
///          there is no /proc to ask where a file lies.
Descriptor open_confined(const std::filesystem::path& path,
                         const std::vector<Boundary>& boundaries);

}  // namespace fathom::files
