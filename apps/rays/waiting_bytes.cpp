#include "apps/rays/waiting_bytes.h"

#include <algorithm>
#include <cstdint>

namespace fathom::app {
namespace {

/// Bytes in memory, and of a piece.
constexpr std::size_t most_in_memory = std::size_t{1} << 20;

}  // namespace

void WaitingBytes::append(files::ByteView bytes) {
  files::append(last_, bytes);
  if (last_.size() <= most_in_memory) return;
  if (!file_) file_ = std::make_unique<files::SpillFile>();
  file_->append(last_);
  last_.clear();
}

void WaitingBytes::for_each_piece(const std::function<void(files::ByteView)>& take) const {
  const std::uint64_t size = file_ ? file_->size() : 0;
  files::Bytes piece;
  for (std::uint64_t at = 0; at < size; at += piece.size()) {
    piece.resize(static_cast<std::size_t>(std::min<std::uint64_t>(most_in_memory, size - at)));
    file_->read(at, piece);
    take(piece);
  }
  if (!last_.empty()) take(last_);
}

}  // namespace fathom::app
