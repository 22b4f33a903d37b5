#include <cstdint>
#include <span>

#include "fathom/failures/errors.h"
#include "fathom/image/files/map_codecs.h"

/// Readers of EXR, PFM, PNG, NPY, NPZ and COLMAP's maps: any bytes are a map or an InputError. A
/// map that was read has as many values as pixels.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const fathom::DepthMap map =
        fathom::image::decode_map(std::as_bytes(std::span(data, size)), "input");
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
