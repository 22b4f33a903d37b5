#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/image/depth_map.h"

/// What the numbers of a map stand for, as files of every format carry it: a text for each channel,
/// `fathom.objects`, `fathom.materials`, `fathom.groups` and `fathom.parts`, the JSON list of
/// names.
namespace fathom::image {

/// Whether a text of this name is such a list.
bool is_name_table(std::string_view text_name);

/// The names of a channel's numbers; nullptr if the map has none.
const std::vector<std::string>* names_of_channel(const DepthMap& map, const std::string& channel);

/// The texts of a map, by their names; none of lists that are empty.
std::map<std::string, std::string> name_tables(const DepthMap& map);

/// Puts a list back where it came from. A text that is no list of strings is an empty one.
void take_name_table(const std::string& text_name, const std::string& text, DepthMap& map);

}  // namespace fathom::image
