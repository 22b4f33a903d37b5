#include "fathom/files/byte_window.h"

#include <algorithm>
#include <cstring>

namespace fathom::files {

bool ByteWindow::read_on(std::size_t count) {
  const auto kept = static_cast<std::size_t>(end_ - at_);
  if (kept + unread_ < count) return false;
  std::memmove(buffer_.data(), at_, kept);
  const auto more =
      static_cast<std::size_t>(std::min<std::uint64_t>(buffer_.size() - kept, unread_));
  file_->read(end_offset_, std::as_writable_bytes(std::span(buffer_).subspan(kept, more)));
  at_ = buffer_.data();
  end_ = at_ + kept + more;
  end_offset_ += more;
  unread_ -= more;
  return true;
}

void ByteWindow::skip(std::uint64_t count) {
  const auto here = std::min<std::uint64_t>(count, static_cast<std::uint64_t>(end_ - at_));
  at_ += here;
  unread_ -= count - here;
  end_offset_ += count - here;
}

}  // namespace fathom::files
