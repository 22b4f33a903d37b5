#include "fathom/fast/lenses/plane_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "fathom/fast/lenses/stage_lanes.h"
#include "fathom/lens/stage.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/rounding.h"

namespace fathom::fast {
using namespace place_arithmetic;

// The origin is moved to a binary64 number, exactly; entries are divided by the last one and
// rounded. Each term has roundings of its entry, of the difference of coordinates and of the
// product, and two sums follow: 5u of the terms, 6u with those of second order. Of a quotient n/z
// with z ≥ least_z, the error is at most (E_n + |n/z|·E_z)/least_z, and a rounding.
CertifiedPlane::CertifiedPlane(const lens::Preimages& preimages, const Projection& projection,
                               std::uint32_t width, std::uint32_t height) {
  const auto [cx, cy] = principal_point(projection);
  if (!std::isfinite(cx) || !std::isfinite(cy)) return;
  const std::array<ExactVector3, 3> rows = preimages.plane_map();
  const auto moved = [cx = cx, cy = cy](const ExactVector3& row) {
    return row[0] * Dyadic(cx) + row[1] * Dyadic(cy) + row[2];
  };
  const Dyadic divisor = moved(rows[2]);
  if (divisor.sign() != Sign::positive) return;
  lanes_.centre_u = cx;
  lanes_.centre_v = cy;
  const double sizes[] = {greatest_size(cx, width - cx), greatest_size(cy, height - cy), 1};
  std::array<double, 3> terms{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Dyadic exact[] = {rows[i][0], rows[i][1], moved(rows[i])};
    for (std::size_t k = 0; k < 3; ++k) {
      const double entry = lanes_.g[i][k] = round_to_binary64(Ratio(exact[k], divisor));
      const double size = std::abs(entry);
      if (!exact[k].is_zero() && !(size > 0x1p-900 && size < 0x1p900)) return;
      terms[i] += std::abs(lanes_.g[i][k]) * sizes[k] * up;
    }
  }
  lanes_.is_affine = lanes_.g[2][0] == 0 && lanes_.g[2][1] == 0;
  const double least_z = lanes_.is_affine ? 1 : (2 - terms[2]) / up;
  if (!(least_z > 0x1p-10)) return;
  const double n = std::max(terms[0], terms[1]);
  error_ =
      (plane_rounding * (n + n / least_z * terms[2]) / least_z + plane_quotient * n / least_z) *
          up +
      std::numeric_limits<double>::min();
}

using lens::PolynomialStage;
using lens::StageBounds;

namespace {

/// A greater residual, relative to 1 + |m|, means that the search has failed.
constexpr double loose_residual = 0x1p-36;

/// A bound on |S(m)| in the disc; +∞ if there is none. S is one to one there, so the points of its
/// image that are farthest from 0 are images of the circle around the disc.
double greatest_image(const PolynomialStage& stage) {
  return stage.limit ? greatest_on_circle(stage.numbers, enclose(*stage.limit).upper)
                     : std::numeric_limits<double>::infinity();
}

/// Finds the places of one tile.
class TileSearch {
 public:
  TileSearch(const lens::Preimages& preimages, const CertifiedPlane& plane, double greatest_image,
             const TileGrid& grid, std::uint32_t tile, FoundPlaces places)
      : preimages_(preimages),
        plane_(plane),
        greatest_image_(greatest_image),
        grid_(grid),
        area_(grid.area(tile)),
        places_(places) {}

  void find() {
    if (plane_.error() < 1) {
      search(*preimages_.stage());
    } else {
      find_exactly(0, 0, TileShape::size, TileShape::size);
    }
  }
  /// The bound on the errors.
  [[nodiscard]] double error() const { return error_; }
  /// Around the samples that have a ray.
  [[nodiscard]] const PlaneBox& box() const { return box_; }

 private:
  [[nodiscard]] bool is_in_image(std::uint32_t column, std::uint32_t row) const {
    return area_.first_column + column < grid_.width && area_.first_row + row < grid_.height;
  }

  /// What a search of a block found: a box around all of its places, and the greatest residual.
  struct Block {
    PlaneBox box;
    double residual = std::numeric_limits<double>::infinity();
  };
  /// A bound on the errors of places in a box whose residuals are at most `most_residual`; the
  /// error of a place is at most (residual + most_residual)/growth.
  struct Certificate {
    double growth = 1, most_residual = -1;
  };

  /// Whether a sample with |y| of at least that has no ray; the error of the plane is covered.
  [[nodiscard]] bool is_beyond_disc(double size) const {
    return size / up > greatest_image_ + beyond_room * plane_.error();
  }
  [[nodiscard]] bool is_beyond_disc(double first_column, double first_row) const;
  void search(const PolynomialStage& stage);
  void search_blocks(const PolynomialStage& stage);
  void store(const BlockSamples& samples, std::uint32_t column, std::uint32_t row);
  [[nodiscard]] Certificate certificate_in(const PolynomialStage& stage, const PlaneBox& box) const;
  void certify_samples(const PolynomialStage& stage, double limit, std::uint32_t column,
                       std::uint32_t row);
  void forget_beyond_image();
  void find_exactly(std::uint32_t column, std::uint32_t row, std::uint32_t columns,
                    std::uint32_t rows) {
    for (std::uint32_t y = row; y < row + rows; ++y)
      for (std::uint32_t x = column; x < column + columns; ++x) find_exactly(x, y);
  }
  void find_exactly(std::uint32_t column, std::uint32_t row);

  const lens::Preimages& preimages_;
  const CertifiedPlane& plane_;
  /// |y| of a sample that has a ray is at most that.
  double greatest_image_;
  const TileGrid& grid_;
  PixelBox area_;
  FoundPlaces places_;
  std::array<double, TileShape::samples> residuals_;
  std::array<Block, TileShape::blocks> blocks_;
  PlaneBox box_;
  double error_ = 0;
};

// The middle of an interval of 64 bits, which errs by half its width, and by a rounding.
void TileSearch::find_exactly(std::uint32_t column, std::uint32_t row) {
  const std::size_t i = TileShape::index(column, row);
  places_.x[i] = places_.y[i] = no_number;
  if (!is_in_image(column, row)) return;
  const auto d = preimages_.before_stage(Dyadic(area_.first_column + column + 0.5),
                                         Dyadic(area_.first_row + row + 0.5));
  if (!d) return;
  const auto enclosure = d->enclosure(64);
  const auto place = [&](const DyadicInterval& interval) {
    const Interval x = enclose(interval);
    const double middle = x.lower / 2 + x.upper / 2;
    error_ = std::max(error_, (x.upper - x.lower + 2 * u * std::abs(middle)) * up);
    return middle;
  };
  const double x = place(enclosure[0]), y = place(enclosure[1]);
  places_.x[i] = x;
  places_.y[i] = y;
  box_.add({x, x, y, y});
}

/// Whether no sample of a block has a ray. Straight edges stay straight in the plane, so the block
/// lies in a circle around its middle that holds its corners.
bool TileSearch::is_beyond_disc(double first_column, double first_row) const {
  constexpr double side = TileShape::block;
  const auto [x, y] = plane_.at(first_column + side / 2, first_row + side / 2);
  double radius = 0;
  for (const double right : {0.0, side}) {
    for (const double down : {0.0, side}) {
      const auto [corner_x, corner_y] = plane_.at(first_column + right, first_row + down);
      radius = std::max(radius, std::hypot(corner_x - x, corner_y - y));
    }
  }
  return is_beyond_disc(std::hypot(x, y) / up - radius * up);
}

// Finds the middles of blocks, each from the one before. Certificates come afterwards.
void TileSearch::search_blocks(const PolynomialStage& stage) {
  const StageForLanes lanes(stage.numbers);
  constexpr double half = TileShape::block / 2.0;
  std::optional<std::array<double, 2>> start;
  BlockSamples samples;
  for (std::uint32_t row = 0; row < TileShape::size; row += TileShape::block) {
    for (std::uint32_t k = 0; k < TileShape::size; k += TileShape::block) {
      // There and back again, so that each block is next to the one before.
      const std::uint32_t column =
          row / TileShape::block % 2 == 0 ? k : TileShape::size - TileShape::block - k;
      if (!is_in_image(column, row)) continue;
      const double first_column = area_.first_column + column, first_row = area_.first_row + row;
      if (is_beyond_disc(first_column, first_row)) continue;
      if (!start) {
        const auto d =
            preimages_.before_stage(Dyadic(first_column + half), Dyadic(first_row + half));
        if (!d) continue;
        start = {d->box()[0].lower, d->box()[1].lower};
      }
      search_block(lanes, plane_.lanes(), first_column, first_row, (*start)[0], (*start)[1],
                   samples);
      store(samples, column, row);
      const std::size_t middle = BlockSamples::count - 16;  // the first sample of the last cell
      const double x = samples.x[middle], y = samples.y[middle];
      if (samples.residual[middle] < 0x1p-30 * (1 + std::abs(x) + std::abs(y))) {
        start = {x, y};
      } else {
        start.reset();
      }
    }
  }
}

void TileSearch::store(const BlockSamples& samples, std::uint32_t column, std::uint32_t row) {
  constexpr std::size_t of_cell = std::size_t{TileShape::cell} * TileShape::cell;
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::size_t from = k * of_cell;
    const std::size_t to =
        TileShape::index(column + k % 2 * TileShape::cell, row + k / 2 * TileShape::cell);
    std::copy_n(samples.x.data() + from, of_cell, places_.x.data() + to);
    std::copy_n(samples.y.data() + from, of_cell, places_.y.data() + to);
    std::copy_n(samples.residual.data() + from, of_cell, residuals_.data() + to);
  }
  blocks_[row / TileShape::block * TileShape::blocks_of_row + column / TileShape::block] = {
      {samples.left, samples.right, samples.top, samples.bottom}, samples.greatest_residual};
}

// Let λ be the growth of S in a box (lens/stage.h) that holds a ball of radius ρ around m̂,
// and r̄ a bound on |S(m̂) − y|. Where λρ > r̄, (S(m) − y)·(m − m̂) > 0 for every m on the sphere,
// so that S takes the value y in the ball (Brouwer): at an m with λ|m − m̂| ≤ |S(m̂) − y|. If the
// ball lies in the disc, m is the preimage, since S is one to one there.
// r̄ is the residual as it is computed, and what its rounding and that of y may hide.
TileSearch::Certificate TileSearch::certificate_in(const PolynomialStage& stage,
                                                   const PlaneBox& box) const {
  // Between these sizes neither residuals nor products of places underflow or overflow.
  const double size = box.size();
  if (!(size > 0x1p-400 && size < 0x1p400)) return {};
  const double radius = ball_share * size;
  const StageBounds bounds =
      bounds_on_box(stage.numbers, {Interval{box.left - radius * up, box.right + radius * up},
                                    Interval{box.top - radius * up, box.bottom + radius * up}});
  const double rounded =
      std::numbers::sqrt2 * up * (bounds.roundings * u * bounds.terms + plane_.error());
  if (!(bounds.growth * radius > 2 * up * rounded)) return {};
  return {bounds.growth, rounded};
}

/// The same for the samples of a block, one by one; those that it does not hold for are found
/// exactly.
void TileSearch::certify_samples(const PolynomialStage& stage, double limit, std::uint32_t column,
                                 std::uint32_t row) {
  const auto for_each = [&](const auto& visit) {
    for (std::uint32_t y = row; y < row + TileShape::block; ++y)
      for (std::uint32_t x = column; x < column + TileShape::block; ++x)
        if (is_in_image(x, y)) visit(x, y, TileShape::index(x, y));
  };
  const auto is_good = [&](std::size_t i, double residual) {
    if (!(residuals_[i] <= residual)) return false;
    const double x = places_.x[i], y = places_.y[i];
    return residuals_[i] <= loose_residual * (1 + std::abs(x) + std::abs(y)) &&
           x * x + y * y <= limit;
  };
  PlaneBox box;
  for_each([&](std::uint32_t, std::uint32_t, std::size_t i) {
    if (is_good(i, std::numeric_limits<double>::max()))
      box.add({places_.x[i], places_.x[i], places_.y[i], places_.y[i]});
  });
  const Certificate certificate = box.is_empty() ? Certificate() : certificate_in(stage, box);
  for_each([&](std::uint32_t x, std::uint32_t y, std::size_t i) {
    if (is_good(i, certificate.most_residual)) {
      error_ = std::max(error_, 2 * certificate.most_residual / certificate.growth * up);
      box_.add({places_.x[i], places_.x[i], places_.y[i], places_.y[i]});
      return;
    }
    const auto [y_x, y_y] = plane_.at(area_.first_column + x + 0.5, area_.first_row + y + 0.5);
    if (is_beyond_disc(std::hypot(y_x, y_y))) {
      places_.x[i] = places_.y[i] = no_number;
    } else {
      find_exactly(x, y);
    }
  });
}

void TileSearch::search(const PolynomialStage& stage) {
  residuals_.fill(no_number);
  search_blocks(stage);
  const double limit = stage.limit ? enclose(*stage.limit).lower * (1 - disc_room)
                                   : std::numeric_limits<double>::infinity();
  PlaneBox box;
  for (std::uint32_t number = 0; number < TileShape::blocks; ++number) {
    Block& block = blocks_[number];
    const double x = greatest_size(block.box.left, block.box.right);
    const double y = greatest_size(block.box.top, block.box.bottom);
    const bool is_whole =
        is_in_image(number % TileShape::blocks_of_row * TileShape::block + TileShape::block - 1,
                    number / TileShape::blocks_of_row * TileShape::block + TileShape::block - 1);
    if (is_whole && block.residual <= loose_residual * (1 + x + y) && x * x + y * y <= limit) {
      box.add(block.box);
    } else {
      block.residual = std::numeric_limits<double>::infinity();  // by samples, or exactly
    }
  }
  const Certificate certificate = box.is_empty() ? Certificate() : certificate_in(stage, box);
  for (std::uint32_t number = 0; number < TileShape::blocks; ++number) {
    const Block& block = blocks_[number];
    if (block.residual <= certificate.most_residual) {
      const double residual = block.residual + certificate.most_residual;
      error_ = std::max(error_, residual / certificate.growth * up);
      box_.add(block.box);
    } else {
      certify_samples(stage, limit, number % TileShape::blocks_of_row * TileShape::block,
                      number / TileShape::blocks_of_row * TileShape::block);
    }
  }
  forget_beyond_image();
}

void TileSearch::forget_beyond_image() {
  if (is_in_image(TileShape::size - 1, TileShape::size - 1)) return;
  for (std::size_t i = 0; i < TileShape::samples; ++i) {
    if (!is_in_image(TileShape::column_of(i), TileShape::row_of(i)))
      places_.x[i] = places_.y[i] = no_number;
  }
}

}  // namespace

PlanePlaces::PlanePlaces(const lens::Preimages& preimages, const Projection& projection,
                         const TileGrid& grid)
    : preimages_(preimages),
      grid_(grid),
      plane_(preimages, projection, grid.width, grid.height),
      greatest_image_(greatest_image(*preimages.stage())) {}

PlanePlaces::OfTile PlanePlaces::find(std::uint32_t tile, FoundPlaces places) const {
  TileSearch search(preimages_, plane_, greatest_image_, grid_, tile, places);
  search.find();
  return {search.error(), search.box()};
}

}  // namespace fathom::fast
