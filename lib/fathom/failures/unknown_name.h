#pragma once

#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/failures/errors.h"

namespace fathom {

/// The names of which `name` is most likely a misspelling, in the order of `names`: those with the
/// least number of letters that are missing, added, wrong or exchanged with their neighbour. At
/// most one such letter is allowed, or two in names of six letters or more; names that differ only
/// by upper and lower case match. Empty if no name is that near.
std::vector<std::string> nearest_names(std::string_view name,
                                       const std::vector<std::string>& names);

/// "did you mean 'near'?", "did you mean 'near' or 'bear'?", or "" for no names.
std::string did_you_mean(const std::vector<std::string>& names);

/// "; did you mean 'near'?", of the nearest names, or of those that begin with `name`; or "".
std::string suggestion(std::string_view name, const std::vector<std::string>& names);

/// An unknown name. Contains the names that exist, so that a program can offer them.
class UnknownName : public UsageError {
 public:
  /// The suggestion is put behind the message, unless the message ends with a question already.
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

/// The value with this name; nullopt if no value has it.
template <class Values>
std::optional<std::ranges::range_value_t<Values>> value_named(const Values& values,
                                                              std::string_view name) {
  for (const auto value : values)
    if (name_of(value) == name) return value;
  return std::nullopt;
}

/// Another name of a thing, only in small letters and digits, and its name in Fathom.
struct OtherName {
  std::string_view other, name;
};

/// The name that `others` lists for this name; nullopt if it lists no such name or several.
std::optional<std::string_view> name_meant_by(std::string_view name,
                                              std::span<const OtherName> others);

/// The failure for a name that is not among `names`. Unless the name is similar to one of them, it
/// suggests the names that `others` lists for it; upper case, hyphens and underscores do not
/// matter.
UnknownName unknown_name(const std::string& message, const std::string& name,
                         std::vector<std::string> names, std::span<const OtherName> others);

}  // namespace fathom
