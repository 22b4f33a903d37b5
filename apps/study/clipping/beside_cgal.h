#pragma once

#include <cstddef>
#include <string>
#include <vector>

/// Weiler–Atherton beside CGAL's Boolean set operations: their answers, which are exact, and their
/// times, which are this machine's.
namespace fathom::studies {

/// Pairs of polygons of one kind and about one size, and what both make of them.
struct BesideCgal {
  std::string kind;
  std::size_t corners = 0;  ///< of both polygons of all pairs
  std::size_t pairs = 0;
  std::size_t polygons = 0;   ///< in all answers of Weiler–Atherton, to both operations
  std::size_t different = 0;  ///< answers that are not the same list of polygons
  /// For all pairs and both operations: the fastest of three rounds, or the only one where that
  /// takes long.
  double ours_ms = 0, cgal_ms = 0;

  [[nodiscard]] double ratio() const { return cgal_ms / ours_ms; }
};

/// The kinds of pairs, in the order of the page:
///   stars     two rings of random radii, in general position
///   grid      pairs of random rings of whole numbers from 0 to 6, which share corners and edges
///   squares   rows of squares, and the same moved by half a square
///   nested    squares in each other, and a triangle that cuts them
///   fan       triangles about one point, and a square that cuts them
const std::vector<std::string>& kinds_beside_cgal();

/// Pairs of about `corners` corners altogether. The same pairs for the same arguments.
BesideCgal measure_beside_cgal(const std::string& kind, std::size_t corners);

}  // namespace fathom::studies
