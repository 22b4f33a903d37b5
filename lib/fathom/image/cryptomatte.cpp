#include "fathom/image/cryptomatte.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/image/matte_channels.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_text.h"

namespace fathom {
namespace {

using image::in_hexadecimal, image::matte_channel;

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

}  // namespace fathom
