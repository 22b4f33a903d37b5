// Any two files as a COLMAP model, binary or text: an InputError of one line, or cameras without
// fault. The first two bytes say how long the first file is, and the third what they are.
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/failures/errors.h"
#include "tests/fuzz/one_line.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fathom;
  using namespace fathom::camera;
  if (size < 3) return 0;
  const std::size_t length = std::min<std::size_t>(data[0] | data[1] << 8, size - 3);
  const std::string text(data + 3, data + size);
  std::istringstream cameras(text.substr(0, length)), images(text.substr(length));
  try {
    const auto imported =
        data[2] % 2 == 0 ? parse_colmap_binary({cameras, "cameras.bin"}, {images, "images.bin"})
                         : parse_colmap_text({cameras, "cameras.txt"}, {images, "images.txt"});
    for (const ImportedCamera& each : imported)
      if (each.fault.empty() && find_fault(each.camera)) std::abort();
  } catch (const InputError& error) {
    fuzz::expect_one_line(error.what());
  }
  return 0;
}
