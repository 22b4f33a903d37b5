#include "apps/mpi/triangle_messages.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "apps/mpi/picked_triangles.h"
#include "fathom/mesh/vertex_normals.h"

namespace fathom::app {
using namespace text;

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
  for (auto& list : lists) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return lists;
}

void append_section(Bytes& message, const ScenePart::From& from, const Mesh& mesh,
                    std::span<const std::uint32_t> triangles) {
  const Section section{from.object, static_cast<std::uint32_t>(mesh.vertices.size()),
                        static_cast<std::uint32_t>(mesh.triangles.size())};
  append_all(message, std::span(&section, 1));
  append_all(message, std::span(mesh.vertices.data(), mesh.vertices.size()));
  append_all(message, std::span(mesh.triangles.data(), mesh.triangles.size()));
  for (const std::uint32_t triangle : triangles) {
    const std::uint32_t number = from.first + triangle;
    append_all(message, std::span(&number, 1));
  }
  append_all(message, std::span(mesh.face_of_triangle.data(), mesh.face_of_triangle.size()));
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

/// Adds a section to the mesh of its object; `numbers` are those of the triangles in the whole mesh.
void add_section(MessageReader& message, const Section& section, Mesh& mesh,
                 std::vector<std::uint32_t>& numbers) {
  const auto first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto vertices = message.several<MeshPoint>(section.vertices);
  mesh.vertices.append(vertices.begin(), vertices.end());
  for (CornerIndices corners : message.several<CornerIndices>(section.triangles)) {
    for (std::uint32_t& corner : corners) corner += first_vertex;
    mesh.triangles.push_back(corners);
  }
  const auto these = message.several<std::uint32_t>(section.triangles);
  numbers.insert(numbers.end(), these.begin(), these.end());
  const auto faces = message.several<std::uint32_t>(section.triangles);
  mesh.face_of_triangle.insert(mesh.face_of_triangle.end(), faces.begin(), faces.end());
}

/// What channels show of a mesh beside positions, for some of its triangles.
void add_attributes(const Mesh& whole, std::span<const std::uint32_t> numbers, Mesh& mesh) {
  for (const TriangleSegments& all : whole.segments) {
    TriangleSegments some{all.by, all.numbers, all.names};
    if (all.numbers.size() > 1) {
      some.numbers.clear();
      for (const std::uint32_t number : numbers) some.numbers.push_back(all.of(number));
    }
    mesh.segments.push_back(std::move(some));
  }
  if (whole.normals.empty() || numbers.empty()) return;
  mesh.normals = whole.normals;
  for (const std::uint32_t number : numbers) {
    CornerIndices corners{};
    for (std::size_t i = 0; i < 3; ++i) corners[i] = mesh::normal_index(whole, number, i);
    mesh.normal_triangles.push_back(corners);
  }
}

}  // namespace

std::vector<Bytes> messages_of(const ScenePart& part, std::span<const TileTouch> touches,
                               std::span<const int> owners, int ranks) {
  const auto lists = triangles_for_ranks(touches, owners, ranks);
  std::vector<Bytes> messages(lists.size());
  std::vector<std::size_t> next(lists.size(), 0);
  std::uint32_t first = 0;  // of the object's triangles in the part
  for (std::size_t object = 0; object < part.from.size(); ++object) {
    const Mesh& mesh = part.scene.meshes[object];
    const auto end = first + static_cast<std::uint32_t>(mesh.triangles.size());
    TrianglePicker picker(mesh);
    for (std::size_t rank = 0; rank < lists.size(); ++rank) {
      std::vector<std::uint32_t> of_object;
      for (; next[rank] < lists[rank].size() && lists[rank][next[rank]] < end; ++next[rank])
        of_object.push_back(lists[rank][next[rank]] - first);
      if (of_object.empty()) continue;
      append_section(messages[rank], part.from[object], picker.picked(of_object), of_object);
    }
    first = end;
  }
  return messages;
}

ReceivedScene received_scene(std::vector<Bytes> messages, const SharedScene& whole) {
  const Scene& outline = whole.outline();
  ReceivedScene received;
  Scene& scene = received.scene;
  scene.objects = outline.objects;
  scene.sources = outline.sources;
  scene.meshes.resize(scene.objects.size());
  std::vector<std::vector<std::uint32_t>> numbers(scene.objects.size());
  for (Bytes& message : messages) {
    MessageReader reader(message);
    while (!reader.is_at_end()) {
      const auto section = reader.one<Section>();
      add_section(reader, section, scene.meshes.at(section.object), numbers[section.object]);
    }
    message = {};
  }
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (whole.is_whole())
      add_attributes(outline.meshes[outline.objects[i].mesh], numbers[i], scene.meshes[i]);
    scene.objects[i].mesh = i;
    scene.meshes[i].face_count = scene.meshes[i].triangles.size();
    for (const std::uint32_t number : numbers[i]) {
      received.numbers.push_back(static_cast<std::uint32_t>(whole.first_numbers()[i]) + number);
    }
  }
  return received;
}

}  // namespace fathom::app
