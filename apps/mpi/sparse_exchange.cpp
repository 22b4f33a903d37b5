#include "apps/mpi/sparse_exchange.h"

#include <mpi.h>

#include <chrono>
#include <deque>
#include <limits>
#include <stdexcept>
#include <thread>
#include <utility>

// How to read this file: end() is the proof that nothing is lost. A send is synchronous: it
// completes when the other rank has begun to receive it. A rank enters the barrier when all its
// sends have completed, so when all have entered, whatever was sent is among what ranks have begun
// to receive.
namespace fathom::app {
using namespace files;

namespace {

/// ranks.cpp has 0.
constexpr int message_tag = 1, given_up_tag = 2;

}  // namespace

struct SparseExchange::State {
  struct OnTheWay {
    int rank = 0;
    Bytes bytes;
    MPI_Request request = MPI_REQUEST_NULL;

    /// Whether it has arrived, or has begun to; asks once.
    bool is_done() {
      int done = 0;
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      return done != 0;
    }
  };

  State(const Ranks& the_ranks, std::size_t most, Take the_take)
      : ranks(the_ranks), most_on_the_way(most), take(std::move(the_take)) {}

  void start_sending(int to, int tag, Bytes message);
  bool finish_sending();
  bool start_receiving();
  bool finish_receiving();
  bool step();
  template <class Condition>
  void step_until(const Condition& condition);
  void end();
  void give_up();

  const Ranks& ranks;
  std::size_t most_on_the_way;
  Take take;
  std::deque<OnTheWay> sent, coming;
  std::size_t bytes_sent = 0, bytes_coming = 0;
  bool given_up = false, has_entered = false, ended = false;
  MPI_Request barrier = MPI_REQUEST_NULL;
};

void SparseExchange::State::start_sending(int to, int tag, Bytes message) {
  OnTheWay& now = sent.emplace_back(OnTheWay{to, std::move(message)});
  bytes_sent += now.bytes.size();
  MPI_Issend(now.bytes.data(), static_cast<int>(now.bytes.size()), MPI_BYTE, to, tag,
             MPI_COMM_WORLD, &now.request);
}

/// Whether any has arrived; so below: whether anything has happened.
bool SparseExchange::State::finish_sending() {
  const std::size_t before = sent.size();
  std::erase_if(sent, [&](OnTheWay& each) {
    if (!each.is_done()) return false;
    bytes_sent -= each.bytes.size();
    return true;
  });
  return sent.size() < before;
}

bool SparseExchange::State::start_receiving() {
  bool any = false;
  while (bytes_coming < most_on_the_way || coming.empty()) {
    int found = 0, size = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &found, &status);
    if (found == 0) return any;
    MPI_Get_count(&status, MPI_BYTE, &size);
    OnTheWay& now =
        coming.emplace_back(OnTheWay{status.MPI_SOURCE, Bytes(static_cast<std::size_t>(size))});
    bytes_coming += now.bytes.size();
    MPI_Irecv(now.bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
              &now.request);
    given_up = given_up || status.MPI_TAG == given_up_tag;
    any = true;
  }
  return any;
}

/// In the order of arrival; messages of one rank arrive in the order of sending.
bool SparseExchange::State::finish_receiving() {
  bool any = false;
  for (; !coming.empty() && coming.front().is_done(); any = true) {
    OnTheWay now = std::move(coming.front());
    coming.pop_front();
    bytes_coming -= now.bytes.size();
    if (!given_up && !now.bytes.empty()) take(now.rank, std::move(now.bytes));
  }
  return any;
}

bool SparseExchange::State::step() {
  const bool has_sent = finish_sending(), has_begun = start_receiving();
  return finish_receiving() || has_sent || has_begun;
}

/// Leaves the processor to others while nothing happens: there may be more ranks than processors.
template <class Condition>
void SparseExchange::State::step_until(const Condition& condition) {
  constexpr std::chrono::microseconds pause(50);
  while (!condition())
    if (!step()) std::this_thread::sleep_for(pause);
}

void SparseExchange::State::end() {
  step_until([&] { return sent.empty(); });
  if (!std::exchange(has_entered, true)) MPI_Ibarrier(MPI_COMM_WORLD, &barrier);
  step_until([&] {
    int all_have_entered = 0;
    MPI_Test(&barrier, &all_have_entered, MPI_STATUS_IGNORE);
    return all_have_entered != 0;
  });
  step_until([&] { return coming.empty(); });
  ended = true;
}

/// Notifies the other ranks, by the barrier and at most once, that this rank sends no more.
void SparseExchange::State::give_up() {
  if (!has_entered && !given_up) {
    for (int rank = 0; rank < ranks.count(); ++rank)
      if (rank != ranks.self()) start_sending(rank, given_up_tag, {});
  }
  given_up = true;
  end();
}

SparseExchange::SparseExchange(const Ranks& ranks, std::size_t most_on_the_way, Take take)
    : state_(std::make_unique<State>(ranks, most_on_the_way, std::move(take))) {}

SparseExchange::~SparseExchange() {
  if (!state_->ended) state_->give_up();
}

void SparseExchange::send(int to, Bytes message) {
  if (message.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::logic_error("a message has more bytes than MPI counts");
  state_->step_until([&] {
    return state_->sent.empty() || state_->bytes_sent + message.size() <= state_->most_on_the_way;
  });
  state_->start_sending(to, message_tag, std::move(message));
}

void SparseExchange::receive() {
  while (state_->step()) {
  }
}

bool SparseExchange::is_given_up() const {
  return state_->given_up;
}

void SparseExchange::end() {
  state_->end();
}

}  // namespace fathom::app
