#include <algorithm>
#include <memory>
#include <vector>

#include "fathom/mesh/triangulate_face.h"
#include "fathom/mesh_files/ply_body.h"
#include "fathom/mesh_files/ply_vertices.h"
#include "fathom/mesh_files/streams.h"

// The file is read through once by the rows and checks of the ordinary reader; what is kept is
// where things are. Faces are read again, from the file, whenever triangles are asked for.
namespace fathom::mesh_files {
using namespace mesh;
using namespace text;

namespace {

constexpr std::size_t window_size = std::size_t{1} << 20;
constexpr std::uint64_t faces_per_entry = 256;

/// A face, and the first triangle that comes from it or a later one.
struct FacePlace {
  std::uint64_t triangle = 0, face = 0, offset = 0;
};

std::uint64_t triangles_of(std::size_t corners) {
  return corners < 3 ? 0 : corners - 2;
}

/// Where the faces are.
class FaceIndex {
 public:
  void begin(std::uint64_t offset) { end_.offset = start_ = offset; }

  /// The next face has so many corners, and its row ends before `offset`.
  void add(std::size_t corners, std::uint64_t offset) {
    const std::uint64_t size = offset - end_.offset;
    if (end_.face == 0) row_size_ = size;
    if (even_ && (corners != 3 || size != row_size_)) note_uneven();
    if (!even_ && end_.face % faces_per_entry == 0) entries_.push_back(end_);
    triangles_only_ = triangles_only_ && corners == 3;
    has_polygons_ = has_polygons_ || corners > 3;
    end_.triangle += triangles_of(corners);
    ++end_.face;
    end_.offset = offset;
  }

  /// A face at or before the one that triangle `number` comes from, less than 256 before it or
  /// followed by no triangle in between.
  [[nodiscard]] FacePlace before(std::uint64_t number) const {
    if (even_) return {number, number, start_ + number * row_size_};
    const auto after = std::upper_bound(
        entries_.begin(), entries_.end(), number,
        [](std::uint64_t n, const FacePlace& place) { return n < place.triangle; });
    return *(after - 1);
  }

  /// Behind the last face.
  [[nodiscard]] const FacePlace& end() const { return end_; }
  [[nodiscard]] bool triangles_only() const { return triangles_only_; }
  [[nodiscard]] bool has_polygons() const { return has_polygons_; }
  /// Bytes to read for one triangle.
  [[nodiscard]] std::size_t reach() const {
    return even_ ? std::max<std::size_t>(row_size_, 8) : std::size_t{1} << 12;
  }

 private:
  /// Until now every face had three corners and a row of the same size.
  void note_uneven() {
    even_ = false;
    for (std::uint64_t face = 0; face < end_.face; face += faces_per_entry) {
      entries_.push_back({face, face, start_ + face * row_size_});
    }
  }

  std::uint64_t start_ = 0, row_size_ = 0;
  FacePlace end_;
  bool even_ = true, triangles_only_ = true, has_polygons_ = false;
  std::vector<FacePlace> entries_;
};

/// What reading the file through leaves behind.
struct Scan {
  bool big_endian = false;
  std::optional<PlyVertexLayout> layout;
  /// Where vertices have list properties.
  std::vector<MeshPoint> list;

  PlyElement face_element;
  std::size_t indices = 0;
  FaceIndex faces;
  std::uint64_t skipped = 0;
  /// Vertices that belong to a triangle; what is beyond its end does not.
  std::vector<bool> used;
};

/// Takes notes while PlyBody reads and checks.
class ScanSink {
 public:
  ScanSink(Scan& scan, const RandomAccessFile& file) : scan_(scan), file_(file) {}

  template <class Has, class Rows>
  void begin_vertices(const PlyElement& element, const Has&, const Rows& rows) {
    lists_ = element.has_lists();
    if (!lists_) scan_.layout = layout_of_vertices(element, rows.position(), scan_.big_endian);
  }
  void vertex(const PlyVertex& row) {
    if (lists_) scan_.list.push_back({row[0], row[1], row[2]});
  }

  template <class Rows>
  void begin_faces(const PlyElement& element, std::size_t indices, std::uint64_t,
                   const Rows& rows) {
    scan_.face_element = element;
    scan_.indices = indices;
    scan_.faces.begin(rows.position());
  }
  template <class Rows>
  void face(const std::vector<std::uint32_t>& ring, const Rows& rows) {
    scan_.faces.add(ring.size(), rows.position());
    const FacePlace& end = scan_.faces.end();
    if (end.triangle > most_elements || end.face > most_elements)
      fail_too_many_triangles(file_.name());
    if (ring.size() < 3) {
      ++scan_.skipped;
      return;
    }
    for (const std::uint32_t vertex : ring) note_used(vertex);
  }

 private:
  void note_used(std::uint32_t vertex) {
    // A vertex takes three bytes at least: of one that cannot be there, reading will tell.
    if (vertex >= file_.size() / 3) return;
    if (vertex >= scan_.used.size()) {
      scan_.used.resize(std::max<std::size_t>(std::size_t{vertex} + 1, 2 * scan_.used.size()));
    }
    scan_.used[vertex] = true;
  }

  Scan& scan_;
  const RandomAccessFile& file_;
  bool lists_ = false;
};

/// The vertices of a chunk, each once where uses of it follow each other closely.
class ChunkVertices {
 public:
  ChunkVertices(const PlyVertices& all, std::vector<MeshPoint>& chunk)
      : all_(all), chunk_(chunk), recent_(1U << 16, {no_index, 0}) {}

  std::uint32_t number_of(std::uint32_t vertex) {
    auto& [known, number] = recent_[vertex % recent_.size()];
    if (known != vertex) {
      known = vertex;
      number = static_cast<std::uint32_t>(chunk_.size());
      chunk_.push_back(all_[vertex]);
    }
    return number;
  }

 private:
  const PlyVertices& all_;
  std::vector<MeshPoint>& chunk_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> recent_;
};

class PlyStream : public TriangleStream {
 public:
  PlyStream(std::unique_ptr<RandomAccessFile> file, Scan scan, std::uint64_t vertex_count,
            Warnings& warnings)
      : file_(std::move(file)),
        scan_(std::move(scan)),
        vertex_count_(vertex_count),
        vertices_(scan_.layout ? std::make_unique<PlyVertices>(*file_, *scan_.layout)
                               : std::make_unique<PlyVertices>(std::move(scan_.list))) {
    find_bounds();
    warn_of_faces(scan_.skipped, count_odd_shapes(), file_->name(), warnings);
  }

  [[nodiscard]] std::uint32_t triangle_count() const override {
    return static_cast<std::uint32_t>(scan_.faces.end().triangle);
  }
  [[nodiscard]] std::uint64_t face_count() const override { return scan_.faces.end().face; }
  [[nodiscard]] std::optional<Bounds> bounds() const override { return bounds_; }

  [[nodiscard]] TriangleChunk read(std::uint32_t first, std::uint32_t count) const override {
    first = std::min(first, triangle_count());
    count = std::min(count, triangle_count() - first);
    TriangleChunk chunk{.first = first, .mesh = {}};
    Mesh& mesh = chunk.mesh;
    mesh.triangles.reserve(count);
    ChunkVertices vertices(*vertices_, mesh.vertices);
    walk(first, count, window_size, [&](std::uint32_t face, const CornerIndices& t) {
      mesh.triangles.push_back(
          {vertices.number_of(t[0]), vertices.number_of(t[1]), vertices.number_of(t[2])});
      if (!scan_.faces.triangles_only()) mesh.face_of_triangle.push_back(face);
    });
    return chunk;
  }

  [[nodiscard]] Triangle triangle(std::uint32_t number) const override {
    Triangle result;
    walk(number, 1, scan_.faces.reach(), [&](std::uint32_t face, const CornerIndices& t) {
      result = {{(*vertices_)[t[0]], (*vertices_)[t[1]], (*vertices_)[t[2]]}, face};
    });
    return result;
  }

  [[nodiscard]] std::uint32_t face_of(std::uint32_t number) const override {
    return scan_.faces.triangles_only() ? number : triangle(number).face;
  }

 private:
  void find_bounds() {
    for (std::size_t i = 0; i < scan_.used.size(); ++i) {
      if (!scan_.used[i]) continue;
      const MeshPoint p = (*vertices_)[static_cast<std::uint32_t>(i)];
      if (!bounds_) bounds_ = Bounds{p, p};
      bounds_->lower = {std::min(bounds_->lower.x, p.x), std::min(bounds_->lower.y, p.y),
                        std::min(bounds_->lower.z, p.z)};
      bounds_->upper = {std::max(bounds_->upper.x, p.x), std::max(bounds_->upper.y, p.y),
                        std::max(bounds_->upper.z, p.z)};
    }
    scan_.used = {};
  }

  /// Faces that are cut into a fan in spite of their shape.
  [[nodiscard]] std::uint64_t count_odd_shapes() const {
    if (!scan_.faces.has_polygons()) return 0;
    std::uint64_t odd = 0;
    std::vector<CornerIndices> cut;
    walk_faces(0, triangle_count(), window_size,
               [&](std::uint64_t, std::uint64_t, const std::vector<std::uint32_t>& ring) {
                 if (cut_face(ring, cut) == Triangulation::fallback_fan) ++odd;
               });
    return odd;
  }

  /// Triangles as numbers of corners.
  Triangulation cut_face(const std::vector<std::uint32_t>& ring,
                         std::vector<CornerIndices>& cut) const {
    cut.clear();
    if (ring.size() < 3) return Triangulation::convex_fan;
    if (ring.size() == 3) {
      cut.push_back({0, 1, 2});
      return Triangulation::convex_fan;
    }
    std::vector<MeshPoint> points;
    points.reserve(ring.size());
    for (const std::uint32_t vertex : ring) points.push_back((*vertices_)[vertex]);
    return triangulate_face(points, cut);
  }

  /// visit(face, corners) for `count` triangles from `first` on, corners as numbers of vertices.
  template <class Visit>
  void walk(std::uint32_t first, std::uint32_t count, std::size_t window,
            const Visit& visit) const {
    const std::uint64_t end = std::uint64_t{first} + count;
    std::vector<CornerIndices> cut;
    walk_faces(
        first, count, window,
        [&](std::uint64_t triangle, std::uint64_t face, const std::vector<std::uint32_t>& ring) {
          if (triangle + triangles_of(ring.size()) <= first) return;
          cut_face(ring, cut);
          for (const auto& [a, b, c] : cut) {
            if (triangle >= first && triangle < end)
              visit(static_cast<std::uint32_t>(face), {ring[a], ring[b], ring[c]});
            ++triangle;
          }
        });
  }

  /// visit(first triangle, face, ring) for the faces that triangles [first, first + count) come
  /// from, and for some before them.
  template <class Visit>
  void walk_faces(std::uint32_t first, std::uint32_t count, std::size_t window,
                  const Visit& visit) const {
    if (count == 0) return;
    if (scan_.big_endian) {
      walk_rows<true>(first, count, window, visit);
    } else {
      walk_rows<false>(first, count, window, visit);
    }
  }

  template <bool big_endian, class Visit>
  void walk_rows(std::uint32_t first, std::uint32_t count, std::size_t window,
                 const Visit& visit) const {
    using Rows = BinaryRows<big_endian>;
    const std::uint64_t end = std::uint64_t{first} + count;
    FacePlace here = scan_.faces.before(first);
    PlyRowReader<Rows> reader(
        Rows(ByteWindow(*file_, here.offset, scan_.faces.end().offset, window), file_->name()),
        vertex_count_);
    std::vector<std::uint32_t> ring;
    while (here.triangle < end) {
      reader.read_face(scan_.face_element, scan_.indices, ring);
      visit(here.triangle, here.face, ring);
      here.triangle += triangles_of(ring.size());
      ++here.face;
    }
  }

  std::unique_ptr<RandomAccessFile> file_;
  Scan scan_;
  std::uint64_t vertex_count_;
  std::unique_ptr<PlyVertices> vertices_;
  std::optional<Bounds> bounds_;
};

template <bool big_endian>
void scan_file(const RandomAccessFile& file, const PlyHeader& header, Scan& scan,
               Warnings& warnings) {
  using Rows = BinaryRows<big_endian>;
  scan.big_endian = big_endian;
  ScanSink sink(scan, file);
  Rows rows(ByteWindow(file, header.size, file.size(), window_size), file.name());
  PlyBody<Rows, ScanSink>(std::move(rows), header, file.name(), false, sink).read(warnings);
}

}  // namespace

std::unique_ptr<TriangleStream> open_ply_stream(std::unique_ptr<RandomAccessFile> file,
                                                const PlyHeader& header, Warnings& warnings) {
  Scan scan;
  if (header.encoding == PlyHeader::Encoding::big_endian) {
    scan_file<true>(*file, header, scan, warnings);
  } else {
    scan_file<false>(*file, header, scan, warnings);
  }
  const std::uint64_t vertices = header.find("vertex")->count;
  return std::make_unique<PlyStream>(std::move(file), std::move(scan), vertices, warnings);
}

}  // namespace fathom::mesh_files
