#include <algorithm>
#include <charconv>
#include <string_view>

#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/files/npy_array.h"
#include "fathom/numeric/rounding.h"
#include "fathom/text/counted.h"

/// NPY ([Ker07]): "\x93NUMPY", version, length of the header, a Python dictionary of descr,
/// fortran_order and shape, then the values. A channel has the shape (height, width); channels that
/// are the parts of one (N.X, N.Y, N.Z) have (height, width, parts).
namespace fathom::image {
using namespace files;
using namespace text;

namespace {

/// A reader of the few Python literals that an NPY header may consist of.
class Literals {
 public:
  Literals(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  bool accept(char c) {
    skip_space();
    if (position_ == text_.size() || text_[position_] != c) return false;
    ++position_;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) fail(std::string("'") + c + "' in its header");
  }
  std::string_view string() {
    skip_space();
    const char quote = position_ < text_.size() ? text_[position_] : '\0';
    const std::size_t end =
        quote == '\'' || quote == '"' ? text_.find(quote, position_ + 1) : std::string_view::npos;
    if (end == std::string_view::npos) fail("a quoted word in its header");
    const std::string_view value = text_.substr(position_ + 1, end - position_ - 1);
    position_ = end + 1;
    return value;
  }
  bool boolean() {
    skip_space();
    for (const std::string_view word : {"True", "False"})
      if (text_.substr(position_, word.size()) == word) {
        position_ += word.size();
        return word == "True";
      }
    fail("True or False for fortran_order");
  }
  std::uint32_t size() {
    skip_space();
    std::uint32_t value = 0;
    const char* begin = text_.data() + position_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error != std::errc() || value == 0) fail("a shape of sizes from 1 to 4294967295");
    position_ += static_cast<std::size_t>(end - begin);
    return value;
  }
  void expect_end() {
    skip_space();
    if (position_ != text_.size()) fail("nothing after the dictionary of its header");
  }

  [[noreturn]] void fail(const std::string& expected) const {
    throw InputError(name_ + ": not a usable NPY file: expected " + expected);
  }

 private:
  void skip_space() {
    while (position_ < text_.size() && (text_[position_] == ' ' || text_[position_] == '\n'))
      ++position_;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t position_ = 0;
};

/// The contents of a header. The shape of an image has at most this many sizes.
struct Array {
  std::string type;
  bool fortran_order = false;
  std::vector<std::uint32_t> shape;

  [[nodiscard]] std::size_t height() const { return shape[0]; }
  [[nodiscard]] std::size_t width() const { return shape[1]; }
  [[nodiscard]] std::size_t parts() const { return shape.size() > 2 ? shape[2] : 1; }
};

/// Pixels have no more parts than colours with opacity.
constexpr std::uint32_t most_parts = 4;

std::vector<std::uint32_t> parse_shape(Literals& literals) {
  std::vector<std::uint32_t> shape;
  literals.expect('(');
  while (!literals.accept(')')) {
    if (shape.size() == 32) literals.fail("a shape of at most 32 sizes");
    shape.push_back(literals.size());
    if (literals.accept(',')) continue;
    literals.expect(')');
    break;
  }
  return shape;
}

Array parse_header(std::string_view text, const std::string& name) {
  Literals literals(text, name);
  Array array;
  bool has_type = false, has_order = false, has_shape = false;
  literals.expect('{');
  while (!literals.accept('}')) {
    const std::string_view key = literals.string();
    literals.expect(':');
    if (key == "descr" && !has_type) {
      has_type = true;
      array.type = literals.string();
    } else if (key == "fortran_order" && !has_order) {
      has_order = true;
      array.fortran_order = literals.boolean();
    } else if (key == "shape" && !has_shape) {
      has_shape = true;
      array.shape = parse_shape(literals);
    } else {
      literals.fail("descr, fortran_order and shape in its header, once each");
    }
    if (!literals.accept(',')) {
      literals.expect('}');
      break;
    }
  }
  literals.expect_end();
  if (!has_type || !has_order || !has_shape)
    literals.fail("descr, fortran_order and shape in its header");
  return array;
}

/// A parsed file: the contents of its header, and the values.
struct Parts {
  Array array;
  ByteView data;
};

Parts take_apart(ByteView bytes, const std::string& name) {
  const auto fail = [&](const char* expected) -> void {
    throw InputError(name + ": not a usable NPY file: expected " + expected);
  };
  if (bytes.size() < 12) fail("a header");
  const auto version = static_cast<unsigned>(bytes[6]);
  if (version < 1 || version > 3) fail("version 1, 2 or 3");
  const std::size_t preamble = version == 1 ? 10 : 12;
  const std::size_t length = version == 1 ? load<std::uint16_t>(&bytes[8], std::endian::little)
                                          : load<std::uint32_t>(&bytes[8], std::endian::little);
  if (length > bytes.size() - preamble) fail("a header of the declared length");
  return {parse_header({reinterpret_cast<const char*>(bytes.data()) + preamble, length}, name),
          bytes.subspan(preamble + length)};
}

/// Of one part of every pixel.
template <class Stored, class Value, class Widen>
Samples<Value> values_of(const Array& array, std::size_t part, ByteView data, std::endian order,
                         Widen widen) {
  const std::size_t width = array.width(), height = array.height(), parts = array.parts();
  Samples<Value> values(width * height);
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t source =
          array.fortran_order ? (part * width + x) * height + y : (y * width + x) * parts + part;
      values[y * width + x] = widen(load<Stored>(&data[source * sizeof(Stored)], order));
    }
  return values;
}

/// The type of the values: "<f4" is of kind "f4" and little endian; kind "" is not a type of maps.
struct ValueType {
  std::string_view kind;
  std::endian order;
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(kind[1] - '0'); }
};

ValueType value_type_of(const Array& array) {
  const std::string_view type = array.type;
  const std::endian order = type.starts_with('>') ? std::endian::big : std::endian::little;
  const bool has_order = type.starts_with('<') || type.starts_with('>') || type == "|u1";
  const std::string_view kind = has_order ? type.substr(1) : "";
  for (const std::string_view known : {"f2", "f4", "f8", "u1", "u2", "u4"})
    if (kind == known) return {known, order};
  return {"", order};
}

decltype(ImageChannel::values) part_of_array(const Array& array, const ValueType& type,
                                             std::size_t part, ByteView data) {
  const auto same = [](auto value) { return value; };
  const auto [kind, order] = type;
  if (kind == "f2")
    return values_of<std::uint16_t, float>(array, part, data, order, widen_binary16);
  if (kind == "f4") return values_of<float, float>(array, part, data, order, same);
  if (kind == "f8") return values_of<double, double>(array, part, data, order, same);
  if (kind == "u4") return values_of<std::uint32_t, std::uint32_t>(array, part, data, order, same);
  if (kind == "u2") return values_of<std::uint16_t, std::uint16_t>(array, part, data, order, same);
  return values_of<unsigned char, std::uint16_t>(array, part, data, order, same);
}

/// N.X, N.Y and N.Z if `name` is a channel with so many parts; else name.0, name.1, ….
std::vector<std::string> names_of_parts(const std::string& name, std::size_t parts) {
  if (parts == 1) return {name};
  if (const auto channel = channel_named(name)) {
    std::vector<std::string> names = part_names(*channel);
    if (names.size() == parts) return names;
  }
  std::vector<std::string> names;
  for (std::size_t k = 0; k < parts; ++k) names.push_back(name + "." + std::to_string(k));
  return names;
}

void require_image(const Array& array, const std::string& name) {
  const auto fail = [&](const std::string& what) {
    throw InputError(name +
                     ": not a usable NPY file: expected two dimensions, height and width, and as a "
                     "third at most 4 parts of a pixel, found " +
                     what);
  };
  if (array.shape.size() < 2) fail(array.shape.empty() ? "none" : "one");
  if (array.shape.size() > 3) fail("more");
  if (array.parts() > most_parts) fail(std::to_string(array.parts()) + " parts");
}

constexpr const char* type_name(float) {
  return "<f4";
}
constexpr const char* type_name(double) {
  return "<f8";
}
constexpr const char* type_name(std::uint16_t) {
  return "<u2";
}
constexpr const char* type_name(std::uint32_t) {
  return "<u4";
}

std::vector<ImageChannel> channels_of_array(const Parts& file, const std::string& channel,
                                            const std::string& name) {
  const Array& array = file.array;
  require_image(array, name);
  const ValueType type = value_type_of(array);
  if (type.kind.empty())
    throw InputError(name + ": NPY type '" + array.type.substr(0, 40) +
                     "' is not one of a map: expected f2, f4, f8, u1, u2 or u4");
  const std::uint64_t pixels = std::uint64_t{array.width()} * array.height();
  const std::size_t pixel_bytes = type.size() * array.parts();
  if (file.data.size() / pixel_bytes != pixels || file.data.size() % pixel_bytes != 0)
    throw InputError(name + ": truncated or overlong NPY file: expected " +
                     std::to_string(array.height()) + "×" + std::to_string(array.width()) +
                     (array.parts() > 1 ? "×" + std::to_string(array.parts()) : "") +
                     " values of " + text::counted(type.size(), "byte") + ", found " +
                     text::counted(file.data.size(), "byte"));
  std::vector<ImageChannel> channels;
  std::size_t part = 0;
  for (const std::string& one : names_of_parts(channel, array.parts()))
    channels.push_back({one, part_of_array(array, type, part++, file.data)});
  return channels;
}

}  // namespace

Bytes npy_header(const std::string& type, const std::string& shape) {
  std::string header =
      "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }";
  constexpr std::size_t preamble = 10;
  header.append(63 - (preamble + header.size()) % 64, ' ');
  header += '\n';
  Bytes bytes;
  append(bytes, std::string("\x93NUMPY\x01\x00", 8));
  bytes.resize(preamble);
  store(&bytes[8], static_cast<std::uint16_t>(header.size()), std::endian::little);
  append(bytes, header);
  return bytes;
}

NpyHeader npy_header_of(ByteView bytes, const std::string& name) {
  const auto [array, data] = take_apart(bytes, name);
  return {array.type, array.fortran_order, array.shape, bytes.size() - data.size()};
}

bool is_image_array(ByteView bytes, const std::string& name) {
  const Array array = take_apart(bytes, name).array;
  return !value_type_of(array).kind.empty() && (array.shape.size() == 2 || array.shape.size() == 3);
}

std::string text_of_array(ByteView bytes, const std::string& name) {
  const auto [array, data] = take_apart(bytes, name);
  if (!array.type.starts_with("|S") || !array.shape.empty())
    throw InputError(name + ": not a usable NPY file: expected one text");
  std::string text(reinterpret_cast<const char*>(data.data()), data.size());
  while (!text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

std::vector<ImageChannel> channels_of_npy(ByteView bytes, const std::string& channel,
                                          ImageSize& size, const std::string& name) {
  const Parts file = take_apart(bytes, name);
  std::vector<ImageChannel> channels = channels_of_array(file, channel, name);
  size = {file.array.shape[1], file.array.shape[0]};
  return channels;
}

Bytes npy_of_text(const std::string& text) {
  Bytes bytes = npy_header("|S" + std::to_string(text.size()), "");
  append(bytes, text);
  return bytes;
}

Bytes npy_of_channels(const ImageSize& size, const std::vector<const ImageChannel*>& channels) {
  return std::visit(
      [&](const auto& first) {
        using Values = std::decay_t<decltype(first)>;
        using Value = typename Values::value_type;
        std::vector<const Values*> parts;
        parts.reserve(channels.size());
        for (const ImageChannel* channel : channels)
          parts.push_back(&std::get<Values>(channel->values));
        std::string shape = std::to_string(size.height) + ", " + std::to_string(size.width);
        if (parts.size() > 1) shape += ", " + std::to_string(parts.size());
        Bytes bytes = npy_header(type_name(Value{}), shape);
        std::size_t position = bytes.size();
        bytes.resize(position + first.size() * parts.size() * sizeof(Value));
        for (std::size_t k = 0; k < first.size(); ++k)
          for (const Values* values : parts) {
            store(&bytes[position], (*values)[k], std::endian::little);
            position += sizeof(Value);
          }
        return bytes;
      },
      channels.front()->values);
}

std::vector<const ImageChannel*> parts_of(const DepthMap& map, const std::string& name) {
  for (std::size_t parts = most_parts; parts >= 2; --parts) {
    std::vector<const ImageChannel*> found;
    for (const std::string& part : names_of_parts(name, parts))
      if (const ImageChannel* channel = map.find(part)) found.push_back(channel);
    const bool complete = found.size() == parts;
    if (complete && std::all_of(found.begin(), found.end(), [&](const ImageChannel* channel) {
          return channel->values.index() == found.front()->values.index();
        }))
      return found;
  }
  return {};
}

Bytes encode_npy(const DepthMap& map, const std::vector<const ImageChannel*>& channels,
                 const std::string&) {
  return npy_of_channels({map.width, map.height}, channels);
}

DepthMap decode_npy(ByteView bytes, const std::string& name) {
  const Parts file = take_apart(bytes, name);
  require_image(file.array, name);
  // The file does not name its channels.
  const bool identifiers = value_type_of(file.array).kind == "u4";
  const std::string channel = file.array.parts() > 1 ? "vector" : identifiers ? "id" : "Z";
  DepthMap map;
  map.channels = channels_of_array(file, channel, name);
  map.width = file.array.shape[1];
  map.height = file.array.shape[0];
  return map;
}

}  // namespace fathom::image
