#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "apps/textbook/pipeline/named_stages.h"
#include "apps/textbook/pipeline/stage_record.h"
#include "fathom/failures/errors.h"
#include "fathom/pipeline/geometry/back_face_culling.h"
#include "fathom/pipeline/geometry/primitive_assembly.h"
#include "fathom/pipeline/geometry/window_triangle.h"
#include "fathom/pipeline/rasterization/rasterizer.h"
#include "fathom/text/counted.h"

namespace fathom::app::stages {
namespace {

using cases::Json;
using pipeline::PipelineOptions;

/// Writes the attributes back into the record, if it has attributes.
template <class Corners>
void put_attributes(Json& record, const Corners& corners) {
  if (record.contains("depths")) {
    record["depths"] = Json::array();
    for (const auto& c : corners)
      record["depths"].push_back(static_cast<double>(c.attributes[pipeline::attribute::depth]));
  }
  if (!record.contains("colours")) return;
  record["colours"] = Json::array();
  for (const auto& c : corners)
    record["colours"].push_back(
        {static_cast<double>(c.attributes[pipeline::attribute::colour]),
         static_cast<double>(c.attributes[pipeline::attribute::colour + 1]),
         static_cast<double>(c.attributes[pipeline::attribute::colour + 2])});
}

Json primitive_assembly(Json record, pipeline::Precision) {
  const auto vertices = cases::points(record, "vertices", 3, 3);
  std::vector<std::uint32_t> indices;
  for (const double i : cases::numbers(cases::member(record, "indices"), "indices", 0, unlimited)) {
    if (i != std::floor(i) || i < 0 || i >= static_cast<double>(vertices.size()))
      throw InputError(fmt::format("indices: {} is not the number of one of {}", i,
                                   text::counted(vertices.size(), "vertex", "vertices")));
    indices.push_back(static_cast<std::uint32_t>(i));
  }
  record["primitives"] = Json::array();
  const auto put = [&](const auto& primitives) {
    for (const auto& primitive : primitives) {
      Json& corners = record["primitives"].emplace_back(Json{{"vertices", Json::array()}});
      for (const std::uint32_t v : primitive) corners["vertices"].push_back(vertices[v]);
    }
  };
  const std::string kind = cases::word(record, "primitive", {"triangles", "lines", "points"});
  if (kind == "triangles") put(pipeline::assemble<3>(indices));
  if (kind == "lines") put(pipeline::assemble<2>(indices));
  if (kind == "points") put(pipeline::assemble<1>(indices));
  return record;
}

/// "transform", 3 × 4; the identity where it is missing.
Object object_of(const Json& record) {
  Object object;
  if (!record.contains("transform")) return object;
  const auto rows = cases::points(record, "transform", 4, 4);
  if (rows.size() != 3) throw InputError("transform: expected three rows of four numbers");
  object.placed_as_is = false;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) object.world_from_mesh.rows[i][k] = Dyadic(rows[i][k]);
  return object;
}

template <class Real>
Json vertex_transform(Json record, pipeline::Precision precision) {
  const auto vertices = cases::points(record, "vertices", 3, 3);
  cases::member(record, "camera");
  const Camera camera = *camera_of(record);
  PipelineOptions options = options_of(record, precision);
  Scene scene;
  scene.meshes.emplace_back();
  for (const auto& v : vertices) scene.meshes[0].vertices.push_back({v[0], v[1], v[2]});
  scene.objects.push_back(object_of(record));
  try {
    pipeline::fill_in_range(scene, camera, options.depth_format);
  } catch (const UsageError& error) {
    throw InputError(error.what());
  }
  record["near"] = options.depth_format.near;
  record["far"] = options.depth_format.far;
  const pipeline::VertexTransform<Real> transform(camera, scene.objects[0], options);
  for (const char* key : {"world", "eye", "clip", "depths"}) record[key] = Json::array();
  for (const auto& v : vertices) {
    const auto world = transform.to_world(MeshPoint{v[0], v[1], v[2]});
    const auto eye = transform.to_eye(world);
    const auto clip = transform.to_clip(eye);
    record["world"].push_back(list_of(world.x, world.y, world.z));
    record["eye"].push_back(list_of(eye.x, eye.y, eye.z));
    record["clip"].push_back(list_of(clip.x, clip.y, clip.z, clip.w));
    record["depths"].push_back(-static_cast<double>(eye.z));
  }
  return record;
}

template <class Real>
std::vector<pipeline::ClipVertex<Real>> clip_corners(const Json& record) {
  const auto positions = cases::points(record, "clip", 4, 4);
  auto attributes = attributes_of<Real>(record, positions.size());
  std::vector<pipeline::ClipVertex<Real>> corners;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const auto& p = positions[k];
    corners.push_back({{static_cast<Real>(p[0]), static_cast<Real>(p[1]), static_cast<Real>(p[2]),
                        static_cast<Real>(p[3])},
                       std::move(attributes[k])});
  }
  return corners;
}

/// A point, a line or a polygon, by its number of corners.
template <class Real>
std::vector<pipeline::ClipVertex<Real>> clipped(
    const std::vector<pipeline::ClipVertex<Real>>& corners, clipping::Volume volume) {
  if (corners.size() > 2) return pipeline::clip_triangle(corners, volume);
  if (corners.size() < 2) {
    if (corners.empty() || !pipeline::is_inside(corners[0], volume)) return {};
    return corners;
  }
  const auto line = pipeline::clip_line(corners[0], corners[1], volume);
  if (!line) return {};
  return {(*line)[0], (*line)[1]};
}

template <class Real>
Json clipping_stage(Json record, pipeline::Precision precision) {
  const auto volume = pipeline::volume_of(options_of(record, precision).depth_format.mapping);
  const auto corners = clipped(clip_corners<Real>(record), volume);
  record["clip"] = Json::array();
  for (const auto& c : corners)
    record["clip"].push_back(list_of(c.position.x, c.position.y, c.position.z, c.position.w));
  put_attributes(record, corners);
  return record;
}

template <class Real>
Json perspective_division(Json record, pipeline::Precision) {
  record["ndc"] = Json::array();
  Json inverse_w = Json::array();
  for (const auto& corner : clip_corners<Real>(record)) {
    if (corner.position.w == 0)
      throw InputError("clip: a corner has w = 0, which no division takes; clip it first");
    const auto ndc = pipeline::divide(corner);
    record["ndc"].push_back(list_of(ndc.x, ndc.y, ndc.z));
    inverse_w.push_back(static_cast<double>(ndc.inverse_w));
  }
  record["inverse_w"] = std::move(inverse_w);
  return record;
}

template <class Real>
Json back_face_culling(Json record, pipeline::Precision precision) {
  const PipelineOptions options = options_of(record, precision);
  constexpr const char* names[] = {"front", "back", "edge on"};
  Json facing = Json::object();
  std::optional<pipeline::Facing> decisive;
  const auto look = [&](const char* space, const auto& corners, const auto& test) {
    if (corners.size() < 3) return;
    decisive = test({corners[0], corners[1], corners[2]}, options.front_face);
    facing[space] = names[static_cast<std::size_t>(*decisive)];
  };
  if (!record.contains("ndc") && !record.contains("window"))
    throw InputError("\"ndc\" or \"window\" is missing");
  if (record.contains("ndc"))
    look("ndc", corners_of<pipeline::NdcVertex<Real>, Real>(record, "ndc"),
         pipeline::facing_in_ndc<Real>);
  if (record.contains("window"))
    look("window", corners_of<pipeline::WindowVertex<Real>, Real>(record, "window"),
         pipeline::facing_in_window<Real>);
  record["facing"] = facing;
  record["culled"] = decisive && pipeline::is_culled(*decisive, options.culling);
  return record;
}

template <class Real>
Json viewport(Json record, pipeline::Precision precision) {
  const PipelineOptions options = options_of(record, precision);
  const Camera image = image_of(record);
  const pipeline::Viewport to_window = pipeline::viewport_of(image, options);
  Json window = Json::array();
  for (const auto& ndc : corners_of<pipeline::NdcVertex<Real>, Real>(record, "ndc")) {
    const auto p = to_window(ndc);
    window.push_back(list_of(p.x, p.y, p.z));
  }
  record["window"] = std::move(window);
  record["stretched"] = pipeline::is_stretched(image, options);
  return record;
}

}  // namespace

std::vector<NamedStage> geometry_stages() {
  return {{{"primitive-assembly", "vertices, indices, primitive", "primitives"},
           primitive_assembly,
           primitive_assembly},
          {{"vertex-transform", "vertices, camera, transform", "world, eye, clip, depths"},
           vertex_transform<float>,
           vertex_transform<double>},
          {{"clipping", "clip", "clip"}, clipping_stage<float>, clipping_stage<double>},
          {{"perspective-division", "clip", "ndc, inverse_w"},
           perspective_division<float>,
           perspective_division<double>},
          {{"back-face-culling", "ndc or window, front_face, cull", "facing, culled"},
           back_face_culling<float>,
           back_face_culling<double>},
          {{"viewport", "ndc, width, height, viewport, depth_range", "window, stretched"},
           viewport<float>,
           viewport<double>}};
}

}  // namespace fathom::app::stages
