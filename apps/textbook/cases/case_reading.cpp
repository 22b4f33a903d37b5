#include "apps/textbook/cases/case_reading.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>

#include "fathom/failures/errors.h"
#include "fathom/text/counted.h"
#include "fathom/text/parse_json.h"
#include "fathom/text/printable.h"

namespace fathom::app::cases {
namespace {

/// "subject ring 0 has … at corner 2" where the fault lies in a ring, else "clip[0]".
std::string not_finite(const std::vector<text::JsonStep>& path) {
  if (path.size() == 4 && (path[0].key == "subject" || path[0].key == "clip"))
    return fmt::format("{} ring {} has a coordinate that is not finite, at corner {}", path[0].key,
                       path[1].index, path[2].index);
  std::string place;
  for (const text::JsonStep& step : path)
    place += step.in_list ? fmt::format("[{}]", step.index) : step.key;
  return text::printable(place) + " is not finite; expected a finite number";
}

/// Whether NaN or Infinity stands where the parser stopped; `byte` counts from 1.
bool is_not_finite_at(std::string_view line, std::size_t byte) {
  std::size_t start = std::min(byte == 0 ? 0 : byte - 1, line.size());
  while (start > 0 &&
         (std::isalpha(static_cast<unsigned char>(line[start - 1])) != 0 || line[start - 1] == '-'))
    --start;
  const std::string_view rest = line.substr(start);
  constexpr std::array<std::string_view, 7> words{"NaN",       "nan", "-NaN", "Infinity",
                                                  "-Infinity", "inf", "-inf"};
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return rest.starts_with(word); });
}

std::string at(const std::string& where, std::size_t i) {
  return fmt::format("{}[{}]", where, i);
}

}  // namespace

Json parse_case(std::string_view line, Json& name) {
  using Kind = text::JsonFault::Kind;
  Json value;
  const auto take_name = [&] {
    if (!value.is_object()) return;
    if (const auto found = value.find("name"); found != value.end()) name = *found;
  };
  try {
    text::parse_json(line, value);
    if (!value.is_object()) throw InputError("expected a JSON object");
    take_name();
    return value;
  } catch (const text::JsonFault& fault) {
    // A name that was not read to its end is none.
    if (fault.path().size() < 2 || fault.path()[0].key != "name") take_name();
    if (fault.kind() == Kind::not_finite) throw InputError(not_finite(fault.path()));
    if (fault.kind() != Kind::syntax) throw;
    if (is_not_finite_at(line, fault.byte())) throw InputError(not_finite(fault.path()));
    throw InputError(fmt::format("not JSON at character {}", fault.byte()));
  }
}

void expect_only(const Json& object, std::initializer_list<std::string_view> known,
                 std::string_view taker) {
  for (const auto& [key, value] : object.items())
    if (key != "name" && std::find(known.begin(), known.end(), key) == known.end())
      throw InputError(fmt::format("{} is not a key of {}; it takes {}", Json(key).dump(), taker,
                                   fmt::join(known, ", ")));
}

const Json& member(const Json& object, std::string_view key) {
  const auto found = object.find(std::string(key));
  if (found == object.end()) throw InputError(fmt::format("\"{}\" is missing", key));
  return *found;
}

std::string word(const Json& object, const std::string& key,
                 std::initializer_list<std::string_view> words) {
  const auto found = object.find(key);
  if (found == object.end()) return std::string(*words.begin());
  if (found->is_string()) {
    const auto match = std::find(words.begin(), words.end(), found->get<std::string>());
    if (match != words.end()) return std::string(*match);
  }
  throw InputError(
      fmt::format("\"{}\" is {}; expected {}", key, found->dump(), fmt::join(words, " or ")));
}

bool flag(const Json& object, const std::string& key) {
  const auto found = object.find(key);
  if (found == object.end()) return false;
  if (!found->is_boolean()) throw InputError(fmt::format("\"{}\": expected true or false", key));
  return found->get<bool>();
}

const Json& list(const Json& value, std::string_view where) {
  if (!value.is_array())
    throw InputError(fmt::format("{}: expected a list, found {}", where, value.type_name()));
  return value;
}

std::vector<double> numbers(const Json& value, const std::string& where, std::size_t least,
                            std::size_t most) {
  const std::size_t size = list(value, where).size();
  if (size < least || size > most)
    throw InputError(fmt::format("{}: {} where {} expected", where, text::counted(size, "number"),
                                 least == most ? text::counted(least, "is", "are")
                                               : fmt::format("{} to {} are", least, most)));
  std::vector<double> result;
  for (const Json& number : value) {
    if (!number.is_number())
      throw InputError(fmt::format("{}: expected finite numbers, found {}",
                                   at(where, result.size()), number.type_name()));
    result.push_back(number.get<double>());
  }
  return result;
}

clipping::Rings<double> rings(const Json& object, const std::string& key) {
  clipping::Rings<double> result;
  for (const Json& ring : list(member(object, key), key)) {
    const std::string ring_name = fmt::format("{} ring {}", key, result.size());
    result.emplace_back();
    for (const Json& point : list(ring, ring_name)) {
      const auto xy =
          numbers(point, fmt::format("{}, corner {}", ring_name, result.back().size()), 2, 2);
      result.back().push_back({xy[0], xy[1]});
    }
  }
  return result;
}

std::vector<std::vector<double>> points(const Json& object, const std::string& key,
                                        std::size_t least, std::size_t most) {
  std::vector<std::vector<double>> result;
  for (const Json& point : list(member(object, key), key))
    result.push_back(numbers(point, at(key, result.size()), least, most));
  return result;
}

std::vector<std::vector<double>> attributes(const Json& object, std::size_t corners) {
  if (!object.contains("attributes")) return std::vector<std::vector<double>>(corners);
  auto result = points(object, "attributes", 0, std::numeric_limits<std::size_t>::max());
  if (result.size() != corners)
    throw InputError(fmt::format("attributes: {} for {}", text::counted(result.size(), "list"),
                                 text::counted(corners, "corner")));
  for (std::size_t i = 0; i < corners; ++i)
    if (result[i].size() != result[0].size())
      throw InputError(fmt::format("{}: {}, but {} at the first corner", at("attributes", i),
                                   text::counted(result[i].size(), "number"), result[0].size()));
  return result;
}

}  // namespace fathom::app::cases
