#include "apps/mpi/triangle_mail.h"

#include <algorithm>
#include <utility>

#include "apps/mpi/triangle_messages.h"

namespace fathom::app {
using namespace files;

TriangleMail::TriangleMail(const Ranks& ranks, std::size_t most_waiting, Traffic& traffic,
                           Draw draw)
    : most_waiting_(most_waiting),
      traffic_(traffic),
      draw_(std::move(draw)),
      waiting_(static_cast<std::size_t>(ranks.count())),
      received_(waiting_.size()),
      exchange_(ranks, most_waiting,
                [this](int from, const Bytes& message) { take(from, message); }) {}

void TriangleMail::send(std::vector<Bytes> messages) {
  for (std::size_t rank = 0; rank < messages.size(); ++rank) add(rank, messages[rank]);
  while (bytes_waiting_ > most_waiting_) send_longest();
}

void TriangleMail::end() {
  while (bytes_waiting_ != 0) send_longest();
  exchange_.end();
  draw_received();
}

void TriangleMail::add(std::size_t rank, Bytes& message) {
  Bytes& waiting = waiting_[rank];
  if (waiting.size() + message.size() > most_waiting_) send_waiting(rank);
  bytes_waiting_ += message.size();
  if (waiting.empty()) {
    waiting = std::move(message);
  } else {
    append(waiting, message);
    message = Bytes();  // {} would keep its memory
  }
}

void TriangleMail::send_longest() {
  const auto longest = std::ranges::max_element(waiting_, {}, &Bytes::size);
  send_waiting(static_cast<std::size_t>(longest - waiting_.begin()));
}

void TriangleMail::send_waiting(std::size_t rank) {
  Bytes message = std::exchange(waiting_[rank], {});
  if (message.empty()) return;
  bytes_waiting_ -= message.size();
  traffic_.add(message.size());
  exchange_.send(static_cast<int>(rank), std::move(message));
}

void TriangleMail::take(int from, const Bytes& message) {
  append(received_[static_cast<std::size_t>(from)], message);
  bytes_received_ += message.size();
  if (bytes_received_ > most_waiting_) draw_received();
}

void TriangleMail::draw_received() {
  bytes_received_ = 0;
  std::vector<Bytes> messages(received_.size());
  messages.swap(received_);
  if (!is_given_up()) draw_(received_triangles(std::move(messages)));
}

}  // namespace fathom::app
