#include <cstdint>
#include <numeric>
#include <span>

#include "fathom/failures/errors.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/files/map_codecs.h"

namespace {

/// As many samples as the counts of the pixels say.
void read_deep(std::span<const std::byte> bytes) {
  const fathom::DeepMap map = fathom::read_deep_map(bytes, "input");
  const std::size_t pixels = std::size_t{map.description.width} * map.description.height;
  const auto samples = std::accumulate(map.counts.begin(), map.counts.end(), std::size_t{0});
  if (map.counts.size() != pixels || map.samples.size() != samples) __builtin_trap();
}

}  // namespace

/// Readers of EXR, deep EXR, PFM, PNG, NPY, NPZ and COLMAP's maps: any bytes are a map or an
/// InputError. A map that was read has as many values as pixels.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
  try {
    if (fathom::is_deep_map(bytes)) read_deep(bytes);
    const fathom::DepthMap map = fathom::image::decode_map(bytes, "input");
    for (const fathom::ImageChannel& channel : map.channels)
      std::visit(
          [&](const auto& values) {
            if (values.size() != std::size_t{map.width} * map.height) __builtin_trap();
          },
          channel.values);
  } catch (const fathom::InputError&) {
  }
  return 0;
}
