#pragma once

#include <cstdint>
#include <optional>

#include "fathom/rendering/rendered.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/triangle/double_word_referee.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/remembered_triangles.h"

namespace fathom::triangle {

/// Settles with exact numbers what a bound did not settle. One for each thread: it remembers the
/// triangles that it was asked about last.
class Referee {
 public:
  /// With `rays`, double-words are tried before exact numbers.
  Referee(const TriangleSource& triangles, const Camera& camera, const SceneRays* rays = nullptr)
      : camera_(camera), remembered_(triangles, camera) {
    if (rays) wide_.emplace(*rays);
  }

  /// Valid until the next question.
  const ProjectedTriangle& projected(std::uint32_t number);

  /// The same in double-words, where there are some.
  std::optional<WideForms> wide_forms(std::uint32_t number) {
    return wide_ ? wide_->forms(number) : std::nullopt;
  }

  bool covers(std::uint32_t number, const ImagePoint& s, RenderStatistics& statistics);
  /// Whether D > 0 and near ≤ D ≤ far, at a covered sample.
  bool is_in_range(std::uint32_t number, const ImagePoint& s, RenderStatistics& statistics);
  /// Whether, at a sample that both cover, `a` hides `b`: its D is less, or equal with the lower
  /// number.
  bool hides(std::uint32_t a, std::uint32_t b, const ImagePoint& s, RenderStatistics& statistics);

 private:
  bool lie_in_one_plane(std::uint32_t a, std::uint32_t b);
  std::optional<bool> is_in_range_by_double_words(std::uint32_t number, const ImagePoint& s);

  const Camera& camera_;
  std::optional<WideReferee> wide_;
  RememberedTriangles remembered_;
  /// The pair asked about last, lower number first, and whether they lie in one plane.
  std::uint32_t first_ = 0, second_ = 0;
  bool same_plane_ = false;
};

}  // namespace fathom::triangle
