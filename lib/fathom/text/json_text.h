#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The little JSON that maps carry as texts, without nlohmann's header for those who need no more.
/// Only for .cpp files.
namespace fathom::text {

/// A string as JSON, in its quotes. Bytes that are not UTF-8 become U+FFFD.
std::string json_string(std::string_view text);

/// Texts between commas, in brackets: "[a,b]". The texts must be JSON or, between the brackets of
/// an object, members of an object.
std::string joined_in(char open, const std::vector<std::string>& parts, char close);

/// The strings of a list, or nothing if the text is not JSON of that kind.
std::optional<std::vector<std::string>> strings_of_json(std::string_view text);

/// The members of an object that are strings, as pairs of key and value in its order; nothing if
/// the text is not a JSON object.
std::optional<std::vector<std::pair<std::string, std::string>>> string_members_of_json(
    std::string_view text);

}  // namespace fathom::text
