#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/image/channel_table.h"

/// The outputs of `render` as users name them: the contents of a file (`-o NAME=FILE`,
/// `--channels NAME`) and the patterns of file names.
namespace fathom::app {

/// What a file contains: some channels, or a mask, whose channel shows where surfaces are.
struct Contents {
  std::vector<Channel> channels;
  bool is_mask = false;
  /// Whether a list of --channels also names a mask, which needs a separate file.
  bool mask_beside = false;
  /// The object whose mask it is, if it is the mask of one object.
  std::optional<std::uint32_t> object = {};
};

/// "Z,N", "depth" or "mask", which stands alone; in a list of --channels also "Z,mask".
/// Fails    UsageError if a name does not exist or occurs twice.
Contents parse_contents(const std::string& list);
Contents parse_channels_of_outputs(const std::string& list);

/// What to do about a list with a mask.
inline constexpr const char* mask_needs_file = "'mask' needs a separate file: add -o mask=FILE.png";

/// "depth (Z), normal (N), …"
std::string names_of_contents();

/// `-o [NAMES=]FILE`: a file for each camera, and its contents if NAMES are given.
struct OutputArgument {
  std::optional<Contents> contents;
  /// Of file names, for names_of_outputs().
  std::string pattern;
};

/// "depth=z/{stem}.png". A text is only a pattern if its part before the first "=" is not a list of
/// names, or contains a "/" or ".", as in "./depth=1.png".
/// Fails    UsageError if a name is misspelt.
OutputArgument parse_output(const std::string& text);

/// The outputs with a mask for each of the scene's objects in place of each mask whose pattern has
/// the field {object}: the number of the object, with leading zeros as {object:03}.
std::vector<OutputArgument> with_objects(const std::vector<OutputArgument>& outputs,
                                         std::size_t objects);

/// The name of a file for each camera, by a pattern: {index} is the camera's number from 0 on,
/// {index:04} the same with leading zeros, {name} its name, {stem} the last part of its name
/// without the suffix; {{ and }} are braces. A pattern without a field is for a single camera.
/// Fails    UsageError, naming the option, if the pattern has another field or a single brace, or
///          if two cameras would share a name; InputError if a camera has no name, or {name} would
///          leave the folder.
std::vector<std::string> names_of_outputs(const char* option, const std::string& pattern,
                                          const std::vector<Camera>& cameras);

/// A name as a place below a folder: "images/1.jpg". Fails with InputError, beginning with `where`,
/// if it is absolute, has a part "..", or does not end with the name of a file.
std::string require_within_folder(const std::string& where, const std::string& name);

}  // namespace fathom::app
