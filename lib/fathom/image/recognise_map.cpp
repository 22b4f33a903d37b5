#include "fathom/image/recognise_map.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "fathom/image/map_files.h"

namespace fathom {
namespace {

/// Whether this is an archive whose first member is an array of NumPy's. Meshes come in archives,
/// too (3MF).
bool is_npz(std::string_view content) {
  constexpr std::size_t name_at = 30;
  if (!content.starts_with("PK\x03\x04") || content.size() < name_at) return false;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(content[i]); };
  const std::size_t length = byte(26) + std::size_t{256} * byte(27);
  return content.substr(name_at, length).ends_with(".npy");
}

}  // namespace

bool is_map(std::span<const std::byte> bytes) {
  using namespace std::string_view_literals;
  const std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  static constexpr std::array magics{
      "\x76\x2f\x31\x01"sv, "\x89PNG"sv, "\x93NUMPY"sv, "Pf"sv, "PF"sv, "II*\0"sv, "MM\0*"sv};
  return std::ranges::any_of(magics,
                             [&](std::string_view magic) { return content.starts_with(magic); }) ||
         is_npz(content) || is_colmap_map(bytes);
}

}  // namespace fathom
