#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>

#include <algorithm>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/image/exr_bands.h"
#include "fathom/image/files/exr_zip.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/files/openexr.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::image {
using namespace files;

namespace {

/// FLOAT or UINT, and where the values are. OpenEXR takes a non-const pointer but does not write
/// through it.
struct PixelSource {
  Imf::PixelType type;
  const char* values;
};

PixelSource source_of(const ImageChannel& channel, const std::string& name) {
  if (const auto* floats = std::get_if<Samples<float>>(&channel.values))
    return {Imf::FLOAT, reinterpret_cast<const char*>(floats->data())};
  if (const auto* ids = std::get_if<Samples<std::uint32_t>>(&channel.values))
    return {Imf::UINT, reinterpret_cast<const char*>(ids->data())};
  throw OutputError(name + ": EXR holds binary32 numbers and 32-bit identifiers, and channel '" +
                    channel.name + "' is stored otherwise");
}

bool is_zipped(Compression compression) {
  return compression == Compression::zip || compression == Compression::zips;
}

/// An EXR up to its table of chunks, whose entries are zeros, in which it ends.
Bytes header_bytes(const Imf::Header& header, const std::string& name) {
  ByteOutput stream(name);
  { const Imf::OutputFile file(stream, header, 0); }
  return stream.take();
}

/// The channels in the order of the file: sorted by name.
std::vector<ExrPlane> planes_of(const Imf::FrameBuffer& pixels) {
  std::vector<ExrPlane> planes;
  for (auto slice = pixels.begin(); slice != pixels.end(); ++slice)
    planes.push_back(reinterpret_cast<ExrPlane>(slice.slice().base));
  return planes;
}

/// The file's header, and where its pixels are.
struct Layout {
  Imf::Header header;
  Imf::FrameBuffer pixels;
};

Layout layout_of(const DepthMap& map, std::uint32_t height, Compression compression,
                 const std::string& name) {
  Layout layout{Imf::Header(static_cast<int>(map.width), static_cast<int>(height)), {}};
  layout.header.compression() = compression_of(compression);
  set_attributes(layout.header, map);
  for (const ImageChannel& channel : map.channels) {
    const PixelSource source = source_of(channel, name);
    if (layout.header.channels().findChannel(channel.name))
      throw OutputError(name + ": two channels of the name '" + channel.name + "'");
    layout.header.channels().insert(channel.name, Imf::Channel(source.type));
    layout.pixels.insert(channel.name, Imf::Slice(source.type, const_cast<char*>(source.values), 4,
                                                  std::size_t{4} * map.width));
  }
  return layout;
}

/// work(), and failures of OpenEXR's as ours.
template <class Work>
Bytes as_output_error(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    throw OutputError(name + ": cannot be written as EXR: " + exr_reason(failure));
  }
}

}  // namespace

double memory_to_encode_exr(Compression compression, std::uint32_t height, double bytes_of_map) {
  if (compression == Compression::none) return bytes_of_map;
  const double of_chunk = bytes_of_map * std::min(height, rows_of_a_chunk(compression)) / height;
  return is_zipped(compression) ? copies_of_zip_chunk * of_chunk : of_chunk;
}

Bytes encode_exr(const DepthMap& map, Compression compression, int threads,
                 const std::string& name) {
  require_size(MapFormat::exr, map.width, map.height, name);
  return as_output_error(name, [&] {
    const auto [header, pixels] = layout_of(map, map.height, compression, name);
    if (is_zipped(compression) && !map.channels.empty()) {
      Bytes file = header_bytes(header, name);
      append_zip_chunks(file, planes_of(pixels), map.width, map.height,
                        rows_of_a_chunk(compression), threads);
      return file;
    }
    ByteOutput stream(name);
    {
      Imf::OutputFile file(stream, header, reserve_exr_threads(threads));
      stream.table_of_chunks_ends_here();
      file.setFrameBuffer(pixels);
      file.writePixels(static_cast<int>(map.height));
    }
    const std::uint32_t rows = rows_of_a_chunk(compression);
    stream.require_chunks((map.height + rows - 1) / rows);
    return stream.take();
  });
}

// Reading.

namespace {

std::string in_words(const Imath::Box2i& box) {
  return "(" + std::to_string(box.min.x) + ", " + std::to_string(box.min.y) + ")–(" +
         std::to_string(box.max.x) + ", " + std::to_string(box.max.y) + ")";
}

/// `file_bytes` is the size of the file.
DepthMap read_part(Imf::InputPart& part, std::size_t file_bytes, const MapMemory& memory,
                   const std::string& name) {
  const Imf::Header& header = part.header();
  const Imath::Box2i window = header.dataWindow();
  if (window != header.displayWindow())
    throw InputError(name + ": cropped and overscanned maps are not read: the data window " +
                     in_words(window) + " is not the display window " +
                     in_words(header.displayWindow()));
  DepthMap map;
  map.width = static_cast<std::uint32_t>(window.max.x - window.min.x + 1);
  map.height = static_cast<std::uint32_t>(window.max.y - window.min.y + 1);
  const auto& channels = header.channels();
  std::uint64_t bytes_per_pixel = 0;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) bytes_per_pixel += 4;
  require_map_memory(map.width, map.height, bytes_per_pixel, file_bytes, memory, name);
  const std::size_t pixels = std::size_t{map.width} * map.height;
  Imf::FrameBuffer target;
  const auto add = [&](const char* channel, Imf::PixelType type, void* values) {
    target.insert(channel,
                  Imf::Slice::Make(type, values, window, sizeof(float), sizeof(float) * map.width));
  };
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    if (channel.channel().type == Imf::UINT) {
      Samples<std::uint32_t> values(pixels);
      add(channel.name(), Imf::UINT, values.data());
      map.channels.push_back({channel.name(), std::move(values)});
    } else {  // FLOAT unchanged, HALF widened
      Samples<float> values(pixels);
      add(channel.name(), Imf::FLOAT, values.data());
      map.channels.push_back({channel.name(), std::move(values)});
    }
  }
  part.setFrameBuffer(target);
  part.readPixels(window.min.y, window.max.y);
  get_attributes(header, map);
  return map;
}

}  // namespace

DepthMap decode_exr(ByteView bytes, const std::string& name, const MapMemory& memory) {
  std::vector<std::size_t> defused = check_exr_claims(bytes, name);
  try {
    ByteInput stream(bytes, name, std::move(defused));
    // Starting threads costs more than a small file does.
    const int threads = bytes.size() < (std::size_t{1} << 18) ? 0 : reserve_exr_threads(0);
    Imf::MultiPartInputFile file(stream, threads, false);
    Imf::InputPart part(file, 0);
    return read_part(part, bytes.size(), memory, name);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    throw InputError(name + ": corrupt or truncated EXR file: " + exr_reason(failure));
  }
}

}  // namespace fathom::image

namespace fathom {
using namespace image;

std::optional<std::uint32_t> rows_of_exr_chunk(Compression compression) {
  if (!is_zipped(compression)) return std::nullopt;
  return rows_of_a_chunk(compression);
}

files::Bytes exr_beginning(const DepthMap& band, std::uint32_t height, Compression compression,
                           const std::string& name) {
  const StandardArithmetic standard;
  require_size(MapFormat::exr, band.width, height, name);
  return as_output_error(
      name, [&] { return header_bytes(layout_of(band, height, compression, name).header, name); });
}

std::vector<files::Bytes> exr_chunks(const DepthMap& band, Compression compression, int threads,
                                     const std::string& name) {
  const StandardArithmetic standard;
  Imf::FrameBuffer pixels;  // sorts channels as the file does
  for (const ImageChannel& channel : band.channels) {
    const PixelSource source = source_of(channel, name);
    pixels.insert(channel.name, Imf::Slice(source.type, const_cast<char*>(source.values)));
  }
  return zip_chunks(planes_of(pixels), band.width, band.height, rows_of_a_chunk(compression),
                    threads);
}

}  // namespace fathom
