#include "apps/options/map_contents.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/image/channel_names.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

bool is_mask(const std::string& name) {
  const ContentsName* const known = contents_named(name);
  return known != nullptr && known->is_mask;
}

Channel channel_of(const std::string& name) {
  if (const ContentsName* const known = contents_named(name)) return known->channel;
  if (const auto channel = channel_named(name)) return *channel;
  throw unknown_contents(name);
}

}  // namespace

Contents parse_contents(const std::string& list) {
  Contents contents;
  contents.channels = parse_distinct(list, [&](const std::string& name) {
    const Channel channel = channel_of(name);
    if (is_mask(name) && name != list) {
      throw UsageError("'" + name + "' needs a separate file: -o " + name + "=FILE.png");
    }
    return channel;
  });
  contents.is_mask = is_mask(list);
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

}  // namespace fathom::app
