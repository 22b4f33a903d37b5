#include "validation/lenses/lens_judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <variant>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/rays/cast.h"
#include "validation/blender/blender_renderer.h"

namespace fathom::validation {
namespace {

using attribution::OtherMap;
using attribution::PixelClass;
using attribution::PixelRays;
using attribution::RayModel;
using attribution::RendererModel;

RendererModel model_of(const LensCase& given, const RoundedRays& rays) {
  auto pixels = std::make_shared<PixelRays>();
  pixels->rays.resize(given.truth.depths.size());
  for (std::size_t k = 0; k < rays.rays.size(); ++k)
    pixels->rays[rays.pixels[k]].direction = rays.rays[k].direction;
  return {
      .name = "rays in binary32", .watertight = false, .kind = RayModel{.rays = std::move(pixels)}};
}

OtherMap map_of(const LensCase& given, const RoundedRays& rays, const std::vector<RayHit>& hits) {
  OtherMap map{.width = given.camera.width, .height = given.camera.height};
  map.depths.assign(given.truth.depths.size(), std::numeric_limits<double>::infinity());
  map.triangles.assign(given.truth.depths.size(), no_surface);
  for (std::size_t k = 0; k < hits.size(); ++k) {
    const auto& [x, y, z] = rays.rays[k].direction;
    map.depths[rays.pixels[k]] = hits[k].t * std::hypot(x, y, z);
    map.triangles[rays.pixels[k]] = hits[k].triangle;
  }
  return map;
}

/// Whether the pixel shows something else than the exact map, for a reason that is known.
bool is_of_another_surface(PixelClass pixel_class) {
  return pixel_class == PixelClass::edge || pixel_class == PixelClass::z_fight ||
         pixel_class == PixelClass::missed;
}

RendererModel model_of_cycles(const Camera& camera, CyclesAzimuth azimuth) {
  auto rays = std::make_shared<PixelRays>(cycles_rays(camera, blender_sample_error, azimuth));
  return {.name = "Cycles",
          .watertight = false,
          .kind = RayModel{.depth_from_point = true, .rays = std::move(rays)}};
}

std::size_t count_rays(const RendererModel& model) {
  const auto& rays = std::get<RayModel>(model.kind).rays->rays;
  return static_cast<std::size_t>(std::ranges::count_if(
      rays, [](const auto& ray) { return ray.direction != std::array<double, 3>{}; }));
}

}  // namespace

LensJudge::LensJudge(const LensCase& given)
    : given_(given), rays_(rounded_rays(given.camera)), model_(model_of(given, rays_)) {
  hits_ = cast(RayScene(given.world), rays_.rays);
}

JudgedLens LensJudge::judge(const EngineAnswers& answers) const {
  JudgedLens judged{.rays = rays_.rays.size(), .map = map_of(given_, rays_, answers.nearest)};
  judged.attribution = attribution::attribute(given_.truth, judged.map, model_);
  for (std::size_t k = 0; k < hits_.size(); ++k) {
    const PixelClass found = judged.attribution.classes[rays_.pixels[k]];
    if (!is_of_another_surface(found)) continue;
    if (answers.nearest[k].triangle == hits_[k].triangle) {
      ++judged.by_rounded_rays;
    } else if (found == PixelClass::missed) {
      ++judged.missed;
    }
  }
  return judged;
}

JudgedLens judge_cycles(const LensCase& given, OtherMap map) {
  const RendererModel model = model_of_cycles(given.camera, CyclesAzimuth::by_acos),
                      smooth = model_of_cycles(given.camera, CyclesAzimuth::exact);
  // Blender writes 10¹⁰ where a ray meets nothing.
  for (double& distance : map.depths)
    if (distance > given.camera.far) distance = std::numeric_limits<double>::infinity();
  JudgedLens judged{.rays = count_rays(model), .map = std::move(map)};
  judged.attribution = attribution::attribute(given.truth, judged.map, model);
  judged.missed = judged.attribution.count(PixelClass::missed);
  const auto by_smooth = attribution::attribute(given.truth, judged.map, smooth);
  for (std::size_t i = 0; i < by_smooth.classes.size(); ++i) {
    if (by_smooth.classes[i] == PixelClass::unexplained &&
        judged.attribution.classes[i] != PixelClass::unexplained)
      ++judged.by_acos;
  }
  return judged;
}

}  // namespace fathom::validation
