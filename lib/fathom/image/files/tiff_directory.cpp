#include "fathom/image/files/tiff_directory.h"

#include <algorithm>

#include "fathom/files/byte_order.h"

namespace fathom::image {
using namespace files;

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

}  // namespace fathom::image
