#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include "fathom/area/convex_union.h"
#include "fathom/area/image_cell.h"
#include "fathom/area/plane/certain_sides.h"
#include "fathom/area/plane/line_sweep.h"
#include "fathom/area/plane/resolve.h"
#include "fathom/numeric/exact_words.h"

/// Areas of boundaries as sums over their segments, on the image and on the surface itself.
namespace fathom::area {

/// Terms whose sum is a quantity. They are not added at once: the exact sum has a long denominator,
/// and an enclosure of the sum mostly decides its rounding.
using Terms = std::vector<Ratio>;

/// Quantities of a part of a triangle A, B, C. A point of the triangle is A + β(B − A) + γ(C − A).
struct SurfaceTerms {
  /// The area on the image, in pixels.
  Terms image;
  /// The part's share of the area of the triangle, on the surface: 2∫∫ dβ dγ, with a minus sign if
  /// the triangle's corners go round the other way.
  Terms share;
  /// 6∫∫ β dβ dγ and 6∫∫ γ dβ dγ, with that sign.
  Terms beta, gamma;
};

void append(SurfaceTerms& all, SurfaceTerms&& some);

/// The sums of share, beta and gamma in double-words with bounds.
struct SurfaceSums {
  Words share{0.0, 0}, beta{0.0, 0}, gamma{0.0, 0};

  SurfaceSums() = default;
  explicit SurfaceSums(const SurfaceTerms& terms)
      : share(sum_in_words(terms.share)),
        beta(sum_in_words(terms.beta)),
        gamma(sum_in_words(terms.gamma)) {}
  SurfaceSums& operator+=(const SurfaceSums& other) {
    share = share + other.share;
    beta = beta + other.beta;
    gamma = gamma + other.gamma;
    return *this;
  }
};

/// The quantities to compute: exact terms, or sums, which take a tenth of the time.
struct WantedTerms {
  bool image = true, share = false, moments = false, sums = false;
  [[nodiscard]] bool on_surface() const { return share || moments; }
};

/// A surface and the part of the image in which it is measured.
struct SurfaceOnPart {
  const SurfaceRegion& surface;
  /// The coordinates of lines begin at its left top corner.
  const PlanePart& part;
};

/// Adds the terms of the area on the image that a boundary encloses.
void add_image_terms(SurfaceTerms& terms, const Boundary& boundary);
/// Adds the terms on the surface.
void add_surface_terms(SurfaceTerms& terms, const Boundary& boundary, const SurfaceOnPart& on,
                       const WantedTerms& wanted);

/// The visibility of a triangle as a whole.
enum class Visibility : std::uint8_t { hidden, whole, partly };

/// The visible parts of the triangles of a mesh within the image, exactly. Combinatorics by parts
/// find the visibility of each triangle; triangles that are partly visible have terms of areas. A
/// triangle that is visible wherever it is in all parts is visible as a whole, without arithmetic.
class PlaneAreas {
 public:
  /// The number of calls of `part_done`.
  static constexpr std::uint64_t parts = 64;
  PlaneAreas(
      const PlaneMesh& mesh, const WantedTerms& wanted,
      const std::function<void()>& part_done = [] {});

  /// The visibility of triangle i of the mesh. A triangle that reaches beyond the image is at most
  /// `partly` visible, and so is a triangle of kind by_forms.
  [[nodiscard]] Visibility visibility(std::uint32_t i) const { return visibility_[i]; }
  /// The terms of the visible part of triangle i; empty if it is wholly visible or hidden.
  [[nodiscard]] const SurfaceTerms& terms(std::uint32_t i) const;
  /// The same, which are forgotten.
  [[nodiscard]] SurfaceTerms take_terms(std::uint32_t i);
  /// The sums of the visible part of triangle i, if it is partly visible.
  [[nodiscard]] const SurfaceSums& sums(std::uint32_t i) const { return sums_[place_[i]]; }
  [[nodiscard]] const ResolvedParts& resolved() const { return resolved_; }
  /// Replaces the terms of the partly visible triangles i with wanted[i] by other terms. Looks only
  /// at the parts in which these triangles are.
  void find_terms(const WantedTerms& terms, std::vector<bool> wanted);

 private:
  void add_parts(const std::function<void()>& part_done);
  void find_whole();
  void add_crowded(const CrowdedPart& crowded);
  /// Returns false, and does nothing, if there are too many lines.
  bool sweep(const CrowdedPart& crowded);
  /// Along edges, as long as that separates triangles.
  void divide_crowd(const CrowdedPart& crowded);
  void add_clip(const VisibleClip& clip);
  void add_sums(const CrowdedPart& crowded, const PartLines& lines,
                const std::vector<LineSweep::Span>& spans);
  void add_terms(std::uint32_t i, const Boundary& boundary, const SurfaceOnPart& on,
                 const WantedTerms& wanted);
  void note_hidden(std::uint32_t i);
  [[nodiscard]] bool is_wanted(const std::vector<std::uint32_t>& triangles) const;
  void add(std::uint32_t i, SurfaceTerms&& terms, const SurfaceSums& sums);

  const PlaneMesh& mesh_;
  WantedTerms wanted_;
  ResolvedParts resolved_;
  std::vector<Visibility> visibility_;
  /// The triangles to measure.
  std::vector<bool> of_;
  /// Whether something of a triangle may be hidden in some crowded part.
  std::vector<std::uint8_t> is_hidden_;
  std::vector<SurfaceTerms> terms_;
  std::vector<SurfaceSums> sums_;
  /// Where the terms and sums of a triangle are.
  std::vector<std::uint32_t> place_;
  /// Mutexes for the terms; enough that threads seldom wait for each other.
  std::array<std::mutex, 64> mutexes_;
};

/// The area of a triangle within the image with all other triangles removed; 0 if culling removes
/// the triangle.
Ratio unoccluded_area(const ProjectedScene& scene, std::uint32_t number);

}  // namespace fathom::area
