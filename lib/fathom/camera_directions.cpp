#include "fathom/camera_directions.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/lens/greatest_component.h"
#include "fathom/lens/preimages.h"
#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/real.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/threads.h"
#include "fathom/triangle/ray_values.h"

namespace fathom {
using lens::ExactDirection;

namespace {

using Direction = DirectionTable::Direction;

double rounded(const Real& x, DirectionRounding rounding) {
  return rounding == DirectionRounding::binary64 ? round_to_binary64(x) : round_to_binary32(x);
}

using Word = Certified<DoubleWord<false>>;

/// As rounded(), of a number in double-words; nullopt if its bound does not settle that.
std::optional<double> settled(const Word& x, DirectionRounding rounding) {
  if (rounding == DirectionRounding::binary64) return to_binary64(x.value, x.error);
  return to_binary32(x.value, x.error);
}

/// A number times 1 or −1.
Word times_sign(const Certified<WordPair>& x, int sign) {
  return {{sign * x.value.hi, sign * x.value.lo}, x.error};
}

/// The direction by double-words, for nearly all pixels; nullopt if their bounds leave open which
/// component is the greatest, or how one is rounded.
std::optional<Direction> settled(const lens::DirectionWords& d, DirectionRounding rounding) {
  std::array<Word, 3> sizes;
  std::array<int, 3> signs{};
  std::size_t greatest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    signs[k] = d[k].value.hi < 0 ? -1 : 1;
    sizes[k] = times_sign(d[k], signs[k]);
    if (sizes[k].value.hi > sizes[greatest].value.hi) greatest = k;
  }
  Direction result{};
  result[greatest] = signs[greatest];
  for (std::size_t k = 0; k < 3; ++k) {
    if (k == greatest) continue;
    const Word lead = sum(sizes[greatest], times_sign(d[k], -signs[k]));
    if (certain_sign(lead.value, lead.error) != 1) return std::nullopt;
    const auto component = settled(quotient(times_sign(d[k], 1), sizes[greatest]), rounding);
    if (!component) return std::nullopt;
    result[k] = *component;
  }
  return result;
}

Direction rounded(const ExactDirection& d, DirectionRounding rounding) {
  if (const auto words = d.words())
    if (const auto direction = settled(*words, rounding)) return *direction;
  const LinearForm greatest(lens::greatest_component(d));
  Direction result{};
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] =
        rounded(triangle::quotient_at(d, LinearForm(lens::component(k)), greatest), rounding);
  }
  return result;
}

lens::Preimages preimages_of(const Camera& camera) {
  return {camera.projection, camera.projection.lens.value_or(Lens())};
}

}  // namespace

DirectionTable directions_of(const Camera& camera, DirectionRounding rounding,
                             const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  require_valid(camera);
  if (is_orthographic(camera.projection)) {
    throw UsageError(
        "an orthographic camera has one direction for all pixels and an origin for each, expected "
        "a perspective camera");
  }
  const lens::Preimages preimages = preimages_of(camera);
  const std::size_t width = camera.width;
  std::vector<double> numbers(3 * width * camera.height);
  Progress done(progress, camera.height);
  parallel_for(std::uint32_t{0}, camera.height, [&](std::uint32_t row) {
    for (std::uint32_t column = 0; column < camera.width; ++column) {
      const auto d = preimages.of_pixel(column, row);
      if (!d) continue;
      std::ranges::copy(rounded(*d, rounding), &numbers[3 * (row * width + column)]);
    }
    done.part_done();
  });
  return {camera.width, camera.height, std::move(numbers)};
}

}  // namespace fathom
