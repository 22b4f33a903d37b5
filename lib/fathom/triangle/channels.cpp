#include "fathom/triangle/channels.h"

#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/image/depth_map.h"
#include "fathom/numeric/rounding.h"
#include "fathom/triangle/stored_quantity.h"

namespace fathom::triangle {
using namespace rendering;

namespace {

static_assert(no_segment == unsegmented, "what a map has is what a scene says");

/// The segments that a map shows; null if it shows none.
std::shared_ptr<const SceneSegments> segments_for(const ChannelValues& values,
                                                  const TriangleSource& triangles) {
  std::vector<Segmentation> wanted;
  for (std::size_t i = 0; i < all_segmentations.size(); ++i) {
    if (values.segments[i]) wanted.push_back(all_segmentations[i]);
  }
  if (wanted.empty()) return nullptr;
  return std::make_shared<const SceneSegments>(triangles, wanted);
}

}  // namespace

void fail(const EncodingFault& fault, const DepthMap& map) {
  throw OutputError(image::place_of_pixel(fault.pixel, map.width) + fault.why +
                    "; choose another scale");
}

ChannelWriter::ChannelWriter(DepthMap& map, const TriangleSource& triangles, const Camera& camera,
                             const RenderOptions& options)
    : triangles_(triangles),
      perspective_(is_perspective(camera.projection)),
      encoding_(options.depth_encoding),
      code_factor_(code_factor_of(encoding_)),
      image_handedness_(is_mirrored(camera.projection) ? Sign::negative : Sign::positive),
      handedness_(image_handedness_ * determinant_of_rotation(camera.world_to_camera).sign()),
      values_(map),
      exact_corner_normals_([this] { return ExactCornerNormals(corner_normals_); }) {
  segments_ = segments_for(values_, triangles_);
  if (values_.shading_normal[0]) {
    corner_normals_ = std::make_shared<const CornerNormals>(triangles, options.normals);
  }
}

std::optional<EncodingFault> ChannelWriter::write(std::size_t pixel, const ProjectedTriangle& t,
                                                  const ImagePoint& s) {
  write_origin(pixel, t.number);
  if (values_.normal[0]) write_normal(pixel, t);
  if (values_.camera_normal[0]) write_camera_normal(pixel, t);
  if (values_.shading_normal[0]) write_shading_normal(pixel, t, s);
  for (std::size_t k = 0; values_.position[0] && k < 3; ++k) write_position(pixel, k, t, s);
  for (std::size_t k = 0; values_.barycentric[0] && k < 2; ++k) write_barycentric(pixel, k, t, s);
  if (values_.distance.wanted()) {
    if (auto fault = write_distance(pixel, t, s)) return fault;
  }
  if (!values_.depth.wanted() && !values_.low) return std::nullopt;
  const Ratio depth = depth_at(t, s);
  if (values_.low) write_low_part(pixel, depth);
  return values_.depth.wanted() ? write_depth(pixel, depth) : std::nullopt;
}

std::optional<EncodingFault> ChannelWriter::write_depth(std::size_t pixel,
                                                        const ProjectedTriangle& t,
                                                        const ImagePoint& s) {
  return write_depth(pixel, depth_at(t, s));
}

void ChannelWriter::write_low_part(std::size_t pixel, const ProjectedTriangle& t,
                                   const ImagePoint& s) {
  write_low_part(pixel, depth_at(t, s));
}

std::optional<EncodingFault> ChannelWriter::write_depth(std::size_t pixel, const Ratio& depth) {
  if (auto why = store(values_.depth, pixel, Quantity<Ratio>{depth, false}, encoding_)) {
    return EncodingFault{pixel, "depth " + to_decimal(depth, 6) + " would be the code " + *why};
  }
  return std::nullopt;
}

// The ray distance is √(x² + y² + z²) in the camera frame under perspective, z otherwise.
std::optional<EncodingFault> ChannelWriter::write_distance(std::size_t pixel,
                                                           const ProjectedTriangle& t,
                                                           const ImagePoint& s) {
  const auto& [A, B, C] = t.camera;
  const Ratio z = depth_at(t, s);
  Ratio value = z;
  if (perspective_) {
    const Ratio x = interpolate(t, s, {A.x, B.x, C.x});
    const Ratio y = interpolate(t, s, {A.y, B.y, C.y});
    // The three denominators are the same number.
    value = {x.numerator * x.numerator + y.numerator * y.numerator + z.numerator * z.numerator,
             z.denominator * z.denominator};
  }
  if (auto why = store(values_.distance, pixel, Quantity<Ratio>{value, perspective_}, encoding_)) {
    return EncodingFault{pixel, "the ray distance would be the code " + *why};
  }
  return std::nullopt;
}

void ChannelWriter::write_low_part(std::size_t pixel, const Ratio& depth) {
  const float high = round_to_binary32(depth);
  values_.low[pixel] = std::isinf(high) ? 0.0F : round_to_binary32(depth - Ratio(Dyadic(high)));
}

void ChannelWriter::write_origin(std::size_t pixel, std::uint32_t number) {
  if (values_.id) values_.id[pixel] = number;
  if (values_.wants_origins()) values_.write(pixel, numbers_of(number));
}

OriginNumbers ChannelWriter::numbers_of(std::uint32_t triangle) const {
  const TriangleOrigin origin = triangles_.origin(triangle);
  OriginNumbers numbers{.face = origin.face, .object = origin.object};
  for (std::size_t i = 0; segments_ && i < all_segmentations.size(); ++i) {
    if (values_.segments[i]) numbers.segments[i] = segments_->number(all_segmentations[i], origin);
  }
  return numbers;
}

namespace {

/// ±n / |n|: each component is ±√(nᵢ² / n·n). 0 where n is.
void write_unit_vector(const std::array<float*, 3>& values, std::size_t pixel,
                       const ExactVector3& n, Sign turn) {
  const Dyadic squared_length = dot(n, n);
  for (std::size_t i = 0; i < 3; ++i) {
    const float magnitude =
        n[i].is_zero() ? 0 : round_sqrt_to_binary32({n[i] * n[i], squared_length});
    values[i][pixel] = n[i].sign() * turn == Sign::negative ? -magnitude : magnitude;
  }
}

}  // namespace

void ChannelWriter::write_normal(std::size_t pixel, const ProjectedTriangle& t) {
  write_unit_vector(values_.normal, pixel, area_vector(t.world), -t.orientation * handedness_);
}

void ChannelWriter::write_camera_normal(std::size_t pixel, const ProjectedTriangle& t) {
  write_unit_vector(values_.camera_normal, pixel, area_vector(t.camera),
                    -t.orientation * image_handedness_);
}

// The weights are eᵢ / Σ eᵢ; Σ eᵢ > 0 does not change the direction.
void ChannelWriter::write_shading_normal(std::size_t pixel, const ProjectedTriangle& t,
                                         const ImagePoint& s) {
  const std::array<ExactVector3, 3> normals = exact_corner_normals_.local().of_triangle(t.number);
  ExactVector3 n;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Dyadic e = t.edges[corner].at(s.u, s.v);
    for (std::size_t i = 0; i < 3; ++i) n[i] += e * normals[corner][i];
  }
  write_unit_vector(values_.shading_normal, pixel, n, Sign::positive);
}

void ChannelWriter::write_position(std::size_t pixel, std::size_t component,
                                   const ProjectedTriangle& t, const ImagePoint& s) {
  constexpr Dyadic WorldPoint::*coordinates[] = {&WorldPoint::x, &WorldPoint::y, &WorldPoint::z};
  const auto coordinate = coordinates[component];
  const auto& [A, B, C] = t.world;
  values_.position[component][pixel] =
      round_to_binary32(interpolate(t, s, {A.*coordinate, B.*coordinate, C.*coordinate}));
}

void ChannelWriter::write_barycentric(std::size_t pixel, std::size_t component,
                                      const ProjectedTriangle& t, const ImagePoint& s) {
  const double of_B = component == 0 ? 1 : 0;
  values_.barycentric[component][pixel] =
      round_to_binary32(interpolate(t, s, {0.0, of_B, 1 - of_B}));
}

}  // namespace fathom::triangle
