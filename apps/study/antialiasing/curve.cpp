#include "apps/study/antialiasing/curve.h"

#include <algorithm>
#include <cmath>

#include "apps/study/antialiasing/methods.h"
#include "apps/study/pipeline_scenes.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/pipeline/scan/tessellate.h"

namespace fathom::studies {
namespace {

using pipeline::ColourImage;
using pipeline::CubicBezier;
using pipeline::PlanePoint;

constexpr std::uint32_t small = 24;
constexpr double tolerance = 0.1;

std::vector<CubicBezier> scaled(const std::vector<CubicBezier>& outline, double factor) {
  std::vector<CubicBezier> result;
  result.reserve(outline.size());
  for (const CubicBezier& curve : outline) result.push_back(curve.scaled(factor));
  return result;
}

/// The corners of an outline's chords, each once.
std::vector<PlanePoint> polygon_of(const std::vector<CubicBezier>& outline, double within) {
  std::vector<PlanePoint> polygon;
  for (const CubicBezier& curve : outline) {
    const std::vector<PlanePoint> points = flattened(curve, within);
    polygon.insert(polygon.end(), points.begin(), points.end() - 1);
  }
  return polygon;
}

double area_of(const std::vector<PlanePoint>& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PlanePoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    sum += (p.x * q.y - p.y * q.x) / 2;
  }
  return sum;
}

/// Areas to the right of directed lines, by pixel: `within` in the line's own pixel, `beyond` for
/// all that are to the right of it in the row.
class AreaSum {
 public:
  explicit AreaSum(std::uint32_t size)
      : size_(size), within_(std::size_t{size} * size), beyond_(within_.size()) {}

  /// Cuts the line where it passes from pixel to pixel.
  void add(const PlanePoint& p, const PlanePoint& q) {
    std::vector<double> cuts{0, 1};
    add_cuts(cuts, p.x, q.x);
    add_cuts(cuts, p.y, q.y);
    std::sort(cuts.begin(), cuts.end());
    const auto at = [&](double t) {
      return PlanePoint{p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
    };
    for (std::size_t i = 1; i < cuts.size(); ++i) add_part(at(cuts[i - 1]), at(cuts[i]));
  }

  [[nodiscard]] ColourImage areas() const {
    ColourImage image{size_, size_, {}};
    for (std::uint32_t y = 0; y < size_; ++y) {
      double from_left = 0;
      for (std::uint32_t x = 0; x < size_; ++x) {
        const std::size_t i = std::size_t{y} * size_ + x;
        const double area = std::abs(from_left + within_[i]);
        image.pixels.push_back({area, area, area});
        from_left += beyond_[i];
      }
    }
    return image;
  }

 private:
  static void add_cuts(std::vector<double>& cuts, double a, double b) {
    const double first = std::floor(std::min(a, b)) + 1, last = std::ceil(std::max(a, b)) - 1;
    for (double place = first; place <= last; ++place) cuts.push_back((place - a) / (b - a));
  }

  /// A part that lies in one pixel.
  void add_part(const PlanePoint& p, const PlanePoint& q) {
    const double x = std::floor((p.x + q.x) / 2), y = std::floor((p.y + q.y) / 2);
    const std::size_t i = static_cast<std::size_t>(y) * size_ + static_cast<std::size_t>(x);
    const double height = q.y - p.y;
    within_[i] += height * (1 - ((p.x + q.x) / 2 - x));
    beyond_[i] += height;
  }

  std::uint32_t size_;
  std::vector<double> within_, beyond_;
};

/// The polygon as triangles.
Scene tessellated(const std::vector<PlanePoint>& polygon) {
  pipeline::Rings<pipeline::Exact> rings(1);
  for (const PlanePoint& p : polygon)
    rings[0].push_back({pipeline::Exact(p.x), pipeline::Exact(p.y)});
  std::vector<MeshPoint> v;
  std::vector<CornerIndices> t;
  for (const auto& triangle : pipeline::tessellate(rings)) {
    const auto first = static_cast<std::uint32_t>(v.size());
    for (const auto& corner : triangle)
      v.push_back({pipeline::to_binary64(corner.x), pipeline::to_binary64(corner.y), 0.5});
    t.push_back({first, first + 1, first + 2});
  }
  return scene_of(std::move(v), std::move(t));
}

/// By areas.
ColourImage drawn(const std::vector<PlanePoint>& polygon, std::uint32_t size) {
  pipeline::PipelineOptions options = precise_options();
  options.antialias.method = pipeline::AntialiasMethod::area;
  return render_frame(tessellated(polygon), window_camera(size, size), options, true).picture;
}

ColourImage enlarged(const ColourImage& image, std::uint32_t factor) {
  ColourImage large{image.width * factor, image.height * factor, {}};
  for (std::uint32_t y = 0; y < large.height; ++y)
    for (std::uint32_t x = 0; x < large.width; ++x)
      large.pixels.push_back(image.at(x / factor, y / factor));
  return large;
}

}  // namespace

std::vector<CubicBezier> heart() {
  return {{{{{0.5, 0.28}, {0.55, 0.02}, {0.98, 0.0}, {0.93, 0.42}}}},
          {{{{0.93, 0.42}, {0.9, 0.66}, {0.62, 0.74}, {0.5, 0.94}}}},
          {{{{0.5, 0.94}, {0.38, 0.74}, {0.1, 0.66}, {0.07, 0.42}}}},
          {{{{0.07, 0.42}, {0.02, 0.0}, {0.45, 0.02}, {0.5, 0.28}}}}};
}

Scene heart_scene(std::uint32_t size, double within) {
  return tessellated(polygon_of(scaled(heart(), size), within));
}

ColourImage outline_areas(const std::vector<CubicBezier>& outline, std::uint32_t size) {
  const std::vector<PlanePoint> polygon = polygon_of(outline, 1e-6);
  AreaSum sum(size);
  for (std::size_t i = 0; i < polygon.size(); ++i)
    sum.add(polygon[i], polygon[(i + 1) % polygon.size()]);
  return sum.areas();
}

CurvePictures curve_pictures(int magnification) {
  const auto factor = static_cast<std::uint32_t>(magnification);
  const auto outline_at = [](std::uint32_t size) { return scaled(heart(), size); };
  return {enlarged(drawn(polygon_of(outline_at(small), tolerance), small), factor),
          drawn(polygon_of(outline_at(small * factor), tolerance), small * factor)};
}

CurveError curve_error(int magnification) {
  const std::uint32_t size = small * static_cast<std::uint32_t>(magnification);
  const std::vector<CubicBezier> outline = scaled(heart(), size);
  const std::vector<PlanePoint> polygon = polygon_of(outline, tolerance);
  double area = 0;
  for (const CubicBezier& curve : outline) area += area_beside(curve);
  const ColourImage truth = outline_areas(outline, size);
  const CurvePictures pictures = curve_pictures(magnification);
  return {magnification, polygon.size(), area_of(polygon) / area - 1,
          error_of(pictures.anew, truth).mean, error_of(pictures.enlarged, truth).mean};
}

}  // namespace fathom::studies
