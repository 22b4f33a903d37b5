#include <charconv>
#include <string_view>

#include "fathom/image/files/map_codecs.h"
#include "fathom/numeric/binary16.h"
#include "fathom/numeric/errors.h"
#include "fathom/text/byte_order.h"
#include "fathom/text/counted.h"

/// NPY ([Ker07]): "\x93NUMPY", version, length of the header, a Python dictionary of descr,
/// fortran_order and shape, then the values.
namespace fathom::image {
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
    if (error != std::errc() || value == 0) fail("a shape of two sizes from 1 to 4294967295");
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

struct Array {
  std::string type;
  bool fortran_order = false;
  std::uint32_t height = 0, width = 0;
};

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
      literals.expect('(');
      array.height = literals.size();
      if (!literals.accept(',') || literals.accept(')'))
        literals.fail("two dimensions, height and width, found one");
      array.width = literals.size();
      literals.accept(',');
      if (!literals.accept(')')) literals.fail("two dimensions, height and width, found more");
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

template <class Stored, class Value, class Widen>
Samples<Value> values_of(const Array& array, ByteView data, std::endian order, Widen widen) {
  Samples<Value> values(std::size_t{array.width} * array.height);
  for (std::size_t y = 0; y < array.height; ++y)
    for (std::size_t x = 0; x < array.width; ++x) {
      const std::size_t source = array.fortran_order ? x * array.height + y : y * array.width + x;
      values[y * array.width + x] = widen(load<Stored>(&data[source * sizeof(Stored)], order));
    }
  return values;
}

ImageChannel channel_of_array(const Array& array, ByteView data, const std::string& name) {
  const std::string_view type = array.type;
  const std::endian order = type.starts_with('>') ? std::endian::big : std::endian::little;
  const std::string_view kind =
      type.starts_with('<') || type.starts_with('>') || type == "|u1" ? type.substr(1) : "";
  const bool known =
      kind == "f2" || kind == "f4" || kind == "f8" || kind == "u1" || kind == "u2" || kind == "u4";
  if (!known)
    throw InputError(name + ": NPY type '" + array.type +
                     "' is not one of a map: expected f2, f4, f8, u1, u2 or u4");
  const std::size_t size = static_cast<std::size_t>(kind[1] - '0');
  const std::uint64_t pixels = std::uint64_t{array.width} * array.height;
  if (data.size() / size != pixels || data.size() % size != 0)
    throw InputError(name + ": truncated or overlong NPY file: expected " +
                     std::to_string(array.height) + "×" + std::to_string(array.width) +
                     " values of " + text::counted(size, "byte") + ", found " +
                     text::counted(data.size(), "byte"));
  const auto same = [](auto value) { return value; };
  if (kind == "f2")
    return {"Z", values_of<std::uint16_t, float>(array, data, order, widen_binary16)};
  if (kind == "f4") return {"Z", values_of<float, float>(array, data, order, same)};
  if (kind == "f8") return {"Z", values_of<double, double>(array, data, order, same)};
  if (kind == "u4")
    return {"id", values_of<std::uint32_t, std::uint32_t>(array, data, order, same)};
  if (kind == "u2") return {"Z", values_of<std::uint16_t, std::uint16_t>(array, data, order, same)};
  return {"Z", values_of<unsigned char, std::uint16_t>(array, data, order, same)};
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

}  // namespace

Bytes encode_npy(const DepthMap& map, const ImageChannel& channel, const std::string&) {
  return std::visit(
      [&](const auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        std::string header = std::string("{'descr': '") + type_name(Value{}) +
                             "', 'fortran_order': False, 'shape': (" + std::to_string(map.height) +
                             ", " + std::to_string(map.width) + "), }";
        // The values begin at a multiple of 64 bytes; the header's last byte is a newline.
        constexpr std::size_t preamble = 10;
        header.append(63 - (preamble + header.size()) % 64, ' ');
        header += '\n';
        Bytes bytes;
        append(bytes, std::string("\x93NUMPY\x01\x00", 8));
        bytes.resize(preamble);
        store(&bytes[8], static_cast<std::uint16_t>(header.size()), std::endian::little);
        append(bytes, header);
        std::size_t position = bytes.size();
        bytes.resize(position + values.size() * sizeof(Value));
        for (const Value value : values) {
          store(&bytes[position], value, std::endian::little);
          position += sizeof(Value);
        }
        return bytes;
      },
      channel.values);
}

DepthMap decode_npy(ByteView bytes, const std::string& name) {
  const auto fail = [&](const char* expected) -> void {
    throw InputError(name + ": not a usable NPY file: expected " + expected);
  };
  if (bytes.size() < 12) fail("a header");
  const auto version = static_cast<unsigned>(bytes[6]);
  if (version < 1 || version > 3) fail("version 1, 2 or 3");
  const std::size_t preamble = version == 1 ? 10 : 12;
  const std::size_t length = version == 1 ? load<std::uint16_t>(&bytes[8], std::endian::little)
                                          : load<std::uint32_t>(&bytes[8], std::endian::little);
  if (length > bytes.size() - preamble) fail("a header as long as it says");
  const Array array =
      parse_header({reinterpret_cast<const char*>(bytes.data()) + preamble, length}, name);
  DepthMap map;
  map.width = array.width;
  map.height = array.height;
  map.channels.push_back(channel_of_array(array, bytes.subspan(preamble + length), name));
  return map;
}

}  // namespace fathom::image
