#include "apps/mpi/waiting_chunks.h"

#include <utility>

namespace fathom::app {

void WaitingChunks::add(files::Bytes chunk) {
  const std::uint64_t size = chunk.size();
  bytes_ += size;
  if (bytes_ <= most_bytes_) {
    chunks_.push_back({std::move(chunk), 0, 0});
    return;
  }
  if (!file_) file_.emplace();
  chunks_.push_back({{}, file_->append(chunk), size});
}

files::Bytes WaitingChunks::take() {
  Chunk& chunk = chunks_.at(next_++);
  if (chunk.size == 0) return std::exchange(chunk.bytes, {});
  files::Bytes bytes(chunk.size);
  file_->read(chunk.offset, bytes);
  return bytes;
}

}  // namespace fathom::app
