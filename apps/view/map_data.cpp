#include "apps/view/map_data.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "apps/view/packing.h"
#include "fathom/camera/pose.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/files/file_texts.h"
#include "fathom/image/preview.h"
#include "fathom/image/surface.h"
#include "fathom/threads/threads.h"

namespace fathom::view {
namespace {

using Words = std::vector<std::uint32_t>;

std::array<std::uint32_t, 5> words_of(const DeepSample& sample) {
  return {std::bit_cast<std::uint32_t>(sample.Z), std::bit_cast<std::uint32_t>(sample.ZBack),
          std::bit_cast<std::uint32_t>(sample.area), std::bit_cast<std::uint32_t>(sample.A),
          sample.id};
}

/// The places where the samples of each pixel begin, followed by the end of all samples.
std::vector<std::size_t> begins_of(const DeepMap& deep) {
  std::vector<std::size_t> begins(deep.counts.size() + 1);
  std::inclusive_scan(deep.counts.begin(), deep.counts.end(), begins.begin() + 1, std::plus<>(),
                      std::size_t{0});
  return begins;
}

/// The samples of the pixels of a tile, in the order of the pixels: Z, ZBack, area, A and id.
std::array<std::string, 5> packed_samples(const DeepMap& deep, std::span<const std::size_t> begins,
                                          const TilePlace& tile) {
  std::array<Words, 5> planes;
  for (std::size_t row = tile.y; row < std::size_t{tile.y} + tile.rows; ++row) {
    const std::size_t first = row * deep.description.width + tile.x;
    for (std::size_t k = begins[first]; k < begins[first + tile.columns]; ++k) {
      const auto words = words_of(deep.samples[k]);
      for (std::size_t plane = 0; plane < planes.size(); ++plane) {
        planes[plane].push_back(words[plane]);
      }
    }
  }
  std::array<std::string, 5> texts;
  std::ranges::transform(planes, texts.begin(), [](const Words& words) { return packed(words); });
  return texts;
}

using Json = nlohmann::json;
using Mask = std::vector<std::uint8_t>;

/// The last level has at most so many pixels: the page draws it and counts its values at once.
constexpr std::uint64_t pixels_at_once = std::uint64_t{1} << 22;

struct ImageSize {
  std::uint32_t width = 0, height = 0;

  [[nodiscard]] ImageSize at_level(unsigned level) const {
    const std::uint32_t round_up = (1U << level) - 1;
    return {(width + round_up) >> level, (height + round_up) >> level};
  }
  [[nodiscard]] unsigned levels() const {
    unsigned level = 0;
    const auto pixels = [this](unsigned n) {
      const ImageSize size = at_level(n);
      return std::uint64_t{size.width} * size.height;
    };
    while (pixels(level) > pixels_at_once) ++level;
    return level + 1;
  }
};

std::uint32_t tiles_in(std::uint32_t pixels) {
  return (pixels + tile_size - 1) / tile_size;
}

std::size_t tiles_at(const ImageSize& size, unsigned level) {
  const ImageSize here = size.at_level(level);
  return std::size_t{tiles_in(here.width)} * tiles_in(here.height);
}

TilePlace tile_of(const ImageSize& size, unsigned level, std::size_t number) {
  const ImageSize here = size.at_level(level);
  const std::uint32_t across = tiles_in(here.width);
  const auto column = static_cast<std::uint32_t>(number % across) * tile_size,
             row = static_cast<std::uint32_t>(number / across) * tile_size;
  return {column << level, row << level, std::min(tile_size, here.width - column),
          std::min(tile_size, here.height - row), 1U << level};
}

/// `packed_tile` makes the text of a tile.
void write_tiles(const std::function<std::string(const TilePlace&)>& packed_tile,
                 const ImageSize& size, const std::string& id, const Sink& sink,
                 Progress* progress = nullptr) {
  for (unsigned level = 0; level < size.levels(); ++level) {
    std::vector<std::string> tiles(tiles_at(size, level));
    parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t k) {
      tiles[k] = packed_tile(tile_of(size, level, k));
      if (progress != nullptr) progress->part_done();
    });
    for (std::size_t k = 0; k < tiles.size(); ++k) {
      sink(script_text(id + "-" + std::to_string(level) + "-" + std::to_string(k), tiles[k]));
    }
  }
}

void write_samples(const DeepMap& deep, const ImageSize& size, const std::string& id,
                   const Sink& sink, Progress& progress) {
  const std::vector<std::size_t> begins = begins_of(deep);
  std::vector<std::array<std::string, 5>> tiles(tiles_at(size, 0));
  parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t k) {
    tiles[k] = packed_samples(deep, begins, tile_of(size, 0, k));
    progress.part_done();
  });
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    for (std::size_t plane = 0; plane < tiles[k].size(); ++plane) {
      sink(script_text(id + std::to_string(plane) + "-0-" + std::to_string(k), tiles[k][plane]));
    }
  }
}

bool is_single_direction(const ImageChannel& channel) {
  return kind_of(channel) == ChannelKind::direction &&
         std::holds_alternative<Samples<float>>(channel.values);
}

/// The channel of triangles next to a channel of directions, as a number.
std::optional<std::size_t> identifiers_beside(const DepthMap& map, const ImageChannel& channel) {
  const ImageChannel* const found = map.find("id");
  if (!is_single_direction(channel) || found == nullptr ||
      !std::holds_alternative<Samples<std::uint32_t>>(found->values)) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - map.channels.data());
}

/// The first parts X, Y, Z of vectors, as numbers of channels of binary32 numbers.
template <std::size_t count>
std::optional<std::array<std::size_t, count>> parts_of(const DepthMap& map,
                                                       const std::string& vectors) {
  std::array<std::size_t, count> numbers{};
  for (std::size_t part = 0; part < count; ++part) {
    const ImageChannel* const found = map.find(vectors + '.' + "XYZ"[part]);
    if (found == nullptr || !std::holds_alternative<Samples<float>>(found->values)) {
      return std::nullopt;
    }
    numbers[part] = static_cast<std::size_t>(found - map.channels.data());
  }
  return numbers;
}

/// The channels X and Y of the unit vectors whose Z a channel holds, as numbers.
std::optional<std::array<std::size_t, 2>> parts_beside(const DepthMap& map,
                                                       const ImageChannel& channel) {
  if (!is_single_direction(channel) || !channel.name.ends_with(".Z")) return std::nullopt;
  return parts_of<2>(map, channel.name.substr(0, channel.name.size() - 2));
}

/// The camera of a map, if its rays are straight: the page computes with no others.
const Camera* straight_camera_of(const ViewedMap& viewed) {
  return viewed.camera && !bends_rays(viewed.camera->projection) ? &*viewed.camera : nullptr;
}

/// The channels of the normals in the world whose planes predict the depths of a channel, as
/// numbers.
std::optional<std::array<std::size_t, 3>> normals_beside(const ViewedMap& viewed,
                                                         const ImageChannel& channel) {
  if (channel.name != "Z" || !std::holds_alternative<Samples<float>>(channel.values) ||
      straight_camera_of(viewed) == nullptr) {
    return std::nullopt;
  }
  return parts_of<3>(viewed.map, "N");
}

/// The bits of values, as words.
template <class T>
auto words_of(const Samples<T>& values) {
  using Word = std::conditional_t<sizeof(T) == 8, std::uint64_t,
                                  std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint16_t>>;
  return std::span(reinterpret_cast<const Word*>(values.data()), values.size());
}

const char* type_of(const ImageChannel& channel) {
  static constexpr std::array names{"f32", "f64", "u16", "u32"};  // in the order of the variant
  return names.at(channel.values.index());
}

/// The scale of a channel, unless the user chooses another: most pixels of a deep map have few
/// samples.
ColourScale scale_for(const ImageChannel& channel) {
  return channel.name == samples_channel ? ColourScale::log : ColourScale::linear;
}

/// The least and the greatest finite value at surfaces, or null.
Json range_of(const ImageChannel& channel, const Mask& mask) {
  return std::visit(
      [&](const auto& values) -> Json {
        bool any = false;
        double low = 0, high = 0;
        for (std::size_t k = 0; k < mask.size(); ++k) {
          const auto value = static_cast<double>(values[k]);
          if (mask[k] == 0 || !std::isfinite(value)) continue;
          low = any ? std::min(low, value) : value;
          high = any ? std::max(high, value) : value;
          any = true;
        }
        return any ? Json{low, high} : Json();
      },
      channel.values);
}

/// Masks of a map, each once.
class Masks {
 public:
  /// The number of a mask; -1 if every pixel shows a surface.
  int number_of(Mask mask) {
    if (std::ranges::find(mask, 0) == mask.end()) return -1;
    auto found = std::ranges::find(masks_, mask);
    if (found == masks_.end()) found = masks_.insert(found, std::move(mask));
    return static_cast<int>(found - masks_.begin());
  }
  [[nodiscard]] const std::vector<Mask>& all() const { return masks_; }

 private:
  std::vector<Mask> masks_;
};

Json describe_channel(const ViewedMap& viewed, const ImageChannel& channel, Masks& masks) {
  const DepthMap& map = viewed.map;
  Mask mask = surface_mask(map, channel);
  const ChannelDrawing drawing = drawing_of(channel);
  Json told{
      {"name", channel.name},
      {"meaning", meaning_of(channel.name.substr(0, channel.name.find('.')))},
      {"type", type_of(channel)},
      {"isError", drawing == ChannelDrawing::errors},
      {"isFight", drawing == ChannelDrawing::fights},
      {"isIdentifier", drawing == ChannelDrawing::identifiers || drawing == ChannelDrawing::fights},
      {"defaults",
       {{"colours", name_of(colours_for(drawing))}, {"scale", name_of(scale_for(channel))}}},
      {"range", range_of(channel, mask)}};
  told["mask"] = masks.number_of(std::move(mask));
  if (const auto parts = parts_beside(map, channel)) told["unit"] = *parts;
  if (const auto normals = normals_beside(viewed, channel)) told["normals"] = *normals;
  if (const auto identifiers = identifiers_beside(map, channel)) told["by"] = *identifiers;
  if (shows_segments(channel.name)) told["none"] = no_segment;
  if (const auto* names = image::names_of_channel(map, channel.name)) told["names"] = *names;
  return told;
}

/// The directions of a map, which the page draws as red, green and blue: their names, and the
/// numbers of the channels of their parts X, Y and Z.
Json describe_directions(const DepthMap& map) {
  Json directions = Json::array();
  for (const ImageChannel& channel : map.channels) {
    if (kind_of(channel) != ChannelKind::direction || !channel.name.ends_with(".X")) continue;
    const std::string name = channel.name.substr(0, channel.name.size() - 2);
    Json parts = Json::array();
    for (const char* part : {".X", ".Y", ".Z"}) {
      if (const ImageChannel* const found = map.find(name + part)) {
        parts.push_back(found - map.channels.data());
      }
    }
    if (parts.size() == 3) directions.push_back({{"name", name}, {"parts", std::move(parts)}});
  }
  return directions;
}

/// The numbers from which the page computes a pixel's place in the world, like point_at() and
/// camera_to_world(), and predicts depths.
Json describe_camera(const Camera& camera) {
  const Projection& projection = camera.projection;
  return {{"orthographic", is_orthographic(projection)},
          {"fx", projection.fx},
          {"fy", projection.fy},
          {"cx", projection.cx},
          {"cy", projection.cy},
          {"skew", projection.skew},
          {"pixelCentre", projection.pixel_centre},
          {"worldFromCamera", camera_to_world(camera.world_to_camera)}};
}

std::span<const float> singles_of(const DepthMap& map, std::size_t channel) {
  return std::get<Samples<float>>(map.channels[channel].values);
}

/// The text of a tile of directions.
std::string packed_direction(const DepthMap& map, const ImageChannel& channel,
                             const TilePlace& tile) {
  DirectionHints hints;
  if (const auto numbers = parts_beside(map, channel)) {
    hints.x = singles_of(map, (*numbers)[0]);
    hints.y = singles_of(map, (*numbers)[1]);
  }
  Segments segments;
  if (const auto number = identifiers_beside(map, channel)) {
    segments = segments_of(std::get<Samples<std::uint32_t>>(map.channels[*number].values),
                           map.width, tile);
    hints.segments = &segments;
  }
  return packed_direction(words_of(std::get<Samples<float>>(channel.values)), hints, map.width,
                          tile);
}

/// The planes that predict the depths of a channel.
std::optional<PlaneHints> planes_beside(const ViewedMap& viewed, const ImageChannel& channel) {
  const auto numbers = normals_beside(viewed, channel);
  if (!numbers) return std::nullopt;
  const Camera& camera = *straight_camera_of(viewed);
  PlaneHints hints{{}, camera.projection, camera_to_world(camera.world_to_camera)};
  std::ranges::transform(*numbers, hints.normals.begin(),
                         [&](std::size_t number) { return singles_of(viewed.map, number); });
  return hints;
}

void write_channel(const ViewedMap& viewed, const ImageChannel& channel, const std::string& id,
                   const Sink& sink, Progress& progress) {
  const DepthMap& map = viewed.map;
  const std::optional<PlaneHints> planes = planes_beside(viewed, channel);
  const auto packed_tile = [&](const TilePlace& tile) {
    if (is_single_direction(channel)) return packed_direction(map, channel, tile);
    if (planes) {
      return packed_depth(words_of(std::get<Samples<float>>(channel.values)), *planes, map.width,
                          tile);
    }
    return std::visit([&](const auto& values) { return packed(words_of(values), map.width, tile); },
                      channel.values);
  };
  write_tiles(packed_tile, {map.width, map.height}, id, sink, &progress);
}

}  // namespace

std::uint64_t count_tiles(const ViewedMap& viewed) {
  const ImageSize size{viewed.map.width, viewed.map.height};
  std::uint64_t tiles = 0;
  for (unsigned level = 0; level < size.levels(); ++level) tiles += tiles_at(size, level);
  return tiles * viewed.map.channels.size() + (viewed.deep ? tiles_at(size, 0) : 0);
}

Json write_planes(const ViewedMap& viewed, const std::string& prefix, const Sink& sink,
                  Progress& progress) {
  const DepthMap& map = viewed.map;
  const ImageSize size{map.width, map.height};
  Json told{{"name", viewed.name},
            {"width", map.width},
            {"height", map.height},
            {"levels", size.levels()},
            {"channels", Json::array()}};
  if (const Camera* const camera = straight_camera_of(viewed)) {
    told["camera"] = describe_camera(*camera);
  }
  if (map.png_scale) told["scale"] = *map.png_scale;
  Masks masks;
  for (std::size_t k = 0; k < map.channels.size(); ++k) {
    const ImageChannel& channel = map.channels[k];
    told["channels"].push_back(describe_channel(viewed, channel, masks));
    write_channel(viewed, channel, prefix + "-c" + std::to_string(k), sink, progress);
  }
  told["directions"] = describe_directions(map);
  for (std::size_t k = 0; k < masks.all().size(); ++k) {
    const std::span<const std::uint8_t> mask(masks.all()[k]);
    const auto packed_tile = [&](const TilePlace& tile) { return packed(mask, size.width, tile); };
    write_tiles(packed_tile, size, prefix + "-k" + std::to_string(k), sink);
  }
  if (viewed.deep) {
    told["deep"] = true;
    write_samples(*viewed.deep, size, prefix + "-d", sink, progress);
  }
  return told;
}

}  // namespace fathom::view
