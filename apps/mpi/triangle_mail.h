#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "apps/mpi/ranks.h"
#include "apps/mpi/traffic.h"
#include "fathom/fast/some_tiles.h"
#include "fathom/files/file_bytes.h"
#include "fathom/mesh/mesh.h"

/// Triangles as messages between ranks.
namespace fathom::app {

/// Copies triangles out of a mesh, once or often. The mesh must outlive it unchanged.
/// Cost     4 bytes for each vertex, once; then proportional to the triangles taken.
class TrianglePicker {
 public:
  explicit TrianglePicker(const Mesh& mesh) : mesh_(mesh) {}
  /// A mesh of these triangles, in this order, with their vertices, but without faces, attributes
  /// and segments.
  [[nodiscard]] Mesh picked(std::span<const std::uint32_t> triangles);

 private:
  const Mesh& mesh_;
  /// For each vertex its place in the new mesh, or no_index.
  std::vector<std::uint32_t> places_;
};

/// Messages of a rank: each other rank gets the triangles that may touch its tiles, each once, in
/// order. A message is a list of sections, one for each object:
///
///   object, numbers of vertices and triangles
///   vertices    three binary64 numbers each, as in the mesh
///   triangles   three vertices of the section each
///   numbers     of the triangles in the scene
///
/// Numbers have the layout of memory: all ranks run on machines of one kind.
/// `touches`    of tiles of other ranks, in the order of the triangles
/// `owners`     the rank of each tile
std::vector<files::Bytes> messages_of(const std::vector<SomeTriangles>& part,
                                      std::span<const TileTouch> touches,
                                      std::span<const int> owners, int ranks);

/// The triangles that a rank has received, as one list for each object, in their order.
/// `messages`   from all ranks, in the order of the triangles that these read. They are used up.
std::vector<SomeTriangles> received_triangles(std::vector<files::Bytes> messages);

/// Sends triangles between ranks. Messages wait until they are large enough to be worth sending,
/// and received triangles wait until there are enough to be worth drawing.
class TriangleMail {
 public:
  using Draw = std::function<void(std::vector<SomeTriangles>)>;

  /// `most_waiting`  limit in bytes for each of these: data to be sent, undelivered data from and
  /// to
  ///                 this rank, data to be drawn; a longer message is sent alone
  /// `traffic`       counts sent bytes
  /// `draw`          gets the received triangles, within the other functions
  TriangleMail(const Ranks& ranks, std::size_t most_waiting, Traffic& traffic, Draw draw);

  /// messages[r] is for rank r. May also receive messages.
  /// Fails    as draw().
  void send(std::vector<files::Bytes> messages);
  /// Receives the messages that have arrived.
  /// Fails    as draw().
  void receive() { exchange_.receive(); }
  /// Sends waiting messages, and returns when all ranks have called this and all received triangles
  /// are drawn.
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
