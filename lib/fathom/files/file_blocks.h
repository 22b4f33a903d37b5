#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>

#include "fathom/files/random_access_file.h"

namespace fathom::files {

/// Small pieces of a file, here and there, through blocks that stay in memory (4 MiB in all).
/// Slower than MappedFile; but a file that is cut short meanwhile is an error, not a signal.
///
/// Several threads may read at the same time.
class FileBlocks {
 public:
  /// The file must outlive this.
  explicit FileBlocks(const RandomAccessFile& file);

  /// Fills `bytes` from `offset` on.
  /// Fails    as RandomAccessFile::read().
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;

 private:
  static constexpr std::size_t block_size = 4096, block_count = 1024;

  struct Block {
    std::mutex mutex;
    /// Which block of the file `bytes` hold.
    std::uint64_t number = UINT64_MAX;
    std::array<std::byte, block_size> bytes;
  };

  void load(Block& block, std::uint64_t number) const;

  const RandomAccessFile& file_;
  /// Block n of the file has place n % block_count.
  std::unique_ptr<std::array<Block, block_count>> blocks_;
};

}  // namespace fathom::files
