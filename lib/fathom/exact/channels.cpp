#include "fathom/exact/channels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/numeric/rounding.h"

namespace fathom {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

template <class T>
ImageChannel filled(const std::string& name, std::size_t pixels, T background) {
  return {name, std::vector<T>(pixels, background)};
}

ImageChannel depth_channel(const std::string& name, std::size_t pixels, DepthEncoding::Type type) {
  switch (type) {
    case DepthEncoding::Type::binary64:
      return filled<double>(name, pixels, infinity);
    case DepthEncoding::Type::scaled_unorm16:
      return filled<std::uint16_t>(name, pixels, 0);
    case DepthEncoding::Type::binary32:
      break;
  }
  return filled<float>(name, pixels, infinity);
}

std::vector<ImageChannel> channels_for(Channel channel, std::size_t n, DepthEncoding::Type type) {
  switch (channel) {
    case Channel::Z:
      return {depth_channel("Z", n, type)};
    case Channel::Zlow:
      return {filled<float>("Zlow", n, 0)};
    case Channel::distance:
      return {depth_channel("distance", n, type)};
    case Channel::id:
      return {filled<std::uint32_t>("id", n, no_surface)};
    case Channel::face:
      return {filled<std::uint32_t>("face", n, no_surface)};
    case Channel::object:
      return {filled<std::uint32_t>("object", n, no_surface)};
    case Channel::N:
      return {filled<float>("N.X", n, 0), filled<float>("N.Y", n, 0), filled<float>("N.Z", n, 0)};
    case Channel::P:
      return {filled<float>("P.X", n, nan), filled<float>("P.Y", n, nan),
              filled<float>("P.Z", n, nan)};
    case Channel::bary:
      return {filled<float>("bary.U", n, nan), filled<float>("bary.V", n, nan)};
  }
  return {};
}

/// Stores a non-negative quantity x, or √x where `root`, in the channel's type.
std::optional<std::string> store(ImageChannel& channel, std::size_t pixel, const Ratio& x,
                                 bool root, double scale) {
  if (auto* binary32 = std::get_if<std::vector<float>>(&channel.values)) {
    (*binary32)[pixel] = root ? round_sqrt_to_binary32(x) : round_to_binary32(x);
    return std::nullopt;
  }
  if (auto* binary64 = std::get_if<std::vector<double>>(&channel.values)) {
    (*binary64)[pixel] = root ? round_sqrt_to_binary64(x) : round_to_binary64(x);
    return std::nullopt;
  }
  auto& codes = std::get<std::vector<std::uint16_t>>(channel.values);
  const Dyadic factor(scale);
  const auto code = root ? round_sqrt_to_integer(x * Ratio(factor * factor), 65535)
                         : round_to_integer(x * Ratio(factor), 65535);
  if (!code) return "above 65535";
  if (*code == 0) return "0, which means no surface";
  codes[pixel] = static_cast<std::uint16_t>(*code);
  return std::nullopt;
}

}  // namespace

DepthMap make_background(const Camera& camera, const RenderOptions& options) {
  DepthMap map;
  map.width = camera.width;
  map.height = camera.height;
  const std::size_t pixels = static_cast<std::size_t>(camera.width) * camera.height;
  std::vector<Channel> seen;
  for (const Channel channel : options.channels) {
    if (std::find(seen.begin(), seen.end(), channel) != seen.end()) continue;
    seen.push_back(channel);
    for (ImageChannel& c : channels_for(channel, pixels, options.depth_encoding.type)) {
      map.channels.push_back(std::move(c));
    }
  }
  if (options.depth_encoding.type == DepthEncoding::Type::scaled_unorm16) {
    map.png_scale = options.depth_encoding.scale;
  }
  return map;
}

ChannelWriter::ChannelWriter(DepthMap& map, const TriangleSource& triangles, const Camera& camera,
                             const RenderOptions& options)
    : map_(map),
      triangles_(triangles),
      perspective_(camera.projection == Projection::perspective),
      encoding_(options.depth_encoding),
      handedness_(Dyadic(camera.fx).sign() * Dyadic(camera.fy).sign() *
                  determinant_of_rotation(camera).sign()) {
  depth_ = channel("Z");
  if (depth_ && std::holds_alternative<std::vector<float>>(depth_->values)) {
    depth32_ = floats("Z");
  }
  distance_ = channel("distance");
  low_ = floats("Zlow");
  id_ = integers("id");
  face_ = integers("face");
  object_ = integers("object");
  normal_ = {floats("N.X"), floats("N.Y"), floats("N.Z")};
  position_ = {floats("P.X"), floats("P.Y"), floats("P.Z")};
  barycentric_ = {floats("bary.U"), floats("bary.V")};
}

ImageChannel* ChannelWriter::channel(const std::string& name) {
  for (ImageChannel& c : map_.channels) {
    if (c.name == name) return &c;
  }
  return nullptr;
}

float* ChannelWriter::floats(const std::string& name) {
  ImageChannel* c = channel(name);
  return c ? std::get<std::vector<float>>(c->values).data() : nullptr;
}

std::uint32_t* ChannelWriter::integers(const std::string& name) {
  ImageChannel* c = channel(name);
  return c ? std::get<std::vector<std::uint32_t>>(c->values).data() : nullptr;
}

bool ChannelWriter::takes_rounded_depths() const {
  const bool others = distance_ || low_ || normal_[0] || position_[0] || barycentric_[0];
  return !others && (!depth_ || depth32_);
}

void ChannelWriter::write(std::size_t pixel, std::uint32_t triangle, float depth) {
  if (depth32_) depth32_[pixel] = depth;
  if (id_ || face_ || object_) write_origin(pixel, triangle);
}

std::optional<EncodingFault> ChannelWriter::write(std::size_t pixel, const ProjectedTriangle& t,
                                                  const ImagePoint& s) {
  if (id_ || face_ || object_) write_origin(pixel, t.number);
  if (normal_[0]) write_normal(pixel, t);
  if (position_[0]) write_position(pixel, t, s);
  if (barycentric_[0]) write_barycentric(pixel, t, s);
  if (distance_) {
    if (auto fault = write_distance(pixel, t, s)) return fault;
  }
  if (!depth_ && !low_) return std::nullopt;
  const Ratio depth = depth_at(t, s);
  if (low_) write_low_part(pixel, depth);
  return depth_ ? write_depth(pixel, depth) : std::nullopt;
}

std::optional<EncodingFault> ChannelWriter::write_depth(std::size_t pixel, const Ratio& depth) {
  if (auto why = store(*depth_, pixel, depth, false, encoding_.scale)) {
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
  if (auto why = store(*distance_, pixel, value, perspective_, encoding_.scale)) {
    return EncodingFault{pixel, "the ray distance would be the code " + *why};
  }
  return std::nullopt;
}

void ChannelWriter::write_low_part(std::size_t pixel, const Ratio& depth) {
  const float high = round_to_binary32(depth);
  low_[pixel] = std::isinf(high) ? 0.0F : round_to_binary32(depth - Ratio(Dyadic(high)));
}

void ChannelWriter::write_origin(std::size_t pixel, std::uint32_t number) {
  if (id_) id_[pixel] = number;
  if (!face_ && !object_) return;
  const TriangleOrigin origin = triangles_.origin(number);
  if (face_) face_[pixel] = origin.face;
  if (object_) object_[pixel] = origin.object;
}

// n / |n| with n = ±(B − A) × (C − A): each component is ±√(nᵢ² / n·n).
void ChannelWriter::write_normal(std::size_t pixel, const ProjectedTriangle& t) {
  const auto& [A, B, C] = t.world;
  const ExactVector3 n =
      cross({B.x - A.x, B.y - A.y, B.z - A.z}, {C.x - A.x, C.y - A.y, C.z - A.z});
  const Dyadic squared_length = dot(n, n);
  const Sign turn = -t.orientation * handedness_;
  for (std::size_t i = 0; i < 3; ++i) {
    const float magnitude = round_sqrt_to_binary32({n[i] * n[i], squared_length});
    normal_[i][pixel] = n[i].sign() * turn == Sign::negative ? -magnitude : magnitude;
  }
}

void ChannelWriter::write_position(std::size_t pixel, const ProjectedTriangle& t,
                                   const ImagePoint& s) {
  const auto& [A, B, C] = t.world;
  position_[0][pixel] = round_to_binary32(interpolate(t, s, {A.x, B.x, C.x}));
  position_[1][pixel] = round_to_binary32(interpolate(t, s, {A.y, B.y, C.y}));
  position_[2][pixel] = round_to_binary32(interpolate(t, s, {A.z, B.z, C.z}));
}

void ChannelWriter::write_barycentric(std::size_t pixel, const ProjectedTriangle& t,
                                      const ImagePoint& s) {
  barycentric_[0][pixel] = round_to_binary32(interpolate(t, s, {0.0, 1.0, 0.0}));
  barycentric_[1][pixel] = round_to_binary32(interpolate(t, s, {0.0, 0.0, 1.0}));
}

}  // namespace fathom
