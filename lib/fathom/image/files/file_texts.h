#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/image/depth_map.h"

/// Texts of files that are not texts of the map (DepthMap::texts): read_map() turns them into other
/// members of a DepthMap. They describe codes, and name the numbers of channels.
namespace fathom::image {

/// DepthMap::png_scale, of a PNG or NPZ.
inline constexpr const char* scale_text = "fathom:scale";
/// DepthMap::codes_beyond, of a PNG.
inline constexpr const char* beyond_text = "fathom:beyond";
/// The name of a PNG's channel, and the kind of its values: "identifier", "normal" or "mask"; a PNG
/// of codes has no such text.
inline constexpr const char* channel_text = "fathom:channel";
inline constexpr const char* type_text = "fathom:type";
inline constexpr const char* normal_type = "normal";
inline constexpr const char* mask_type = "mask";
/// The axes of normals in the camera's frame: "opengl", or no such text for the channel's own.
inline constexpr const char* axes_text = "fathom:axes";

/// The value of scale_text in the file `name`.
/// Fails    InputError unless it is a positive number.
double read_scale(const std::string& text, const std::string& name);

// The names of the numbers in a map, as files of all formats store them: for each channel a text
// (`fathom.objects`, `fathom.materials`, `fathom.groups` or `fathom.parts`) with the JSON list of
// names.

/// Whether a text of this name is such a list.
bool is_name_table(std::string_view text_name);

/// The names of a channel's numbers; nullptr if the map has none.
const std::vector<std::string>* names_of_channel(const DepthMap& map, const std::string& channel);

/// The texts of a map by their names; empty lists are left out.
std::map<std::string, std::string> name_tables(const DepthMap& map);

/// Puts a list back where it came from. A text that is not a list of strings counts as an empty
/// list.
void take_name_table(const std::string& text_name, const std::string& text, DepthMap& map);

}  // namespace fathom::image
