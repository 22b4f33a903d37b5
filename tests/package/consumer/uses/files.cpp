#include <fathom/files/byte_order.h>

#include <array>

bool use_files() {
  std::array<std::byte, 2> bytes{};
  fathom::store<std::uint16_t>(bytes.data(), 0x1234, std::endian::big);
  return fathom::load<std::uint16_t>(bytes.data(), std::endian::little) == 0x3412;
}
