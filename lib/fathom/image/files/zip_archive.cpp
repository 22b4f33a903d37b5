#include "fathom/image/files/zip_archive.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>
#include <optional>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/image/files/map_codecs.h"

/// [ZIP]: for each file a local header, its name and its bytes; then the directory, which repeats
/// the local headers and adds their offsets; last, the offset of the directory. All numbers are
/// little endian.
namespace fathom::image {
using namespace files;

namespace {

constexpr std::uint32_t local_magic = 0x04034b50, entry_magic = 0x02014b50, end_magic = 0x06054b50;
constexpr std::size_t local_size = 30, entry_size = 46, end_size = 22;
/// The first of January 1980, where the calendar of the format begins: no clock gets into a map.
constexpr std::uint16_t no_date = 0x21;
constexpr std::uint16_t stored_method = 0, deflate_method = 8;
constexpr std::uint32_t beyond = 0xFFFFFFFF;

std::uint16_t two(ByteView bytes, std::size_t at) {
  return load<std::uint16_t>(&bytes[at], std::endian::little);
}
std::uint32_t four(ByteView bytes, std::size_t at) {
  return load<std::uint32_t>(&bytes[at], std::endian::little);
}

std::uint32_t checksum(ByteView bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// From the version that can unpack it on, what local headers and the directory have in common.
void put_facts(Bytes& bytes, std::uint32_t crc, std::uint32_t size, std::uint16_t name_size) {
  put_number<std::uint16_t>(bytes, 20);
  put_number<std::uint16_t>(bytes, 0x800);  // names are UTF-8
  put_number(bytes, stored_method);
  put_number<std::uint16_t>(bytes, 0);  // midnight
  put_number(bytes, no_date);
  put_number(bytes, crc);
  put_number(bytes, size);
  put_number(bytes, size);
  put_number(bytes, name_size);
  put_number<std::uint16_t>(bytes, 0);  // no extra fields
}

/// A reader of the directory.
class Directory {
 public:
  Directory(ByteView bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  std::vector<ZipEntry> read() {
    const std::size_t end = find_end();
    const std::size_t count = two(bytes_, end + 10);
    const std::uint32_t size = four(bytes_, end + 12), begin = four(bytes_, end + 16);
    if (two(bytes_, end + 4) != 0 || two(bytes_, end + 6) != 0 || two(bytes_, end + 8) != count)
      fail("it is one of several parts");
    if (begin == beyond || size == beyond || count == 0xFFFF) fail_as_zip64();
    if (begin > end || size > end - begin) fail("its directory is longer than the file");
    std::vector<ZipEntry> entries;
    ByteView rest = bytes_.subspan(begin, size);
    // The bytes of no two files overlap where all together are no more than there are before the
    // directory: a small archive cannot stand for a large one.
    std::size_t left = begin;
    for (std::size_t k = 0; k < count; ++k) {
      entries.push_back(read_entry(rest, begin));
      const std::size_t taken = local_size + entries.back().stored.size();
      if (taken > left) fail("its files overlap");
      left -= taken;
    }
    return entries;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(name_ + ": corrupt or truncated ZIP archive: " + what);
  }
  [[noreturn]] void fail_as_zip64() const {
    throw InputError(name_ + ": ZIP archives from 4 GiB on (ZIP64) are not read");
  }

  /// It ends the file, except for a comment of at most 65535 bytes.
  [[nodiscard]] std::size_t find_end() const {
    if (bytes_.size() < end_size) fail("expected a directory");
    const std::size_t last = bytes_.size() - end_size;
    for (std::size_t comment = 0; comment <= std::min<std::size_t>(last, 0xFFFF); ++comment) {
      const std::size_t at = last - comment;
      if (four(bytes_, at) == end_magic && two(bytes_, at + 20) == comment) return at;
    }
    fail("expected a directory at its end");
  }

  /// Takes an entry off `rest`; files lie before `limit`, where the directory begins.
  [[nodiscard]] ZipEntry read_entry(ByteView& rest, std::size_t limit) const {
    if (rest.size() < entry_size || four(rest, 0) != entry_magic) fail("its directory ends early");
    const std::size_t name_size = two(rest, 28), extra = two(rest, 30), comment = two(rest, 32);
    const std::size_t whole = entry_size + name_size + extra + comment;
    if (whole > rest.size()) fail("its directory ends early");
    ZipEntry entry;
    entry.name.assign(reinterpret_cast<const char*>(rest.data()) + entry_size, name_size);
    const std::uint16_t flags = two(rest, 8), method = two(rest, 10);
    entry.crc = four(rest, 16);
    const std::uint32_t packed = four(rest, 20), size = four(rest, 24), at = four(rest, 42);
    if (packed == beyond || size == beyond || at == beyond) fail_as_zip64();
    if ((flags & 1) != 0) throw InputError(name_ + ": encrypted ZIP archives are not read");
    if (method != stored_method && method != deflate_method)
      throw InputError(name_ + ": a ZIP archive compressed by method " + std::to_string(method) +
                       ": expected none or DEFLATE");
    entry.deflated = method == deflate_method;
    entry.size = size;
    entry.stored = bytes_of(at, packed, limit);
    if (!entry.deflated && size != packed) fail("a file in it has two sizes");
    if (size > std::uint64_t{packed} * greatest_deflate_ratio)
      fail("a file in it claims " + std::to_string(size) + " bytes, more than " +
           std::to_string(packed) + " bytes can hold");
    rest = rest.subspan(whole);
    return entry;
  }

  /// What follows the local header at `at`.
  [[nodiscard]] ByteView bytes_of(std::size_t at, std::size_t size, std::size_t limit) const {
    if (at > limit || limit - at < local_size || four(bytes_, at) != local_magic)
      fail("a file in it is not at the place in its directory");
    const std::size_t before =
        local_size + two(bytes_, at + 26) + std::size_t{two(bytes_, at + 28)};
    if (before > limit - at || size > limit - at - before)
      fail("a file in it is longer than the archive");
    return bytes_.subspan(at + before, size);
  }

  ByteView bytes_;
  const std::string& name_;
};

/// A stream of zlib's that ends with this object.
struct Inflating {
  z_stream stream{};
  Inflating() {
    // Negative: without zlib's own header.
    if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
  }
  Inflating(const Inflating&) = delete;
  Inflating& operator=(const Inflating&) = delete;
  ~Inflating() { inflateEnd(&stream); }
};

/// False unless `packed` is exactly as many bytes as `room` has.
bool inflate_into(Bytes& room, ByteView packed) {
  Inflating inflating;
  z_stream& stream = inflating.stream;
  // Sizes in the archive are 32 bits, as zlib's counts are.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(room.data());
  stream.avail_out = static_cast<uInt>(room.size());
  const int result = inflate(&stream, Z_FINISH);
  if (result == Z_MEM_ERROR) throw std::bad_alloc();
  return result == Z_STREAM_END && stream.avail_out == 0;
}

}  // namespace

void ZipWriter::require_space(std::size_t more) const {
  const std::uint64_t whole = std::uint64_t{bytes_.size()} + directory_.size() + end_size + more;
  if (whole >= beyond)
    throw OutputError(name_ + ": " + std::string(description_of(MapFormat::npz).limit));
  if (files_ >= 0xFFFE) throw OutputError(name_ + ": an NPZ holds at most 65534 arrays");
}

void ZipWriter::add(const std::string& file, ByteView content) {
  if (file.size() > 0xFFFF)
    throw OutputError(name_ + ": the name of a channel is too long for NPZ");
  require_space(local_size + entry_size + 2 * file.size() + content.size());
  const auto at = static_cast<std::uint32_t>(bytes_.size());
  const std::uint32_t crc = checksum(content);
  const auto size = static_cast<std::uint32_t>(content.size());
  const auto name_size = static_cast<std::uint16_t>(file.size());
  put_number(bytes_, local_magic);
  put_facts(bytes_, crc, size, name_size);
  append(bytes_, file);
  append(bytes_, content);
  put_number(directory_, entry_magic);
  put_number<std::uint16_t>(directory_, 20);  // made by version 2.0
  put_facts(directory_, crc, size, name_size);
  // No comment, first disk, no attributes.
  for (int k = 0; k < 5; ++k) put_number<std::uint16_t>(directory_, 0);
  put_number(directory_, at);
  append(directory_, file);
  ++files_;
}

Bytes ZipWriter::take() {
  const auto begin = static_cast<std::uint32_t>(bytes_.size());
  const auto count = static_cast<std::uint16_t>(files_);
  append(bytes_, directory_);
  put_number(bytes_, end_magic);
  put_number<std::uint32_t>(bytes_, 0);  // the number of this disk, and of the directory's disk
  put_number(bytes_, count);
  put_number(bytes_, count);
  put_number(bytes_, static_cast<std::uint32_t>(directory_.size()));
  put_number(bytes_, begin);
  put_number<std::uint16_t>(bytes_, 0);  // no comment
  return std::move(bytes_);
}

std::vector<ZipEntry> read_zip_directory(ByteView bytes, const std::string& name) {
  return Directory(bytes, name).read();
}

ByteView unpack(const ZipEntry& entry, Bytes& room, const std::string& name) {
  ByteView content = entry.stored;
  if (entry.deflated) {
    room.assign(entry.size, std::byte{0});
    if (!inflate_into(room, entry.stored))
      throw InputError(name + ": corrupt ZIP archive: it cannot be unpacked to the size it claims");
    content = room;
  }
  if (checksum(content) != entry.crc)
    throw InputError(name + ": corrupt ZIP archive: its checksum differs");
  return content;
}

}  // namespace fathom::image
