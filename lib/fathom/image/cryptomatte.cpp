#include "fathom/image/cryptomatte.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdio>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_text.h"

namespace fathom {
namespace {

std::string in_hexadecimal(std::uint32_t bits) {
  std::array<char, 9> text{};
  std::snprintf(text.data(), text.size(), "%08x", bits);
  return text.data();
}

/// LAYER00 holds the ranks 0 and 1, LAYER01 the ranks 2 and 3, ….
std::string matte_channel(const std::string& layer, std::size_t level, char component) {
  return layer + (level < 10 ? "0" : "") + std::to_string(level) + "." + component;
}

std::uint32_t mixed(std::uint32_t k) {
  return std::rotl(k * 0xcc9e2d51U, 15) * 0x1b873593U;
}

std::string manifest_of(const std::vector<std::string>& names) {
  std::vector<std::string> members;
  std::set<std::string_view> known;
  for (const std::string& name : names) {
    if (known.insert(name).second)
      members.push_back(text::json_string(name) + ":\"" + in_hexadecimal(cryptomatte_id(name)) +
                        '"');
  }
  return text::joined_in('{', members, '}');
}

}  // namespace

std::uint32_t murmur_hash(const std::string& text) {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i]));
  };
  std::uint32_t h = 0;
  const std::size_t blocks = text.size() / 4;
  for (std::size_t i = 0; i < 4 * blocks; i += 4) {
    const std::uint32_t k = byte(i) | byte(i + 1) << 8 | byte(i + 2) << 16 | byte(i + 3) << 24;
    h = std::rotl(h ^ mixed(k), 13) * 5 + 0xe6546b64U;
  }
  std::uint32_t tail = 0;
  for (std::size_t i = text.size(); i > 4 * blocks; --i) tail = tail << 8 | byte(i - 1);
  h ^= mixed(tail);
  h ^= static_cast<std::uint32_t>(text.size());
  h = (h ^ h >> 16) * 0x85ebca6bU;
  h = (h ^ h >> 13) * 0xc2b2ae35U;
  return h ^ h >> 16;
}

std::uint32_t cryptomatte_id(const std::string& name) {
  const StandardArithmetic standard;
  const std::uint32_t hash = murmur_hash(name);
  const std::uint32_t exponent = hash >> 23 & 255;
  return exponent == 0 || exponent == 255 ? hash ^ 1U << 23 : hash;
}

void add_mattes(DepthMap& map, const Mattes& mattes) {
  const StandardArithmetic standard;
  // A map that is yet to get its channels has no other fault.
  if (!map.channels.empty()) require_valid(map);
  if (mattes.counts.size() != std::size_t{map.width} * map.height ||
      std::accumulate(mattes.counts.begin(), mattes.counts.end(), std::size_t{0}) !=
          mattes.shares.size()) {
    throw InputError(
        "mattes: expected a count for each pixel of the map, and as many shares as the "
        "counts say");
  }
  std::uint32_t ranks = 6;
  for (const std::uint32_t count : mattes.counts) ranks = std::max(ranks, count);
  const std::size_t levels = (ranks + 1) / 2;
  const std::size_t first = map.channels.size();
  for (std::size_t level = 0; level < levels; ++level) {
    for (const char component : {'R', 'G', 'B', 'A'}) {
      map.channels.push_back(
          {matte_channel(mattes.layer, level, component), Samples<float>(mattes.counts.size())});
    }
  }
  std::size_t next = 0;
  for (std::size_t pixel = 0; pixel < mattes.counts.size(); ++pixel) {
    for (std::size_t rank = 0; rank < mattes.counts[pixel]; ++rank, ++next) {
      const auto channel = [&](std::size_t component) -> float& {
        return std::get<Samples<float>>(map.channels[first + 2 * rank + component].values)[pixel];
      };
      channel(0) = std::bit_cast<float>(mattes.shares[next].id);
      channel(1) = mattes.shares[next].coverage;
    }
  }
  const std::string key = "cryptomatte/" + in_hexadecimal(murmur_hash(mattes.layer)).substr(0, 7);
  map.texts[key + "/name"] = mattes.layer;
  map.texts[key + "/hash"] = "MurmurHash3_32";
  map.texts[key + "/conversion"] = "uint32_to_float32";
  map.texts[key + "/manifest"] = manifest_of(mattes.names);
}

// Reading mattes.
namespace {

constexpr std::string_view prefix = "cryptomatte/", suffix = "/name";

/// The names of a layer's channels that a map has, up to a level that lacks one of the four.
std::vector<std::string> channels_of(const DepthMap& map, const std::string& layer) {
  std::vector<std::string> names;
  for (std::size_t level = 0;; ++level) {
    for (const char component : {'R', 'G', 'B', 'A'}) {
      names.push_back(matte_channel(layer, level, component));
      if (map.values<float>(names.back()) == nullptr) {
        names.resize(4 * level);
        return names;
      }
    }
  }
}

/// Ids are in R and B, their coverages in G and A.
void take_shares(const DepthMap& map, MatteLayer& layer) {
  std::vector<const Samples<float>*> values;
  for (const std::string& name : layer.channels) values.push_back(map.values<float>(name));
  layer.counts.assign(values.front()->size(), 0);
  for (std::size_t pixel = 0; pixel < layer.counts.size(); ++pixel) {
    for (std::size_t k = 0; k < values.size(); k += 2) {
      const float coverage = (*values[k + 1])[pixel];
      if (!(coverage > 0)) break;
      layer.shares.push_back({std::bit_cast<std::uint32_t>((*values[k])[pixel]), coverage});
      ++layer.counts[pixel];
    }
  }
}

/// {"spot":"3ae39a58"}; entries that are no ids are left out.
void take_manifest(const std::string& manifest, MatteLayer& layer) {
  const auto members = text::string_members_of_json(manifest);
  if (!members) return;
  for (const auto& [name, digits] : *members) {
    std::uint32_t id = 0;
    const char* const end = digits.data() + digits.size();
    const auto [rest, error] = std::from_chars(digits.data(), end, id, 16);
    if (error == std::errc() && rest == end) layer.names.try_emplace(id, name);
  }
}

void name_unknown_ids(MatteLayer& layer) {
  for (const MatteShare& share : layer.shares) {
    if (!layer.names.contains(share.id)) layer.names[share.id] = "0x" + in_hexadecimal(share.id);
  }
}

/// The numbers of the names, in their alphabetical order.
std::map<std::uint32_t, std::uint32_t> numbers_of(const MatteLayer& layer) {
  std::vector<std::pair<std::string_view, std::uint32_t>> sorted;
  for (const auto& [id, name] : layer.names) sorted.emplace_back(name, id);
  std::ranges::sort(sorted);
  std::map<std::uint32_t, std::uint32_t> numbers;
  for (const auto& [name, id] : sorted) {
    numbers.emplace(id, static_cast<std::uint32_t>(numbers.size()));
  }
  return numbers;
}

std::vector<std::string> in_order(const MatteLayer& layer,
                                  const std::map<std::uint32_t, std::uint32_t>& numbers) {
  std::vector<std::string> names(numbers.size());
  for (const auto& [id, number] : numbers) names[number] = layer.names.at(id);
  return names;
}

/// Adds the channels of a layer to a map of its size.
void add_names(const MatteLayer& layer, DepthMap& map) {
  const auto numbers = numbers_of(layer);
  const std::size_t pixels = layer.counts.size();
  const std::uint32_t most = layer.counts.empty() ? 0 : *std::ranges::max_element(layer.counts);
  for (std::uint32_t rank = 0; rank < std::max(most, 1U); ++rank) {
    Samples<std::uint32_t> shown(pixels, no_surface);
    Samples<float> coverage(pixels);
    std::size_t first = 0;
    for (std::size_t pixel = 0; pixel < pixels; first += layer.counts[pixel++]) {
      if (rank >= layer.counts[pixel]) continue;
      const MatteShare& share = layer.shares[first + rank];
      shown[pixel] = numbers.at(share.id);
      coverage[pixel] = share.coverage;
    }
    const std::string name = rank == 0 ? layer.name : layer.name + "." + std::to_string(rank + 1);
    map.channels.push_back({name, std::move(shown)});
    map.channels.push_back({name + ".coverage", std::move(coverage)});
    map.tables[name] = in_order(layer, numbers);
  }
}

/// Whether a channel already has a name that add_names() would give.
bool has_channels_of(const DepthMap& map, const std::string& layer) {
  return std::ranges::any_of(map.channels, [&](const ImageChannel& channel) {
    return channel.name == layer || channel.name.starts_with(layer + ".");
  });
}

}  // namespace

std::vector<MatteLayer> matte_layers(const DepthMap& map) {
  const StandardArithmetic standard;
  require_valid(map);
  std::vector<MatteLayer> layers;
  for (const auto& [key, name] : map.texts) {
    if (!key.starts_with(prefix) || !key.ends_with(suffix)) continue;
    MatteLayer layer{.name = name, .channels = channels_of(map, name)};
    if (layer.channels.empty()) continue;
    take_shares(map, layer);
    const auto manifest = map.texts.find(key.substr(0, key.size() - suffix.size()) + "/manifest");
    if (manifest != map.texts.end()) take_manifest(manifest->second, layer);
    name_unknown_ids(layer);
    layers.push_back(std::move(layer));
  }
  return layers;
}

std::vector<MatteExtent> extents(const MatteLayer& layer) {
  const StandardArithmetic standard;
  const auto numbers = numbers_of(layer);
  std::vector<MatteExtent> found;
  for (const std::string& name : in_order(layer, numbers)) found.push_back({.name = name});
  for (const MatteShare& share : layer.shares) {
    MatteExtent& extent = found[numbers.at(share.id)];
    ++extent.pixels;
    extent.area += double{share.coverage};
  }
  std::erase_if(found, [](const MatteExtent& extent) { return extent.pixels == 0; });
  return found;
}

DepthMap with_matte_names(DepthMap map) {
  const StandardArithmetic standard;
  for (const MatteLayer& layer : matte_layers(map)) {
    if (has_channels_of(map, layer.name)) continue;
    std::erase_if(map.channels, [&](const ImageChannel& channel) {
      return std::ranges::find(layer.channels, channel.name) != layer.channels.end();
    });
    add_names(layer, map);
  }
  return map;
}

}  // namespace fathom
