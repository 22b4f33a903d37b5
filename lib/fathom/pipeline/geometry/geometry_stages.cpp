#include "fathom/pipeline/geometry/geometry_stages.h"

#include <algorithm>
#include <cmath>

#include "fathom/pipeline/fragments/shading.h"
#include "fathom/threads/interruption.h"

// How to read this file: GeometryStages::run() is the order of the stages, for one triangle.
namespace fathom::pipeline {
namespace {

template <class Real>
bool is_finite(const ClipVertex<Real>& v) {
  const auto& [x, y, z, w] = v.position;
  return std::isfinite(x) && std::isfinite(y) && std::isfinite(z) && std::isfinite(w) &&
         std::all_of(v.attributes.begin(), v.attributes.end(),
                     [](Real a) { return std::isfinite(a); });
}

template <class Real>
class GeometryStages {
 public:
  GeometryStages(const Camera& camera, const PipelineOptions& options,
                 const std::vector<DrawRules>& rules, WindowPrimitives<Real>& out,
                 PipelineStatistics& statistics)
      : options_(options),
        rules_(rules),
        viewport_(viewport_of(camera, options)),
        lighting_(lighting_of(camera, options)),
        out_(out),
        count_(statistics) {}

  void run(const InputTriangle& input, const VertexTransform<Real>& transform) {
    check_interruption();
    ++count_.triangles;
    std::vector<ClipVertex<Real>> corners;
    for (const InputVertex& corner : input.corners) corners.push_back(transform(corner));
    if (!std::all_of(corners.begin(), corners.end(), is_finite<Real>)) {
      ++count_.not_finite;
      return;
    }
    if (options_.shading == Shading::gouraud) light_corners(corners, lighting_);
    const auto polygon = clip_triangle(corners, viewport_.volume);
    if (polygon.empty()) {
      ++count_.clipped_away;
      return;
    }
    const bool whole = polygon.size() == 3 && same_place(polygon, corners);
    if (!whole) ++count_.clipped;
    std::vector<WindowVertex<Real>> window;
    window.reserve(polygon.size());
    for (const ClipVertex<Real>& corner : polygon) window.push_back(viewport_(divide(corner)));
    if (whole) compare_facings(corners, window);
    bool culled = false, degenerate = true;
    WindowTriangle<Real> part{
        .number = input.number, .corners = {}, .face = face_of(corners), .object = input.object};
    for (std::size_t i = 2; i < window.size(); ++i) {
      part.corners = {window[0], window[i - 1], window[i]};
      emit(part, culled, degenerate);
    }
    count_.culled += culled;
    count_.degenerate += degenerate && !culled;
    if (!degenerate) emit_outline(input, corners);
  }

  /// A line of a file; a point where `is_point`.
  void run(const InputLine& input, const VertexTransform<Real>& transform, bool is_point) {
    check_interruption();
    const ClipVertex<Real> a = transform(input.ends[0]), b = transform(input.ends[1]);
    if (!is_finite(a) || !is_finite(b)) {
      ++count_.not_finite;
    } else if (is_point) {
      count_.points += emit_point(input.number, input.object, a);
    } else {
      count_.lines += emit_line(input.number, input.object, a, b);
    }
  }

 private:
  static bool same_place(const std::vector<ClipVertex<Real>>& a,
                         const std::vector<ClipVertex<Real>>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), [](const auto& p, const auto& q) {
      return p.position.x == q.position.x && p.position.y == q.position.y &&
             p.position.z == q.position.z && p.position.w == q.position.w;
    });
  }

  static std::array<std::array<Real, 3>, 3> face_of(const std::vector<ClipVertex<Real>>& corners) {
    std::array<std::array<Real, 3>, 3> face{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < 3; ++i) face[k][i] = corners[k].attributes[attribute::world + i];
    return face;
  }

  void compare_facings(const std::vector<ClipVertex<Real>>& corners,
                       const std::vector<WindowVertex<Real>>& window) {
    std::array<WorldVertex<Real>, 3> world;
    for (std::size_t k = 0; k < 3; ++k) {
      const Real* p = &corners[k].attributes[attribute::world];
      world[k] = {p[0], p[1], p[2]};
    }
    const FrontFace rule = options_.front_face;
    const bool in_world = facing_in_world(world, lighting_.eye, !lighting_.orthographic,
                                          lighting_.mirrored, rule) == Facing::front;
    const bool in_ndc =
        facing_in_ndc<Real>({divide(corners[0]), divide(corners[1]), divide(corners[2])}, rule) ==
        Facing::front;
    const bool in_window =
        facing_in_window<Real>({window[0], window[1], window[2]}, rule) == Facing::front;
    FacingStatistics& f = count_.facings;
    ++f.compared;
    f.front_in_world += in_world;
    f.front_in_ndc += in_ndc;
    f.front_in_window += in_window;
    f.disagreeing += in_world != in_ndc || in_ndc != in_window;
  }

  void emit_outline(const InputTriangle& input, const std::vector<ClipVertex<Real>>& corners) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (options_.shading == Shading::wireframe) {
        emit_line(input.number, input.object, corners[k], corners[(k + 1) % 3]);
      } else if (options_.shading == Shading::points) {
        emit_point(input.number, input.object, corners[k]);
      }
    }
  }

  /// Whether something of it is in the view volume.
  bool emit_line(std::uint32_t number, std::uint32_t object, const ClipVertex<Real>& a,
                 const ClipVertex<Real>& b) {
    const auto line = clip_line(a, b, viewport_.volume);
    if (!line) return false;
    const auto& [from, to] = *line;
    out_.lines.push_back({number, {viewport_(divide(from)), viewport_(divide(to))}, object});
    return true;
  }

  bool emit_point(std::uint32_t number, std::uint32_t object, const ClipVertex<Real>& place) {
    if (!is_inside(place, viewport_.volume)) return false;
    out_.points.push_back({number, viewport_(divide(place)), object});
    return true;
  }

  void emit(WindowTriangle<Real> triangle, bool& culled, bool& degenerate) {
    const Facing facing = facing_in_window(triangle.corners, options_.front_face);
    if (facing == Facing::edge_on) return;
    if (is_culled(facing, options_.culling)) {
      culled = true;
      return;
    }
    degenerate = false;
    triangle.front = facing == Facing::front;
    triangle.depth_offset =
        depth_offset(triangle, options_.depth_format.storage, rules_[triangle.object].offset);
    const auto on_grid = GridTriangle::of(snapped(triangle, options_.subpixel_bits));
    const bool ccw = (options_.front_face == FrontFace::counter_clockwise) == triangle.front;
    if (!on_grid || on_grid->counter_clockwise() != ccw) ++count_.turned_by_snapping;
    ++count_.drawn;
    out_.triangles.push_back(triangle);
  }

  const PipelineOptions& options_;
  const std::vector<DrawRules>& rules_;
  Viewport viewport_;
  Lighting lighting_;
  WindowPrimitives<Real>& out_;
  PipelineStatistics& count_;
};

}  // namespace

template <class Real>
WindowPrimitives<Real> to_window(const Scene& scene, const Camera& camera,
                                 const PipelineOptions& options,
                                 const std::vector<DrawRules>& rules,
                                 PipelineStatistics& statistics) {
  WindowPrimitives<Real> primitives;
  GeometryStages<Real> stages(camera, options, rules, primitives, statistics);
  std::vector<VertexTransform<Real>> transforms;
  for (const Object& object : scene.objects) transforms.emplace_back(camera, object, options);
  std::uint32_t number = 0;
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
    for (const InputTriangle& triangle :
         assemble_triangles(scene, object, number, options.front_face, options.normals_from))
      stages.run(triangle, transforms[object]);
    number += static_cast<std::uint32_t>(scene.meshes[scene.objects[object].mesh].triangles.size());
  }
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
    for (const bool points : {false, true}) {
      const auto list =
          points ? assemble_points(scene, object, number) : assemble_lines(scene, object, number);
      for (const InputLine& each : list) stages.run(each, transforms[object], points);
      number += static_cast<std::uint32_t>(list.size());
    }
  }
  return primitives;
}

template WindowPrimitives<float> to_window(const Scene&, const Camera&, const PipelineOptions&,
                                           const std::vector<DrawRules>&, PipelineStatistics&);
template WindowPrimitives<double> to_window(const Scene&, const Camera&, const PipelineOptions&,
                                            const std::vector<DrawRules>&, PipelineStatistics&);

}  // namespace fathom::pipeline
