#include "fathom/image/files/exr_camera.h"

#include <ImfMatrixAttribute.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fathom::image {
namespace {

constexpr std::array matrix_names{"worldToCamera", "worldToNDC"};

/// For column vectors.
using Matrix4 = std::array<std::array<double, 4>, 4>;

/// Row by row for row vectors, as Imath multiplies them: the transpose.
std::vector<double> for_row_vectors(const Matrix4& matrix) {
  std::vector<double> flat(16);
  for (std::size_t k = 0; k < 16; ++k) flat[k] = matrix[k % 4][k / 4];
  return flat;
}

Matrix4 camera_from_world(const Camera& camera) {
  auto [x, y, z] = camera.world_to_camera;
  for (double& component : y) component = -component;
  return {x, y, z, {0, 0, 0, 1}};
}

/// The image after division by the last component.
Matrix4 ndc_from_world(const Camera& camera) {
  const auto& [x, y, z] = camera.world_to_camera;
  const bool perspective = is_perspective(camera.projection);
  const auto [cx, cy] = principal_point(camera.projection);
  Matrix4 m{};
  m[3] = perspective ? z : std::array<double, 4>{0, 0, 0, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    m[0][k] =
        (camera.projection.fx * x[k] + camera.projection.skew * y[k] + cx * m[3][k]) / camera.width;
    m[1][k] = (camera.projection.fy * y[k] + cy * m[3][k]) / camera.height;
    m[2][k] = z[k];
  }
  return m;
}

/// nullptr unless there are so many under the name.
const std::vector<double>* numbers_named(const ExrNumbers& numbers, const std::string& name,
                                         std::size_t count) {
  const auto found = numbers.find(name);
  return found == numbers.end() || found->second.size() != count ? nullptr : &found->second;
}

bool fits_binary32(double x) {
  return std::abs(x) <= std::numeric_limits<float>::max();
}

void set_window(Imf::Header& header, const ExrNumbers& numbers) {
  // OpenEXR's limits for the headers that it writes.
  const auto* ratio = numbers_named(numbers, "pixelAspectRatio", 1);
  if (ratio && ratio->front() >= 1e-6 && ratio->front() <= 1e6)
    header.pixelAspectRatio() = static_cast<float>(ratio->front());
  const auto* centre = numbers_named(numbers, "screenWindowCenter", 2);
  const auto* extent = numbers_named(numbers, "screenWindowWidth", 1);
  if (!centre || !extent) return;
  const auto x = static_cast<float>((*centre)[0]), y = static_cast<float>((*centre)[1]);
  const auto width = static_cast<float>(extent->front());
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(width) || width < 0) return;
  header.screenWindowCenter() = {x, y};
  header.screenWindowWidth() = width;
}

}  // namespace

ExrNumbers exr_numbers(const Camera& camera) {
  const auto [cx, cy] = principal_point(camera.projection);
  // The window is on the plane z = 1; for an orthographic camera it is the image's extent.
  return {{"worldToCamera", for_row_vectors(camera_from_world(camera))},
          {"worldToNDC", for_row_vectors(ndc_from_world(camera))},
          {"pixelAspectRatio", {std::abs(camera.projection.fy / camera.projection.fx)}},
          {"screenWindowCenter",
           {(camera.width / 2.0 - cx) / camera.projection.fx,
            (cy - camera.height / 2.0) / camera.projection.fy}},
          {"screenWindowWidth", {camera.width / std::abs(camera.projection.fx)}}};
}

void set_numbers(Imf::Header& header, const ExrNumbers& numbers) {
  set_window(header, numbers);
  for (const char* name : matrix_names) {
    const auto* values = numbers_named(numbers, name, 16);
    if (!values || !std::ranges::all_of(*values, fits_binary32)) continue;
    Imath::M44f matrix;
    for (int k = 0; k < 16; ++k)
      matrix[k / 4][k % 4] = static_cast<float>((*values)[static_cast<std::size_t>(k)]);
    header.insert(name, Imf::M44fAttribute(matrix));
  }
}

ExrNumbers get_numbers(const Imf::Header& header) {
  ExrNumbers numbers;
  numbers["pixelAspectRatio"] = {header.pixelAspectRatio()};
  numbers["screenWindowCenter"] = {header.screenWindowCenter().x, header.screenWindowCenter().y};
  numbers["screenWindowWidth"] = {header.screenWindowWidth()};
  for (const char* name : matrix_names) {
    const auto* attribute = header.findTypedAttribute<Imf::M44fAttribute>(name);
    if (!attribute) continue;
    std::vector<double>& values = numbers[name];
    for (int k = 0; k < 16; ++k) values.push_back(attribute->value()[k / 4][k % 4]);
  }
  return numbers;
}

}  // namespace fathom::image
