// Any bytes as a texture: an InputError of one line, or a picture that has a colour wherever it is
// looked at. The first bytes say where.
#include <array>
#include <cstring>

#include "fathom/failures/errors.h"
#include "fathom/pipeline/fragments/texture.h"
#include "tests/fuzz/one_line.h"

namespace {

using namespace fathom;
using namespace fathom::pipeline;

constexpr std::size_t footprint_size = 6 * sizeof(double);

TextureFootprint footprint_from(const std::uint8_t* data) {
  std::array<double, 6> x;
  std::memcpy(x.data(), data, footprint_size);
  return {{x[0], x[1]}, {x[2], x[3]}, {x[4], x[5]}};
}

void look(const Texture& texture, const TextureFootprint& footprint) {
  for (const TextureFilter filter : {TextureFilter::nearest, TextureFilter::bilinear,
                                     TextureFilter::trilinear, TextureFilter::anisotropic}) {
    for (const double component : texture.sample(footprint, filter))
      if (!(component >= -1e-9 && component <= 1 + 1e-9)) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < footprint_size) return 0;
  const TextureFootprint footprint = footprint_from(data);
  static const Texture checker = Texture::checker();
  look(checker, footprint);
  try {
    const RgbImage image = decode_rgb_png(
        std::as_bytes(std::span(data + footprint_size, size - footprint_size)), "input");
    // Of larger ones only the reading is tried: mip maps take twenty times the memory.
    if (image.pixels.size() <= std::size_t{1} << 14) look(Texture(image), footprint);
  } catch (const InputError& error) {
    fuzz::expect_one_line(error.what());
  }
  return 0;
}
