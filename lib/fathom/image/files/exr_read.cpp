#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>

#include "fathom/failures/errors.h"
#include "fathom/image/files/exr_attributes.h"
#include "fathom/image/files/exr_streams.h"
#include "fathom/image/files/map_codecs.h"

namespace fathom::image {
using namespace files;

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
    } else {  // FLOAT as it is, HALF widened
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
