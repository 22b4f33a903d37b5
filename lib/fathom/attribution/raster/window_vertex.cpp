#include "fathom/attribution/raster/window_vertex.h"

#include <algorithm>
#include <cmath>

#include "fathom/attribution/model/own_roundings.h"
#include "fathom/numeric/unit_roundoff.h"

namespace fathom::attribution {

WindowVertex to_window(const ClipVertex& v, const Camera& camera, const RasterModel& model) {
  constexpr double u = unit_roundoff<float>;
  const double w = v.value[3], rest = std::max(w - v.error[3], 0x1p-1000);
  // A quotient by w: errors of both, a reciprocal of two roundings and a product.
  const auto divided_error = [&](double quotient, double error) {
    return (error + std::abs(quotient) * v.error[3]) / rest + 4 * u * std::abs(quotient);
  };
  const double half_width = camera.width / 2.0, half_height = camera.height / 2.0;
  WindowVertex window{.borders = v.borders};
  window.x = half_width + half_width * (v.value[0] / w);
  window.y = half_height - half_height * (v.value[1] / w);
  window.error_x = own_roundings * (half_width * divided_error(v.value[0] / w, v.error[0]) +
                                    2 * u * (std::abs(window.x) + half_width));
  window.error_y = own_roundings * (half_height * divided_error(v.value[1] / w, v.error[1]) +
                                    2 * u * (std::abs(window.y) + half_height));

  window.from_border = std::max(std::abs(window.y), std::abs(camera.height - window.y));

  const double z = v.value[2] / w;
  // Of z_ndc/2 where there is one: z is that and a half.
  const double divided = model.mapping == Mapping::opengl ? z - 0.5 : z;
  window.z = z;
  window.error_z =
      own_roundings * (divided_error(divided, v.error[2]) + 2 * u * (std::abs(z) + 0.5));
  window.q = window.z;
  window.error_q = window.error_z;
  if (model.written && model.written->of_w) {  // a reciprocal of up to two roundings
    window.q = 1 / w;
    window.error_q = own_roundings * (v.error[3] / rest + 3 * u) / w;
  }
  if (!model.written) {
    window.z += model.bias;
    window.error_z += model.bias_error;
  }

  const double snap = std::ldexp(0.5, -model.subpixel_bits);
  window.snapped_x = window.error_x + snap;
  window.snapped_y = window.error_y + snap;
  return window;
}

}  // namespace fathom::attribution
