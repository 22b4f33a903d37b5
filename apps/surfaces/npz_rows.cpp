#include "apps/surfaces/npz_rows.h"

#include <libdeflate.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "apps/shell/standard_streams.h"
#include "fathom/image/files/npy_array.h"

/// [ZIP] with the extra fields of ZIP64. All numbers are little endian.
namespace fathom::app {
namespace {

using files::put_number;

constexpr std::uint32_t local_magic = 0x04034b50, entry_magic = 0x02014b50, end_magic = 0x06054b50,
                        end64_magic = 0x06064b50, locator_magic = 0x07064b50;
constexpr std::uint32_t in_extra_field = 0xFFFFFFFF;
constexpr std::uint16_t version = 45, utf8_names = 0x800, no_date = 0x21;

std::string file_of(const NpzRows::Array& array) {
  return array.name + ".npy";
}

files::Bytes array_header(const NpzRows::Array& array) {
  std::string shape;
  for (const std::uint64_t extent : array.shape) shape += std::to_string(extent) + ", ";
  return image::npy_header(array.type, shape);
}

/// What a local header and an entry of the directory have in common, up to the size of the extra
/// fields.
void put_facts(files::Bytes& bytes, std::uint32_t crc, const std::string& file,
               std::uint16_t extra_bytes) {
  put_number(bytes, version);
  put_number(bytes, utf8_names);
  put_number<std::uint16_t>(bytes, 0);  // stored
  put_number<std::uint16_t>(bytes, 0);  // midnight
  put_number(bytes, no_date);
  put_number(bytes, crc);
  put_number(bytes, in_extra_field);
  put_number(bytes, in_extra_field);
  put_number(bytes, static_cast<std::uint16_t>(file.size()));
  put_number(bytes, extra_bytes);
}

void put_zip64(files::Bytes& bytes, const std::vector<std::uint64_t>& numbers) {
  put_number<std::uint16_t>(bytes, 1);
  put_number(bytes, static_cast<std::uint16_t>(8 * numbers.size()));
  for (const std::uint64_t number : numbers) put_number(bytes, number);
}

files::Bytes local_header(const std::string& file, std::uint32_t crc, std::uint64_t size) {
  files::Bytes bytes;
  put_number(bytes, local_magic);
  put_facts(bytes, crc, file, 20);
  files::append(bytes, file);
  put_zip64(bytes, {size, size});
  return bytes;
}

}  // namespace

NpzRows::NpzRows(int descriptor, std::string target, std::vector<Array> arrays)
    : descriptor_(descriptor), target_(std::move(target)) {
  for (Array& array : arrays) {
    std::uint64_t values = array.element_bytes;
    for (const std::uint64_t extent : array.shape) values *= extent;
    const files::Bytes header = array_header(array);
    Place& place = places_.emplace_back();
    place.array = std::move(array);
    place.header_at = end_;
    place.content_at = end_ + local_header(file_of(place.array), 0, 0).size();
    place.size = header.size() + values;
    end_ = place.content_at + place.size;
    append(places_.size() - 1, header);
  }
}

void NpzRows::append(std::size_t array, files::ByteView bytes) {
  Place& place = places_[array];
  write_at(place.content_at + place.written, bytes);
  place.written += bytes.size();
  place.crc = libdeflate_crc32(place.crc, bytes.data(), bytes.size());
}

void NpzRows::finish() {
  files::Bytes directory;
  for (const Place& place : places_) {
    const std::string file = file_of(place.array);
    write_at(place.header_at, local_header(file, place.crc, place.size));
    put_number(directory, entry_magic);
    put_number(directory, version);
    put_facts(directory, place.crc, file, 28);
    // No comment, first disk, no attributes.
    for (int k = 0; k < 5; ++k) put_number<std::uint16_t>(directory, 0);
    put_number(directory, in_extra_field);
    files::append(directory, file);
    put_zip64(directory, {place.size, place.size, place.header_at});
  }
  const std::uint64_t size = directory.size(), count = places_.size();
  put_number(directory, end64_magic);
  put_number<std::uint64_t>(directory, 44);  // the bytes that follow in this record
  put_number(directory, version);
  put_number(directory, version);
  put_number<std::uint64_t>(directory, 0);  // this disk, and the disk of the directory
  put_number(directory, count);
  put_number(directory, count);
  put_number(directory, size);
  put_number(directory, end_);
  put_number(directory, locator_magic);
  put_number<std::uint32_t>(directory, 0);
  put_number(directory, end_ + size);
  put_number<std::uint32_t>(directory, 1);  // disks
  put_number(directory, end_magic);
  put_number<std::uint32_t>(directory, 0);
  put_number<std::uint32_t>(directory, in_extra_field);  // two counts
  put_number(directory, in_extra_field);
  put_number(directory, in_extra_field);
  put_number<std::uint16_t>(directory, 0);  // no comment
  write_at(end_, directory);
}

void NpzRows::write_at(std::uint64_t at, files::ByteView bytes) const {
  while (!bytes.empty()) {
    const ssize_t written =
        ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_with_errno(target_, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    at += static_cast<std::uint64_t>(written);
  }
}

}  // namespace fathom::app
