#include "fathom/pipeline/trace.h"

#include <cmath>

#include "fathom/numeric/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/pipeline/output/draw_rules.h"
#include "fathom/scene/scene_fault.h"

namespace fathom::pipeline {
namespace {

InputTriangle triangle_numbered(const Scene& scene, std::uint32_t number,
                                const PipelineOptions& options) {
  std::uint32_t first = 0;
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
    const auto count =
        static_cast<std::uint32_t>(scene.meshes[scene.objects[object].mesh].triangles.size());
    if (number - first < count)
      return assemble_triangles(scene, object, first, options.front_face,
                                options.normals_from)[number - first];
    first += count;
  }
  throw UsageError(Setting{"triangle"}, "there is no triangle " + std::to_string(number) +
                                            "; the scene has " + std::to_string(first));
}

template <class Vertex>
std::array<double, 3> xyz(const Vertex& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

template <class Real>
std::array<double, 4> xyzw(const clipping::Point4<Real>& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z),
          static_cast<double>(p.w)};
}

template <class Real>
class Tracer {
 public:
  Tracer(const Scene& scene, const Camera& camera, const PipelineOptions& options)
      : scene_(scene),
        camera_(camera),
        options_(options),
        rules_(draw_rules_of(scene, options)),
        window_(drawable_window(camera, options)),
        viewport_(viewport_of(camera, options)),
        shader_(camera, options, texture_of(scene, options)) {}

  TriangleTrace run(const InputTriangle& input, const std::optional<Pixel>& pixel) {
    object_ = input.object;
    const VertexTransform<Real> transform(camera_, scene_.objects[input.object], options_);
    std::vector<ClipVertex<Real>> corners;
    std::array<WorldVertex<Real>, 3> world;
    for (std::size_t k = 0; k < 3; ++k) {
      const InputVertex& corner = input.corners[k];
      world[k] = transform.to_world(corner.position);
      corners.push_back(transform(corner));
      trace_.corners[k] = {xyz(corner.position), xyz(world[k]), xyz(transform.to_eye(world[k])),
                           xyzw(corners.back().position)};
      for (const double c : trace_.corners[k].clip)
        if (!std::isfinite(c))
          throw InputError("a corner of the triangle is no number after the transform");
    }
    const Lighting eye = lighting_of(camera_, options_);
    trace_.in_world =
        facing_in_world(world, eye.eye, !eye.orthographic, eye.mirrored, options_.front_face);
    if (options_.shading == Shading::gouraud) light_corners(corners, eye);
    for (std::size_t k = 0; k < 3; ++k) face_[k] = {world[k].x, world[k].y, world[k].z};
    const auto polygon = clip_triangle(corners, viewport_.volume);
    if (!polygon.empty()) to_window(polygon, input.number, pixel);
    return trace_;
  }

 private:
  void to_window(const std::vector<ClipVertex<Real>>& polygon, std::uint32_t number,
                 const std::optional<Pixel>& pixel) {
    std::vector<NdcVertex<Real>> ndc;
    std::vector<WindowVertex<Real>> window;
    for (const ClipVertex<Real>& corner : polygon) {
      ndc.push_back(divide(corner));
      window.push_back(viewport_(ndc.back()));
      const auto at = xyz(window.back());
      const GridPoint on_grid = snap(at[0], at[1], options_.subpixel_bits);
      trace_.polygon.push_back({xyzw(corner.position),
                                xyz(ndc.back()),
                                at,
                                {static_cast<double>(on_grid.x) / static_cast<double>(grid_one),
                                 static_cast<double>(on_grid.y) / static_cast<double>(grid_one)}});
    }
    trace_.in_ndc = facing_in_ndc<Real>({ndc[0], ndc[1], ndc[2]}, options_.front_face);
    trace_.in_window =
        facing_in_window<Real>({window[0], window[1], window[2]}, options_.front_face);
    trace_.culled = is_culled(trace_.in_window, options_.culling);
    if (trace_.culled) return;
    for (std::size_t i = 2; i < window.size(); ++i) {
      WindowTriangle<Real> part{
          number, {window[0], window[i - 1], window[i]}, trace_.in_window == Facing::front, face_};
      part.depth_offset = depth_offset(part, options_.depth_format.storage, rules_[object_].offset);
      if (const auto t = Interpolator<Real>::of(part, options_)) rasterize(*t, pixel);
    }
  }

  void rasterize(const Interpolator<Real>& t, const std::optional<Pixel>& pixel) {
    const PixelWindow box = t.grid().bounding_box();
    for (std::int64_t y = std::max(window_.y_begin, box.y_begin);
         y < std::min(box.y_end, window_.y_end); ++y) {
      const Span span = t.grid().span_of_row(y, window_);
      trace_.fragments +=
          static_cast<std::uint64_t>(std::max<std::int64_t>(0, span.x_end - span.x_begin));
    }
    if (!pixel || (trace_.sample && trace_.sample->covered)) return;
    const GridPoint sample = sample_of(*pixel);
    SampleTrace s;
    const auto edges = t.grid().edges_at(sample);
    const auto linear = t.linear_weights(sample), weights = t.attribute_weights(sample);
    for (std::size_t k = 0; k < 3; ++k) {
      s.edges[k] = std::ldexp(static_cast<double>(edges[k]), -2 * grid_bits);
      s.weights[k] = static_cast<double>(linear[k]);
      s.attribute_weights[k] = static_cast<double>(weights[k]);
    }
    s.covered = t.grid().covers(sample);
    s.drawable = window_.contains(*pixel);
    Fragment fragment = t.depths_at(sample);
    s.window_z = fragment.window_z;
    s.depth = fragment.depth;
    s.stored = DepthTest(options_).stored(fragment);
    if (s.covered) shade(s, t, fragment, sample);
    trace_.sample = s;
  }

  void shade(SampleTrace& s, const Interpolator<Real>& t, Fragment& fragment,
             const GridPoint& sample) {
    shader_.begin(t.triangle());
    t.complete(fragment, sample);
    const auto weights = t.attribute_weights(sample);
    s.turned = !shader_.shows_normals();
    s.light = shader_.light(fragment, weights);
    s.colour = shader_.shade(fragment, weights);
  }

  const Scene& scene_;
  const Camera& camera_;
  const PipelineOptions& options_;
  std::vector<DrawRules> rules_;
  PixelWindow window_;
  std::uint32_t object_ = 0;
  Viewport viewport_;
  Shader<Real> shader_;
  std::array<std::array<Real, 3>, 3> face_{};
  TriangleTrace trace_;
};

}  // namespace

TriangleTrace trace_triangle(const Scene& scene, const Camera& camera,
                             const PipelineOptions& options, std::uint32_t number,
                             const std::optional<Pixel>& pixel) {
  const StandardArithmetic standard;
  require_meaningful(options);
  require_renderable(scene, camera);
  PipelineOptions complete = options;
  fill_in_range(scene, camera, complete.depth_format);
  require_meaningful(complete.depth_format);
  const InputTriangle input = triangle_numbered(scene, number, complete);
  TriangleTrace trace = complete.precision == Precision::binary32
                            ? Tracer<float>(scene, camera, complete).run(input, pixel)
                            : Tracer<double>(scene, camera, complete).run(input, pixel);
  trace.near = complete.depth_format.near;
  trace.far = complete.depth_format.far;
  return trace;
}

}  // namespace fathom::pipeline
