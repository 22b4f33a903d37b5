#include <cmath>

#include "fathom/numeric/exact_polynomial.h"
#include "fathom/numeric/rounding.h"
#include "fathom/triangle/channels.h"
#include "fathom/triangle/ray_values.h"
#include "fathom/triangle/stored_quantity.h"

// Values along the ray of a sample, where a camera bends rays (specification, section 6). With the
// direction d, the edge functions e_A, e_B and e_C and their sum w, the ray meets the triangle at
// |T|/w(d)·d.
namespace fathom::triangle {
using lens::ExactDirection;

namespace {

LinearForm times(const Dyadic& factor, const LinearForm& form) {
  ExactVector3 l = form.coefficients();
  for (Dyadic& coefficient : l) coefficient *= factor;
  return LinearForm(l);
}
QuadraticForm times(const Dyadic& factor, const QuadraticForm& form) {
  return factor * form;
}

Sign sign_at(const ExactDirection& d, const LinearForm& form) {
  TierCounts uncounted;
  return Sample(d).sign_of(form, uncounted);
}

float rounded_root(const Real& squared) {
  return to_binary32(Quantity<Real>{squared, true});
}

/// Stores numerator/denominator at the ray, or its root.
template <class Form>
std::optional<std::string> store_at(const ExactDirection& d, const rendering::EncodedValues& values,
                                    std::size_t pixel, const Form& numerator,
                                    const Form& denominator, bool root,
                                    const DepthEncoding& encoding) {
  const Quantity<Real> quantity{quotient_at(d, numerator, denominator), root};
  return store(values, pixel, quantity, encoding, [&] {
    // A code steps at a half, which is a dyadic number only of the quotient that it counts.
    Dyadic scale(encoding.scale), divisor(encoding.divisor);
    if (root) {
      scale *= scale;
      divisor *= divisor;
    }
    return Quantity<Real>{quotient_at(d, times(scale, numerator), times(divisor, denominator)),
                          root};
  });
}

}  // namespace

std::optional<EncodingFault> ChannelWriter::write(std::size_t pixel, const ProjectedTriangle& t,
                                                  const ExactDirection& d) {
  write_origin(pixel, t.number);
  if (values_.normal[0]) write_normal(pixel, t);
  if (values_.camera_normal[0]) write_camera_normal(pixel, t);
  if (values_.shading_normal[0]) write_shading_normal(pixel, t, d);
  if (values_.position[0]) write_position(pixel, t, d);
  if (values_.barycentric[0]) write_barycentric(pixel, t, d);
  if (values_.distance.wanted()) {
    if (auto fault = write_distance(pixel, t, d)) return fault;
  }
  if (values_.low) write_low_part(pixel, t, d);
  return values_.depth.wanted() ? write_depth(pixel, t, d) : std::nullopt;
}

std::optional<EncodingFault> ChannelWriter::write_depth(std::size_t pixel,
                                                        const ProjectedTriangle& t,
                                                        const ExactDirection& d) {
  if (encoding_.type == StoredType::scaled_unorm16 &&
      sign_at(d, t.depth_numerator) != Sign::positive) {
    return EncodingFault{pixel, "the planar depth is not above 0; store the channel distance"};
  }
  if (float* const values = values_.depth.binary32) {
    values[pixel] = binary32_at(d, t.depth_numerator, t.weight);
    return std::nullopt;
  }
  if (auto why = store_at(d, values_.depth, pixel, t.depth_numerator, t.weight, false, encoding_)) {
    return EncodingFault{pixel, "the depth would be the code " + *why};
  }
  return std::nullopt;
}

// The distance is |T|·|d| / w(d), from the eye along the ray.
std::optional<EncodingFault> ChannelWriter::write_distance(std::size_t pixel,
                                                           const ProjectedTriangle& t,
                                                           const ExactDirection& d) {
  if (float* const values = values_.distance.binary32) {
    if (const auto settled = distance_in(d.box(), t.volume, t.weight)) {
      values[pixel] = *settled;
      return std::nullopt;
    }
  }
  const QuadraticForm squared = (t.volume * t.volume) * squared_length();
  const QuadraticForm weight = square_of(t.weight.coefficients());
  if (auto why = store_at(d, values_.distance, pixel, squared, weight, true, encoding_)) {
    return EncodingFault{pixel, "the ray distance would be the code " + *why};
  }
  return std::nullopt;
}

void ChannelWriter::write_low_part(std::size_t pixel, const ProjectedTriangle& t,
                                   const ExactDirection& d) {
  const float high = binary32_at(d, t.depth_numerator, t.weight);
  if (std::isinf(high)) {
    values_.low[pixel] = 0;
    return;
  }
  ExactVector3 rest = t.depth_numerator.coefficients();
  for (std::size_t k = 0; k < 3; ++k) rest[k] -= Dyadic(high) * t.weight.coefficients()[k];
  values_.low[pixel] = binary32_at(d, LinearForm(rest), t.weight);
}

// Each component of the interpolated normal m is a linear form of d; its unit vector has the
// components ±√(mᵢ² / m·m).
void ChannelWriter::write_shading_normal(std::size_t pixel, const ProjectedTriangle& t,
                                         const ExactDirection& d) {
  const std::array<ExactVector3, 3> normals = exact_corner_normals_.local().of_triangle(t.number);
  std::array<LinearForm, 3> m;
  std::array<Sign, 3> signs{};
  QuadraticForm squared_length;
  for (std::size_t i = 0; i < 3; ++i) {
    m[i] = interpolated_form(t, {normals[0][i], normals[1][i], normals[2][i]});
    signs[i] = sign_at(d, m[i]);
    squared_length += square_of(m[i].coefficients());
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const float size =
        signs[i] == Sign::zero
            ? 0
            : rounded_root(quotient_at(d, square_of(m[i].coefficients()), squared_length));
    values_.shading_normal[i][pixel] = signs[i] == Sign::negative ? -size : size;
  }
}

void ChannelWriter::write_position(std::size_t pixel, const ProjectedTriangle& t,
                                   const ExactDirection& d) {
  const std::array<LinearForm, 3> forms = position_forms(t);
  for (std::size_t k = 0; k < 3; ++k)
    values_.position[k][pixel] = binary32_at(d, forms[k], t.weight);
}

void ChannelWriter::write_barycentric(std::size_t pixel, const ProjectedTriangle& t,
                                      const ExactDirection& d) {
  for (std::size_t k = 0; k < 2; ++k) {
    values_.barycentric[k][pixel] = binary32_at(d, t.edges[k + 1], t.weight);
  }
}

}  // namespace fathom::triangle
