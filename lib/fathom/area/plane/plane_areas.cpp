#include "fathom/area/plane/plane_areas.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "fathom/area/image_cell.h"
#include "fathom/area/plane/triangle_words.h"
#include "fathom/area/visible_fragments.h"
#include "fathom/threads/interruption.h"

namespace fathom::area {
namespace {

/// The place on a surface of a point of the image: β and γ times σ, and σ.
struct SurfacePoint {
  Dyadic b, c, sigma;
};

ExactVector3 localised(const LinearForm& form, const PlanePart& part) {
  const ExactVector3& l = form.coefficients();
  return {l[0], l[1], form.at(part.left, part.top)};
}

/// The edge functions of B and C, and the sum of all three edge functions, in a cell's coordinates.
/// At the point where two lines cross, homogeneous with the weight turn(line, other), a form has
/// the value det(form, line, other); the weight cancels from β and γ.
class SurfaceForms {
 public:
  explicit SurfaceForms(const SurfaceOnPart& on)
      : b_(localised(on.surface.region[1], on.part)),
        c_(localised(on.surface.region[2], on.part)),
        sigma_(localised(on.surface.weight, on.part)) {}

  [[nodiscard]] SurfacePoint at(const HalfPlane& line, const HalfPlane& other) const {
    const ExactVector3 place = cross(line.exact(), other.exact());
    return {dot(b_, place), dot(c_, place), dot(sigma_, place)};
  }

 private:
  ExactVector3 b_, c_, sigma_;
};

// In the plane of (β, γ), with Green's theorem: 2∫∫ dβ dγ = Σ p × q, and
// 6∫∫ β dβ dγ = Σ (p × q)(β_p + β_q).
void add_term(SurfaceTerms& terms, const SurfacePoint& p, const SurfacePoint& q, bool reversed,
              const WantedTerms& wanted) {
  Dyadic product = p.b * q.c - p.c * q.b;
  if (product.is_zero()) return;
  if (reversed) product = -product;
  const Dyadic weight = p.sigma * q.sigma;
  if (wanted.moments) {
    const Dyadic squared = weight * weight;
    terms.beta.emplace_back(product * (p.b * q.sigma + q.b * p.sigma), squared);
    terms.gamma.emplace_back(product * (p.c * q.sigma + q.c * p.sigma), squared);
  }
  terms.share.emplace_back(std::move(product), weight);
}

}  // namespace

void add_image_terms(SurfaceTerms& terms, const Boundary& boundary) {
  std::vector<Ratio> added = terms_of_area(boundary);
  std::move(added.begin(), added.end(), std::back_inserter(terms.image));
}

void add_surface_terms(SurfaceTerms& terms, const Boundary& boundary, const SurfaceOnPart& on,
                       const WantedTerms& wanted) {
  const SurfaceForms forms(on);
  for (const BoundarySegment& s : boundary) {
    add_term(terms, forms.at(*s.line, *s.from), forms.at(*s.line, *s.to), s.reversed, wanted);
  }
}

namespace {

ImageCell cell_of(const PlanePart& part) {
  return ImageCell(CellRectangle{part.left, part.top, part.right, part.bottom});
}

void append(Terms& all, Terms&& some) {
  if (all.empty()) {
    all = std::move(some);
  } else {
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
}

}  // namespace

void append(SurfaceTerms& all, SurfaceTerms&& some) {
  append(all.image, std::move(some.image));
  append(all.share, std::move(some.share));
  append(all.beta, std::move(some.beta));
  append(all.gamma, std::move(some.gamma));
}

namespace {

void add_terms(SurfaceTerms& terms, const Boundary& boundary, const SurfaceOnPart& on,
               const WantedTerms& wanted) {
  if (wanted.image) add_image_terms(terms, boundary);
  if (wanted.on_surface()) add_surface_terms(terms, boundary, on, wanted);
}

/// The exact terms of which sums are made.
constexpr WantedTerms all_on_surface{.image = false, .share = true, .moments = true};

/// The sums of regular triangles over the lines of a sweep, as add_surface_terms().
class SweptSums {
 public:
  SweptSums(const PlaneMesh& mesh, const CrowdedPart& crowded, const PartLines& lines)
      : mesh_(mesh),
        crowded_(crowded),
        lines_(lines),
        words_(lines.size()),
        pieces_(crowded.triangles.size()) {}

  /// Adds what a part of a line contributes to the piece on its left and to that on its right.
  void add(const LineSweep::Span& span) {
    const WordVector from = cross(line(span.along), line(span.from)),
                     to = cross(line(span.along), line(span.to));
    if (span.left.piece != LineSweep::none) add(span.left.piece, from, to);
    if (span.right.piece != LineSweep::none) add(span.right.piece, to, from);
  }
  [[nodiscard]] const SurfaceSums& sums(std::size_t piece) const { return pieces_[piece].sums; }

 private:
  /// β and γ.
  struct Place {
    Words b, c;
  };
  struct Piece {
    struct Forms {
      WordVector b, c, sigma;
    };
    std::optional<Forms> forms;
    SurfaceSums sums;

    [[nodiscard]] Place at(const WordVector& place) const {
      const Words sigma = dot(forms->sigma, place);
      return {dot(forms->b, place) / sigma, dot(forms->c, place) / sigma};
    }
  };

  const WordVector& line(std::uint32_t number) {
    auto& its = words_[number];
    if (!its) its = in_words(lines_[number].exact());
    return *its;
  }

  void add(std::uint32_t number, const WordVector& from, const WordVector& to) {
    Piece& piece = pieces_[number];
    if (!piece.forms) {
      const auto [a, b, c] = edges_in_words(mesh_, crowded_.triangles[number], crowded_.part);
      piece.forms =
          Piece::Forms{b, c, {a[0] + b[0] + c[0], a[1] + b[1] + c[1], a[2] + b[2] + c[2]}};
    }
    const Place p = piece.at(from), q = piece.at(to);
    const Words product = p.b * q.c - p.c * q.b;
    piece.sums.share = piece.sums.share + product;
    piece.sums.beta = piece.sums.beta + product * (p.b + q.b);
    piece.sums.gamma = piece.sums.gamma + product * (p.c + q.c);
  }

  const PlaneMesh& mesh_;
  const CrowdedPart& crowded_;
  const PartLines& lines_;
  std::vector<std::optional<WordVector>> words_;
  std::vector<Piece> pieces_;
};

}  // namespace

PlaneAreas::PlaneAreas(const PlaneMesh& mesh, const WantedTerms& wanted,
                       const std::function<void()>& part_done)
    : mesh_(mesh),
      wanted_(wanted),
      resolved_(resolve(mesh, mesh.scene().image(), PartCuts::through_few)),
      visibility_(mesh.size(), Visibility::hidden),
      of_(mesh.size(), true),
      is_hidden_(mesh.size(), 0),
      place_(mesh.size(), 0) {
  std::uint32_t places = 0;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    const PartFlags flags = resolved_.flags[i];
    if ((flags & (is_seen_somewhere | is_crowded_somewhere)) == 0) continue;
    const bool is_whole = is_wholly_visible(mesh, resolved_, i);
    visibility_[i] = is_whole ? Visibility::whole : Visibility::partly;
    if (!is_whole) place_[i] = places++;
  }
  terms_.resize(places);
  if (wanted.sums) sums_.resize(places);
  add_parts(part_done);
  find_whole();
}

// Pieces of about equal size, in reported steps.
void PlaneAreas::add_parts(const std::function<void()>& part_done) {
  const std::size_t crowded = resolved_.crowded.size(), all = crowded + resolved_.clips.size();
  for (std::size_t step = 0; step < parts; ++step) {
    const std::size_t first = all * step / parts, end = all * (step + 1) / parts;
    in_parallel(end - first, [&](std::size_t k) {
      const std::size_t i = first + k;
      if (i < crowded) {
        add_crowded(resolved_.crowded[i]);
      } else {
        add_clip(resolved_.clips[i - crowded]);
      }
    });
    part_done();
  }
}

// The parts cover the image, so a triangle inside the image (PlaneBox::is_inside()) is the union of
// its pieces in the parts that it does not certainly miss. In a simple part it is visible wherever
// it is. Where resolve() finds it behind a sheet, it sets is_hidden_somewhere. All other parts are
// crowded: sweep() and divide_crowd() set is_hidden_ unless the piece is visible wherever it is.
void PlaneAreas::find_whole() {
  for (std::uint32_t i = 0; i < mesh_.size(); ++i) {
    if (visibility_[i] != Visibility::partly || is_hidden_[i] != 0) continue;
    if ((resolved_.flags[i] & is_hidden_somewhere) != 0 || !mesh_.is_regular(i)) continue;
    if (!mesh_.box(i).is_inside(mesh_.scene().image())) continue;
    visibility_[i] = Visibility::whole;
    terms_[place_[i]] = {};
  }
}

void PlaneAreas::find_terms(const WantedTerms& terms, std::vector<bool> wanted) {
  wanted_ = terms;
  of_ = std::move(wanted);
  for (std::uint32_t i = 0; i < mesh_.size(); ++i) {
    if (of_[i] && visibility_[i] == Visibility::partly) terms_[place_[i]] = {};
  }
  add_parts([] {});
}

const SurfaceTerms& PlaneAreas::terms(std::uint32_t i) const {
  static const SurfaceTerms none;
  return visibility_[i] == Visibility::partly ? terms_[place_[i]] : none;
}

SurfaceTerms PlaneAreas::take_terms(std::uint32_t i) {
  if (visibility_[i] != Visibility::partly) return {};
  return std::exchange(terms_[place_[i]], {});
}

void PlaneAreas::add(std::uint32_t i, SurfaceTerms&& terms, const SurfaceSums& sums) {
  const std::lock_guard lock(mutexes_[i % mutexes_.size()]);
  append(terms_[place_[i]], std::move(terms));
  if (wanted_.sums) sums_[place_[i]] += sums;
}

void PlaneAreas::add_terms(std::uint32_t i, const Boundary& boundary, const SurfaceOnPart& on,
                           const WantedTerms& wanted) {
  SurfaceTerms terms;
  area::add_terms(terms, boundary, on, wanted);
  SurfaceSums sums;
  if (wanted.sums) {
    SurfaceTerms summed;
    area::add_terms(summed, boundary, on, all_on_surface);
    sums = SurfaceSums(summed);
  }
  add(i, std::move(terms), sums);
}

void PlaneAreas::note_hidden(std::uint32_t i) {
  const std::lock_guard lock(mutexes_[i % mutexes_.size()]);
  is_hidden_[i] = 1;
}

bool PlaneAreas::is_wanted(const std::vector<std::uint32_t>& triangles) const {
  return std::ranges::any_of(triangles, [&](std::uint32_t i) { return of_[i]; });
}

void PlaneAreas::add_sums(const CrowdedPart& crowded, const PartLines& lines,
                          const std::vector<LineSweep::Span>& spans) {
  SweptSums sums(mesh_, crowded, lines);
  for (const LineSweep::Span& span : spans) sums.add(span);
  for (std::size_t piece = 0; piece < crowded.triangles.size(); ++piece) {
    const SurfaceSums& its = sums.sums(piece);
    if (!is_exact_zero(its.share)) add(crowded.triangles[piece], {}, its);
  }
}

void PlaneAreas::add_crowded(const CrowdedPart& crowded) {
  check_interruption();
  if (!is_wanted(crowded.triangles)) return;
  if (crowded.triangles.size() > LineSweep::most_lines || !sweep(crowded)) divide_crowd(crowded);
}

bool PlaneAreas::sweep(const CrowdedPart& crowded) {
  LineSweep swept(mesh_, crowded.part, crowded.triangles);
  if (!swept.is_simple()) return false;
  const std::vector<LineSweep::Span> spans = swept.spans();
  const std::vector<bool> is_hidden = swept.hidden_somewhere(spans);
  for (std::size_t piece = 0; piece < is_hidden.size(); ++piece) {
    if (is_hidden[piece]) note_hidden(crowded.triangles[piece]);
  }
  WantedTerms wanted = wanted_;
  if (wanted.sums && std::ranges::all_of(crowded.triangles,
                                         [&](std::uint32_t i) { return mesh_.is_regular(i); })) {
    add_sums(crowded, swept.lines(), spans);
    wanted.sums = false;
  }
  if (!wanted.image && !wanted.on_surface() && !wanted.sums) return true;
  const std::vector<Boundary> boundaries = swept.boundaries(spans);
  for (std::size_t piece = 0; piece < boundaries.size(); ++piece) {
    const std::uint32_t i = crowded.triangles[piece];
    if (boundaries[piece].empty() || !of_[i]) continue;
    add_terms(i, boundaries[piece], {swept.surface(piece), crowded.part}, wanted);
  }
  return true;
}

void PlaneAreas::divide_crowd(const CrowdedPart& crowded) {
  for (const std::uint32_t i : crowded.triangles) note_hidden(i);
  std::vector<SurfaceRegion> surfaces;
  std::vector<const SurfaceRegion*> pointers;
  surfaces.reserve(crowded.triangles.size());
  for (const std::uint32_t i : crowded.triangles) {
    surfaces.push_back(mesh_.scene().surface(mesh_.number(i)));
  }
  pointers.reserve(surfaces.size());
  for (const SurfaceRegion& surface : surfaces) pointers.push_back(&surface);
  ImageCell cell = cell_of(crowded.part);
  CellVisibility pieces(cell);
  pieces.add_visible(pointers);
  divide(std::move(pieces), [&](CellVisibility& part) {
    for (std::size_t piece = 0; piece < part.size(); ++piece) {
      const Boundary boundary = part.visible(piece);
      if (boundary.empty()) continue;
      const SurfaceRegion& surface = part.surface(piece);
      const std::uint32_t i =
          crowded.triangles[static_cast<std::size_t>(&surface - surfaces.data())];
      if (of_[i]) add_terms(i, boundary, {surface, crowded.part}, wanted_);
    }
  });
}

void PlaneAreas::add_clip(const VisibleClip& clip) {
  if (visibility_[clip.triangle] != Visibility::partly || !of_[clip.triangle]) return;
  const SurfaceRegion surface = mesh_.scene().surface(mesh_.number(clip.triangle));
  ImageCell cell = cell_of(clip.part);
  TierCounts counts;
  if (const auto piece = cell.clip(surface.region, counts)) {
    add_terms(clip.triangle, boundary_of(piece->polygon), {surface, clip.part}, wanted_);
  }
}

Ratio unoccluded_area(const ProjectedScene& scene, std::uint32_t number) {
  switch (scene.extent(number)) {
    case TriangleExtent::none:
      return {};
    case TriangleExtent::within_image:
      return scene.own_area(number);
    case TriangleExtent::elsewhere:
      break;
  }
  ImageCell cell = cell_of(scene.image());
  TierCounts counts;
  const auto piece = cell.clip(scene.surface(number).region, counts);
  return piece ? exact_area(boundary_of(piece->polygon)) : Ratio();
}

}  // namespace fathom::area
