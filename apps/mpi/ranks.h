#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "fathom/files/file_bytes.h"

/// The processes of a run, numbered from 0. Only ranks.cpp calls MPI.
namespace fathom::app {

/// If ranks on a machine end without agreeing on a reason, only one of them reports
/// (shell/last_resort.h). This takes effect before MPI starts if the environment names the folder
/// of the run's files, and otherwise when MPI has started. Returns whether it took effect.
bool share_last_word_of_run();

/// MPI, from the start of the program to its end.
class MpiSession {
 public:
  MpiSession(int& argc, char**& argv);
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  ~MpiSession();
};

/// Communication between the processes of a run. All processes call every function, in the same
/// order, in the thread that has the MpiSession; it returns when every process has its data. Bytes
/// and counts may exceed an int: they are sent in rounds.
class Ranks {
 public:
  Ranks();

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] int self() const { return self_; }
  /// The first rank reads standard input, answers and writes files.
  [[nodiscard]] bool is_first() const { return self_ == 0; }

  /// How many ranks share the memory of this machine.
  [[nodiscard]] int count_on_this_machine() const;
  [[nodiscard]] std::uint64_t least(std::uint64_t value) const;
  [[nodiscard]] std::uint64_t greatest(std::uint64_t value) const;
  [[nodiscard]] std::uint64_t sum(std::uint64_t value) const;
  /// Sums lists of equal length, element by element.
  void add_up(std::span<std::uint64_t> values) const;
  /// The same with the least instead of the sum; no number is NaN.
  void take_least(std::span<double> values) const;
  /// The text of rank `from`.
  [[nodiscard]] std::string broadcast(const std::string& text, int from) const;
  /// Sends messages[r] to rank r and returns the messages that ranks have sent to this one.
  /// Messages are freed when they are sent. In a round a rank sends at most `most_at_once` bytes,
  /// or one message to each rank.
  [[nodiscard]] std::vector<files::Bytes> exchange(std::vector<files::Bytes> messages,
                                                   std::size_t most_at_once = std::size_t{1}
                                                                              << 26) const;

  /// Rank 0 receives bytes of the other ranks in the order of the ranks, in pieces. Only rank 0
  /// calls receive(), other ranks call send(); the numbers of calls must match.
  void send_to_first(files::ByteView bytes) const;
  [[nodiscard]] files::Bytes receive_from(int rank) const;

  /// Ends all processes with this status at once, when they cannot agree any more.
  [[noreturn]] void abort(int status) const;

 private:
  int count_ = 1, self_ = 0;
};

/// Messages between ranks that work at their own pace: a rank waits only if too many of its bytes
/// are undelivered. The exchange ends when no rank has more to send and all messages have arrived:
/// dynamic sparse data exchange by nonblocking consensus [HSL10]. All ranks construct it together;
/// a collective call such as together() must separate two exchanges.
class SparseExchange {
 public:
  using Take = std::function<void(int from, files::Bytes message)>;

  /// `most_on_the_way`  limit of undelivered bytes that this rank has sent, and of bytes that it is
  ///                    receiving; a longer message is sent alone
  /// `take`             gets each message; messages of one rank arrive in the order of sending
  SparseExchange(const Ranks& ranks, std::size_t most_on_the_way, Take take);
  SparseExchange(const SparseExchange&) = delete;
  SparseExchange& operator=(const SparseExchange&) = delete;
  /// If end() has not been called or has failed, this rank gives up: it notifies the other ranks
  /// and discards their messages until they have ended too.
  ~SparseExchange();

  /// Sends less than 2³¹ bytes to another rank. Receives messages meanwhile.
  /// Fails    as take().
  void send(int to, files::Bytes message);
  /// Receives the messages that have arrived, without waiting for more.
  /// Fails    as take().
  void receive();
  /// Whether a rank has given up: further work is useless.
  [[nodiscard]] bool is_given_up() const;
  /// Receives messages until all ranks have called end() or given up.
  /// Fails    as take().
  void end();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace fathom::app
