#include "apps/doctor/hypothesis.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "fathom/camera/image_points.h"

namespace fathom::doctor {
namespace {

/// A permutation of axes with signs: row i has ±1 at the axis that is the i-th.
using Axes = std::array<std::array<double, 3>, 3>;

constexpr Axes identity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

constexpr Axes axes_of(CameraAxes axes) {
  switch (axes) {
    case CameraAxes::opengl:
      return {{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
    case CameraAxes::body:
      return {{{0, -1, 0}, {0, 0, -1}, {1, 0, 0}}};
    default:
      return identity;
  }
}

constexpr Axes axes_of(WorldAxes axes) {
  switch (axes) {
    case WorldAxes::x_minus_z_y:
      return {{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}};
    case WorldAxes::x_z_minus_y:
      return {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
    case WorldAxes::x_minus_y_minus_z:
      return {{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
    case WorldAxes::y_z_x:
      return {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}};
    case WorldAxes::z_x_y:
      return {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
    default:
      return identity;
  }
}

const char* words_of(WorldAxes axes) {
  switch (axes) {
    case WorldAxes::x_minus_z_y:
      return "x, -z, y of the mesh: the cameras have z up, the mesh y";
    case WorldAxes::x_z_minus_y:
      return "x, z, -y of the mesh: the cameras have y up, the mesh z";
    case WorldAxes::x_minus_y_minus_z:
      return "x, -y, -z of the mesh";
    case WorldAxes::y_z_x:
      return "y, z, x of the mesh";
    case WorldAxes::z_x_y:
      return "z, x, y of the mesh";
    default:
      return "x, y, z of the mesh";
  }
}

/// Permutes the rows; exact, as each sum has one term that is not zero.
Pose turned_camera(const Axes& axes, const Pose& pose) {
  Pose turned{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 3; ++k)
        if (axes[i][k] != 0) turned[i][j] = axes[i][k] * pose[k][j];
  return turned;
}

/// Permutes the columns of the rotation.
Pose turned_world(const Pose& pose, const Axes& axes) {
  Pose turned = pose;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        if (axes[k][j] != 0) turned[i][j] = pose[i][k] * axes[k][j];
  return turned;
}

Pose corrected(Pose pose, const Hypothesis& h) {
  for (auto& row : pose) row[3] *= h.unit;
  const Axes axes = axes_of(h.camera_axes);
  if (h.matrix == Matrix::inverse_of_turned) {
    pose = camera_to_world(turned_camera(axes, pose));
  } else {
    if (h.matrix == Matrix::inverse) pose = camera_to_world(pose);
    if (h.matrix == Matrix::inverse_of_opengl) {
      const Axes opengl = axes_of(CameraAxes::opengl);
      pose = turned_camera(opengl, camera_to_world(turned_camera(opengl, pose)));
    }
    pose = turned_camera(axes, pose);
  }
  return turned_world(pose, axes_of(h.world_axes));
}

std::optional<Lens> corrected(const std::optional<Lens>& given, LensMeaning meaning) {
  if (!given || meaning == LensMeaning::ignored) return std::nullopt;
  Lens lens = *given;
  auto& d = lens.distortion;
  switch (meaning) {
    case LensMeaning::opencv_as_fisheye:
      lens.model = LensModel::opencv_fisheye;
      break;
    case LensMeaning::fisheye_as_opencv:
      lens.model = LensModel::opencv;
      break;
    case LensMeaning::tangential_swapped:
      std::swap(d[2], d[3]);
      break;
    case LensMeaning::radial_third:
      lens.model = LensModel::full_opencv;
      d = {d[0], d[1], 0, 0, d[2]};
      break;
    case LensMeaning::radial_before_tangential:
      d = {d[0], d[1], d[3], d[4], d[2], d[5], d[6], d[7]};
      break;
    default:
      break;
  }
  return lens;
}

/// The camera of the middle of its image.
Camera cropped(Camera camera, const ImageSize& image) {
  camera.projection.cx -= (double(camera.width) - image.width) / 2;
  camera.projection.cy -= (double(camera.height) - image.height) / 2;
  camera.width = image.width;
  camera.height = image.height;
  return camera;
}

bool is_same_unit(const Hypothesis& h) {
  return h.unit != 1 && h.depth_scale == 1 / h.unit;
}

std::string text_of_turn(Turn turn) {
  switch (turn) {
    case Turn::mirrored_x:
      return "the depth images are mirrored: left is right";
    case Turn::mirrored_y:
      return "the depth images are upside down: their rows go from the bottom up";
    case Turn::half:
      return "the depth images are turned by 180 degrees";
    case Turn::left:
      return "the depth images are turned by 90 degrees to the left";
    default:
      return "the depth images are turned by 90 degrees to the right";
  }
}

std::string text_of_lens(LensMeaning meaning) {
  switch (meaning) {
    case LensMeaning::ignored:
      return "the depth images are a pinhole's: they do not have the lens of the cameras";
    case LensMeaning::opencv_as_fisheye:
      return "the lens OPENCV is OPENCV_FISHEYE with the same numbers";
    case LensMeaning::fisheye_as_opencv:
      return "the lens OPENCV_FISHEYE is OPENCV with the same numbers";
    case LensMeaning::tangential_swapped:
      return "p1 and p2 of the lens are swapped";
    case LensMeaning::radial_third:
      return "the third number of the lens is k3, read as p1";
    default:
      return "the numbers of the lens are k1, k2, k3, p1, p2, read as k1, k2, p1, p2, k3";
  }
}

}  // namespace

Hypothesis rendering_of(Hypothesis h) {
  const Hypothesis right;
  h.turn = right.turn;
  h.is_distance = right.is_distance;
  h.depth_scale = right.depth_scale;
  h.is_truncated = right.is_truncated;
  return h;
}

std::string name_of(Fault fault) {
  switch (fault) {
    case Fault::image_size:
      return "image-size";
    case Fault::matrix:
      return "camera-to-world";
    case Fault::camera_axes:
      return "camera-axes";
    case Fault::world_axes:
      return "world-axes";
    case Fault::unit:
      return "units";
    case Fault::mirrored:
      return "mirrored";
    case Fault::lens:
      return "lens";
    case Fault::ray_distance:
      return "ray-distance";
    case Fault::depth_scale:
      return "depth-scale";
    case Fault::half_pixel:
      return "half-pixel";
    case Fault::truncated:
      return "truncated-codes";
  }
  return {};
}

std::vector<Fault> faults_of(const Hypothesis& h) {
  std::vector<Fault> faults;
  const auto add = [&](bool is_there, Fault fault) {
    if (is_there) faults.push_back(fault);
  };
  add(h.resizing != Resizing::as_given, Fault::image_size);
  add(h.matrix != Matrix::as_given, Fault::matrix);
  add(h.camera_axes != CameraAxes::as_given, Fault::camera_axes);
  add(h.world_axes != WorldAxes::as_given, Fault::world_axes);
  add(h.unit != 1, Fault::unit);
  add(h.turn != Turn::as_given, Fault::mirrored);
  add(h.lens != LensMeaning::as_given, Fault::lens);
  add(h.is_distance, Fault::ray_distance);
  add(h.depth_scale != 1 && !is_same_unit(h), Fault::depth_scale);
  add(h.shift_x != 0 || h.shift_y != 0, Fault::half_pixel);
  add(h.is_truncated, Fault::truncated);
  return faults;
}

Hypothesis without(Hypothesis h, Fault fault) {
  const Hypothesis right;
  switch (fault) {
    case Fault::image_size:
      h.resizing = right.resizing;
      break;
    case Fault::matrix:
      h.matrix = right.matrix;
      break;
    case Fault::camera_axes:
      h.camera_axes = right.camera_axes;
      break;
    case Fault::world_axes:
      h.world_axes = right.world_axes;
      break;
    case Fault::unit:
      if (is_same_unit(h)) h.depth_scale = right.depth_scale;
      h.unit = right.unit;
      break;
    case Fault::mirrored:
      h.turn = right.turn;
      break;
    case Fault::lens:
      h.lens = right.lens;
      break;
    case Fault::ray_distance:
      h.is_distance = right.is_distance;
      break;
    case Fault::depth_scale:
      h.depth_scale = right.depth_scale;
      break;
    case Fault::half_pixel:
      h.shift_x = h.shift_y = 0;
      break;
    case Fault::truncated:
      h.is_truncated = false;
      break;
  }
  return h;
}

std::string text_of(Fault fault, const Hypothesis& h) {
  switch (fault) {
    case Fault::image_size:
      return h.resizing == Resizing::scaled
                 ? "the depth images have another size than the cameras: they were scaled"
                 : "the depth images have another size than the cameras: their middle was cut out";
    case Fault::matrix:
      return h.matrix == Matrix::inverse_of_opengl
                 ? "the matrices are world to camera, read as camera to world with OpenGL's axes, "
                   "or the reverse"
                 : "the matrices are camera to world, read as world to camera, or the reverse";
    case Fault::camera_axes:
      return h.camera_axes == CameraAxes::opengl
                 ? "the camera axes are OpenGL's where OpenCV's are expected, or the reverse: y "
                   "and "
                   "z have the other sign"
                 : "the camera axes are a vehicle's: x forward, y left, z up";
    case Fault::world_axes:
      return fmt::format("x, y, z of the cameras' world are {}", words_of(h.world_axes));
    case Fault::unit:
      return fmt::format("one unit of the camera positions{} is {:g} units of the mesh",
                         is_same_unit(h) ? " and of the depths" : "", h.unit);
    case Fault::mirrored:
      return text_of_turn(h.turn);
    case Fault::lens:
      return text_of_lens(h.lens);
    case Fault::ray_distance:
      return "the depths are distances along the ray, not planar depths";
    case Fault::depth_scale:
      return fmt::format("the depths are {:.6g} times too {}",
                         h.depth_scale < 1 ? 1 / h.depth_scale : h.depth_scale,
                         h.depth_scale < 1 ? "small" : "large");
    case Fault::half_pixel:
      return fmt::format("cx and cy are off: {:+g} and {:+g} pixels are missing", h.shift_x,
                         h.shift_y);
    case Fault::truncated:
      return "the codes were truncated instead of rounded: depths are half a code too small";
  }
  return {};
}

std::vector<LensMeaning> other_meanings(const std::optional<Lens>& lens) {
  if (!lens || is_pinhole(*lens)) return {};
  std::vector<LensMeaning> list;
  if (has_pinhole_part(lens->model) || lens->model == LensModel::opencv_fisheye)
    list.push_back(LensMeaning::ignored);
  const auto& d = lens->distortion;
  if (lens->model == LensModel::opencv) {
    list.push_back(LensMeaning::opencv_as_fisheye);
    if (d[2] != 0 || d[3] != 0) list.push_back(LensMeaning::radial_third);
  }
  if (lens->model == LensModel::opencv_fisheye) list.push_back(LensMeaning::fisheye_as_opencv);
  const bool has_tangential = lens->model == LensModel::opencv ||
                              lens->model == LensModel::full_opencv ||
                              lens->model == LensModel::opencv_14;
  if (has_tangential && d[2] != d[3]) list.push_back(LensMeaning::tangential_swapped);
  if (has_tangential && lens->model != LensModel::opencv && d[4] != 0)
    list.push_back(LensMeaning::radial_before_tangential);
  return list;
}

Camera corrected(const Camera& given, const Hypothesis& h, const ImageSize& image) {
  Camera camera = given;
  const bool has_other_size = image.width != given.width || image.height != given.height;
  if (h.resizing == Resizing::scaled && has_other_size)
    camera = resized(given, image.width, image.height);
  if (h.resizing == Resizing::cropped && has_other_size) camera = cropped(given, image);
  camera.world_to_camera = corrected(given.world_to_camera, h);
  camera.near *= h.unit;
  camera.far *= h.unit;
  if (h.lens != LensMeaning::as_given)
    camera.projection.lens = corrected(camera.projection.lens, h.lens);
  camera.projection.cx += h.shift_x;
  camera.projection.cy += h.shift_y;
  return camera;
}

std::array<std::int64_t, 2> stored_place(const Hypothesis& h, const Camera& camera, std::uint32_t x,
                                         std::uint32_t y) {
  const std::int64_t column = x, row = y;
  const std::int64_t last_column = std::int64_t{camera.width} - 1;
  const std::int64_t last_row = std::int64_t{camera.height} - 1;
  switch (h.turn) {
    case Turn::mirrored_x:
      return {last_column - column, row};
    case Turn::mirrored_y:
      return {column, last_row - row};
    case Turn::half:
      return {last_column - column, last_row - row};
    case Turn::left:
      return {row, last_column - column};
    case Turn::right:
      return {last_row - row, column};
    default:
      return {column, row};
  }
}

}  // namespace fathom::doctor
