#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <vector>

#include "fathom/fast/rounds/distinct_vertices.h"
#include "fathom/fast/rounds/kept_triangles.h"
#include "fathom/fast/tiles/frame.h"

namespace fathom::fast {

/// Triangles that were kept, put together again and sorted into tiles. Those of an object of the
/// scene are one object here, too, with vertices that they share, so that edges between triangles
/// that were kept apart are known to be between them.
class GatheredTriangles {
 public:
  /// Room for so many more triangles of an object.
  void reserve(std::uint32_t object, const KeptSize& more);
  void add(const KeptTriangles& kept);
  /// All of them, none of which is left there.
  void take(std::vector<KeptTriangles>& kept);
  /// What has been added, no triangle twice, into bins for at most `parts` parts. Once, after the
  /// last add().
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

  /// Several for an object only where one would have more vertices than can be numbered.
  std::deque<Part> parts_;
  /// For each object of the scene the part that triangles are added to.
  std::map<std::uint32_t, Part*> part_of_;
  ImageObjects objects_;
  std::vector<Bins> bins_;
};

}  // namespace fathom::fast
