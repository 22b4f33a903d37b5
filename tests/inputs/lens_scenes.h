#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <ostream>
#include <random>
#include <vector>

#include "tests/inputs/random_scenes.h"
#include "tests/oracle/lens_rays.h"

namespace fathom::checks {

/// The models of the table that may bend rays: all but the pinholes and TABLE.
inline std::vector<LensModel> bending_models() {
  std::vector<LensModel> models;
  for (const LensModelEntry& entry : lens_models()) {
    const LensModel model = entry.model;
    if (model != LensModel::simple_pinhole && model != LensModel::pinhole &&
        model != LensModel::table)
      models.push_back(model);
  }
  return models;
}

/// A lens that tests list, and are named after.
struct NamedLens {
  const char* name;
  Lens lens;
};
inline void PrintTo(const NamedLens& named, std::ostream* out) {
  *out << named.name;
}

struct LensCase {
  Case view;
  oracle::LensNumbers numbers;
};

/// Random lenses of few bits in front of the cameras of CaseMaker; some of the scenes are moved so
/// that corners and edges lie on the ray of a sample, exactly.
class LensCaseMaker {
 public:
  LensCaseMaker(std::uint64_t seed, Kind kind) : random_(seed), cases_(seed + 1, kind) {}

  LensCase make(LensModel model) {
    LensCase c;
    do c.view = cases_.make();
    while (is_orthographic(c.view.camera.projection));
    set_lens(model, c);
    if (below(2) != 0) return c;
    is_panorama(model) ? put_corners_on_a_turned_ray(c) : put_corners_on_a_ray(c);
    return c;
  }

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  double term() { return std::ldexp(below(9) - 5, -4 - below(3)); }
  double small_term() { return below(2) == 0 ? 0 : std::ldexp(below(5) - 2, -7); }

  void set_lens(LensModel model, LensCase& c) {
    Lens lens{model};
    oracle::LensNumbers& n = c.numbers;
    switch (model) {
      case LensModel::simple_radial:
        lens.distortion[0] = n.above[0] = term();
        break;
      case LensModel::radial:
        lens.distortion[0] = n.above[0] = term();
        lens.distortion[1] = n.above[1] = term() / 4;
        break;
      case LensModel::opencv:
        lens.distortion = {n.above[0] = term(), n.above[1] = term() / 4, n.p1 = small_term(),
                           n.p2 = small_term()};
        break;
      case LensModel::full_opencv:
      case LensModel::opencv_14:
        lens.distortion = {n.above[0] = term(), n.above[1] = term() / 4, n.p1 = small_term(),
                           n.p2 = small_term(), n.above[2] = term() / 8};
        if (below(2) == 0) {
          lens.distortion[5] = n.below[0] = term() / 2;
          lens.distortion[6] = n.below[1] = term() / 8;
          lens.distortion[7] = n.below[2] = term() / 16;
        }
        if (model == LensModel::full_opencv) break;
        lens.distortion[8] = n.s1 = small_term();
        lens.distortion[9] = n.s2 = small_term() / 2;
        lens.distortion[10] = n.s3 = small_term();
        lens.distortion[11] = n.s4 = small_term() / 2;
        break;
      case LensModel::brown:
        lens.distortion = {n.above[0] = term(),     n.above[1] = term() / 4,
                           n.above[2] = term() / 8, n.above[3] = term() / 16,
                           n.p1 = small_term(),     n.p2 = small_term()};
        break;
      case LensModel::fov:
        n.omega = lens.distortion[0] = (below(2) == 0 ? 1 : -1) * (1 + below(20)) / 8.0;
        break;
      case LensModel::ftheta: {
        n.angle = {below(2) == 0 ? 0 : -below(3) / 4.0,
                   0.5 + below(5) / 4.0,
                   term() / 2,
                   term() / 4,
                   term() / 8,
                   term() / 16};
        std::copy(n.angle->begin(), n.angle->end(), lens.distortion.begin());
        break;
      }
      case LensModel::simple_division:
      case LensModel::division:
        lens.distortion[0] = term();
        n.division = lens.distortion[0];
        break;
      case LensModel::fisheye_stereographic:
        n.division = -0.25;
        break;
      case LensModel::simple_fisheye:
      case LensModel::fisheye:
        break;
      case LensModel::simple_radial_fisheye:
        lens.distortion[0] = n.above[0] = term();
        break;
      case LensModel::radial_fisheye:
        lens.distortion = {n.above[0] = term(), n.above[1] = term() / 4};
        break;
      case LensModel::opencv_fisheye:
        lens.distortion = {n.above[0] = term(), n.above[1] = term() / 4, n.above[2] = term() / 8,
                           n.above[3] = term() / 16};
        break;
      case LensModel::thin_prism_fisheye:
        lens.distortion = {n.above[0] = term(), n.above[1] = term() / 4, n.p1 = small_term(),
                           n.p2 = small_term(), n.above[2] = term() / 8, n.above[3] = term() / 16,
                           n.s1 = small_term(), n.s3 = small_term()};
        break;
      case LensModel::rad_tan_thin_prism_fisheye:
        for (std::size_t i = 0; i < n.first.size(); ++i)
          lens.distortion[i] = n.first[i] = std::ldexp(term(), -2 * static_cast<int>(i));
        lens.distortion[6] = n.p2 = small_term();
        lens.distortion[7] = n.p1 = small_term();
        lens.distortion[8] = n.s1 = small_term();
        lens.distortion[9] = n.s2 = small_term() / 2;
        lens.distortion[10] = n.s3 = small_term();
        lens.distortion[11] = n.s4 = small_term() / 2;
        break;
      case LensModel::fisheye_orthographic:
        n.root = oracle::LensNumbers::Root::orthographic;
        break;
      case LensModel::fisheye_equisolid:
        n.root = oracle::LensNumbers::Root::equisolid;
        break;
      case LensModel::ucm:
      case LensModel::eucm:
        n.root = oracle::LensNumbers::Root::unified;
        lens.distortion[0] = n.alpha = below(9) / 8.0;
        if (model == LensModel::eucm) lens.distortion[1] = n.beta = (1 + below(8)) / 4.0;
        break;
      case LensModel::double_sphere:
        n.root = oracle::LensNumbers::Root::double_sphere;
        lens.distortion = {n.xi = (below(15) - 7) / 8.0, n.alpha = below(9) / 8.0};
        break;
      case LensModel::omni:
        n.root = oracle::LensNumbers::Root::omnidirectional;
        lens.distortion[0] = n.xi = below(13) / 8.0;
        if (below(2) == 0) break;
        lens.distortion[1] = n.above[0] = term();
        lens.distortion[2] = n.above[1] = term() / 4;
        lens.distortion[3] = n.p1 = small_term();
        lens.distortion[4] = n.p2 = small_term();
        break;
      default:
        break;
    }
    n.is_angle = entry_of(model).formula == RayFormula::angle;
    Projection& projection = c.view.camera.projection;
    if (has_one_focal_length(entry_of(model))) {
      projection.fy = projection.fx;
      projection.skew = 0;
    }
    if (is_panorama(model)) set_panorama(model, c);
    projection.lens = lens;
  }

  /// Widths and heights of which samples lie at 30°, 45°, 36° and others.
  void set_panorama(LensModel model, LensCase& c) {
    constexpr std::array turns{6.0, 8.0, 10.0, 12.0, 14.0, 24.0};
    const bool is_sphere = model == LensModel::equirectangular;
    Projection& p = c.view.camera.projection;
    p.fx = turns[static_cast<std::size_t>(below(6))];
    if (is_sphere) p.fy = turns[static_cast<std::size_t>(below(6))] / 2;
    p.skew = 0;
    using Panorama = oracle::LensNumbers::Panorama;
    c.numbers.panorama = is_sphere ? Panorama::sphere : Panorama::cylinder;
  }

  /// Moves the image so that a sample sees a point m of few bits, and corners onto its ray.
  void put_corners_on_a_ray(LensCase& c) {
    Projection& p = c.view.camera.projection;
    for (const double below : c.numbers.below)
      if (below != 0) return;
    if (c.numbers.omega && below(2) == 0) return put_corners_on_the_fixed_circle(c);
    const double m_x = std::ldexp(this->below(9) - 4, -3), m_y = std::ldexp(this->below(9) - 4, -3);
    double first = 1, power_of_first = 1;
    for (const double k : c.numbers.first) first += k * (power_of_first *= m_x * m_x + m_y * m_y);
    const double x = m_x * first, y = m_y * first;
    const double q = x * x + y * y;
    double factor = 1, power = 1;
    for (const double k : c.numbers.above) factor += k * (power *= q);
    const oracle::LensNumbers& n = c.numbers;
    const double gx =
        x * factor + 2 * n.p1 * x * y + n.p2 * (q + 2 * x * x) + n.s1 * q + n.s2 * q * q;
    const double gy =
        y * factor + n.p1 * (q + 2 * y * y) + 2 * n.p2 * x * y + n.s3 * q + n.s4 * q * q;
    const std::array d{m_x, m_y, n.division ? 1 + *n.division * q : 1.0};
    // Corners of few bits lie on no ray of a fisheye but the axis, and on few of FOV and of a model
    // with a root. Edges in the plane of the ray and the axis meet it.
    const bool is_meridian =
        (n.is_angle || n.omega || n.angle || n.root != oracle::LensNumbers::Root::none) && q > 0;
    p.skew = 0;
    p.pixel_centre = 0.5;
    p.cx = this->below(6) + 0.5 - p.fx * gx;
    p.cy = this->below(5) + 0.5 - p.fy * gy;
    move_corners(c, d, is_meridian ? std::optional<std::size_t>(2) : std::nullopt);
  }

  /// Moves the image so that a sample of FOV lies at (3, 4)/10, on the circle that it shows where a
  /// pinhole does.
  void put_corners_on_the_fixed_circle(LensCase& c) {
    Projection& p = c.view.camera.projection;
    p.fx = p.fy = 10;
    p.skew = 0;
    p.pixel_centre = 0.5;
    p.cx = below(6) + 0.5 - 3;
    p.cy = below(5) + 0.5 - 4;
    move_corners(c, {0.75, 1, 2.5}, std::nullopt);
  }

  /// Moves the image so that a sample looks along a multiple of 45°. Where its ray has no direction
  /// of few bits, edges in its meridian plane meet it.
  void put_corners_on_a_turned_ray(LensCase& c) {
    Projection& p = c.view.camera.projection;
    const bool is_sphere = c.numbers.panorama == oracle::LensNumbers::Panorama::sphere;
    const int eighths = below(8), down = below(3) - 1;
    constexpr std::array<double, 8> sines{0, 1, 1, 1, 0, -1, -1, -1};
    const double across = sines[static_cast<std::size_t>(eighths)];
    const double ahead = sines[static_cast<std::size_t>((eighths + 2) % 8)];
    p.pixel_centre = 0.5;
    p.cx = below(6) + 0.5 - p.fx * eighths / 8;
    p.cy = below(5) + 0.5 - p.fy * down / 4;
    const bool is_meridian = eighths % 2 != 0 && down != 0;
    move_corners(c, {across, is_sphere ? down : down / 4.0, ahead},
                 is_meridian ? std::optional<std::size_t>(1) : std::nullopt);
  }

  /// Moves corners onto the ray d, or (`free`) into the plane of the ray and this axis.
  void move_corners(LensCase& c, const std::array<double, 3>& d, std::optional<std::size_t> free) {
    c.view.camera.world_to_camera = Camera().world_to_camera;
    const auto in_plane = [&](double t, double along) {
      std::array<double, 3> p{d[0] * t, d[1] * t, d[2] * t};
      p[*free] = along;
      return MeshPoint{p[0], p[1], p[2]};
    };
    for (Mesh& mesh : c.view.scene.meshes) {
      std::vector<MeshPoint> corners(mesh.vertices.begin(), mesh.vertices.end());
      for (std::size_t i = 0; i + 1 < corners.size(); i += 2) {
        const double t = 1 + this->below(4);
        const double across = std::ldexp(this->below(9) - 4, -1),
                     up = std::ldexp(this->below(9) - 4, -1);
        // Either the corner is on the ray, or the ray meets the middle between two corners.
        const double aside = free ? 0 : this->below(2);
        corners[i] = {d[0] * t + aside * across, d[1] * t + aside * up, d[2] * t};
        if (free) corners[i] = in_plane(t, across);
        if (free && this->below(2) == 0) corners[i + 1] = in_plane(up, -across);
        if (aside != 0) corners[i + 1] = {d[0] * t - across, d[1] * t - up, d[2] * t};
      }
      mesh.vertices = std::move(corners);
    }
  }

  std::mt19937_64 random_;
  CaseMaker cases_;
};

}  // namespace fathom::checks
