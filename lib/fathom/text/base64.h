#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace fathom::text {

/// The bytes of a text in base64; the padding at its end may be missing. nullopt for another
/// character and for an impossible length.
/// Source   RFC 4648, section 4
std::optional<std::vector<std::byte>> decode_base64(std::string_view text);

}  // namespace fathom::text
