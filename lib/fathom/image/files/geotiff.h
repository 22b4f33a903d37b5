#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/files/file_bytes.h"

/// Parts of a GeoTIFF: its directory, and the place of its image in the world.
namespace fathom::image {

/// The directory of a little-endian TIFF: the description of its image as tagged values ([TIFF92],
/// section 2). It does not interpret the tags.
class TiffDirectory {
 public:
  void add_short(std::uint16_t tag, std::span<const std::uint16_t> values);
  void add_long(std::uint16_t tag, std::span<const std::uint32_t> values);
  void add_double(std::uint16_t tag, std::span<const double> values);
  /// Adds a terminating zero byte; the text must not contain one.
  void add_text(std::uint16_t tag, const std::string& text);

  void add_short(std::uint16_t tag, std::uint16_t value) { add_short(tag, std::span(&value, 1)); }
  void add_long(std::uint16_t tag, std::uint32_t value) { add_long(tag, std::span(&value, 1)); }

  /// The bytes of the directory at offset `at`, followed by the values that do not fit into its
  /// entries; no other directory follows. The length depends only on the number of values.
  [[nodiscard]] files::Bytes encoded_at(std::uint32_t at) const;

 private:
  struct Entry {
    std::uint16_t tag, type;
    std::uint32_t count;
    files::Bytes values;
  };
  template <class T>
  void add(std::uint16_t tag, std::uint16_t type, std::span<const T> values);

  std::vector<Entry> entries_;
};

/// In the order of GDAL's geotransform.
using WorldFromImage = std::array<double, 6>;

/// The affine map from the image to the world that a GeoTIFF needs. It exists if the camera is
/// orthographic and looks straight along the world's z axis, up or down, because then the place of
/// an image point does not depend on its depth.
///
/// Returns  g: the point (u, v), in pixels from the top left corner
///          of the image, v downwards, is x = g[0] + g[1]·u + g[2]·v, y = g[3] + g[4]·u + g[5]·v.
/// Unit     x and y: scene units
/// Exact    its existence is decided exactly; each number is the exact one rounded once.
/// Fails    nullopt also if a number is too large for binary64.
std::optional<WorldFromImage> world_from_image(const Camera& camera);

}  // namespace fathom::image
