#include <charconv>
#include <cmath>
#include <string_view>

#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/text/decimal.h"

/// PFM ([Netpbm]): "Pf" or "PF", width, height and scale, one white space after each, then binary32
/// rows from the bottom up. A negative scale means little endian. The scale's magnitude is a unit
/// that most readers ignore: it is not applied, so that the values keep their bits; if it is not 1,
/// it is kept as the text `pfm.scale`.
namespace fathom::image {
using namespace files;
using namespace text;

namespace {

class Header {
 public:
  Header(ByteView bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  std::string_view word() {
    while (position_ < bytes_.size() && is_space(bytes_[position_])) ++position_;
    const std::size_t begin = position_;
    while (position_ < bytes_.size() && !is_space(bytes_[position_])) {
      if (++position_ - begin > 64) fail("a header of magic, width, height and scale");
    }
    if (position_ == bytes_.size()) fail("a header of magic, width, height and scale");
    return {reinterpret_cast<const char*>(bytes_.data()) + begin, position_ - begin};
  }

  template <class T>
  T number(const char* expected) {
    const std::string_view text = word();
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) fail(expected);
    return value;
  }

  [[noreturn]] void fail(const std::string& expected) const {
    throw InputError(name_ + ": not a usable PFM file: expected " + expected);
  }

  /// What follows the single white space after the last word.
  [[nodiscard]] ByteView rest() const { return bytes_.subspan(position_ + 1); }

 private:
  static bool is_space(std::byte b) {
    const char c = static_cast<char>(b);
    return c == ' ' || c == '\n' || c == '\r' || c == '\t';
  }

  ByteView bytes_;
  const std::string& name_;
  std::size_t position_ = 0;
};

}  // namespace

Bytes encode_pfm(const DepthMap& map, const ImageChannel& channel, const std::string& name) {
  const auto* values = std::get_if<Samples<float>>(&channel.values);
  if (!values)
    throw OutputError(name + ": PFM holds binary32 numbers, and channel '" + channel.name +
                      "' is stored otherwise");
  Bytes bytes;
  append(bytes, "Pf\n" + std::to_string(map.width) + " " + std::to_string(map.height) + "\n-1.0\n");
  std::size_t position = bytes.size();
  bytes.resize(position + values->size() * sizeof(float));
  for (std::size_t row = map.height; row-- > 0;)
    for (std::size_t x = 0; x < map.width; ++x, position += sizeof(float))
      store(&bytes[position], (*values)[row * map.width + x], std::endian::little);
  return bytes;
}

DepthMap decode_pfm(ByteView bytes, const std::string& name) {
  Header header(bytes, name);
  const std::string_view magic = header.word();
  if (magic != "Pf" && magic != "PF") header.fail("the magic word Pf or PF");
  const std::size_t channels = magic == "PF" ? 3 : 1;
  DepthMap map;
  map.width = header.number<std::uint32_t>("a width from 1 to 4294967295");
  map.height = header.number<std::uint32_t>("a height from 1 to 4294967295");
  if (map.width == 0 || map.height == 0) header.fail("a width and height of at least 1");
  const auto scale = header.number<double>("a scale that is a number");
  if (!std::isfinite(scale) || scale == 0) header.fail("a finite scale that is not 0");

  const ByteView data = header.rest();
  const std::uint64_t pixels = std::uint64_t{map.width} * map.height;
  const std::size_t pixel_bytes = channels * sizeof(float);
  require_raw_pixels(data, map.width, map.height, pixel_bytes, "PFM file", name);
  const std::endian order = scale < 0 ? std::endian::little : std::endian::big;
  for (std::size_t c = 0; c < channels; ++c) {
    Samples<float> values(pixels);
    for (std::size_t y = 0; y < map.height; ++y)
      for (std::size_t x = 0; x < map.width; ++x) {
        const std::size_t source = (map.height - 1 - y) * map.width + x;
        values[y * map.width + x] = load<float>(&data[source * pixel_bytes + 4 * c], order);
      }
    map.channels.push_back({channels == 1 ? "Z" : std::string(1, "RGB"[c]), std::move(values)});
  }
  if (std::abs(scale) != 1) map.texts["pfm.scale"] = shortest_decimal(std::abs(scale));
  return map;
}

}  // namespace fathom::image
