#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "apps/mpi/ranks.h"
#include "fathom/files/file_bytes.h"

namespace fathom::app {

/// Messages between ranks that work at their own pace: none waits for another but where more of
/// what it has sent is on the way than may be. It ends when all ranks have no more to send and all
/// has arrived: dynamic sparse data exchange by nonblocking consensus [HSL10]. Each rank makes one
/// at the same time; what comes before the next is a collective call of all, such as together().
class SparseExchange {
 public:
  using Take = std::function<void(int from, files::Bytes message)>;

  /// `most_on_the_way`  bytes that this rank may have sent and others not received yet, and that it
  ///                    may be receiving; a message that is longer goes alone
  /// `take`             gets each message, those of one rank in the order in which they were sent
  SparseExchange(const Ranks& ranks, std::size_t most_on_the_way, Take take);
  SparseExchange(const SparseExchange&) = delete;
  SparseExchange& operator=(const SparseExchange&) = delete;
  /// Where end() has not been called or has failed, this rank gives up: the others are told, and
  /// what comes from them is thrown away until they have ended too.
  ~SparseExchange();

  /// Sends less than 2³¹ bytes to another rank. Takes what comes meanwhile.
  /// Fails    as take().
  void send(int to, files::Bytes message);
  /// Takes what has come, and does not wait for more.
  /// Fails    as take().
  void receive();
  /// Whether a rank has given up: what is sent and drawn from then on is of no use to anybody.
  [[nodiscard]] bool is_given_up() const;
  /// Takes what comes until all ranks have called end() or given up.
  /// Fails    as take().
  void end();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace fathom::app
