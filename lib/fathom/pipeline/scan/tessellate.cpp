#include "fathom/pipeline/scan/tessellate.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Triangulation_data_structure_2.h>

#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

using Kernel = CGAL::Simple_cartesian<Exact>;
using Structure =
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<Kernel>,
                                         CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_intersections_tag>;

using Triangle = std::array<Point<Exact>, 3>;

Point<Exact> centroid(const Triangle& t) {
  return {Exact((t[0].x + t[1].x + t[2].x) / Exact(3)),
          Exact((t[0].y + t[1].y + t[2].y) / Exact(3))};
}

}  // namespace

std::vector<std::array<Point<Exact>, 3>> tessellate(const Rings<Exact>& polygon) {
  Triangulation triangulation;
  for (const Ring<Exact>& ring : polygon) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      check_interruption();
      const auto &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if (!(a == b)) triangulation.insert_constraint({a.x, a.y}, {b.x, b.y});
    }
  }
  std::vector<Triangle> triangles;
  if (triangulation.dimension() < 2) return triangles;
  for (const auto face : triangulation.finite_face_handles()) {
    Triangle triangle;
    for (int i = 0; i < 3; ++i) {
      const auto& p = face->vertex(i)->point();
      triangle[static_cast<std::size_t>(i)] = {p.x(), p.y()};
    }
    // Every outline consists of edges of faces, so a face is inside or outside as a whole.
    if (ray_crossings(polygon, centroid(triangle)).count % 2 != 0) triangles.push_back(triangle);
  }
  return triangles;
}

}  // namespace fathom::pipeline
