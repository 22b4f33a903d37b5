#include "fathom/image/files/exr_attributes.h"

#include <ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "fathom/image/files/exr_camera.h"
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
  for (const auto& [name, text] : texts_of(map))
    if (!is_reserved(name) && !is_name_table(name)) header.insert(name, Imf::StringAttribute(text));
  header.insert("software", Imf::StringAttribute(text::software_in_outputs()));
  set_numbers(header, map.camera ? exr_numbers(*map.camera) : map.numbers);
  set_names(header, map);
}

void get_attributes(const Imf::Header& header, DepthMap& map) {
  map.numbers = get_numbers(header);
  for (auto entry = header.begin(); entry != header.end(); ++entry) {
    const std::string name = entry.name();
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&entry.attribute());
    if (!text) continue;
    if (is_name_table(name))
      take_name_table(name, text->value(), map);
    else if (!is_reserved(name))
      map.texts[name] = text->value();
  }
}

}  // namespace fathom::image
