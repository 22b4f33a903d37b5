#include "fathom/depth_format/opengl_storage.h"

#include <string>

#include "fathom/failures/errors.h"

namespace fathom {

Storage storage_of_attachment(int bits, bool is_floating_point) {
  if (is_floating_point && bits == 32) return Storage::float32;
  for (const Storage storage : {Storage::unorm16, Storage::unorm24, Storage::unorm32}) {
    if (!is_floating_point && bits == bits_of(storage)) return storage;
  }
  throw InputError("OpenGL: the depth attachment has " + std::to_string(bits) + " bits");
}

double window_depth_of_pixel(Storage storage, std::uint32_t pixel) {
  const std::uint32_t code = storage == Storage::unorm24 ? pixel >> 8 : pixel;
  return static_cast<double>(code) / greatest_code(storage);
}

}  // namespace fathom
