#include "apps/mpi/ranks.h"

#include <mpi.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <deque>
#include <limits>
#include <new>
#include <stdexcept>
#include <thread>
#include <utility>

#include "apps/mpi/together.h"

namespace fathom::app {
using namespace files;

namespace {

/// The most bytes of one message of MPI, whose counts are ints.
constexpr std::size_t most_at_once = std::size_t{1} << 30;

std::uint64_t reduced(std::uint64_t value, MPI_Op how) {
  std::uint64_t result = 0;
  MPI_Allreduce(&value, &result, 1, MPI_UINT64_T, how, MPI_COMM_WORLD);
  return result;
}

template <class T>
void reduce_all(std::span<T> values, MPI_Datatype type, MPI_Op how) {
  constexpr std::size_t most = most_at_once / sizeof(T);
  for (; !values.empty(); values = values.subspan(std::min(values.size(), most))) {
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(std::min(values.size(), most)),
                  type, how, MPI_COMM_WORLD);
  }
}

/// The part of a message of `size` bytes that is sent in a round.
struct Piece {
  std::size_t offset = 0;
  int count = 0;
};

Piece piece_of(std::size_t size, std::size_t round, std::size_t most) {
  const std::size_t offset = std::min(size, round * most);
  return {offset, static_cast<int>(std::min(size - offset, most))};
}

MPI_Comm ranks_on_this_machine() {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  return machine;
}

/// A number in memory that the ranks on this machine share. It is 0 at first and exists until the
/// end.
std::atomic<int>* shared_number() {
  using Number = std::atomic<int>;
  static_assert(Number::is_always_lock_free);
  MPI_Comm machine = ranks_on_this_machine();
  int self = 0;
  MPI_Comm_rank(machine, &self);
  Number* number = nullptr;
  MPI_Win window = MPI_WIN_NULL;
  MPI_Win_allocate_shared(self == 0 ? sizeof(Number) : 0, sizeof(Number), MPI_INFO_NULL, machine,
                          &number, &window);
  MPI_Aint size = 0;
  int unit = 0;
  MPI_Win_shared_query(window, 0, &size, &unit, &number);
  if (self == 0) new (number) Number(0);
  MPI_Barrier(machine);
  return number;
}

}  // namespace

// A folder of the run, which is removed with the run.
bool share_last_word_of_run() {
  const char* const folder = std::getenv("PMIX_SERVER_TMPDIR");
  if (folder == nullptr) return false;
  share_last_word(std::string(folder) + "/fathom-has-spoken");
  return true;
}

MpiSession::MpiSession(int& argc, char**& argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  share_last_word(shared_number());
}

MpiSession::~MpiSession() {
  share_last_word(nullptr);
  MPI_Finalize();
}

Ranks::Ranks() {
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
  MPI_Comm_rank(MPI_COMM_WORLD, &self_);
}

int Ranks::count_on_this_machine() const {
  MPI_Comm machine = ranks_on_this_machine();
  int count = 1;
  MPI_Comm_size(machine, &count);
  MPI_Comm_free(&machine);
  return count;
}

std::uint64_t Ranks::least(std::uint64_t value) const {
  return reduced(value, MPI_MIN);
}

std::uint64_t Ranks::greatest(std::uint64_t value) const {
  return reduced(value, MPI_MAX);
}

std::uint64_t Ranks::sum(std::uint64_t value) const {
  return reduced(value, MPI_SUM);
}

void Ranks::add_up(std::span<std::uint64_t> values) const {
  reduce_all(values, MPI_UINT64_T, MPI_SUM);
}

void Ranks::take_least(std::span<double> values) const {
  reduce_all(values, MPI_DOUBLE, MPI_MIN);
}

std::string Ranks::broadcast(const std::string& text, int from) const {
  std::uint64_t size = text.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, from, MPI_COMM_WORLD);
  std::string result = self_ == from ? text : std::string(size, '\0');
  for (std::size_t at = 0; at < size; at += most_at_once) {
    MPI_Bcast(result.data() + at, static_cast<int>(std::min(size - at, most_at_once)), MPI_BYTE,
              from, MPI_COMM_WORLD);
  }
  return result;
}

std::vector<Bytes> Ranks::exchange(std::vector<Bytes> messages, std::size_t most_in_a_round) const {
  const auto ranks = static_cast<std::size_t>(count_);
  std::vector<std::uint64_t> sizes(ranks), sizes_to_come(ranks);
  std::uint64_t longest = 0;
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    sizes[rank] = messages[rank].size();
    longest = std::max(longest, sizes[rank]);
  }
  MPI_Alltoall(sizes.data(), 1, MPI_UINT64_T, sizes_to_come.data(), 1, MPI_UINT64_T,
               MPI_COMM_WORLD);
  // Offsets within the sent and received data of a round are ints, too.
  const std::size_t most =
      std::max<std::size_t>(1, std::min(most_in_a_round, most_at_once) / ranks);
  const std::size_t rounds = (greatest(longest) + most - 1) / most;
  std::vector<Bytes> received(ranks);
  for (std::size_t rank = 0; rank < ranks; ++rank) received[rank].reserve(sizes_to_come[rank]);
  std::vector<int> counts(ranks), places(ranks), counts_to_come(ranks), places_to_come(ranks);
  Bytes out, in;
  for (std::size_t round = 0; round < rounds; ++round) {
    out.clear();
    std::size_t to_come = 0;
    for (std::size_t rank = 0; rank < ranks; ++rank) {
      const Piece piece = piece_of(sizes[rank], round, most);
      places[rank] = static_cast<int>(out.size());
      counts[rank] = piece.count;
      append(out,
             ByteView(messages[rank]).subspan(piece.offset, static_cast<std::size_t>(piece.count)));
      places_to_come[rank] = static_cast<int>(to_come);
      counts_to_come[rank] = piece_of(sizes_to_come[rank], round, most).count;
      to_come += static_cast<std::size_t>(counts_to_come[rank]);
    }
    in.resize(to_come);
    MPI_Alltoallv(out.data(), counts.data(), places.data(), MPI_BYTE, in.data(),
                  counts_to_come.data(), places_to_come.data(), MPI_BYTE, MPI_COMM_WORLD);
    for (std::size_t rank = 0; rank < ranks; ++rank) {
      append(received[rank], ByteView(in).subspan(static_cast<std::size_t>(places_to_come[rank]),
                                                  static_cast<std::size_t>(counts_to_come[rank])));
    }
  }
  return received;
}

void Ranks::send_to_first(ByteView bytes) const {
  std::uint64_t size = bytes.size();
  MPI_Send(&size, 1, MPI_UINT64_T, 0, 0, MPI_COMM_WORLD);
  for (std::size_t at = 0; at < bytes.size(); at += most_at_once) {
    MPI_Send(bytes.data() + at, static_cast<int>(std::min(bytes.size() - at, most_at_once)),
             MPI_BYTE, 0, 0, MPI_COMM_WORLD);
  }
}

Bytes Ranks::receive_from(int rank) const {
  std::uint64_t size = 0;
  MPI_Recv(&size, 1, MPI_UINT64_T, rank, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  Bytes bytes(size);
  for (std::size_t at = 0; at < bytes.size(); at += most_at_once) {
    MPI_Recv(bytes.data() + at, static_cast<int>(std::min(bytes.size() - at, most_at_once)),
             MPI_BYTE, rank, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  }
  return bytes;
}

void Ranks::abort(int status) const {
  MPI_Abort(MPI_COMM_WORLD, status);
  std::_Exit(status);
}

// How to read this file: end() is the proof that nothing is lost. A send is synchronous: it
// completes when the other rank has begun to receive it. A rank enters the barrier when all its
// sends have completed. So when all ranks have entered, ranks have begun to receive everything that
// was sent.

namespace {

/// Ranks uses tag 0.
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

/// Returns whether any message has arrived. The functions below also return whether anything has
/// happened.
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

/// Yields the processor while nothing happens, because there may be more ranks than processors.
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
