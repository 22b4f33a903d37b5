#include "fathom/mesh_files/ply_body.h"
#include "fathom/mesh_files/ply_text.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/text/text_ends.h"

namespace fathom::mesh_files {
using namespace mesh;
using namespace text;

namespace {

/// Collects vertices and faces in a mesh.
class MeshSink {
 public:
  MeshSink(const std::string& file, bool primitives)
      : faces_(mesh_, file), primitives_(primitives) {}

  template <class Has, class Rows>
  void begin_vertices(const PlyElement& element, const Has& has, const Rows&) {
    normals_ = has(slot_normal) && has(slot_normal + 1) && has(slot_normal + 2);
    textures_ = has(slot_texture) && has(slot_texture + 1);
    colours_ = has(slot_colour) && has(slot_colour + 1) && has(slot_colour + 2);
    mesh_.vertices.reserve(element.count);
    if (normals_) mesh_.normals.reserve(element.count);
    if (textures_) mesh_.texture_coordinates.reserve(element.count);
    if (colours_) mesh_.colours.reserve(element.count);
  }

  void vertex(const PlyVertex& row) {
    mesh_.vertices.push_back({row[0], row[1], row[2]});
    if (normals_) mesh_.normals.push_back({row[3], row[4], row[5]});
    if (textures_) mesh_.texture_coordinates.push_back({row[6], row[7]});
    if (colours_) push_colour(row);
  }

  template <class Rows>
  void begin_faces(const PlyElement&, std::size_t, std::uint64_t most, const Rows&) {
    mesh_.triangles.reserve(most);
  }

  template <class Rows>
  void face(std::span<const std::uint32_t> ring, const Rows&) {
    faces_.add(ring);
  }

  void begin_strips(const PlyElement&, std::size_t) {}
  template <class Rows>
  void strip_corner(const PlyStrip&, std::uint64_t, const Rows&) {}
  void strip_triangle(const CornerIndices& corners) { faces_.add(corners); }

  [[nodiscard]] bool wants_edges() const { return primitives_; }
  void edge(const std::array<std::uint32_t, 2>& ends) { mesh_.lines.push_back(ends); }

  Mesh finish(const std::string& file, Warnings& warnings) {
    cut_polygons(mesh_, faces_.skipped(), file, warnings);
    return std::move(mesh_);
  }

 private:
  void push_colour(const PlyVertex& row) {
    std::array<float, 4> colour{};
    for (std::size_t i = 0; i < 4; ++i) colour[i] = static_cast<float>(row[slot_colour + i]);
    mesh_.colours.push_back(colour);
  }

  Mesh mesh_;
  FaceCollector faces_;
  bool primitives_;
  bool normals_ = false, textures_ = false, colours_ = false;
};

template <class Rows>
Mesh read_body(std::string_view text, const PlyHeader& header, const std::string& file,
               const ReadOptions& options, Warnings& warnings) {
  MeshSink sink(file, options.primitives);
  Rows rows(text.substr(header.size), file, header);
  PlyBody<Rows, MeshSink>(std::move(rows), header, file, options.attributes, sink).read(warnings);
  return sink.finish(file, warnings);
}

}  // namespace

Mesh read_ply(std::span<const std::byte> bytes, const std::string& file, const ReadOptions& options,
              Warnings& warnings) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  expect_no_utf16(text, file);
  const PlyHeader header = read_ply_header(text, file, warnings);
  switch (header.encoding) {
    case PlyHeader::Encoding::ascii:
      return read_body<PlyTextRows>(without_padding(text), header, file, options, warnings);
    case PlyHeader::Encoding::little_endian:
      return read_body<BinaryRows<false>>(text, header, file, options, warnings);
    default:
      return read_body<BinaryRows<true>>(text, header, file, options, warnings);
  }
}

}  // namespace fathom::mesh_files
