#include "apps/options/output_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <unordered_map>

#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/channel_table.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

/// What one name of a list stands for.
struct Named {
  Channel channel;
  bool is_mask;
  friend bool operator==(const Named&, const Named&) = default;
};

Named parse_named(const std::string& name) {
  if (const ContentsName* const known = contents_named(name))
    return {known->channel, known->is_mask};
  if (const auto channel = channel_named(name)) return {*channel, false};
  if (added_channel_named(name) != nullptr && name.starts_with('Z')) {
    throw UsageError(name +
                     " is a channel of a depth buffer: --depth-format NAME adds Zwindow and "
                     "Zdecoded, with --against-exact also Zerror, Zwinner and Zfight");
  }
  throw unknown_contents(name);
}

}  // namespace

Contents parse_channels_of_outputs(const std::string& list) {
  const std::vector<Named> names = parse_distinct(list, parse_named);
  if (names.size() == 1) return {{names.front().channel}, names.front().is_mask};
  Contents contents;
  for (const Named& each : names) {
    if (each.is_mask) contents.mask_beside = true;
    if (!each.is_mask) contents.channels.push_back(each.channel);
  }
  return contents;
}

Contents parse_contents(const std::string& list) {
  Contents contents = parse_channels_of_outputs(list);
  if (contents.mask_beside)
    throw UsageError(std::string(mask_needs_file) + ", and leave it out of the list");
  return contents;
}

std::string names_of_contents() {
  std::vector<std::string> names;
  for (const ContentsName& each : contents_table) {
    const std::string meaning =
        each.is_mask ? "8-bit PNG" : std::string(description_of(each.channel).name);
    names.push_back(std::string(each.name) + " (" + meaning + ")");
  }
  return joined(names, ", ");
}

std::vector<OutputArgument> with_objects(const std::vector<OutputArgument>& outputs,
                                         std::size_t objects) {
  static const std::regex field(R"(\{object(?::0([1-9]))?\})");
  std::vector<OutputArgument> all;
  for (const OutputArgument& output : outputs) {
    std::smatch found;
    const bool is_mask = output.contents && output.contents->is_mask;
    if (!is_mask || !std::regex_search(output.pattern, found, field)) {
      all.push_back(output);
      continue;
    }
    const int digits = found[1].matched ? std::stoi(found[1]) : 1;
    for (std::size_t k = 0; k < objects; ++k) {
      OutputArgument of_object = output;
      of_object.contents->channels = {Channel::object};
      of_object.contents->object = static_cast<std::uint32_t>(k);
      of_object.pattern =
          found.prefix().str() + fmt::format("{:0{}}", k, digits) + found.suffix().str();
      all.push_back(std::move(of_object));
    }
  }
  return all;
}

OutputArgument parse_output(const std::string& text) {
  const std::size_t end = text.find('=');
  if (end == std::string::npos) return {std::nullopt, text};
  const std::string names = text.substr(0, end);
  if (names.empty() || names.find_first_of("/.{") != std::string::npos) return {std::nullopt, text};
  OutputArgument output;
  try {
    output.contents = parse_contents(names);
  } catch (const UnknownName& error) {
    // A letter or two are near to many names.
    const bool is_misspelt =
        error.name().size() > 2 && !nearest_names(error.name(), error.names()).empty();
    if (!is_misspelt) return {std::nullopt, text};
    throw UsageError(std::string(error.what()) + "; a file of this name is './" +
                     text::printable(text) + "'");
  }
  output.pattern = text.substr(end + 1);
  if (output.pattern.empty()) throw UsageError("'" + names + "=' has no file");
  return output;
}

namespace {

namespace fs = std::filesystem;

/// Part of a pattern: a literal text or a field.
struct Part {
  enum class Kind { text, index, name, stem };
  Kind kind = Kind::text;
  std::string text = {};
  /// The least number of digits of an index.
  int digits = 1;
};

constexpr const char* fields =
    "the fields are {index}, {index:04} with leading zeros, {name} and {stem}, and {{ stands for a "
    "brace; -o mask= also has {object}";

/// The field between two braces. Fails with UsageError for an unknown field.
Part field_named(const char* option, const std::string& field) {
  const std::size_t colon = field.find(':');
  const std::string name = field.substr(0, colon);
  const std::string digits = colon == std::string::npos ? "" : field.substr(colon + 1);
  const bool has_zeros =
      digits.size() == 2 && digits[0] == '0' && '1' <= digits[1] && digits[1] <= '9';
  if (name == "index" && colon == std::string::npos) return {Part::Kind::index};
  if (name == "index" && has_zeros) return {Part::Kind::index, {}, digits[1] - '0'};
  if (field == "name") return {Part::Kind::name};
  if (field == "stem") return {Part::Kind::stem};
  std::vector<std::string> near = nearest_names(field, {"index", "name", "stem"});
  for (std::string& each : near) each = "{" + each + "}";
  throw UsageError(fmt::format("{}: there is no field '{{{}}}'{}{}; {}", option,
                               text::printable(field), near.empty() ? "" : ": ", did_you_mean(near),
                               fields));
}

/// Fails with UsageError where a brace belongs to no field.
std::vector<Part> parts_of(const char* option, const std::string& pattern) {
  std::vector<Part> parts(1);
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const char c = pattern[i];
    const bool is_doubled = i + 1 < pattern.size() && pattern[i + 1] == c;
    if ((c != '{' && c != '}') || is_doubled) {
      parts.back().text += c;
      i += c == '{' || c == '}' ? 1 : 0;
      continue;
    }
    const std::size_t end = pattern.find('}', i);
    if (c == '}' || end == std::string::npos) {
      throw UsageError(fmt::format("{}: '{}' has a single '{}'; {}", option,
                                   text::printable(pattern), c, fields));
    }
    parts.push_back(field_named(option, pattern.substr(i + 1, end - i - 1)));
    parts.emplace_back();
    i = end;
  }
  return parts;
}

bool has(const std::vector<Part>& parts, Part::Kind kind) {
  return std::ranges::any_of(parts, [&](const Part& part) { return part.kind == kind; });
}

/// Times have no suffix: ".160407" of "1305031102.160407" is part of the number.
std::string stem_of(const std::string& name) {
  const fs::path path(name);
  const std::string suffix = path.extension().string();
  const bool is_suffix = suffix.size() > 1 && !('0' <= suffix[1] && suffix[1] <= '9');
  return (is_suffix ? path.stem() : path.filename()).string();
}

std::string filled_in(const std::vector<Part>& parts, std::size_t index, const std::string& name) {
  std::string text;
  for (const Part& part : parts) {
    switch (part.kind) {
      case Part::Kind::text:
        text += part.text;
        break;
      case Part::Kind::index:
        text += fmt::format("{:0{}}", index, part.digits);
        break;
      case Part::Kind::name:
        text += name;
        break;
      case Part::Kind::stem:
        text += stem_of(name);
        break;
    }
  }
  return text;
}

void require_different(const char* option, const std::vector<std::string>& names) {
  std::unordered_map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto [there, is_new] = first.emplace(names[i], i);
    if (is_new) continue;
    throw UsageError(fmt::format("{}: cameras {} and {} would both be written as {}", option,
                                 there->second, i, text::printable(names[i])));
  }
}

}  // namespace

std::string require_within_folder(const std::string& where, const std::string& name) {
  const fs::path path(name);
  const bool leaves = path.is_absolute() || std::ranges::find(path, fs::path("..")) != path.end() ||
                      name.find('\0') != std::string::npos || !path.has_filename() ||
                      path.filename() == ".";
  if (!leaves) return name;
  throw InputError(fmt::format(
      "{}: the name '{}' is no place below a folder; expected one without '..' or a leading '/'",
      where, text::printable(name)));
}

std::vector<std::string> names_of_outputs(const char* option, const std::string& pattern,
                                          const std::vector<Camera>& cameras) {
  const std::vector<Part> parts = parts_of(option, pattern);
  const bool has_name = has(parts, Part::Kind::name), has_stem = has(parts, Part::Kind::stem);
  if (!has_name && !has_stem && !has(parts, Part::Kind::index) && cameras.size() != 1) {
    throw UsageError(fmt::format(
        "the camera file is a path of {} cameras: {} needs a pattern such as maps/{{index:04}}{}",
        cameras.size(), option, fs::path(pattern).extension().string()));
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const std::string& name = cameras[i].name;
    if ((has_name || has_stem) && name.empty()) {
      throw InputError(fmt::format(
          "camera {} has no name for '{}': use {{index:04}}, or add \"name\" to the camera file", i,
          pattern));
    }
    // A stem alone does not depend on the folder of the image.
    const std::string where = fmt::format("camera {}", i);
    if (has_name) require_within_folder(where, name);
    if (has_stem) require_within_folder(where, stem_of(name));
    names.push_back(filled_in(parts, i, name));
  }
  require_different(option, names);
  return names;
}

}  // namespace fathom::app
