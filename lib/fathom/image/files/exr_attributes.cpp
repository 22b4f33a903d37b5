#include "fathom/image/files/exr_attributes.h"

#include <ImfMatrixAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "fathom/image/files/exr_id_manifest.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/files/name_tables.h"
#include "fathom/text/version.h"

namespace fathom::image {
namespace {

/// Attributes of the format itself: texts with these names are not ours.
constexpr std::array<std::string_view, 17> reserved{"channels",
                                                    "compression",
                                                    "dataWindow",
                                                    "displayWindow",
                                                    "lineOrder",
                                                    "tiles",
                                                    "name",
                                                    "type",
                                                    "version",
                                                    "chunkCount",
                                                    "worldToCamera",
                                                    "worldToNDC",
                                                    "pixelAspectRatio",
                                                    "screenWindowCenter",
                                                    "screenWindowWidth",
                                                    "idManifest",
                                                    "preview"};

bool is_reserved(std::string_view name) {
  return name.empty() || name.size() > 255 ||
         std::find(reserved.begin(), reserved.end(), name) != reserved.end();
}

/// Imath multiplies row vectors: the transpose of the matrix for column vectors.
Imath::M44f for_row_vectors(const std::array<double, 16>& matrix) {
  Imath::M44f result;
  for (int k = 0; k < 16; ++k)
    result[k % 4][k / 4] = static_cast<float>(matrix[static_cast<std::size_t>(k)]);
  return result;
}

std::array<double, 16> for_column_vectors(const Imath::M44f& matrix) {
  std::array<double, 16> result{};
  for (int k = 0; k < 16; ++k) result[static_cast<std::size_t>(k)] = matrix[k % 4][k / 4];
  return result;
}

bool fits_binary32(const std::array<double, 16>& matrix) {
  return std::all_of(matrix.begin(), matrix.end(),
                     [](double x) { return std::abs(x) <= std::numeric_limits<float>::max(); });
}

void set_window(Imf::Header& header, const DepthMap& map) {
  // OpenEXR's limits for the headers that it writes.
  if (map.pixel_aspect_ratio >= 1e-6 && map.pixel_aspect_ratio <= 1e6)
    header.pixelAspectRatio() = static_cast<float>(map.pixel_aspect_ratio);
  const auto x = static_cast<float>(map.screen_window_centre[0]);
  const auto y = static_cast<float>(map.screen_window_centre[1]);
  const auto width = static_cast<float>(map.screen_window_width);
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(width) || width < 0) return;
  header.screenWindowCenter() = {x, y};
  header.screenWindowWidth() = width;
}

/// The names of the map's numbers: in our words, and of the channels that it has, in EXR's.
void set_names(Imf::Header& header, const DepthMap& map) {
  for (const auto& [name, text] : name_tables(map)) {
    if (text.size() > std::numeric_limits<int>::max())
      throw std::length_error(name + " takes more than 2 GiB");
    header.insert(name, Imf::StringAttribute(text));
  }
  std::vector<NamedChannel> named;
  for (const ImageChannel& channel : map.channels)
    if (const auto* names = names_of_channel(map, channel.name))
      named.push_back({channel.name, *names});
  if (!named.empty()) header.insert("idManifest", id_manifest(named));
}

}  // namespace

Imf::Compression compression_of(Compression compression) {
  switch (compression) {
    case Compression::none:
      return Imf::NO_COMPRESSION;
    case Compression::rle:
      return Imf::RLE_COMPRESSION;
    case Compression::zips:
      return Imf::ZIPS_COMPRESSION;
    case Compression::zip:
      return Imf::ZIP_COMPRESSION;
    case Compression::piz:
      return Imf::PIZ_COMPRESSION;
  }
  return Imf::ZIP_COMPRESSION;
}

std::uint32_t rows_of_a_chunk(Compression compression) {
  if (compression == Compression::zip) return 16;
  return compression == Compression::piz ? 32 : 1;
}

void set_attributes(Imf::Header& header, const DepthMap& map) {
  set_window(header, map);
  for (const auto& [name, text] : map.texts)
    if (!is_reserved(name) && !is_name_table(name)) header.insert(name, Imf::StringAttribute(text));
  header.insert("software", Imf::StringAttribute(text::software_in_outputs()));
  if (map.world_to_camera && fits_binary32(*map.world_to_camera))
    Imf::addWorldToCamera(header, for_row_vectors(*map.world_to_camera));
  if (map.world_to_ndc && fits_binary32(*map.world_to_ndc))
    Imf::addWorldToNDC(header, for_row_vectors(*map.world_to_ndc));
  set_names(header, map);
}

void get_attributes(const Imf::Header& header, DepthMap& map) {
  map.pixel_aspect_ratio = header.pixelAspectRatio();
  map.screen_window_centre = {header.screenWindowCenter().x, header.screenWindowCenter().y};
  map.screen_window_width = header.screenWindowWidth();
  for (auto entry = header.begin(); entry != header.end(); ++entry) {
    const std::string name = entry.name();
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&entry.attribute())) {
      if (is_name_table(name))
        take_name_table(name, text->value(), map);
      else if (!is_reserved(name))
        map.texts[name] = text->value();
    } else if (const auto* m = dynamic_cast<const Imf::M44fAttribute*>(&entry.attribute())) {
      if (name == "worldToCamera") map.world_to_camera = for_column_vectors(m->value());
      if (name == "worldToNDC") map.world_to_ndc = for_column_vectors(m->value());
    }
  }
}

}  // namespace fathom::image
