#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/failures/unknown_name.h"

namespace fathom {

/// What other programs and people call a thing, in small letters and digits alone, and its name.
struct OtherName {
  std::string_view other, name;
};

/// The name that `others` lists for this one; nothing if there is none, or more than one.
std::optional<std::string_view> name_meant_by(std::string_view name,
                                              std::span<const OtherName> others);

/// The failure for a name that is none of `names`. Unless the name is nearly one of them, it
/// suggests those that `others` lists for it; upper case, hyphens and underscores do not matter.
UnknownName unknown_name(const std::string& message, const std::string& name,
                         std::vector<std::string> names, std::span<const OtherName> others);

}  // namespace fathom
