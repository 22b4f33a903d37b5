#include <algorithm>
#include <memory>
#include <vector>

#include "fathom/mesh/triangulate_face.h"
#include "fathom/mesh_files/ply/ply_body.h"
#include "fathom/mesh_files/ply/ply_face_index.h"
#include "fathom/mesh_files/ply/ply_layout.h"
#include "fathom/mesh_files/streams.h"

// The file is read once, with the rows and checks of the ordinary reader; or, if that is not
// requested, its layout is derived from its size. Only the places of vertices and faces are kept.
// Faces are read again from the file for every request of triangles.
namespace fathom::mesh_files {
using namespace mesh;
using namespace files;

namespace {

constexpr std::size_t window_size = std::size_t{1} << 20;

/// What reading the file through leaves behind.
struct Scan {
  /// The layout that is assumed instead.
  std::optional<PlySupposedTriangles> supposed;
  bool big_endian = false;
  std::optional<PlyVertexLayout> layout;
  /// Used if vertices have list properties.
  PlyVertexList list;
  PlyLabels labels;

  PlyElement face_element;
  PlyFaceColumns columns;
  FaceIndex faces;
  std::uint64_t skipped = 0;

  PlyElement strip_element;
  std::size_t strip_indices = 0;
  StripIndex strips;
  bool strips_first = false;
  /// Which vertices belong to a triangle; those beyond its end do not.
  std::vector<bool> used;
};

/// Takes notes while PlyBody reads and checks.
class ScanSink {
 public:
  ScanSink(Scan& scan, const RandomAccessFile& file) : scan_(scan), file_(file) {}

  template <class Has, class Rows>
  void begin_vertices(const PlyElement& element, const Has&, const Rows& rows) {
    lists_ = element.has_lists();
    if (lists_) return;
    scan_.layout =
        layout_of_vertices(element, rows.position(), scan_.big_endian, scan_.labels.in_vertex);
  }
  void vertex(const PlyVertex& row) {
    if (!lists_) return;
    scan_.list.points.push_back({row[0], row[1], row[2]});
    if (scan_.labels.in_vertex)
      scan_.list.labels.push_back(static_cast<std::uint32_t>(row[slot_label]));
  }

  template <class Rows>
  void begin_faces(const PlyElement& element, const PlyFaceColumns& columns, std::uint64_t,
                   const Rows& rows) {
    scan_.face_element = element;
    scan_.columns = columns;
    scan_.faces.begin(rows.position());
  }
  template <class Rows>
  void face(const PlyFace& face, const Rows& rows) {
    const std::vector<std::uint32_t>& ring = face.ring;
    scan_.faces.add(ring.size(), rows.position());
    expect_numbers();
    if (ring.size() < 3) {
      ++scan_.skipped;
      return;
    }
    for (const std::uint32_t vertex : ring) note_used(vertex);
  }

  void begin_strips(const PlyElement& element, std::size_t indices) {
    scan_.strip_element = element;
    scan_.strip_indices = indices;
    scan_.strips_first = scan_.face_element.name.empty();
  }
  template <class Rows>
  void strip_corner(const PlyStrip& strip, std::uint64_t row, const Rows& rows) {
    scan_.strips.add_corner(strip, row, rows.position());
  }
  void strip_triangle(const CornerIndices& corners) {
    scan_.strips.add_triangle();
    expect_numbers();
    for (const std::uint32_t vertex : corners) note_used(vertex);
  }

 private:
  void expect_numbers() const {
    const FacePlace& end = scan_.faces.end();
    if (scan_.strips.triangles() + end.triangle > most_elements ||
        scan_.strips.triangles() + end.face > most_elements)
      fail_too_many_triangles(file_.name());
  }

  void note_used(std::uint32_t vertex) {
    // A vertex takes at least three bytes; missing vertices are noticed when they are read.
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

/// The vertices of a chunk, each only once if its uses follow each other closely.
class ChunkVertices {
 public:
  ChunkVertices(const PlyVertices& all, MeshArray<MeshPoint>& chunk)
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
  MeshArray<MeshPoint>& chunk_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> recent_;
};

class PlyStream : public TriangleStream {
 public:
  PlyStream(std::unique_ptr<RandomAccessFile> file, Scan scan, std::uint64_t vertex_count,
            bool map_vertices, Warnings& warnings)
      : file_(std::move(file)),
        scan_(std::move(scan)),
        vertex_count_(vertex_count),
        vertices_(scan_.layout ? std::make_unique<PlyVertices>(*file_, *scan_.layout, map_vertices)
                               : std::make_unique<PlyVertices>(std::move(scan_.list))) {
    find_bounds();
    warn_of_faces(scan_.skipped, count_odd_shapes(), file_->name(), warnings);
  }

  [[nodiscard]] std::uint32_t triangle_count() const override {
    return static_cast<std::uint32_t>(scan_.faces.end().triangle + scan_.strips.triangles());
  }
  [[nodiscard]] std::uint64_t face_count() const override {
    return scan_.faces.end().face + scan_.strips.triangles();
  }
  [[nodiscard]] std::optional<Bounds> bounds() const override { return bounds_; }

  [[nodiscard]] TriangleChunk read(std::uint32_t first, std::uint32_t count) const override {
    first = std::min(first, triangle_count());
    count = std::min(count, triangle_count() - first);
    TriangleChunk chunk{.first = first, .mesh = {}};
    Mesh& mesh = chunk.mesh;
    mesh.triangles.reserve(count);
    ChunkVertices vertices(*vertices_, mesh.vertices);
    walk(first, count, Reading::many, [&](Origin from, const CornerIndices& t) {
      mesh.triangles.push_back(
          {vertices.number_of(t[0]), vertices.number_of(t[1]), vertices.number_of(t[2])});
      if (!scan_.faces.triangles_only()) mesh.face_of_triangle.push_back(from.face);
    });
    file_->expect_unchanged();
    return chunk;
  }

  [[nodiscard]] Triangle triangle(std::uint32_t number) const override {
    Triangle result;
    walk(number, 1, Reading::one, [&](Origin from, const CornerIndices& t) {
      result = {{(*vertices_)[t[0]], (*vertices_)[t[1]], (*vertices_)[t[2]]}, from.face};
    });
    file_->expect_unchanged();
    return result;
  }

  [[nodiscard]] std::uint32_t face_of(std::uint32_t number) const override {
    return scan_.faces.triangles_only() ? number : triangle(number).face;
  }

  [[nodiscard]] bool check_part(std::uint64_t part, std::uint64_t parts) const override {
    return !scan_.supposed || scan_.supposed->check(*file_, part, parts);
  }

  [[nodiscard]] std::uint32_t label_of(std::uint32_t number) const override {
    std::uint32_t label = unsegmented;
    if (!scan_.labels.in_face && !vertices_->have_labels()) return label;
    walk(number, 1, Reading::one, [&](Origin from, const CornerIndices& t) {
      label = from.label;
      if (vertices_->have_labels())
        label =
            common_label(vertices_->label(t[0]), vertices_->label(t[1]), vertices_->label(t[2]));
    });
    file_->expect_unchanged();
    return label;
  }

 private:
  /// The face that a triangle comes from, and the face's label.
  struct Origin {
    std::uint32_t face = 0, label = unsegmented;
  };

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

  /// The number of faces that are cut into a fan in spite of their shape.
  [[nodiscard]] std::uint64_t count_odd_shapes() const {
    if (!scan_.faces.has_polygons()) return 0;
    std::uint64_t odd = 0;
    std::vector<CornerIndices> cut;
    walk_faces(0, scan_.faces.end().triangle, window_size,
               [&](std::uint64_t, std::uint64_t, const PlyFace& face) {
                 if (cut_face(face.ring, cut) == Triangulation::fallback_fan) ++odd;
               });
    return odd;
  }

  /// Cuts a face into triangles, as numbers of corners.
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

  enum class Reading { one, many };

  /// Calls visit(origin, corners) for `count` triangles from `first` on, corners being numbers of
  /// vertices: triangles of faces and of strips, in the order of the file.
  template <class Visit>
  void walk(std::uint32_t first, std::uint32_t count, Reading reading, const Visit& visit) const {
    const FacePlace& faces = scan_.faces.end();
    const std::uint64_t strips = scan_.strips.triangles(), end = std::uint64_t{first} + count;
    const auto walk_strips_from = [&](std::uint64_t triangle, std::uint64_t face) {
      walk_strips(part_of(first, end, triangle, strips), reading,
                  [&](std::uint64_t t, const CornerIndices& corners) {
                    visit({.face = static_cast<std::uint32_t>(face + t)}, corners);
                  });
    };
    if (scan_.strips_first) walk_strips_from(0, 0);
    const std::uint64_t before = scan_.strips_first ? strips : 0;
    walk_cut_faces(part_of(first, end, before, faces.triangle), reading,
                   [&](std::uint64_t face, std::uint32_t label, const CornerIndices& corners) {
                     visit({static_cast<std::uint32_t>(before + face), label}, corners);
                   });
    if (!scan_.strips_first) walk_strips_from(faces.triangle, faces.face);
  }

  struct Part {
    std::uint64_t first = 0, end = 0;
    [[nodiscard]] bool empty() const { return first >= end; }
  };

  /// What triangles [first, end) have in common with `count` ones from `start` on, as numbers
  /// among those.
  static Part part_of(std::uint64_t first, std::uint64_t end, std::uint64_t start,
                      std::uint64_t count) {
    return {std::max(first, start) - start, std::min(std::max(end, start) - start, count)};
  }

  template <class Visit>
  void walk_cut_faces(Part part, Reading reading, const Visit& visit) const {
    if (part.empty()) return;
    const std::size_t window = reading == Reading::one ? scan_.faces.reach() : window_size;
    std::vector<CornerIndices> cut;
    walk_faces(part.first, part.end, window,
               [&](std::uint64_t triangle, std::uint64_t number, const PlyFace& face) {
                 const std::vector<std::uint32_t>& ring = face.ring;
                 if (triangle + triangles_of(ring.size()) <= part.first) return;
                 cut_face(ring, cut);
                 for (const auto& [a, b, c] : cut) {
                   if (triangle >= part.first && triangle < part.end)
                     visit(number, face.label, {ring[a], ring[b], ring[c]});
                   ++triangle;
                 }
               });
  }

  /// Calls visit(first triangle, number, face) for the faces that triangles [first, end) come from,
  /// and for some before them.
  template <class Visit>
  void walk_faces(std::uint64_t first, std::uint64_t end, std::size_t window,
                  const Visit& visit) const {
    if (first == end) return;
    if (scan_.big_endian) {
      walk_rows<true>(first, end, window, visit);
    } else {
      walk_rows<false>(first, end, window, visit);
    }
  }

  template <bool big_endian, class Visit>
  void walk_rows(std::uint64_t first, std::uint64_t end, std::size_t window,
                 const Visit& visit) const {
    FacePlace here = scan_.faces.before(first);
    auto reader = reader_at<big_endian>(here.offset, scan_.faces.end().offset, window);
    PlyFace face;
    while (here.triangle < end) {
      const std::uint64_t offset = reader.rows().position();
      reader.read_face(scan_.face_element, scan_.columns, face);
      if (scan_.supposed && face.ring.size() != 3) fail_supposed(offset);
      visit(here.triangle, here.face, face);
      here.triangle += triangles_of(face.ring.size());
      ++here.face;
    }
  }

  template <bool big_endian>
  [[nodiscard]] PlyRowReader<BinaryRows<big_endian>> reader_at(std::uint64_t offset,
                                                               std::uint64_t end,
                                                               std::size_t window) const {
    return {BinaryRows<big_endian>(ByteWindow(*file_, offset, end, window), file_->name()),
            vertex_count_};
  }

  [[noreturn]] void fail_supposed(std::uint64_t offset) const {
    throw InputError(file_->name() + ": byte " + std::to_string(offset) +
                     ": a face has not three corners, as all have in a file of this size that is "
                     "opened without being looked through");
  }

  /// Calls visit(triangle, corners) for these triangles of the strips.
  template <class Visit>
  void walk_strips(Part part, Reading reading, const Visit& visit) const {
    if (part.empty()) return;
    const std::size_t window = reading == Reading::one ? std::size_t{1} << 12 : window_size;
    if (scan_.big_endian) {
      walk_strip_rows<true>(part, window, visit);
    } else {
      walk_strip_rows<false>(part, window, visit);
    }
  }

  template <bool big_endian, class Visit>
  void walk_strip_rows(Part part, std::size_t window, const Visit& visit) const {
    const auto& properties = scan_.strip_element.properties;
    StripPlace here = scan_.strips.before(part.first);
    auto reader = reader_at<big_endian>(here.offset, file_->size(), window);
    while (here.triangle < part.end) {
      if (here.strip.left == 0) {
        for (std::size_t k = scan_.strip_indices + 1; k < properties.size(); ++k)
          reader.skip(properties[k]);
        for (std::size_t k = 0; k < scan_.strip_indices; ++k) reader.skip(properties[k]);
        here.strip = reader.begin_strip(properties[scan_.strip_indices]);
        continue;
      }
      const auto triangle = reader.next_corner(properties[scan_.strip_indices], here.strip);
      if (!triangle) continue;
      if (here.triangle >= part.first) visit(here.triangle, *triangle);
      ++here.triangle;
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
  PlyBody<Rows, ScanSink>(std::move(rows), header, file.name(), false, scan.labels, sink)
      .read(warnings);
}

/// The result of reading a file in which all faces are triangles, except its bounds.
Scan scan_of(const PlySupposedTriangles& supposed, bool big_endian) {
  Scan scan;
  scan.big_endian = big_endian;
  scan.layout =
      layout_of_vertices(supposed.vertices(), supposed.vertex_offset(), big_endian, std::nullopt);
  scan.face_element = supposed.faces();
  scan.columns = {supposed.indices()};
  scan.faces.begin(supposed.face_offset());
  scan.faces.add_triangles(supposed.faces().count, supposed.face_size());
  scan.supposed = supposed;
  return scan;
}

}  // namespace

std::unique_ptr<TriangleStream> open_ply_stream(std::unique_ptr<RandomAccessFile> file,
                                                const PlyHeader& header, const ReadOptions& options,
                                                Warnings& warnings) {
  Scan scan;
  if (options.segments) scan.labels = find_ply_labels(header, file->name(), warnings);
  const auto supposed = options.check_when_opened || options.segments
                            ? std::nullopt
                            : PlySupposedTriangles::of(header, file->size());
  if (supposed) {
    scan = scan_of(*supposed, header.encoding == PlyHeader::Encoding::big_endian);
  } else if (header.encoding == PlyHeader::Encoding::big_endian) {
    scan_file<true>(*file, header, scan, warnings);
  } else {
    scan_file<false>(*file, header, scan, warnings);
  }
  const std::uint64_t vertices = header.find("vertex")->count;
  return std::make_unique<PlyStream>(std::move(file), std::move(scan), vertices,
                                     options.map_large_files, warnings);
}

}  // namespace fathom::mesh_files
