#include "validation/rays/ray_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "fathom/rays/cast.h"
#include "fathom/scene/scene.h"
#include "validation/rays/touched_triangles.h"
#include "validation/scenes/shapes.h"

namespace fathom::validation {
namespace {

using attribution::WorldMesh;
using Signs = std::array<double, 3>;

constexpr Signs unmirrored{1, 1, 1};

std::vector<Signs> mirrors() {
  std::vector<Signs> all;
  for (int k = 1; k < 8; ++k)
    all.push_back(
        {(k & 1) != 0 ? -1.0 : 1.0, (k & 2) != 0 ? -1.0 : 1.0, (k & 4) != 0 ? -1.0 : 1.0});
  return all;
}

Scene mirrored(const WorldMesh& mesh, const Signs& signs) {
  std::vector<MeshPoint> points;
  for (const auto& p : mesh.points)
    points.push_back({signs[0] * p[0], signs[1] * p[1], signs[2] * p[2]});
  Mesh made;
  made.vertices = std::move(points);
  made.triangles = mesh.triangles;
  return bench::as_scene({std::move(made)}, "mesh");
}

std::vector<Ray> mirrored(std::vector<Ray> rays, const Signs& signs) {
  for (Ray& ray : rays) {
    for (std::size_t k = 0; k < 3; ++k) {
      ray.origin[k] *= signs[k];
      ray.direction[k] *= signs[k];
    }
  }
  return rays;
}

/// The distance of t from the true t, in steps of binary32 there.
double steps_between(double t, double truth) {
  const auto near = static_cast<float>(truth);
  const double step = static_cast<double>(std::nextafter(near, std::numeric_limits<float>::max())) -
                      static_cast<double>(near);
  return std::abs(t - truth) / step;
}

bool has_hit(const RayHit& hit) {
  return hit.triangle != no_triangle;
}

}  // namespace

const char* name_of(RayVerdict verdict) {
  constexpr std::array<const char*, verdict_count> names{"right",    "tie",    "lost",
                                                         "invented", "behind", "beside"};
  return names.at(static_cast<std::size_t>(verdict));
}

bool is_fault(RayVerdict verdict) {
  return verdict != RayVerdict::right && verdict != RayVerdict::tie;
}

std::size_t JudgedRays::faults() const {
  std::size_t sum = 0;
  for (std::size_t k = 0; k < verdict_count; ++k)
    if (is_fault(static_cast<RayVerdict>(k))) sum += counts[k];
  return sum;
}

struct RayJudge::Parts {
  const RayCase& given;
  int threads;
  TouchedTriangles touched;
  std::vector<RayHit> truth;
  std::vector<std::uint32_t> counts;
  /// Whether the ray touches no edge and no corner.
  std::vector<bool> is_plain;

  Parts(const RayCase& rays, int thread_count)
      : given(rays), threads(thread_count), touched(rays.mesh) {
    const Scene scene = mirrored(given.mesh, unmirrored);
    const RayScene prepared(scene, threads);
    truth = cast(prepared, given.rays, {.threads = threads});
    counts = count_hits(prepared, given.rays, {.threads = threads});
    const std::vector<std::uint32_t> opposite = opposite_counts();
    for (std::size_t i = 0; i < given.rays.size(); ++i)
      is_plain.push_back(opposite[i] == counts[i] && touched.count(given.rays[i]) == counts[i]);
  }

  /// How many triangles the rays meet if they are moved to the other side of all edges. A ray that
  /// touches an edge or a corner leaves a triangle then, or touches more than it meets.
  [[nodiscard]] std::vector<std::uint32_t> opposite_counts() const {
    const Scene scene = mirrored(given.mesh, {-1, -1, -1});
    return count_hits(RayScene(scene, threads), mirrored(given.rays, {-1, -1, -1}),
                      {.threads = threads});
  }

  /// The hits of some rays, moved by an infinitely small step: (±ε, ±ε², ±ε³), each but that of the
  /// specification. A mirrored scene has the ties of the other signs.
  [[nodiscard]] std::vector<std::vector<RayHit>> moved_hits(
      const std::vector<std::size_t>& numbers) const {
    std::vector<Ray> rays;
    rays.reserve(numbers.size());
    for (const std::size_t i : numbers) rays.push_back(given.rays[i]);
    std::vector<std::vector<RayHit>> hits;
    if (rays.empty()) return hits;
    for (const Signs& signs : mirrors()) {
      const Scene scene = mirrored(given.mesh, signs);
      const RayScene prepared(scene, threads);
      hits.push_back(cast(prepared, mirrored(rays, signs), {.threads = threads}));
    }
    return hits;
  }

  /// Of a ray whose answer has another triangle than the truth has.
  [[nodiscard]] RayVerdict fault_of(std::size_t i, const RayHit& answer) const {
    if (!has_hit(answer)) return RayVerdict::lost;
    const bool touches = touched.touches(given.rays[i], answer.triangle);
    if (!has_hit(truth[i])) return touches ? RayVerdict::tie : RayVerdict::invented;
    if (!touches) return RayVerdict::beside;
    const std::optional<int> order =
        touched.order(given.rays[i], answer.triangle, truth[i].triangle);
    return order && *order > 0 ? RayVerdict::behind : RayVerdict::tie;
  }

  void judge_counts(const EngineAnswers& answers, JudgedRays& judged) const {
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (!is_plain[i]) continue;
      ++judged.counts_judged;
      if (answers.counts[i] < counts[i]) ++judged.counts_too_low;
      if (answers.counts[i] > counts[i]) ++judged.counts_too_high;
    }
  }
};

RayJudge::RayJudge(const RayCase& rays, int threads)
    : parts_(std::make_unique<Parts>(rays, threads)) {}

RayJudge::~RayJudge() = default;

JudgedRays RayJudge::judge(const EngineAnswers& answers) const {
  JudgedRays judged;
  judged.truth = parts_->truth;
  judged.verdicts.assign(judged.truth.size(), RayVerdict::right);
  std::vector<std::size_t> doubtful;
  for (std::size_t i = 0; i < judged.truth.size(); ++i) {
    const RayHit &answer = answers.nearest[i], &truth = judged.truth[i];
    if (answer.triangle == truth.triangle) {
      if (!has_hit(truth)) continue;
      const double steps = steps_between(answer.t, truth.t);
      judged.greatest_error_of_t = std::max(judged.greatest_error_of_t, steps);
      continue;
    }
    judged.verdicts[i] = parts_->fault_of(i, answer);
    if (is_fault(judged.verdicts[i]) && !parts_->is_plain[i]) doubtful.push_back(i);
  }
  for (const std::vector<RayHit>& hits : parts_->moved_hits(doubtful)) {
    for (std::size_t k = 0; k < doubtful.size(); ++k) {
      const std::size_t i = doubtful[k];
      if (hits[k].triangle == answers.nearest[i].triangle) judged.verdicts[i] = RayVerdict::tie;
    }
  }
  for (const RayVerdict verdict : judged.verdicts)
    ++judged.counts[static_cast<std::size_t>(verdict)];
  parts_->judge_counts(answers, judged);
  return judged;
}

}  // namespace fathom::validation
