#include "fathom/triangle/channels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/failures/errors.h"
#include "fathom/image/pixel_place.h"
#include "fathom/numeric/rounding.h"
#include "fathom/threads/threads.h"
#include "fathom/triangle/segment_channels.h"

namespace fathom::triangle {
namespace {

static_assert(no_segment == unsegmented, "what a map has is what a scene says");

/// Where the memory of a map's channels comes from.
struct MapMemory {
  std::size_t pixels;
  const RenderOptions& options;
  /// A map whose channels are not needed any more.
  DepthMap& before;
};

template <class T>
struct Room {
  Samples<T> values;
  /// Whether they are 0.
  bool is_zeroed;
};

template <class T>
Room<T> room_for(const std::string& name, const MapMemory& memory) {
  // First the caller's own, which a map of before may have been lent, too.
  void* const lent = memory.options.memory ? memory.options.memory(name) : nullptr;
  if (lent) return {Samples<T>::lent(static_cast<T*>(lent), memory.pixels), false};
  if (auto* values = memory.before.values<T>(name); values && values->size() == memory.pixels) {
    return {std::move(*values), false};
  }
  return {Samples<T>(memory.pixels), true};
}

template <class T>
ImageChannel channel_with(const std::string& name, T background, const MapMemory& memory,
                          MapBackground& to_fill) {
  auto [values, is_zeroed] = room_for<T>(name, memory);
  if (!is_zeroed || background != T{0}) to_fill.add(name, values.data(), background);  // NaN too
  return {name, std::move(values)};
}

/// A channel whose kind decides which value says that no surface is seen.
ImageChannel channel_of_kind(const std::string& name, const ChannelDescription& d,
                             const MapMemory& memory, MapBackground& to_fill) {
  const DepthEncoding::Type encoding = memory.options.depth_encoding.type;
  if (d.type == ChannelType::identifier)
    return channel_with<std::uint32_t>(name, no_surface, memory, to_fill);
  if (d.type == ChannelType::encoded && encoding == DepthEncoding::Type::scaled_unorm16) {
    return channel_with<std::uint16_t>(name, 0, memory, to_fill);
  }
  const float value = d.kind == ChannelKind::depth      ? Backgrounds::depth
                      : d.kind == ChannelKind::position ? Backgrounds::position
                                                        : Backgrounds::other;
  if (d.type == ChannelType::encoded && encoding == DepthEncoding::Type::binary64) {
    return channel_with<double>(name, value, memory, to_fill);
  }
  return channel_with<float>(name, value, memory, to_fill);
}

/// Stores a non-negative quantity x, or √x where `root`, in the channel's type.
std::optional<std::string> store(const EncodedValues& values, std::size_t pixel, const Ratio& x,
                                 bool root, const DepthEncoding& encoding) {
  if (values.binary32) {
    values.binary32[pixel] = root ? round_sqrt_to_binary32(x) : round_to_binary32(x);
    return std::nullopt;
  }
  if (values.binary64) {
    values.binary64[pixel] = root ? round_sqrt_to_binary64(x) : round_to_binary64(x);
    return std::nullopt;
  }
  const Ratio factor(encoding.scale, encoding.divisor);
  const auto code = root ? round_sqrt_to_integer(x * (factor * factor), 65535)
                         : round_to_integer(x * factor, 65535);
  if (!code && !encoding.beyond_is_none) return "above 65535";
  if (code == 0U) return "0, which means no surface";
  values.codes[pixel] = static_cast<std::uint16_t>(code.value_or(0));
  return std::nullopt;
}

/// The values of a channel if it exists and has this type.
template <class T>
T* values_of(DepthMap& map, const std::string& name) {
  Samples<T>* values = map.values<T>(name);
  return values ? values->data() : nullptr;
}

EncodedValues encoded_values_of(DepthMap& map, const std::string& name) {
  return {values_of<float>(map, name), values_of<double>(map, name),
          values_of<std::uint16_t>(map, name)};
}

std::array<std::uint32_t*, all_segmentations.size()> segment_values_of(DepthMap& map) {
  std::array<std::uint32_t*, all_segmentations.size()> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = values_of<std::uint32_t>(
        map, std::string(description_of(channel_of(all_segmentations[i])).name));
  }
  return values;
}

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

void MapBackground::fill(std::size_t first_pixel, std::size_t count) const {
  for_each(
      [&](auto* values, auto background) { std::fill_n(values + first_pixel, count, background); });
}

UnfilledMap make_unfilled_map(const Camera& camera, const RenderOptions& options, DepthMap before) {
  UnfilledMap made;
  DepthMap& map = made.map;
  map.width = camera.width;
  map.height = camera.height;
  const MapMemory memory{static_cast<std::size_t>(camera.width) * camera.height, options, before};
  std::vector<Channel> seen;
  for (const Channel channel : options.channels) {
    if (std::find(seen.begin(), seen.end(), channel) != seen.end()) continue;
    seen.push_back(channel);
    for (const std::string& name : part_names(channel)) {
      map.channels.push_back(
          channel_of_kind(name, description_of(channel), memory, made.background));
    }
  }
  if (options.depth_encoding.type == DepthEncoding::Type::scaled_unorm16) {
    map.png_scale = options.depth_encoding.scale / options.depth_encoding.divisor;
  }
  return made;
}

DepthMap make_background(const Camera& camera, const RenderOptions& options, DepthMap before) {
  UnfilledMap made = make_unfilled_map(camera, options, std::move(before));
  const std::size_t pixels = std::size_t{camera.width} * camera.height;
  // A huge page is zeroed by whichever thread touches it first, while others wait for it.
  constexpr std::size_t part = (std::size_t{1} << 21) / sizeof(float);
  parallel_for(std::size_t{0}, (pixels + part - 1) / part, [&](std::size_t i) {
    made.background.fill(i * part, std::min(part, pixels - i * part));
  });
  return std::move(made.map);
}

ChannelValues::ChannelValues(DepthMap& map)
    : depth(encoded_values_of(map, "Z")),
      distance(encoded_values_of(map, "distance")),
      coverage(values_of<float>(map, "A")),
      low(values_of<float>(map, "Zlow")),
      id(values_of<std::uint32_t>(map, "id")),
      face(values_of<std::uint32_t>(map, "face")),
      object(values_of<std::uint32_t>(map, "object")),
      segments(segment_values_of(map)),
      normal{values_of<float>(map, "N.X"), values_of<float>(map, "N.Y"),
             values_of<float>(map, "N.Z")},
      camera_normal{values_of<float>(map, "Nc.X"), values_of<float>(map, "Nc.Y"),
                    values_of<float>(map, "Nc.Z")},
      shading_normal{values_of<float>(map, "Ns.X"), values_of<float>(map, "Ns.Y"),
                     values_of<float>(map, "Ns.Z")},
      position{values_of<float>(map, "P.X"), values_of<float>(map, "P.Y"),
               values_of<float>(map, "P.Z")},
      barycentric{values_of<float>(map, "bary.U"), values_of<float>(map, "bary.V")} {}

bool ChannelValues::wants_origins() const {
  return face || object ||
         std::any_of(segments.begin(), segments.end(), [](const auto* values) { return values; });
}

void ChannelValues::write(std::size_t pixel, const OriginNumbers& numbers) const {
  const auto values = origins();
  const auto all = numbers.all();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i]) values[i][pixel] = all[i];
  }
}

ChannelWriter::ChannelWriter(DepthMap& map, const TriangleSource& triangles, const Camera& camera,
                             const RenderOptions& options)
    : triangles_(triangles),
      perspective_(camera.projection == Projection::perspective),
      encoding_(options.depth_encoding),
      code_factor_(code_factor_of(encoding_)),
      image_handedness_(Dyadic(camera.fx).sign() * Dyadic(camera.fy).sign()),
      handedness_(image_handedness_ * determinant_of_rotation(camera).sign()),
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
  if (auto why = store(values_.depth, pixel, depth, false, encoding_)) {
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
  if (auto why = store(values_.distance, pixel, value, perspective_, encoding_)) {
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
