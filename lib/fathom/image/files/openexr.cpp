#include "fathom/image/files/openexr.h"

#include <ImfHeader.h>
#include <ImfIDManifest.h>
#include <ImfMatrixAttribute.h>
#include <ImfOpaqueAttribute.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/files/byte_order.h"
#include "fathom/image/files/file_texts.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/text/version.h"

namespace fathom::image {
namespace {

/// A channel with the names of its numbers: names[n] for n.
struct NamedChannel {
  std::string channel;
  const std::vector<std::string>& names;
};

std::vector<char> serialized(const std::vector<NamedChannel>& channels) {
  Imf::IDManifest manifest;
  for (const auto& [channel, names] : channels) {
    Imf::IDManifest::ChannelGroupManifest& group = manifest.add(channel);
    group.setLifetime(Imf::IDManifest::LIFETIME_FRAME);
    group.setHashScheme(Imf::IDManifest::NOTHASHED);
    group.setEncodingScheme(Imf::IDManifest::ID_SCHEME);
    group.setComponent("name");
    for (std::size_t n = 0; n < names.size(); ++n) group.insert(n, names[n]);
  }
  std::vector<char> bytes;
  manifest.serialize(bytes);
  return bytes;
}

/// EXR's attribute of the type "idmanifest", which names the numbers in channels. The bytes are the
/// bytes of Imf::CompressedIDManifest, which OpenEXR 3.1 copies without checking for lack of
/// memory: first the uncompressed size in eight bytes, little endian, then zlib's stream.
/// Fails    std::bad_alloc.
Imf::OpaqueAttribute id_manifest(const std::vector<NamedChannel>& channels) {
  const std::vector<char> plain = serialized(channels);
  uLongf size = ::compressBound(plain.size());
  files::Bytes value(sizeof(std::uint64_t) + size);
  store(value.data(), std::uint64_t{plain.size()}, std::endian::little);
  if (::compress(reinterpret_cast<Bytef*>(value.data() + sizeof(std::uint64_t)), &size,
                 reinterpret_cast<const Bytef*>(plain.data()), plain.size()) != Z_OK) {
    throw std::bad_alloc();  // there is room enough
  }
  value.resize(sizeof(std::uint64_t) + size);
  ByteInput stream(value, "idmanifest", {});
  Imf::OpaqueAttribute attribute("idmanifest");
  attribute.readValueFrom(stream, static_cast<int>(value.size()), 2);
  return attribute;
}

/// A camera in OpenEXR's words: the attributes that are numbers, under their names there.
using ExrNumbers = std::map<std::string, std::vector<double>>;

constexpr std::array matrix_names{"worldToCamera", "worldToNDC"};

/// For column vectors.
using Matrix4 = std::array<std::array<double, 4>, 4>;

/// Row by row for row vectors, as Imath multiplies them: the transpose.
std::vector<double> for_row_vectors(const Matrix4& matrix) {
  std::vector<double> flat(16);
  for (std::size_t k = 0; k < 16; ++k) flat[k] = matrix[k % 4][k / 4];
  return flat;
}

Matrix4 camera_from_world(const Pose& world_to_camera) {
  auto [x, y, z] = world_to_camera;
  for (double& component : y) component = -component;
  return {x, y, z, {0, 0, 0, 1}};
}

/// The image after division by the last component.
Matrix4 ndc_from_world(const Camera& camera) {
  const auto& [x, y, z] = camera.world_to_camera;
  const Projection& projection = camera.projection;
  const auto [cx, cy] = principal_point(projection);
  Matrix4 m{};
  m[3] = is_perspective(projection) ? z : std::array<double, 4>{0, 0, 0, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    m[0][k] = (projection.fx * x[k] + projection.skew * y[k] + cx * m[3][k]) / camera.width;
    m[1][k] = (projection.fy * y[k] + cy * m[3][k]) / camera.height;
    m[2][k] = z[k];
  }
  return m;
}

/// nullptr unless the name has exactly this many numbers.
const std::vector<double>* numbers_named(const ExrNumbers& numbers, const std::string& name,
                                         std::size_t count) {
  const auto found = numbers.find(name);
  return found == numbers.end() || found->second.size() != count ? nullptr : &found->second;
}

bool fits_binary32(double x) {
  return std::abs(x) <= std::numeric_limits<float>::max();
}

void set_window(Imf::Header& header, const ExrNumbers& numbers) {
  // OpenEXR's limits for the headers that it writes.
  const auto* ratio = numbers_named(numbers, "pixelAspectRatio", 1);
  if (ratio && ratio->front() >= 1e-6 && ratio->front() <= 1e6)
    header.pixelAspectRatio() = static_cast<float>(ratio->front());
  const auto* centre = numbers_named(numbers, "screenWindowCenter", 2);
  const auto* extent = numbers_named(numbers, "screenWindowWidth", 1);
  if (!centre || !extent) return;
  const auto x = static_cast<float>((*centre)[0]), y = static_cast<float>((*centre)[1]);
  const auto width = static_cast<float>(extent->front());
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(width) || width < 0) return;
  header.screenWindowCenter() = {x, y};
  header.screenWindowWidth() = width;
}

/// The attributes of an EXR that describe a camera to other programs; `fathom.camera` has the exact
/// numbers.
///   worldToCamera       x right, y up, z forward; for row vectors, row by row
///   worldToNDC          (0, 0) is the top left, (1, 1) the bottom right corner; likewise
///   pixelAspectRatio, screenWindowCenter (x right, y up), screenWindowWidth
/// Rounded in binary64.
ExrNumbers exr_numbers(const Camera& camera) {
  if (bends_rays(camera.projection))
    return {{"worldToCamera", for_row_vectors(camera_from_world(camera.world_to_camera))}};
  const auto [cx, cy] = principal_point(camera.projection);
  // The window is on the plane z = 1; for an orthographic camera it is the image's extent.
  return {{"worldToCamera", for_row_vectors(camera_from_world(camera.world_to_camera))},
          {"worldToNDC", for_row_vectors(ndc_from_world(camera))},
          {"pixelAspectRatio", {std::abs(camera.projection.fy / camera.projection.fx)}},
          {"screenWindowCenter",
           {(camera.width / 2.0 - cx) / camera.projection.fx,
            (cy - camera.height / 2.0) / camera.projection.fy}},
          {"screenWindowWidth", {camera.width / std::abs(camera.projection.fx)}}};
}

/// Puts them into a header, in binary32. Values that a header cannot hold (a mirrored screen
/// window, a matrix beyond binary32) are left out or neutral.
void set_numbers(Imf::Header& header, const ExrNumbers& numbers) {
  set_window(header, numbers);
  for (const char* name : matrix_names) {
    const auto* values = numbers_named(numbers, name, 16);
    if (!values || !std::ranges::all_of(*values, fits_binary32)) continue;
    Imath::M44f matrix;
    for (int k = 0; k < 16; ++k)
      matrix[k / 4][k % 4] = static_cast<float>((*values)[static_cast<std::size_t>(k)]);
    header.insert(name, Imf::M44fAttribute(matrix));
  }
}

/// Reads them back.
ExrNumbers get_numbers(const Imf::Header& header) {
  ExrNumbers numbers;
  numbers["pixelAspectRatio"] = {header.pixelAspectRatio()};
  numbers["screenWindowCenter"] = {header.screenWindowCenter().x, header.screenWindowCenter().y};
  numbers["screenWindowWidth"] = {header.screenWindowWidth()};
  for (const char* name : matrix_names) {
    const auto* attribute = header.findTypedAttribute<Imf::M44fAttribute>(name);
    if (!attribute) continue;
    std::vector<double>& values = numbers[name];
    for (int k = 0; k < 16; ++k) values.push_back(attribute->value()[k / 4][k % 4]);
  }
  return numbers;
}

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

int reserve_exr_threads(int threads) {
  static std::mutex growing;
  const std::lock_guard lock(growing);
  const int wanted =
      threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  // One by one: if the system starts no more threads, OpenEXR's pool keeps its threads. A single
  // call for all of them would leave threads running on a destroyed pool.
  try {
    for (int n = Imf::globalThreadCount(); n < wanted; ++n) Imf::setGlobalThreadCount(n + 1);
  } catch (const std::system_error&) {
    return std::min(wanted, Imf::globalThreadCount());
  }
  return wanted;
}

std::string exr_reason(const std::exception& failure) {
  std::string reason = failure.what();
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  while (!reason.empty() && (reason.back() == ' ' || reason.back() == '.')) reason.pop_back();
  return reason;
}

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
