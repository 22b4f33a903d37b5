#pragma once

#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/failures/errors.h"

namespace fathom {

/// Those of the names that `name` is most likely a misspelling of, in the order of `names`: they
/// differ from it by the least number of letters that are missing, too many, wrong or exchanged
/// with their neighbour, at most one, or two where there are six letters or more; or by upper and
/// lower case alone. Empty where none is that near.
std::vector<std::string> nearest_names(std::string_view name,
                                       const std::vector<std::string>& names);

/// "did you mean 'near'?", "did you mean 'near' or 'bear'?", or "" for no names.
std::string did_you_mean(const std::vector<std::string>& names);

/// "; did you mean 'near'?", of the nearest names, or "" where no name is near.
std::string suggestion(std::string_view name, const std::vector<std::string>& names);

/// A name that is none of those that exist. It carries them, so that a program can offer them.
class UnknownName : public UsageError {
 public:
  /// The suggestion is put behind the message.
  UnknownName(const std::string& message, std::string name, std::vector<std::string> names);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  std::string name_;
  std::vector<std::string> names_;
};

/// "a, b and c"
std::string joined(const std::vector<std::string>& names, std::string_view last = " and ");

/// The names of the values of an enumeration, as its name_of() returns them.
template <class Values>
std::vector<std::string> names_of(const Values& values) {
  std::vector<std::string> names;
  names.reserve(std::size(values));
  for (const auto value : values) names.emplace_back(name_of(value));
  return names;
}

/// The value with this name; nullopt if none of the values has it.
template <class Values>
std::optional<std::ranges::range_value_t<Values>> value_named(const Values& values,
                                                              std::string_view name) {
  for (const auto value : values)
    if (name_of(value) == name) return value;
  return std::nullopt;
}

}  // namespace fathom
