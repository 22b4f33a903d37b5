#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "apps/mpi/ranks.h"
#include "fathom/files/file_bytes.h"
#include "fathom/files/spill_file.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/map_files.h"

namespace fathom::app {

/// Chunks of a file that wait for their turn to be written: in memory, or in a file of their own
/// where they would take more of it than they may.
class WaitingChunks {
 public:
  explicit WaitingChunks(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}
  /// Fails    OutputError if the disk is full.
  void add(files::Bytes chunk);
  /// The first chunk that has not been taken.
  /// Fails    InputError if the file cannot be read any more.
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

/// An EXR that the first rank writes, chunk by chunk, as chunks arrive from the ranks that have the
/// rows (image/exr_bands.h): it never holds more of the image than its own chunks and one other
/// chunk. Called by all ranks, with the chunks of their bands, which are consumed.
/// `path`       in the first rank, path of the file; `beginning`: its first bytes
/// `of_chunks`  the rank of each chunk
/// Fails    after everything has been sent: in the first rank OutputError; InputError if own chunks
///          cannot be read.
void write_banded_exr(const Ranks& ranks, const std::filesystem::path& path,
                      const files::Bytes& beginning, std::span<const int> of_chunks,
                      std::uint32_t rows_of_chunk, WaitingChunks& own_chunks);

}  // namespace fathom::app
