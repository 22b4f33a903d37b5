#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "apps/mpi/ranks.h"
#include "fathom/files/file_bytes.h"

namespace fathom::app {

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

  /// Sends less than 2³¹ bytes to another rank. Takes what comes meanwhile.
  /// Fails    as take().
  void send(int to, files::Bytes message);
  /// Takes what has come, and does not wait for more.
  /// Fails    as take().
  void receive();
  /// Whether a rank has given up: further work is useless.
  [[nodiscard]] bool is_given_up() const;
  /// Takes what comes until all ranks have called end() or given up.
  /// Fails    as take().
  void end();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace fathom::app
