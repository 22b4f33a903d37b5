#pragma once

#include <string>
#include <string_view>

namespace fathom::app {

/// The name of an output that has no other yet: ".fathom-", 16 hexadecimal digits that no other
/// process has drawn, ".part".
std::string new_part_name();

/// Whether a file's name is one of these.
bool is_part_name(std::string_view name);

}  // namespace fathom::app
