#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/view/page.h"

namespace fathom::view {

/// Whether a text begins as a page does, and holds the maps of a report of `fathom validate`.
bool is_report(std::string_view text);

/// The maps of a report.html: of each scene the exact map, with Z and id, and after it those of the
/// renderers, with Z and `class`, what was found about each pixel. `name` is the file's name for
/// messages. `most_bytes` is what the maps may take.
/// Fails    InputError: "NAME: is not a report of fathom validate: …".
std::vector<ViewedMap> maps_of_report(std::string_view text, const std::string& name,
                                      std::uint64_t most_bytes);

}  // namespace fathom::view
