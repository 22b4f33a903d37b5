#include "fathom/pipeline/trace.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/pipeline/output/draw_rules.h"
#include "fathom/pipeline/rasterization/rasterizer.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

/// A triangle, or a line or point of a file.
struct Numbered {
  std::variant<InputTriangle, InputLine> input;
  PrimitiveKind kind = PrimitiveKind::triangle;
};

std::uint32_t size_of(std::size_t count) {
  return static_cast<std::uint32_t>(count);
}

std::optional<Numbered> triangle_numbered(const Scene& scene, std::uint32_t number,
                                          const PipelineOptions& options) {
  std::uint32_t first = 0;
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
    const auto count = size_of(scene.meshes[scene.objects[object].mesh].triangles.size());
    if (number - first < count)
      return Numbered{assemble_triangles(scene, object, first, options.front_face,
                                         options.normals_from)[number - first]};
    first += count;
  }
  return std::nullopt;
}

std::optional<Numbered> line_or_point_numbered(const Scene& scene, std::uint32_t number) {
  auto first = size_of(triangle_count(scene));
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
    const Mesh& mesh = scene.meshes[scene.objects[object].mesh];
    if (number - first < mesh.lines.size())
      return Numbered{assemble_lines(scene, object, first)[number - first], PrimitiveKind::line};
    first += size_of(mesh.lines.size());
    if (number - first < mesh.points.size())
      return Numbered{assemble_points(scene, object, first)[number - first], PrimitiveKind::point};
    first += size_of(mesh.points.size());
  }
  return std::nullopt;
}

std::size_t lines_and_points_of(const Scene& scene) {
  std::size_t count = 0;
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    count += mesh.lines.size() + mesh.points.size();
  }
  return count;
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
  Tracer(const Scene& scene, const Camera& camera, const PipelineOptions& options,
         const TraceRequest& request)
      : scene_(scene),
        camera_(camera),
        options_(options),
        request_(request),
        rules_(draw_rules_of(scene, options)),
        window_(drawable_window(camera, options)),
        viewport_(viewport_of(camera, options)),
        shader_(camera, options, texture_of(scene, options)) {
    options_.early_depth = false;  // all fragments are to be observed
  }

  PrimitiveTrace run(const Numbered& numbered) {
    trace_.kind = numbered.kind;
    if (const auto* triangle = std::get_if<InputTriangle>(&numbered.input)) {
      trace_.number = triangle->number;
      follow(*triangle);
    } else {
      const auto& line = std::get<InputLine>(numbered.input);
      trace_.number = line.number;
      follow(line, numbered.kind == PrimitiveKind::point);
    }
    return std::move(trace_);
  }

 private:
  /// The vertex transform of one corner.
  ClipVertex<Real> transformed(const InputVertex& corner, const VertexTransform<Real>& transform) {
    const WorldVertex<Real> world = transform.to_world(corner.position);
    ClipVertex<Real> vertex = transform(corner);
    trace_.corners.push_back(
        {xyz(corner.position), xyz(world), xyz(transform.to_eye(world)), xyzw(vertex.position)});
    for (const double c : trace_.corners.back().clip)
      if (!std::isfinite(c))
        throw InputError("a corner of the primitive is no number after the transform");
    return vertex;
  }

  /// Division and viewport.
  WindowVertex<Real> to_window(const ClipVertex<Real>& corner) {
    const NdcVertex<Real> ndc = divide(corner);
    const WindowVertex<Real> window = viewport_(ndc);
    const auto at = xyz(window);
    const GridPoint on_grid = snap(at[0], at[1], options_.subpixel_bits);
    trace_.polygon.push_back({xyzw(corner.position),
                              xyz(ndc),
                              at,
                              {static_cast<double>(on_grid.x) / static_cast<double>(grid_one),
                               static_cast<double>(on_grid.y) / static_cast<double>(grid_one)}});
    return window;
  }

  void follow(const InputLine& input, bool is_point) {
    object_ = input.object;
    const VertexTransform<Real> transform(camera_, scene_.objects[input.object], options_);
    const ClipVertex<Real> a = transformed(input.ends[0], transform);
    if (is_point) {
      if (!is_inside(a, viewport_.volume)) return;
      const WindowPoint<Real> point{input.number, to_window(a), input.object};
      observe_rows(point.place.y, point.place.y,
                   [&](const RasterizerSettings& settings, FrameBuffer& row) {
                     rasterize_points<Real>({point}, settings, row, uncounted_);
                   });
      return;
    }
    const auto part = clip_line(a, transformed(input.ends[1], transform), viewport_.volume);
    if (!part) return;
    const WindowVertex<Real> from = to_window((*part)[0]), to = to_window((*part)[1]);
    const WindowLine<Real> line{input.number, {from, to}, input.object};
    observe_rows(std::min(from.y, to.y), std::max(from.y, to.y),
                 [&](const RasterizerSettings& settings, FrameBuffer& row) {
                   rasterize_lines<Real>({line}, settings, row, uncounted_);
                 });
  }

  void follow(const InputTriangle& input) {
    object_ = input.object;
    const VertexTransform<Real> transform(camera_, scene_.objects[input.object], options_);
    std::vector<ClipVertex<Real>> corners;
    std::array<WorldVertex<Real>, 3> world;
    for (std::size_t k = 0; k < 3; ++k) {
      world[k] = transform.to_world(input.corners[k].position);
      corners.push_back(transformed(input.corners[k], transform));
    }
    const Lighting eye = lighting_of(camera_, options_);
    trace_.in_world =
        facing_in_world(world, eye.eye, !eye.orthographic, eye.mirrored, options_.front_face);
    if (options_.shading == Shading::gouraud) light_corners(corners, eye);
    for (std::size_t k = 0; k < 3; ++k) face_[k] = {world[k].x, world[k].y, world[k].z};
    const auto polygon = clip_triangle(corners, viewport_.volume);
    if (!polygon.empty()) draw(polygon, input.number);
  }

  void draw(const std::vector<ClipVertex<Real>>& polygon, std::uint32_t number) {
    std::vector<WindowVertex<Real>> window;
    window.reserve(polygon.size());
    for (const ClipVertex<Real>& corner : polygon) window.push_back(to_window(corner));
    trace_.in_ndc = facing_in_ndc<Real>(
        {divide(polygon[0]), divide(polygon[1]), divide(polygon[2])}, options_.front_face);
    trace_.in_window =
        facing_in_window<Real>({window[0], window[1], window[2]}, options_.front_face);
    trace_.culled = is_culled(trace_.in_window, options_.culling);
    if (trace_.culled) return;
    for (std::size_t i = 2; i < window.size(); ++i) {
      WindowTriangle<Real> part{
          number, {window[0], window[i - 1], window[i]}, trace_.in_window == Facing::front, face_};
      part.object = object_;
      part.depth_offset = depth_offset(part, options_.depth_format.storage, rules_[object_].offset);
      if (const auto t = Interpolator<Real>::of(part, options_)) rasterize_part(*t);
    }
  }

  void rasterize_part(const Interpolator<Real>& t) {
    const PixelWindow box = t.grid().bounding_box();
    for (std::int64_t y = std::max(window_.y_begin, box.y_begin);
         y < std::min(box.y_end, window_.y_end); ++y) {
      check_interruption();
      const Span span = t.grid().span_of_row(y, window_);
      trace_.fragments +=
          static_cast<std::uint64_t>(std::max<std::int64_t>(0, span.x_end - span.x_begin));
      if (request_.fragments)
        observe_row(y, [&](const RasterizerSettings& settings, FrameBuffer& row) {
          rasterize<Real>({t.triangle()}, settings, &shader_, row, uncounted_);
        });
    }
    if (request_.pixel && !(trace_.sample && trace_.sample->covered)) look_at(*request_.pixel, t);
  }

  void look_at(const Pixel& pixel, const Interpolator<Real>& t) {
    const GridPoint sample = sample_of(pixel);
    SampleTrace s;
    const auto edges = t.grid().edges_at(sample);
    const auto linear = t.linear_weights(sample), weights = t.attribute_weights(sample);
    for (std::size_t k = 0; k < 3; ++k) {
      s.edges[k] = std::ldexp(static_cast<double>(edges[k]), -2 * grid_bits);
      s.weights[k] = static_cast<double>(linear[k]);
      s.attribute_weights[k] = static_cast<double>(weights[k]);
    }
    s.covered = t.grid().covers(sample);
    s.drawable = window_.contains(pixel);
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

  /// Lists the fragments of one row that `draw` makes, in a frame buffer where nothing else is.
  template <class Draw>
  void observe_row(std::int64_t y, const Draw& draw_row) {
    FrameBuffer row{camera_.width, 1, 1, options_.background, static_cast<std::uint32_t>(y)};
    const ObserveMerge observe = [&](const MergeStep& step) {
      if (step.pixel.y != y) return;
      trace_.fragment_list.push_back({step.pixel, step.fragment.window_z, step.fragment.depth,
                                      step.fragment.stored, step.colour});
    };
    const PixelWindow window{window_.x_begin, y, window_.x_end, y + 1};
    draw_row(
        RasterizerSettings{options_, rules_, centre_, ShadingRate::per_sample,
                           options_.hidden_surface == HiddenSurface::z_buffer, window, &observe},
        row);
  }

  /// The same for the rows of a line or a point. Their fragments are few, so they are counted by
  /// drawing them. A line can draw a row beyond the rows of its ends.
  template <class Draw>
  void observe_rows(Real top, Real bottom, const Draw& draw_row) {
    const auto begin = std::max(window_.y_begin, floor_of(top) - 1);
    const auto end = std::min(window_.y_end, floor_of(bottom) + 2);
    if (window_.is_empty()) return;
    for (std::int64_t y = begin; y < end; ++y) observe_row(y, draw_row);
    trace_.fragments = trace_.fragment_list.size();
    if (!request_.fragments) trace_.fragment_list.clear();
  }

  const Scene& scene_;
  const Camera& camera_;
  PipelineOptions options_;
  const TraceRequest& request_;
  std::vector<DrawRules> rules_;
  PixelWindow window_;
  GridSamples centre_ = GridSamples::centre();
  std::uint32_t object_ = 0;
  Viewport viewport_;
  Shader<Real> shader_;
  PipelineStatistics uncounted_;
  std::array<std::array<Real, 3>, 3> face_{};
  PrimitiveTrace trace_;
};

/// The stages that look at the primitive by itself.
PrimitiveTrace follow_stages(const Scene& scene, const Camera& camera,
                             const PipelineOptions& options,
                             const std::optional<Numbered>& numbered, const TraceRequest& request) {
  PrimitiveTrace trace = options.precision == Precision::binary32
                             ? Tracer<float>(scene, camera, options, request).run(*numbered)
                             : Tracer<double>(scene, camera, options, request).run(*numbered);
  trace.near = options.depth_format.near;
  trace.far = options.depth_format.far;
  trace.storage = options.depth_format.storage;
  return trace;
}

PipelineOptions traced_options(const Scene& scene, const Camera& camera,
                               const PipelineOptions& options) {
  require_meaningful(options);
  require_renderable(scene, camera);
  PipelineOptions complete = options;
  fill_in_range(scene, camera, complete.depth_format);
  require_meaningful(complete.depth_format);
  return complete;
}

}  // namespace

PrimitiveTrace trace_primitive(const Scene& scene, const Camera& camera,
                               const PipelineOptions& options, std::uint32_t number,
                               const TraceRequest& request) {
  const StandardArithmetic standard;
  const PipelineOptions complete = traced_options(scene, camera, options);
  auto numbered = triangle_numbered(scene, number, complete);
  if (numbered && (options.shading == Shading::points || options.shading == Shading::wireframe))
    throw UsageError(Setting{"shading"}, "points and wireframe draw no triangle to be traced");
  if (!numbered) numbered = line_or_point_numbered(scene, number);
  if (!numbered)
    throw UsageError(Setting{"primitive"},
                     "there is no primitive " + std::to_string(number) + "; the scene has " +
                         std::to_string(triangle_count(scene)) + " triangles, then " +
                         std::to_string(lines_and_points_of(scene)) + " lines and points");
  PrimitiveTrace trace = follow_stages(scene, camera, complete, numbered, request);
  if (!request.merger && !request.painter) return trace;
  FrameWatch watch =
      watch_frame(scene, camera, options, request.merger ? request.pixel : std::nullopt);
  trace.merger = std::move(watch.merger);
  trace.painter = std::move(watch.painter);
  return trace;
}

PrimitiveTrace trace_triangle(const Scene& scene, const Camera& camera,
                              const PipelineOptions& options, std::uint32_t number,
                              const std::optional<Pixel>& pixel) {
  const StandardArithmetic standard;
  const PipelineOptions complete = traced_options(scene, camera, options);
  const auto numbered = triangle_numbered(scene, number, complete);
  if (!numbered)
    throw UsageError(Setting{"triangle"}, "there is no triangle " + std::to_string(number) +
                                              "; the scene has " +
                                              std::to_string(triangle_count(scene)));
  return follow_stages(scene, camera, complete, numbered, {.pixel = pixel});
}

}  // namespace fathom::pipeline
