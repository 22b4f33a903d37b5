#include "apps/mpi/triangle_mail.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace fathom::app {

using namespace files;

namespace {

struct Section {
  std::uint32_t object = 0, vertices = 0, triangles = 0;
};

template <class T>
void append_all(Bytes& message, std::span<const T> values) {
  static_assert(std::is_trivially_copyable_v<T>);
  append(message, std::as_bytes(values));
}

/// For each rank the triangles that may touch its tiles, in their order.
std::vector<std::vector<std::uint32_t>> triangles_for_ranks(std::span<const TileTouch> touches,
                                                            std::span<const int> owners,
                                                            int ranks) {
  std::vector<std::vector<std::uint32_t>> lists(static_cast<std::size_t>(ranks));
  for (const TileTouch& touch : touches) {
    auto& list = lists[static_cast<std::size_t>(owners[touch.tile])];
    if (list.empty() || list.back() != touch.triangle) list.push_back(touch.triangle);
  }
  return lists;
}

void append_section(Bytes& message, const SomeTriangles& from, const Mesh& mesh,
                    std::span<const std::uint32_t> triangles) {
  const Section section{from.object, static_cast<std::uint32_t>(mesh.vertices.size()),
                        static_cast<std::uint32_t>(mesh.triangles.size())};
  append_all(message, std::span(&section, 1));
  append_all(message, std::span(mesh.vertices.data(), mesh.vertices.size()));
  append_all(message, std::span(mesh.triangles.data(), mesh.triangles.size()));
  std::vector<std::uint32_t> numbers;
  numbers.reserve(triangles.size());
  for (const std::uint32_t triangle : triangles) numbers.push_back(from.numbers[triangle]);
  append_all(message, std::span(std::as_const(numbers)));
}

/// Takes values from the beginning of a message.
class MessageReader {
 public:
  explicit MessageReader(ByteView message) : left_(message) {}
  [[nodiscard]] bool is_at_end() const { return left_.empty(); }

  template <class T>
  T one() {
    T value;
    take(&value, sizeof(T));
    return value;
  }
  template <class T>
  std::vector<T> several(std::size_t count) {
    std::vector<T> values(count);
    take(values.data(), count * sizeof(T));
    return values;
  }

 private:
  void take(void* to, std::size_t size) {
    if (size > left_.size()) throw std::logic_error("a message of triangles is too short");
    if (size != 0) std::memcpy(to, left_.data(), size);
    left_ = left_.subspan(size);
  }
  ByteView left_;
};

/// Adds a section to the triangles of its object.
void add_section(MessageReader& message, const Section& section, SomeTriangles& to) {
  Mesh& mesh = to.mesh;
  const auto first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto vertices = message.several<MeshPoint>(section.vertices);
  mesh.vertices.append(vertices.begin(), vertices.end());
  for (CornerIndices corners : message.several<CornerIndices>(section.triangles)) {
    for (std::uint32_t& corner : corners) corner += first_vertex;
    mesh.triangles.push_back(corners);
  }
  const auto numbers = message.several<std::uint32_t>(section.triangles);
  to.numbers.insert(to.numbers.end(), numbers.begin(), numbers.end());
}

}  // namespace

Mesh TrianglePicker::picked(std::span<const std::uint32_t> triangles) {
  if (places_.empty()) places_.assign(mesh_.vertices.size(), no_index);
  Mesh result;
  result.triangles.reserve(triangles.size());
  std::vector<std::uint32_t> used;
  for (const std::uint32_t number : triangles) {
    CornerIndices corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = mesh_.triangles[number][i];
      std::uint32_t& place = places_.at(vertex);
      if (place == no_index) {
        place = static_cast<std::uint32_t>(used.size());
        used.push_back(vertex);
      }
      corners[i] = place;
    }
    result.triangles.push_back(corners);
  }
  result.vertices.reserve(used.size());
  for (const std::uint32_t vertex : used) {
    result.vertices.push_back(mesh_.vertices[vertex]);
    places_[vertex] = no_index;
  }
  return result;
}

std::vector<Bytes> messages_of(const std::vector<SomeTriangles>& part,
                               std::span<const TileTouch> touches, std::span<const int> owners,
                               int ranks) {
  const auto lists = triangles_for_ranks(touches, owners, ranks);
  std::vector<Bytes> messages(lists.size());
  std::vector<std::size_t> next(lists.size(), 0);
  std::uint32_t first = 0;  // of the list's triangles in the part
  for (const SomeTriangles& from : part) {
    const auto end = first + static_cast<std::uint32_t>(from.mesh.triangles.size());
    TrianglePicker picker(from.mesh);
    for (std::size_t rank = 0; rank < lists.size(); ++rank) {
      std::vector<std::uint32_t> of_list;
      for (; next[rank] < lists[rank].size() && lists[rank][next[rank]] < end; ++next[rank])
        of_list.push_back(lists[rank][next[rank]] - first);
      if (of_list.empty()) continue;
      append_section(messages[rank], from, picker.picked(of_list), of_list);
    }
    first = end;
  }
  return messages;
}

std::vector<SomeTriangles> received_triangles(std::vector<Bytes> messages) {
  std::map<std::uint32_t, SomeTriangles> of_objects;
  for (Bytes& message : messages) {
    MessageReader reader(message);
    while (!reader.is_at_end()) {
      const auto section = reader.one<Section>();
      add_section(reader, section, of_objects[section.object]);
    }
    message = Bytes();  // {} would keep its memory
  }
  std::vector<SomeTriangles> lists;
  for (auto& [object, triangles] : of_objects) {
    triangles.object = object;
    lists.push_back(std::move(triangles));
  }
  return lists;
}

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
