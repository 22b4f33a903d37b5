#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "fathom/rays/exact_ray.h"
#include "fathom/rays/ray_tree.h"
#include "fathom/rays/walk_ray.h"

namespace fathom::rays {

/// The question about a ray.
enum class Question { nearest, any, all };

/// The hits of a ray, as a walk finds them: doubtful triangles and limits are settled exactly when
/// they are offered, the order of hits at the end.
class Candidates final : public TriangleVisitor {
 public:
  Candidates(const TriangleSource& source, const RayTree& tree, const CastOptions& options,
             Question question)
      : source_(source), tree_(tree), options_(options), question_(question) {}

  /// Forgets all hits and begins with a ray; both arguments must stay unchanged meanwhile.
  void begin(const Ray& given, const WalkRay& ray);

  bool offer(const TestedTriangle& triangle) override;

  struct Hit {
    std::uint32_t triangle = 0;
    /// The triangle that it repeats, or itself, and where the tree has that.
    std::uint32_t first = 0;
    std::size_t place = 0;
    /// The sign of n·d.
    Sign side = Sign::zero;
    /// Contains s.
    Interval s;
  };
  /// The hits that were found, in no order: all if the question is for all. Else further hits and
  /// repeated triangles are missing.
  [[nodiscard]] const std::vector<Hit>& hits() const { return hits_; }

  /// The hit with the least t, among equals the lowest number; nullopt if there is none.
  [[nodiscard]] std::optional<Hit> nearest();
  /// Sorts hits() by t, then by number.
  void sort();
  /// t of a hit, exactly.
  [[nodiscard]] const Ratio& exact_t(const Hit& hit);

 private:
  [[nodiscard]] const ExactRay& exact_ray();
  [[nodiscard]] std::optional<Hit> settle(const TestedTriangle& triangle);
  [[nodiscard]] bool is_before(const Hit& a, const Hit& b);

  const TriangleSource& source_;
  const RayTree& tree_;
  const CastOptions& options_;
  Question question_;

  const Ray* given_ = nullptr;
  const WalkRay* ray_ = nullptr;
  std::optional<ExactRay> exact_ray_;
  std::vector<Hit> hits_;
  /// Each is computed once, however often it is compared; by Hit::first.
  std::unordered_map<std::uint32_t, Ratio> exact_ts_;
  /// The least upper end of the s of a hit; last() follows from it.
  double least_upper_ = 0;
};

}  // namespace fathom::rays
