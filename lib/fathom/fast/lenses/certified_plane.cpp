#include "fathom/fast/lenses/certified_plane.h"

#include <algorithm>
#include <cmath>

#include "fathom/fast/lenses/place_arithmetic.h"
#include "fathom/numeric/certified.h"
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
  error_ = (6 * u * (n + n / least_z * terms[2]) / least_z + u * n / least_z) * up +
           std::numeric_limits<double>::min();
}

}  // namespace fathom::fast
