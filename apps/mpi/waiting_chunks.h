#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "fathom/files/file_bytes.h"
#include "fathom/files/spill_file.h"

namespace fathom::app {

/// Chunks of a file that wait for their turn to be written: in memory, or in a file of their own where
/// they would take more of it than they may.
class WaitingChunks {
 public:
  explicit WaitingChunks(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}
  /// Fails    OutputError where there is no room in a file.
  void add(files::Bytes chunk);
  /// The first one of those that have not been taken.
  /// Fails    InputError where the file cannot be read any more.
  [[nodiscard]] files::Bytes take();
  [[nodiscard]] std::size_t count() const { return chunks_.size(); }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  struct Chunk {
    files::Bytes bytes;
    /// In the file, where they are not here.
    std::uint64_t offset = 0, size = 0;
  };
  std::uint64_t most_bytes_, bytes_ = 0;
  std::vector<Chunk> chunks_;
  std::size_t next_ = 0;
  std::optional<files::SpillFile> file_;
};

}  // namespace fathom::app
