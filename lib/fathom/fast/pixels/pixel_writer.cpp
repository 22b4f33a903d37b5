#include "fathom/fast/pixels/pixel_writer.h"

#include <cmath>

#include "fathom/numeric/certified_rounding.h"
#include "fathom/triangle/settled_storage.h"

namespace fathom::fast {
using namespace rendering;
using namespace triangle;

void PixelWriter::write_position(std::size_t k) {
  if (facts_.usable && settle_position(k)) return count_wide();
  count_exact();
  target_.exact.write_position(surface_.pixel, k, projected(), surface_.sample);
}

bool PixelWriter::settle_position(std::size_t k) {
  float& target = target_.values.position[k][surface_.pixel];
  if (const auto& c = constant_of(facts_, k); c && take(to_binary32(*c, 0), target)) return true;
  if (take(values_.position(k), target)) return true;
  if (!values_.position_is_zero(k)) return false;
  target = 0;
  return true;
}

void PixelWriter::write_barycentric(std::size_t k) {
  if (facts_.usable && settle_barycentric(k)) return;
  count_exact();
  target_.exact.write_barycentric(surface_.pixel, k, projected(), surface_.sample);
}

bool PixelWriter::settle_barycentric(std::size_t k) {
  float& target = target_.values.barycentric[k][surface_.pixel];
  const Certified<double> narrow = weights_of(facts_, frame_).at(k, surface_.sample);
  if (take(to_binary32(narrow.value, narrow.error), target)) {
    count_narrow();
    return true;
  }
  if (values_.weight_is_zero(narrow)) {
    target = 0;
    count_narrow();
    return true;
  }
  if (!take(values_.weight(k), target)) {
    if (!values_.weight_is_zero(k)) return false;
    target = 0;
  }
  count_wide();
  return true;
}

std::optional<EncodingFault> PixelWriter::write_depth() {
  if (settle_depth(target_.values.depth)) return std::nullopt;
  return target_.exact.write_depth(surface_.pixel, projected(), surface_.sample);
}

bool PixelWriter::settle_depth(const EncodedValues& values) {
  const auto stored = [&](const Certified<WordPair>& depth) {
    return store(values, surface_.pixel, depth, target_.exact.code_factor());
  };
  if (facts_.usable &&
      (stored(values_.depth()) || (values_.exact_depth() && stored({*values_.exact_depth(), 0})))) {
    count_wide();
    return true;
  }
  count_exact();
  return false;
}

// Perspective: depth times the length of the ray at depth 1. Orthographic: the depth.
std::optional<EncodingFault> PixelWriter::write_distance() {
  const bool settled =
      frame_.image.perspective ? settle_distance() : settle_depth(target_.values.distance);
  if (settled) return std::nullopt;
  return target_.exact.write_distance(surface_.pixel, projected(), surface_.sample);
}

bool PixelWriter::settle_distance() {
  if (facts_.usable && store(target_.values.distance, surface_.pixel, values_.distance(),
                             target_.exact.code_factor())) {
    count_wide();
    return true;
  }
  count_exact();
  return false;
}

void PixelWriter::write_low_part() {
  if (facts_.usable && settle_low_part()) return count_wide();
  count_exact();
  target_.exact.write_low_part(surface_.pixel, projected(), surface_.sample);
}

bool PixelWriter::settle_low_part() {
  float& target = target_.values.low[surface_.pixel];
  return store_low_part(values_.depth(), target) ||
         (values_.exact_depth() && store_low_part({*values_.exact_depth(), 0}, target));
}

const std::array<float, 3>& PixelWriter::normal() {
  if (facts_.normal) return *facts_.normal;
  std::array<float, 3> normal{};
  if (!facts_.usable || !settle_normal(normal)) {
    count_exact();
    target_.exact.write_normal(surface_.pixel, projected());
    for (std::size_t i = 0; i < 3; ++i) normal[i] = target_.values.normal[i][surface_.pixel];
  }
  facts_.normal = normal;
  return *facts_.normal;
}

const std::array<float, 3>& PixelWriter::camera_normal() {
  if (facts_.camera_normal) return *facts_.camera_normal;
  std::array<float, 3> normal{};
  if (!facts_.usable || !facts_.object->camera_normals_usable || !settle_camera_normal(normal)) {
    count_exact();
    target_.exact.write_camera_normal(surface_.pixel, projected());
    for (std::size_t i = 0; i < 3; ++i) normal[i] = target_.values.camera_normal[i][surface_.pixel];
  }
  facts_.camera_normal = normal;
  return *facts_.camera_normal;
}

/// Each component by its own tier.
template <class Wide>
bool PixelWriter::settle_components(const Vector<Certified<double>>& narrow, const Wide& make_wide,
                                    std::array<float, 3>& normal) {
  std::optional<Vector<Certified<WordPair>>> wide;
  bool all = true;
  for (std::size_t i = 0; i < 3; ++i) {
    if (take(to_binary32(narrow[i].value, narrow[i].error), normal[i])) {
      count_narrow();
      continue;
    }
    if (!wide) wide = make_wide();
    if (take((*wide)[i], normal[i])) {
      count_wide();
    } else {
      all = false;
    }
  }
  return all;
}

bool PixelWriter::settle_normal(std::array<float, 3>& normal) {
  const ObjectRays& world = frame_.rays.world();
  const ImagePoint& s = surface_.sample;
  const ImageBounds& image = frame_.image;
  return settle_components(
      unit_normal<double>(facts_.corners, *facts_.object, world, image, s),
      [&] { return frame_.wide.normal(facts_.corners, *facts_.object, world, image, s); }, normal);
}

bool PixelWriter::settle_camera_normal(std::array<float, 3>& normal) {
  const ObjectRays& world = frame_.rays.world();
  const ImagePoint& s = surface_.sample;
  const ImageBounds& image = frame_.image;
  const Sign handedness = frame_.rays.handedness();
  return settle_components(
      unit_camera_normal<double>(facts_.corners, *facts_.object, world, image, s, handedness),
      [&] {
        return frame_.wide.camera_normal(facts_.corners, *facts_.object, world, image, s,
                                         handedness);
      },
      normal);
}

void PixelWriter::write_shading_normal(ShadingNormals& normals) {
  if (facts_.usable && settle_shading_normal(normals)) return;
  count_exact();
  target_.exact.write_shading_normal(surface_.pixel, projected(), surface_.sample);
}

void PixelWriter::settle_zero(Certified<double>& component, std::size_t i,
                              ShadingNormals& normals) {
  if (is_exact_zero(component) || !(std::abs(component.value) <= component.error)) return;
  if (!facts_.normal_bits) facts_.normal_bits = normals.last_bits(surface_.triangle);
  if (values_.interpolated_is_zero(component, (*facts_.normal_bits)[i])) component = {0, 0};
}

bool PixelWriter::settle_shading_normal(ShadingNormals& normals) {
  if (!facts_.corner_normals) facts_.corner_normals = normals.of_surface(surface_.triangle, facts_);
  const WeightForms<double>& forms = weights_of(facts_, frame_);
  Vector<Certified<double>> n = interpolated(
      *facts_.corner_normals, {forms.at(0, surface_.sample), forms.at(1, surface_.sample)});
  for (std::size_t i = 0; i < 3; ++i) settle_zero(n[i], i, normals);
  n = unit(n);
  std::array<float, 3> rounded{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!take(to_binary32(n[i].value, n[i].error), rounded[i])) return false;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    target_.values.shading_normal[i][surface_.pixel] = rounded[i];
    count_narrow();
  }
  return true;
}

}  // namespace fathom::fast
