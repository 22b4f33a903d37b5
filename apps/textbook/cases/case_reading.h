#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/clipping/points.h"

/// Reads the cases of `fathom clip` and `fathom scan`: a JSON object per line.
/// Fails    InputError, naming the ring and the corner.
namespace fathom::app::cases {

using Json = nlohmann::ordered_json;

/// A line as an object. A number beyond binary64, NaN and Infinity are refused as not finite.
/// `name` gets the member "name", even if the text after it cannot be read.
Json parse_case(std::string_view line, Json& name);

/// Refuses keys that are not in `known`; "name" is always known. `taker` names in messages what
/// takes the known keys.
void expect_only(const Json& object, std::initializer_list<std::string_view> known,
                 std::string_view taker = "this algorithm");

/// A required member.
const Json& member(const Json& object, std::string_view key);

/// A member with one of these words; the first word if the member is missing.
std::string word(const Json& object, const std::string& key,
                 std::initializer_list<std::string_view> words);

bool flag(const Json& object, const std::string& key);

/// A list; `where` names it in messages.
const Json& list(const Json& value, std::string_view where);

/// A list of `least` to `most` finite numbers.
std::vector<double> numbers(const Json& value, const std::string& where, std::size_t least,
                            std::size_t most);

/// [[ring], …] as the member `key`.
clipping::Rings<double> rings(const Json& object, const std::string& key);

/// [[x, …], …] as the member `key`: points of `least` to `most` coordinates.
std::vector<std::vector<double>> points(const Json& object, const std::string& key,
                                        std::size_t least, std::size_t most);

/// The member "attributes": a list for each of `corners` corners, all of one length; empty lists if
/// it is missing.
std::vector<std::vector<double>> attributes(const Json& object, std::size_t corners);

}  // namespace fathom::app::cases
