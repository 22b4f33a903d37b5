#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "apps/mpi/ranks.h"
#include "apps/mpi/sparse_exchange.h"
#include "apps/mpi/traffic.h"
#include "fathom/fast/some_tiles.h"
#include "fathom/files/file_bytes.h"

namespace fathom::app {

/// Triangles on their way between ranks: messages (triangle_messages.h) wait until together they
/// are worth sending, and what has come until it is worth drawing.
class TriangleMail {
 public:
  using Draw = std::function<void(std::vector<SomeTriangles>)>;

  /// `most_waiting`  limit in bytes for each of these: data to be sent, undelivered data from and
  /// to
  ///                 this rank, data to be drawn; a longer message is sent alone
  /// `traffic`       counts sent bytes
  /// `draw`          gets the received triangles, within the other functions
  TriangleMail(const Ranks& ranks, std::size_t most_waiting, Traffic& traffic, Draw draw);

  /// messages[r] is for rank r. May take what has come meanwhile.
  /// Fails    as draw().
  void send(std::vector<files::Bytes> messages);
  /// Takes what has come.
  /// Fails    as draw().
  void receive() { exchange_.receive(); }
  /// Sends what waits, and returns when all ranks have called this and all that came is drawn.
  /// Fails    as draw().
  void end();
  /// Whether a rank has failed: nothing is drawn any more.
  [[nodiscard]] bool is_given_up() const { return exchange_.is_given_up(); }

 private:
  void add(std::size_t rank, files::Bytes& message);
  void send_longest();
  void send_waiting(std::size_t rank);
  void take(int from, const files::Bytes& message);
  void draw_received();

  std::size_t most_waiting_;
  Traffic& traffic_;
  Draw draw_;
  /// For each rank, from each rank.
  std::vector<files::Bytes> waiting_, received_;
  std::size_t bytes_waiting_ = 0, bytes_received_ = 0;
  SparseExchange exchange_;
};

}  // namespace fathom::app
