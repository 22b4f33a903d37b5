#include "fathom/files/mapped_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>
#include <mutex>
#include <utility>

#include "fathom/text/printable.h"

namespace fathom::files {

/// Where a file is mapped. Kept in a list that a signal handler can walk: nodes are never freed,
/// their names have a fixed place. `begin` is written last and cleared first.
struct MappedRange {
  std::atomic<const char*> begin{nullptr};
  std::atomic<std::size_t> size{0};
  std::array<char, 4096> name{};
  MappedRange* next = nullptr;
};

namespace {

// A signal handler has no other way to know.
std::atomic<MappedRange*> first_range{nullptr};
std::mutex noting;

MappedRange* note_range(const void* begin, std::size_t size, const std::string& name) {
  const std::lock_guard lock(noting);
  MappedRange* range = first_range.load();
  while (range != nullptr && range->begin.load() != nullptr) range = range->next;
  const bool fresh = range == nullptr;
  if (fresh) range = new MappedRange;
  const std::string shown = text::printable(name).substr(0, range->name.size() - 1);
  std::memcpy(range->name.data(), shown.c_str(), shown.size() + 1);
  range->size.store(size);
  range->begin.store(static_cast<const char*>(begin));
  if (fresh) {
    range->next = first_range.load();
    first_range.store(range);
  }
  return range;
}

}  // namespace

MappedFile::MappedFile(int descriptor, std::uint64_t offset, std::size_t size,
                       const std::string& name) {
  const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  const std::uint64_t before = offset % page;
  const std::size_t length = static_cast<std::size_t>(before) + size;
  void* const mapping = ::mmap(nullptr, length, PROT_READ, MAP_PRIVATE, descriptor,
                               static_cast<off_t>(offset - before));
  if (mapping == MAP_FAILED) return;
  mapping_ = mapping;
  mapped_ = length;
  data_ = static_cast<const std::byte*>(mapping) + before;
  range_ = note_range(mapping, length, name);
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : mapping_(std::exchange(other.mapping_, nullptr)),
      mapped_(other.mapped_),
      data_(std::exchange(other.data_, nullptr)),
      range_(std::exchange(other.range_, nullptr)) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(mapping_, other.mapping_);
  std::swap(mapped_, other.mapped_);
  std::swap(data_, other.data_);
  std::swap(range_, other.range_);
  return *this;
}

MappedFile::~MappedFile() {
  if (range_ != nullptr) range_->begin.store(nullptr);
  if (mapping_ != nullptr) ::munmap(mapping_, mapped_);
}

const char* mapped_file_at(const void* address) noexcept {
  const char* const at = static_cast<const char*>(address);
  for (const MappedRange* range = first_range.load(); range != nullptr; range = range->next) {
    const char* const begin = range->begin.load();
    if (begin != nullptr && begin <= at && at < begin + range->size.load()) {
      return range->name.data();
    }
  }
  return nullptr;
}

}  // namespace fathom::files
