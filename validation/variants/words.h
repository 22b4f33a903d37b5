#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "fathom/depth_format/depth_format.h"

/// What the names of variants are made of: words with one blank between them.
namespace fathom::validation {

/// The words of `name`; two blanks in a row have an empty word between them. Never empty.
std::vector<std::string_view> words_of(std::string_view name);

/// The number that a whole word is, in decimal digits; nothing below `least` or beyond int.
std::optional<int> count_named(std::string_view word, int least);

/// The storage types that a depth attachment of OpenGL may have.
inline constexpr Storage attachment_storages[] = {Storage::unorm16, Storage::unorm24,
                                                  Storage::unorm32, Storage::float32};
std::optional<Storage> attachment_named(std::string_view word);

}  // namespace fathom::validation
