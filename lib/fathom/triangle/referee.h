#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>

#include "fathom/lens/exact_direction.h"
#include "fathom/rendering/rendered.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/triangle/double_word_referee.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::triangle {

/// A cache of the exact triangles that a referee used last: about 5 kB each.
class RememberedTriangles {
 public:
  RememberedTriangles(const TriangleSource& triangles, const Camera& camera)
      : triangles_(triangles), camera_(camera) {}

  /// Forgets everything if there is no room for two more.
  void make_room() {
    if (remembered_.size() + 2 > most) remembered_.clear();
  }
  /// Valid until make_room().
  const ProjectedTriangle& get(std::uint32_t number) {
    auto& slot = remembered_[number];
    if (!slot) {
      TierCounts counted_before;  // facing is counted when triangles are binned
      slot = std::make_unique<ProjectedTriangle>(
          project(triangles_.world_corners(number), number, camera_, counted_before));
    }
    return *slot;
  }

 private:
  static constexpr std::size_t most = 2048;

  TriangleSource triangles_;
  const Camera& camera_;
  std::unordered_map<std::uint32_t, std::unique_ptr<ProjectedTriangle>> remembered_;
};

/// Settles decisions that a bound left open with exact numbers. One for each thread, because it
/// caches the triangles that it used last.
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
  /// The last pair, lower number first, and whether they lie in one plane.
  std::uint32_t first_ = 0, second_ = 0;
  bool same_plane_ = false;
};

/// The referee of a camera that bends rays: settles decisions that a bound left open with exact
/// numbers, along the ray of a sample. One for each thread, because it caches the triangles that it
/// used last.
class RayReferee {
 public:
  RayReferee(const TriangleSource& triangles, const Camera& camera)
      : camera_(camera), remembered_(triangles, camera) {}

  /// Valid until the next question.
  const ProjectedTriangle& projected(std::uint32_t number) {
    remembered_.make_room();
    return remembered_.get(number);
  }

  bool covers(std::uint32_t number, const lens::ExactDirection& d, RenderStatistics& statistics);
  /// Whether D > 0 and near ≤ D ≤ far, where the triangle covers the sample; for a camera whose
  /// limits bound ray distances, whether the ray distance is between them.
  bool is_in_range(std::uint32_t number, const lens::ExactDirection& d,
                   RenderStatistics& statistics);
  /// Whether, at a sample that both cover, `a` hides `b`: it is nearer along the ray, or as near
  /// with the lower number.
  bool hides(std::uint32_t a, std::uint32_t b, const lens::ExactDirection& d,
             RenderStatistics& statistics);

 private:
  const Camera& camera_;
  RememberedTriangles remembered_;
};

}  // namespace fathom::triangle
