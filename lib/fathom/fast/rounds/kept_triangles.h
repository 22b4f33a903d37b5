#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <vector>

#include "fathom/fast/bins/bins.h"
#include "fathom/fast/tiles/frame.h"
#include "fathom/files/spill_file.h"
#include "fathom/scene/scene.h"
#include "fathom/scene/triangle_source.h"

namespace fathom::fast {

/// Vertices of a mesh that is assembled; no two are the same point, bit for bit. Files with three
/// vertices for each triangle become meshes with a sixth of the vertices, and the numbers of their
/// ends show which edges lie between triangles.
class DistinctVertices {
 public:
  void reserve(std::size_t count);
  [[nodiscard]] std::size_t size() const { return vertices_.size(); }
  /// Adds a point unless it is there; its number.
  std::uint32_t number_of(const MeshPoint& point);
  /// Returns all vertices, by their numbers, and removes them from here.
  std::vector<MeshPoint> take();

 private:
  void grow_slots(std::size_t vertices);
  /// The slot of a point, or where it would be.
  [[nodiscard]] std::size_t slot_of(const MeshPoint& point) const;

  std::vector<MeshPoint> vertices_;
  /// Numbers; at least half of the slots are empty. The size is a power of two.
  std::vector<std::uint32_t> slots_;
};

/// Some triangles of an object of the scene, taken out of where they were sorted into tiles.
struct KeptTriangles {
  /// Which object of the scene.
  std::uint32_t object = 0;
  /// No two vertices are the same point.
  Mesh mesh;
  /// Their numbers in the scene.
  std::vector<std::uint32_t> numbers;
};

/// Of triangles that are kept.
struct KeptSize {
  std::uint64_t vertices = 0, triangles = 0;

  [[nodiscard]] bool is_nothing() const { return triangles == 0; }
  /// Their approximate size in bytes while they are reassembled and sorted into tiles again: their
  /// corners, the table that finds corners, the corners in the image, and the places of triangles
  /// in tiles.
  [[nodiscard]] std::uint64_t bytes_in_use() const {
    constexpr std::uint64_t to_find = 16, per_place = 24;
    return vertices * (sizeof(MeshPoint) + to_find + sizeof(ImageVertex)) +
           triangles * (sizeof(CornerIndices) + sizeof(std::uint32_t) + per_place);
  }
  KeptSize& operator+=(const KeptSize& more) {
    vertices += more.vertices;
    triangles += more.triangles;
    return *this;
  }
};
KeptSize size_of(const KeptTriangles& kept);

/// The triangles that bins have in any of the tiles, each once, object by object; `objects` are the
/// objects that were sorted into these bins.
std::vector<KeptTriangles> triangles_in_tiles(const ImageObjects& objects,
                                              std::span<const Bins> bins,
                                              std::span<const std::uint32_t> tiles,
                                              const TriangleSource& triangles);

/// Kept triangles, reassembled and sorted into tiles. The triangles of an object of the scene form
/// a single object here too, with shared vertices, so that common edges of separately kept
/// triangles are recognised.
class GatheredTriangles {
 public:
  /// Makes room for so many more triangles of an object.
  void reserve(std::uint32_t object, const KeptSize& more);
  void add(const KeptTriangles& kept);
  /// Adds all of them and empties the list.
  void take(std::vector<KeptTriangles>& kept);
  /// Sorts all added triangles into bins for at most `parts` parts. Call it once, after the last
  /// add(); no triangle may have been added twice.
  void sort(std::uint32_t parts, const TriangleSource& triangles, const FastFrame& frame,
            FastWorkers& workers);

  // Once they are sorted:
  [[nodiscard]] const ImageObjects& objects() const { return objects_; }
  [[nodiscard]] const std::vector<Bins>& bins() const { return bins_; }

 private:
  struct Part {
    KeptTriangles triangles;
    /// Until they are sorted.
    DistinctVertices vertices;
  };
  Part& part_for(std::uint32_t object, std::size_t vertices);

  /// An object has several parts only if one part would have more vertices than can be numbered.
  std::deque<Part> parts_;
  /// For each object of the scene, the part to which triangles are added.
  std::map<std::uint32_t, Part*> part_of_;
  ImageObjects objects_;
  std::vector<Bins> bins_;
};

/// Triangles that are stored on disk, in buckets that are read separately. A record remains in
/// memory for each addition to a bucket.
/// Fails    as SpillFile.
class SpilledTriangles {
 public:
  explicit SpilledTriangles(std::size_t buckets) : buckets_(buckets) {}
  /// Several threads may add to different buckets at the same time.
  void add(std::size_t bucket, std::span<const KeptTriangles> kept);
  [[nodiscard]] KeptSize size_of_bucket(std::size_t bucket) const;
  /// Everything in a bucket.
  void gather(std::size_t bucket, GatheredTriangles& to) const;
  /// Calls visit(triangles) for all in a bucket, as they were added.
  template <class Visit>
  void for_each(std::size_t bucket, const Visit& visit) const {
    for (const Block& block : buckets_[bucket]) visit(read(block));
  }

 private:
  struct Block {
    std::uint64_t offset;
    std::uint32_t object, vertices, triangles;
  };
  [[nodiscard]] KeptTriangles read(const Block& block) const;

  files::SpillFile file_;
  std::vector<std::vector<Block>> buckets_;
};

}  // namespace fathom::fast
