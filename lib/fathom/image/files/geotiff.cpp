#include "fathom/image/files/geotiff.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/files/compressor.h"
#include "fathom/image/files/file_texts.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/surface.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/decimal.h"
#include "fathom/text/version.h"
#include "fathom/threads/per_thread.h"
#include "fathom/threads/threads.h"

/// GeoTIFF ([GEO19], a TIFF [TIFF92] with a place in the world): a band of binary32 numbers for
/// each channel, one after the other, in strips that are compressed by DEFLATE after the predictor
/// for floating point ([TTN05]). Without the predictor, the depth of data/meshes/spot.obj at
/// 1024×1024 takes 2.4 times as much; with bands that are interleaved, Z, A, P and Nc together take
/// 1.15 times as much.
///
/// world_from_image() places the image in the world: pixels are areas, and (0, 0) is the corner of
/// the first pixel. The coordinate system is user-defined, because the world is not the earth. All
/// bands mark missing surfaces by the same value, because GDAL has one such value for each file:
/// the background that the map declares, or NaN. Quantities such as A have 0 there instead, which
/// is also an ordinary value.
namespace fathom::image {
using namespace files;
using namespace text;

// The directory of a TIFF.

namespace {

/// Source   [TIFF92], section 2, "Types"
constexpr std::uint16_t ascii_type = 2, short_type = 3, long_type = 4, double_type = 12;

template <class T>
void put_value(Bytes& bytes, T value) {
  bytes.resize(bytes.size() + sizeof value);
  store(&bytes[bytes.size() - sizeof value], value, std::endian::little);
}

}  // namespace

template <class T>
void TiffDirectory::add(std::uint16_t tag, std::uint16_t type, std::span<const T> values) {
  Entry entry{tag, type, static_cast<std::uint32_t>(values.size()), {}};
  for (const T value : values) put_value(entry.values, value);
  entries_.push_back(std::move(entry));
}

void TiffDirectory::add_short(std::uint16_t tag, std::span<const std::uint16_t> values) {
  add(tag, short_type, values);
}

void TiffDirectory::add_long(std::uint16_t tag, std::span<const std::uint32_t> values) {
  add(tag, long_type, values);
}

void TiffDirectory::add_double(std::uint16_t tag, std::span<const double> values) {
  add(tag, double_type, values);
}

void TiffDirectory::add_text(std::uint16_t tag, const std::string& text) {
  add(tag, ascii_type, std::span(text.c_str(), text.size() + 1));
}

Bytes TiffDirectory::encoded_at(std::uint32_t at) const {
  std::vector<const Entry*> sorted;
  for (const Entry& entry : entries_) sorted.push_back(&entry);
  std::ranges::sort(sorted, {}, [](const Entry* entry) { return entry->tag; });

  constexpr std::size_t entry_size = 12, room = 4;
  const std::size_t size = sizeof(std::uint16_t) + entry_size * sorted.size() + room;
  Bytes directory, behind;
  put_value(directory, static_cast<std::uint16_t>(sorted.size()));
  for (const Entry* entry : sorted) {
    put_value(directory, entry->tag);
    put_value(directory, entry->type);
    put_value(directory, entry->count);
    if (entry->values.size() <= room) {
      append(directory, entry->values);
      directory.resize(directory.size() + room - entry->values.size());
      continue;
    }
    put_value(directory, static_cast<std::uint32_t>(at + size + behind.size()));
    append(behind, entry->values);
    behind.resize(behind.size() + behind.size() % 2);  // values lie at even places
  }
  put_value(directory, std::uint32_t{0});
  append(directory, behind);
  return directory;
}

// The place in the world.

namespace {

struct ImageVector {
  Dyadic u, v;
};

ImageVector operator-(const ImageVector& a, const ImageVector& b) {
  return {a.u - b.u, a.v - b.v};
}

/// For orthographic cameras, whose projection does not divide.
ImageVector image_of(const Camera& camera, const WorldPoint& X) {
  const HomogeneousImagePoint p = to_image(camera.projection, to_camera(camera.world_to_camera, X));
  return {p.U, p.V};
}

}  // namespace

std::optional<WorldFromImage> world_from_image(const Camera& camera) {
  const StandardArithmetic standard;
  if (!is_orthographic(camera.projection) || find_fault(camera)) return std::nullopt;
  const ImageVector o = image_of(camera, {0, 0, 0});
  const ImageVector x = image_of(camera, {1, 0, 0}) - o;
  const ImageVector y = image_of(camera, {0, 1, 0}) - o;
  const ImageVector z = image_of(camera, {0, 0, 1}) - o;
  // Points above each other have the same image.
  if (!z.u.is_zero() || !z.v.is_zero()) return std::nullopt;

  // (u, v) = o + X·x + Y·y, solved by Cramer's rule; x and y are independent, as the camera is
  // regular.
  const Dyadic det = x.u * y.v - y.u * x.v;
  const auto over_det = [&](const Dyadic& numerator) {
    return round_to_binary64(Ratio(numerator, det));
  };
  const WorldFromImage g{over_det(y.u * o.v - y.v * o.u), over_det(y.v),  over_det(-y.u),
                         over_det(x.v * o.u - x.u * o.v), over_det(-x.v), over_det(x.u)};
  const bool fits = std::ranges::all_of(g, [](double each) { return std::isfinite(each); });
  return fits ? std::optional(g) : std::nullopt;
}

namespace {

[[noreturn]] void refuse_tiff(const std::string& name, const std::string& why) {
  throw OutputError(name + ": " + why);
}

/// Numbers of tags and values, under their names in the specifications.
namespace tag {
constexpr std::uint16_t image_width = 256, image_length = 257, bits_per_sample = 258,
                        compression = 259, photometric_interpretation = 262, strip_offsets = 273,
                        samples_per_pixel = 277, rows_per_strip = 278, strip_byte_counts = 279,
                        planar_configuration = 284, software = 305, predictor = 317,
                        extra_samples = 338, sample_format = 339, model_pixel_scale = 33550,
                        model_tiepoint = 33922, model_transformation = 34264,
                        geo_key_directory = 34735, geo_ascii_params = 34737, gdal_metadata = 42112,
                        gdal_nodata = 42113;
}  // namespace tag
constexpr std::uint16_t by_deflate = 8, black_is_zero = 1, separate_planes = 2, floating_point = 3,
                        floating_point_predictor = 3, unspecified = 0;

// The values of the bands.

/// The value that means "no surface" in all bands.
float value_of_none(const DepthMap& map) {
  const double declared =
      declared_background(map).value_or(std::numeric_limits<double>::infinity());
  if (std::isinf(declared)) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>(declared);
}

std::string none_as_text(float value) {
  return std::isnan(value) ? "nan" : shortest_decimal(value);
}

/// A channel as a band: `none` where it shows no surface.
std::vector<float> band_of(const DepthMap& map, const ImageChannel& channel, float none,
                           const std::string& name) {
  const auto* floats = std::get_if<Samples<float>>(&channel.values);
  const auto* numbers = std::get_if<Samples<std::uint32_t>>(&channel.values);
  if (!floats && !numbers)
    refuse_tiff(name, "a GeoTIFF holds binary32 numbers, and channel '" + channel.name +
                          "' is stored otherwise");
  const bool is_quantity = kind_of(channel) == ChannelKind::quantity;
  const std::vector<std::uint8_t> surface =
      is_quantity ? std::vector<std::uint8_t>() : surface_mask(map, channel);
  std::vector<float> band(std::size_t{map.width} * map.height, none);
  constexpr std::uint32_t greatest_whole = 1U << 24;
  for (std::size_t k = 0; k < band.size(); ++k) {
    if (!is_quantity && surface[k] == 0) continue;
    if (numbers && (*numbers)[k] > greatest_whole)
      refuse_tiff(name, place_of_pixel(k, map.width) + "channel '" + channel.name +
                            "' has the number " + std::to_string((*numbers)[k]) +
                            ", and binary32 holds those up to 16777216; .exr holds all");
    band[k] = numbers ? static_cast<float>((*numbers)[k]) : (*floats)[k];
    if (!is_quantity && band[k] == none)
      refuse_tiff(name, place_of_pixel(k, map.width) + "a surface has the value " +
                            none_as_text(none) + " in channel '" + channel.name +
                            "', which stands for none: choose another background");
  }
  return band;
}

// Strips.

/// Before compression, about: as GDAL and libtiff take them into memory whole.
constexpr std::size_t bytes_of_strip = std::size_t{1} << 18;

/// The buffers of a thread, reused for its next strip.
struct StripPlace {
  Compressor compressor = new_compressor();
  Bytes predicted;
};

/// Of a row of n numbers their first bytes, most significant, then their second ones, and so on;
/// each of all these as its difference from the one before.
/// Source   [TTN05]
void predict_row(std::span<const float> row, std::byte* to) {
  constexpr std::size_t size = sizeof(float);
  for (std::size_t i = 0; i < row.size(); ++i) {
    std::byte bytes[size];
    store(bytes, row[i], std::endian::big);
    for (std::size_t b = 0; b < size; ++b) to[b * row.size() + i] = bytes[b];
  }
  for (std::size_t k = size * row.size(); k-- > 1;)
    to[k] = static_cast<std::byte>(static_cast<unsigned>(to[k]) - static_cast<unsigned>(to[k - 1]));
}

Bytes compressed_strip(std::span<const float> rows, std::size_t width, StripPlace& place) {
  place.predicted.resize(rows.size_bytes());
  for (std::size_t at = 0; at < rows.size(); at += width)
    predict_row(rows.subspan(at, width), &place.predicted[sizeof(float) * at]);
  Bytes strip(libdeflate_zlib_compress_bound(place.compressor.get(), place.predicted.size()));
  strip.resize(libdeflate_zlib_compress(place.compressor.get(), place.predicted.data(),
                                        place.predicted.size(), strip.data(), strip.size()));
  return strip;
}

struct TiffStrips {
  std::uint32_t rows = 0;  // of each, but for the last of a band
  std::vector<Bytes> of_all_bands;
};

TiffStrips compressed_strips(const DepthMap& map, float none, int threads,
                             const std::string& name) {
  TiffStrips strips;
  const std::size_t row_bytes = sizeof(float) * map.width;
  strips.rows = static_cast<std::uint32_t>(
      std::clamp<std::size_t>(bytes_of_strip / row_bytes, 1, map.height));
  const std::size_t per_band = (map.height + strips.rows - 1) / strips.rows;
  for (const ImageChannel& channel : map.channels) {
    const std::vector<float> band = band_of(map, channel, none, name);
    std::vector<Bytes> of_band(per_band);
    run_with_threads(threads, [&] {
      PerThread<StripPlace> places;
      in_parallel(per_band, [&](std::size_t i) {
        const std::size_t first = i * strips.rows * map.width;
        const std::size_t count =
            std::min(band.size() - first, std::size_t{strips.rows} * map.width);
        of_band[i] =
            compressed_strip(std::span(band).subspan(first, count), map.width, places.local());
      });
    });
    std::ranges::move(of_band, std::back_inserter(strips.of_all_bands));
  }
  return strips;
}

// The description of the image.

WorldFromImage place_of(const std::optional<Camera>& camera, const std::string& name) {
  if (camera)
    if (const auto place = world_from_image(*camera)) return *place;
  refuse_tiff(name,
              "a GeoTIFF needs an orthographic camera that looks straight down or up the world's z "
              "axis; .exr holds the map of any camera");
}

/// Source   [GEO19] 7.1 (GeoKeyDirectoryTag), annex B.6 (raster to model)
void add_place(TiffDirectory& directory, const WorldFromImage& g) {
  // North up, as most programs expect it: they know scales better than a matrix.
  if (g[1] > 0 && g[5] < 0 && g[2] == 0 && g[4] == 0) {
    directory.add_double(tag::model_pixel_scale, std::array{g[1], -g[5], 0.0});
    directory.add_double(tag::model_tiepoint, std::array{0.0, 0.0, 0.0, g[0], g[3], 0.0});
  } else {
    directory.add_double(tag::model_transformation, std::array{g[1], g[2], 0.0, g[0],  //
                                                               g[4], g[5], 0.0, g[3],  //
                                                               0.0, 0.0, 0.0, 0.0,     //
                                                               0.0, 0.0, 0.0, 1.0});
  }
  const std::string citation = "scene coordinates|";
  constexpr std::uint16_t gt_model_type = 1024, gt_raster_type = 1025, gt_citation = 1026;
  constexpr std::uint16_t user_defined = 32767, pixel_is_area = 1;
  directory.add_short(tag::geo_key_directory, std::array<std::uint16_t, 16>{
                                                  1, 1, 0, 3,  // version, revision, keys
                                                  gt_model_type, 0, 1, user_defined,    //
                                                  gt_raster_type, 0, 1, pixel_is_area,  //
                                                  gt_citation, tag::geo_ascii_params,
                                                  static_cast<std::uint16_t>(citation.size()), 0});
  directory.add_text(tag::geo_ascii_params, citation);
}

void require_printable(const std::string& text, const std::string& what, const std::string& name) {
  if (std::ranges::any_of(text, [](char c) { return 0 <= c && c < ' ' && c != '\t' && c != '\n'; }))
    refuse_tiff(name, "a GeoTIFF cannot hold " + what + ", which has a control character");
}

std::string as_xml(const std::string& text, bool in_quotes) {
  std::string xml;
  for (const char c : text) {
    if (c == '&') {
      xml += "&amp;";
    } else if (c == '<') {
      xml += "&lt;";
    } else if (c == '>') {
      xml += "&gt;";
    } else if (c == '"' && in_quotes) {
      xml += "&quot;";
    } else {
      xml += c;
    }
  }
  return xml;
}

/// GDAL takes the escapes out of a value twice.
std::string xml_item(const std::string& key, const std::string& more, const std::string& value) {
  return "  <Item name=\"" + as_xml(key, true) + "\"" + more + ">" +
         as_xml(as_xml(value, false), false) + "</Item>\n";
}

/// The texts of the map and the names of its bands, as GDAL has them.
std::string gdal_metadata(const DepthMap& map, const std::string& name) {
  std::string xml = "<GDALMetadata>\n";
  std::map<std::string, std::string> texts = name_tables(map);
  for (const auto& [key, text] : texts_of(map))
    if (key != background_text) texts[key] = text;
  for (const auto& [key, text] : texts) {
    require_printable(key, "the name of a text", name);
    require_printable(text, "the text '" + key + "'", name);
    xml += xml_item(key, "", text);
  }
  for (std::size_t i = 0; i < map.channels.size(); ++i) {
    require_printable(map.channels[i].name, "the name of a channel", name);
    xml += xml_item("DESCRIPTION", " sample=\"" + std::to_string(i) + "\" role=\"description\"",
                    map.channels[i].name);
  }
  return xml + "</GDALMetadata>\n";
}

TiffDirectory directory_of(const DepthMap& map, const WorldFromImage& place, float none,
                           std::uint32_t rows, const std::string& name) {
  const auto bands = static_cast<std::uint16_t>(map.channels.size());
  using Shorts = std::vector<std::uint16_t>;
  TiffDirectory directory;
  directory.add_long(tag::image_width, map.width);
  directory.add_long(tag::image_length, map.height);
  directory.add_short(tag::bits_per_sample, Shorts(bands, 8 * sizeof(float)));
  directory.add_short(tag::compression, by_deflate);
  directory.add_short(tag::photometric_interpretation, black_is_zero);
  directory.add_short(tag::samples_per_pixel, bands);
  directory.add_long(tag::rows_per_strip, rows);
  directory.add_short(tag::planar_configuration, separate_planes);
  directory.add_text(tag::software, software_in_outputs());
  directory.add_short(tag::predictor, floating_point_predictor);
  if (bands > 1) directory.add_short(tag::extra_samples, Shorts(bands - 1U, unspecified));
  directory.add_short(tag::sample_format, Shorts(bands, floating_point));
  add_place(directory, place);
  directory.add_text(tag::gdal_metadata, gdal_metadata(map, name));
  directory.add_text(tag::gdal_nodata, none_as_text(none));
  return directory;
}

/// Header, directory, strips: a reader finds the description without reading the image.
Bytes assembled_tiff(const TiffDirectory& description, const std::vector<Bytes>& strips,
                     const std::string& name) {
  constexpr std::uint32_t header_size = 8;
  std::vector<std::uint32_t> offsets(strips.size()), sizes(strips.size());
  const auto with_strips = [&] {
    TiffDirectory directory = description;
    directory.add_long(tag::strip_offsets, offsets);
    directory.add_long(tag::strip_byte_counts, sizes);
    return directory.encoded_at(header_size);
  };
  std::uint64_t at = header_size + with_strips().size();
  for (std::size_t i = 0; i < strips.size(); ++i) {
    offsets[i] = static_cast<std::uint32_t>(at);
    sizes[i] = static_cast<std::uint32_t>(strips[i].size());
    at += strips[i].size();
  }
  if (at > std::numeric_limits<std::uint32_t>::max())
    refuse_tiff(name, std::string(description_of(MapFormat::tiff).limit));
  Bytes file;
  file.reserve(at);
  append(file, std::string("II*\0", 4));
  file.resize(header_size);
  store(&file[4], header_size, std::endian::little);
  append(file, with_strips());
  for (const Bytes& strip : strips) append(file, strip);
  return file;
}

}  // namespace

Bytes encode_geotiff(const DepthMap& map, const std::optional<Camera>& camera, int threads,
                     const std::string& name) {
  const WorldFromImage place = place_of(camera ? camera : camera_of(map, name), name);
  require_size(MapFormat::tiff, map.width, map.height, name);
  if (map.channels.size() > 0xFFFF) refuse_tiff(name, "a GeoTIFF holds fewer than 65536 bands");
  const float none = value_of_none(map);
  const TiffStrips strips = compressed_strips(map, none, threads, name);
  return assembled_tiff(directory_of(map, place, none, strips.rows, name), strips.of_all_bands,
                        name);
}

}  // namespace fathom::image

namespace fathom {

void require_place_in_world(const Camera& camera, const std::string& name) {
  (void)image::place_of(camera, name);
}

}  // namespace fathom
