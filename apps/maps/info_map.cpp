#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "apps/maps/info.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/image/cryptomatte.h"
#include "fathom/image/surface.h"
#include "fathom/text/parse_json.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

struct ChannelSummary {
  std::string type;
  std::uint64_t surface = 0, infinite = 0, nan = 0, finite = 0;
  /// Where a surface is visible that has no segment; of channels that show segments.
  std::optional<std::uint64_t> without;
  double least = 0, greatest = 0;
  double scale = 1;

  void add(double value) {
    if (std::isnan(value)) {
      ++nan;
    } else if (std::isinf(value)) {
      ++infinite;
    } else {
      least = finite == 0 ? value : std::min(least, value);
      greatest = finite == 0 ? value : std::max(greatest, value);
      ++finite;
    }
  }
};

const char* type_name(float) {
  return "float32";
}
const char* type_name(double) {
  return "float64";
}
const char* type_name(std::uint16_t) {
  return "uint16";
}
const char* type_name(std::uint32_t) {
  return "uint32";
}

/// One byte per pixel: 1 where the channel shows a surface. Coverage shows one wherever it is not
/// 0, also at pixels whose centre no surface covers.
std::vector<std::uint8_t> pixels_with_surface(const DepthMap& map, const ImageChannel& channel) {
  const auto* coverage = map.values<float>(channel.name);
  if (coverage == nullptr ||
      (channel.name != "A" && channel.name != "Asampled" && channel.name != "mask"))
    return surface_mask(map, channel);
  std::vector<std::uint8_t> mask(coverage->size());
  std::ranges::transform(*coverage, mask.begin(), [](float value) { return value != 0; });
  return mask;
}

/// The values where the channel shows a surface; codes are shown as the depths they stand for.
ChannelSummary summarise(const DepthMap& map, const ImageChannel& channel) {
  ChannelSummary summary;
  const std::vector<std::uint8_t> surface = pixels_with_surface(map, channel);
  const bool codes = std::holds_alternative<Samples<std::uint16_t>>(channel.values);
  if (codes && map.png_scale) summary.scale = *map.png_scale;
  if (shows_segments(channel.name) &&
      std::holds_alternative<Samples<std::uint32_t>>(channel.values))
    summary.without = 0;
  std::visit(
      [&](const auto& values) {
        summary.type = type_name(typename std::decay_t<decltype(values)>::value_type{});
        for (std::size_t i = 0; i < values.size(); ++i) {
          if (surface[i] == 0) continue;
          ++summary.surface;
          if (summary.without && static_cast<double>(values[i]) == double{no_segment}) {
            ++*summary.without;
            continue;
          }
          summary.add(static_cast<double>(values[i]) / summary.scale);
        }
      },
      channel.values);
  return summary;
}

/// The shortest text that denotes the value in the channel's type; "-" without a value.
std::string figure(const ChannelSummary& summary, double value) {
  if (summary.finite == 0) return "-";
  return summary.type == "float32" ? fmt::format("{}", static_cast<float>(value))
                                   : fmt::format("{}", value);
}

/// Camera and sources are JSON themselves; any other text, and JSON that is nested too deeply, is a
/// string.
Json as_json(const std::string& value) {
  try {
    Json parsed = text::parse_json<Json>(value);
    if (parsed.is_structured()) return parsed;
  } catch (const text::JsonFault&) {
  }
  return value;
}

/// A text of the map; a camera with the digits of camera files, which are fewer.
std::string shown_text(const DepthMap& map, const std::string& name, const std::string& value) {
  if (name != camera_text) return value;
  try {
    const std::optional<Camera> camera = camera_of(map, name);
    return camera ? to_json(*camera) : value;
  } catch (const InputError&) {
    return value;
  }
}

/// A text of several lines, indented so that no line looks like a line of this program.
std::string indented(const std::string& value) {
  std::string text;
  for (const char c : value) text += c == '\n' ? std::string("\n    ") : std::string(1, c);
  return text;
}

/// How many values there are is called differently of maps and of deep maps.
Json describe_values(const ChannelSummary& summary, const char* count) {
  return {{"type", summary.type},
          {count, summary.surface},
          {"min", summary.finite > 0 ? Json(summary.least) : Json(nullptr)},
          {"max", summary.finite > 0 ? Json(summary.greatest) : Json(nullptr)},
          {"infinite", summary.infinite},
          {"nan", summary.nan}};
}

/// What the layers of Cryptomatte show, by their names.
Json describe_mattes(const DepthMap& map) {
  Json layers = Json::object();
  for (const MatteLayer& layer : matte_layers(map)) {
    Json names = Json::object();
    for (const MatteExtent& extent : extents(layer)) {
      text::append_member(names, extent.name, {{"pixels", extent.pixels}, {"area", extent.area}});
    }
    text::append_member(layers, layer.name, std::move(names));
  }
  return layers;
}

/// Scale, names and texts.
void describe_rest(const DepthMap& map, Json& answer) {
  if (map.png_scale) answer["png_scale"] = *map.png_scale;
  if (!map.object_names.empty()) answer["objects"] = map.object_names;
  for (const auto& [channel, names] : map.tables) answer[channel + "s"] = names;
  Json attributes = Json::object();
  for (const auto& [name, value] : map.texts) {
    text::append_member(attributes, name, as_json(value));
  }
  if (!attributes.empty()) answer["attributes"] = std::move(attributes);
}

Json describe(const DepthMap& map, const std::string& file) {
  Json channels = Json::object();
  for (const ImageChannel& channel : map.channels) {
    const ChannelSummary summary = summarise(map, channel);
    Json entry = describe_values(summary, "surface_pixels");
    if (summary.without) entry["none"] = *summary.without;
    text::append_member(channels, channel.name, std::move(entry));
  }
  Json answer{{"file", file},
              {"kind", "map"},
              {"width", map.width},
              {"height", map.height},
              {"channels", std::move(channels)}};
  if (Json mattes = describe_mattes(map); !mattes.empty()) answer["mattes"] = std::move(mattes);
  describe_rest(map, answer);
  return answer;
}

std::string heading_of_table(const char* count) {
  return fmt::format("  {:<10} {:<8} {:>14} {:>24} {:>24}\n", "channel", "type", count, "least",
                     "greatest");
}

std::string row_of_table(const std::string& name, const ChannelSummary& s) {
  std::string text =
      fmt::format("  {:<10} {:<8} {:>14} ", text::printable(name), s.type, s.surface);
  text += fmt::format("{:>24} {:>24}", figure(s, s.least), figure(s, s.greatest));
  if (s.infinite > 0) text += fmt::format("  {} infinite", s.infinite);
  if (s.nan > 0) text += fmt::format("  {} NaN", s.nan);
  if (s.without.value_or(0) > 0) text += fmt::format("  {} without one", *s.without);
  return text + "\n";
}

/// Scale, names and texts.
std::string rest_as_text(const DepthMap& map) {
  std::string text;
  if (map.png_scale)
    text += fmt::format("  scale      {} {} per unit\n", *map.png_scale,
                        *map.png_scale == 1 ? "code" : "codes");
  text += name_line("objects", map.object_names);
  for (const auto& [channel, names] : map.tables) text += name_line(channel + "s", names);
  for (const auto& [name, value] : map.texts) {
    text +=
        fmt::format("  {}: {}\n", text::printable(name), indented(shown_text(map, name, value)));
  }
  return text;
}

/// Whether a channel holds hashes and coverages of a layer, which stand in mattes_as_text().
bool is_of_mattes(const std::string& channel, const std::vector<MatteLayer>& layers) {
  return std::ranges::any_of(layers, [&](const MatteLayer& layer) {
    return std::ranges::find(layer.channels, channel) != layer.channels.end();
  });
}

std::string mattes_as_text(const MatteLayer& layer) {
  std::string text =
      fmt::format("  {} (Cryptomatte, {} to {})\n", text::printable(layer.name),
                  text::printable(layer.channels.front()), text::printable(layer.channels.back()));
  const std::vector<MatteExtent> found = extents(layer);
  constexpr std::size_t most = 20;
  for (const MatteExtent& extent : std::span(found).first(std::min(most, found.size()))) {
    text +=
        fmt::format("    {:<27} {:>7} {} with an area of {:.2f}\n", text::printable(extent.name),
                    extent.pixels, extent.pixels == 1 ? "pixel" : "pixels", extent.area);
  }
  if (found.size() > most) text += fmt::format("    … and {} more names\n", found.size() - most);
  return text;
}

std::string describe_as_text(const DepthMap& map, const std::string& file) {
  std::string text =
      fmt::format("{}: a map of {}x{} pixels\n", text::printable(file), map.width, map.height);
  text += heading_of_table("surface pixels");
  const std::vector<MatteLayer> layers = matte_layers(map);
  for (const ImageChannel& channel : map.channels) {
    if (is_of_mattes(channel.name, layers)) continue;
    text += row_of_table(channel.name, summarise(map, channel));
  }
  for (const MatteLayer& layer : layers) text += mattes_as_text(layer);
  return text + rest_as_text(map);
}

template <class T>
ChannelSummary summarise(const DeepMap& deep, T DeepSample::*channel) {
  ChannelSummary summary;
  summary.type = type_name(T{});
  summary.surface = deep.samples.size();
  for (const DeepSample& sample : deep.samples) summary.add(static_cast<double>(sample.*channel));
  return summary;
}

std::vector<std::pair<const char*, ChannelSummary>> summaries(const DeepMap& deep) {
  return {{"Z", summarise(deep, &DeepSample::Z)},
          {"ZBack", summarise(deep, &DeepSample::ZBack)},
          {"area", summarise(deep, &DeepSample::area)},
          {"A", summarise(deep, &DeepSample::A)},
          {"id", summarise(deep, &DeepSample::id)}};
}

struct SampleCounts {
  std::size_t pixels = 0;
  std::uint32_t most = 0;
};

SampleCounts count_samples(const DeepMap& deep) {
  SampleCounts found;
  for (const std::uint32_t count : deep.counts) {
    if (count > 0) ++found.pixels;
    found.most = std::max(found.most, count);
  }
  return found;
}

Json describe(const DeepMap& deep, const std::string& file) {
  const SampleCounts found = count_samples(deep);
  Json channels = Json::object();
  for (const auto& [name, summary] : summaries(deep)) {
    channels[name] = describe_values(summary, "samples");
  }
  Json answer{{"file", file},
              {"kind", "deep map"},
              {"width", deep.description.width},
              {"height", deep.description.height},
              {"samples", deep.samples.size()},
              {"pixels_with_samples", found.pixels},
              {"most_samples", found.most},
              {"channels", std::move(channels)}};
  describe_rest(deep.description, answer);
  return answer;
}

std::string describe_as_text(const DeepMap& deep, const std::string& file) {
  const SampleCounts found = count_samples(deep);
  std::string text = fmt::format("{}: a deep map of {}x{} pixels\n", text::printable(file),
                                 deep.description.width, deep.description.height);
  text += fmt::format("  {} {} at {} {}, at most {} at a pixel\n", deep.samples.size(),
                      deep.samples.size() == 1 ? "sample" : "samples", found.pixels,
                      found.pixels == 1 ? "pixel" : "pixels", found.most);
  text += heading_of_table("samples");
  for (const auto& [name, summary] : summaries(deep)) text += row_of_table(name, summary);
  return text + rest_as_text(deep.description);
}

}  // namespace

std::string info_of_map(const DepthMap& map, const std::string& file, AnswerForm form) {
  if (form == AnswerForm::text) return describe_as_text(map, file);
  return json_answer(describe(map, file));
}

std::string info_of_deep_map(const DeepMap& deep, const std::string& file, AnswerForm form) {
  if (form == AnswerForm::text) return describe_as_text(deep, file);
  return json_answer(describe(deep, file));
}

}  // namespace fathom::app
