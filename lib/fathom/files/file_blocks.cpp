#include "fathom/files/file_blocks.h"

#include <algorithm>
#include <cstring>

namespace fathom::files {

FileBlocks::FileBlocks(const RandomAccessFile& file)
    : file_(file), blocks_(std::make_unique<std::array<Block, block_count>>()) {}

void FileBlocks::load(Block& block, std::uint64_t number) const {
  block.number = UINT64_MAX;  // as long as it is not whole
  const std::uint64_t begin = number * block_size;
  const std::uint64_t there = file_.size() > begin ? file_.size() - begin : 0;
  const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(there, block_size));
  file_.read(begin, std::span(block.bytes).first(size));
  block.number = number;
}

void FileBlocks::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  if (offset > file_.size() || bytes.size() > file_.size() - offset) {
    file_.read(offset, bytes);  // fails, and says where the file ends
    return;
  }
  while (!bytes.empty()) {
    const std::uint64_t number = offset / block_size;
    const auto within = static_cast<std::size_t>(offset % block_size);
    const std::size_t size = std::min(bytes.size(), block_size - within);
    Block& block = (*blocks_)[number % block_count];
    {
      const std::lock_guard lock(block.mutex);
      if (block.number != number) load(block, number);
      std::memcpy(bytes.data(), block.bytes.data() + within, size);
    }
    bytes = bytes.subspan(size);
    offset += size;
  }
}

}  // namespace fathom::files
