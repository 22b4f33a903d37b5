#include "apps/textbook/cases/case_reading.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <limits>
#include <set>

#include "fathom/numeric/errors.h"

namespace fathom::app::cases {
namespace {

/// Where the parser is, so that a number that is none can be named by its place.
class Place {
 public:
  explicit Place(Json& name) : name_(name) {}

  bool operator()(int, Json::parse_event_t event, const Json& parsed) {
    using Event = Json::parse_event_t;
    switch (event) {
      case Event::object_start:
      case Event::array_start:
        steps_.push_back({event == Event::array_start, 0, "", {}});
        break;
      case Event::key:
        steps_.back().key = parsed.get<std::string>();
        if (!steps_.back().keys.insert(steps_.back().key).second)
          throw InputError(fmt::format("the key {} stands twice", parsed.dump()));
        break;
      case Event::object_end:
      case Event::array_end:
        steps_.pop_back();
        [[fallthrough]];
      case Event::value:
        if (steps_.size() == 1 && steps_[0].key == "name") name_ = parsed;
        if (!steps_.empty()) ++steps_.back().index;
        break;
    }
    return true;
  }

  /// "subject ring 0 has … at corner 2" where the parser stands in a ring, else "clip[0]".
  [[nodiscard]] std::string not_finite() const {
    if (steps_.size() == 4 && (steps_[0].key == "subject" || steps_[0].key == "clip"))
      return fmt::format("{} ring {} has a coordinate that is not finite, at corner {}",
                         steps_[0].key, steps_[1].index, steps_[2].index);
    std::string path;
    for (const Step& step : steps_)
      path += step.in_array ? fmt::format("[{}]", step.index) : step.key;
    return path + " is not finite; expected a finite number";
  }

 private:
  struct Step {
    bool in_array;
    std::size_t index;
    std::string key;
    std::set<std::string> keys;
  };
  std::vector<Step> steps_;
  Json& name_;
};

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
  Place place(name);
  try {
    Json value = Json::parse(line.begin(), line.end(), std::ref(place));
    if (!value.is_object()) throw InputError("expected a JSON object");
    if (const auto found = value.find("name"); found != value.end()) name = *found;
    return value;
  } catch (const Json::parse_error& error) {
    if (is_not_finite_at(line, error.byte)) throw InputError(place.not_finite());
    throw InputError(fmt::format("not JSON at character {}", error.byte));
  } catch (const Json::out_of_range&) {
    throw InputError(place.not_finite());
  }
}

void expect_only(const Json& object, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : object.items())
    if (key != "name" && std::find(known.begin(), known.end(), key) == known.end())
      throw InputError(fmt::format("{} is no key of this algorithm; it takes {}", Json(key).dump(),
                                   fmt::join(known, ", ")));
}

const Json& member(const Json& object, const std::string& key) {
  const auto found = object.find(key);
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

const Json& list(const Json& value, const std::string& where) {
  if (!value.is_array())
    throw InputError(fmt::format("{}: expected a list, found {}", where, value.type_name()));
  return value;
}

std::vector<double> numbers(const Json& value, const std::string& where, std::size_t least,
                            std::size_t most) {
  const std::size_t size = list(value, where).size();
  if (size < least || size > most)
    throw InputError(fmt::format(
        "{}: {} numbers where {} are expected", where, size,
        least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most)));
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
    throw InputError(fmt::format("attributes: {} lists for {} corners", result.size(), corners));
  for (std::size_t i = 0; i < corners; ++i)
    if (result[i].size() != result[0].size())
      throw InputError(fmt::format("{}: {} numbers, but {} at the first corner",
                                   at("attributes", i), result[i].size(), result[0].size()));
  return result;
}

}  // namespace fathom::app::cases
