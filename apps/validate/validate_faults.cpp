#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "apps/validate/faults/fault_study.h"
#include "apps/validate/validate_arguments.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/failures/errors.h"
#include "fathom/text/counted.h"
#include "validation/child/in_child.h"
#include "validation/peers/drawing.h"

namespace fathom::app {
namespace {

using validation::Fault;
using validation::FaultCase;
using validation::FaultStudy;
using validation::FaultSubject;
using validation::Peer;
using validation::ValidationScene;

/// A renderer in the variant whose maps are spoiled, and the named model that fits it.
struct Spoiled {
  Peer peer;
  attribution::RendererModel model;

  [[nodiscard]] std::string name() const {
    return validation::name_of(validation::renderer_of(peer));
  }
  [[nodiscard]] bool is_raster() const {
    return std::holds_alternative<attribution::RasterModel>(model.kind);
  }
};

Spoiled spoiled(const validation::DrivenRenderer& renderer) {
  using validation::Renderer;
  const auto made = [&](const char* variant) {
    const Peer peer = validation::peer_named(renderer, variant);
    return Spoiled{peer, attribution::model_named(validation::matching_model(peer).value())};
  };
  switch (renderer.renderer) {
    case Renderer::vtk:
    case Renderer::opengl:
      return made("unorm24");
    case Renderer::embree:
      return made("robust");
    case Renderer::blender:
      break;
  }
  return made("cycles");
}

/// A map that a fault spoiled, drawn or yet to be made of the right one.
struct SpoiledMap {
  const Fault* fault = nullptr;
  double size = 0;
  validation::Drawing drawing;
};

/// All maps of one renderer and scene. Before any thread is started: see draw_in_child.
struct SpoiledMaps {
  std::string scene;
  Spoiled renderer;
  std::function<ValidationScene()> make;
  validation::Drawing right;
  std::vector<SpoiledMap> maps;
};

/// Sizes of all faults, computed in a separate process, which may start threads.
std::vector<std::vector<double>> planned_sizes(const std::vector<Fault>& faults,
                                               const SpoiledMaps& maps) {
  return validation::in_child(
      [&] {
        const ValidationScene scene = maps.make();
        const FaultSubject subject =
            fault_subject(scene, maps.right.drawn->map, maps.renderer.model);
        std::vector<std::vector<double>> sizes;
        sizes.reserve(faults.size());
        for (const Fault& fault : faults) sizes.push_back(sizes_of(fault, subject));
        return sizes;
      },
      {.name = "planning", .seconds = 3600});
}

SpoiledMaps drawn_maps(const std::vector<Fault>& faults, const SceneToMake& scene,
                       const Spoiled& renderer, int seconds) {
  SpoiledMaps maps{scene.name, renderer, scene.make, {}, {}};
  maps.right = validation::draw_in_child(renderer.peer, scene.make, seconds);
  if (!maps.right.drawn) return maps;
  const std::vector<std::vector<double>> sizes = planned_sizes(faults, maps);
  for (std::size_t f = 0; f < faults.size(); ++f) {
    const Fault& fault = faults[f];
    if (fault.raster_only && !renderer.is_raster()) continue;
    for (const double size : sizes[f]) {
      SpoiledMap map{&fault, size, {}};
      if (fault.drawn) {
        map.drawing = validation::draw_in_child(
            renderer.peer, [&] { return fault.drawn(scene.make(), size); }, seconds);
      }
      maps.maps.push_back(std::move(map));
    }
  }
  return maps;
}

std::string said_of(const attribution::Attribution& found) {
  if (!found.findings.empty())
    return found.findings.front().kind + ": " + found.findings.front().text;
  const auto unexplained = found.count(attribution::PixelClass::unexplained);
  return unexplained == 0 ? "" : text::counted(unexplained, "pixel") + " unexplained";
}

void judge(const SpoiledMaps& maps, FaultStudy& study) {
  if (!maps.right.drawn) {
    study.right.push_back({maps.scene, maps.renderer.name(), maps.right.failure, ""});
    return;
  }
  const ValidationScene scene = maps.make();
  const FaultSubject subject = fault_subject(scene, maps.right.drawn->map, maps.renderer.model);
  study.right.push_back({maps.scene, maps.renderer.name(), "", said_of(subject.found)});
  for (const SpoiledMap& map : maps.maps) {
    FaultCase c{map.fault, maps.scene, maps.renderer.name(), map.drawing.failure, {}};
    if (!map.fault->drawn) {
      c.result = judged(*map.fault, subject, changed_map(*map.fault, subject, map.size), map.size);
    } else if (map.drawing.drawn) {
      const attribution::OtherMap brought = validation::as_brought(map.drawing.drawn->map);
      c.result = judged(*map.fault, subject, brought, map.size);
    }
    study.faults.push_back(std::move(c));
  }
}

void write_files(const FaultStudy& study, const std::string& folder) {
  OutputFile json(std::filesystem::path(folder) / "faults.json");
  OutputFile table(std::filesystem::path(folder) / "faults.md");
  json.write(validation::to_json(study));
  table.write(validation::to_markdown(study));
  OutputFile::commit_together({&json, &table});
}

bool all_drawn(const FaultStudy& study) {
  return std::all_of(study.right.begin(), study.right.end(),
                     [](const auto& c) { return c.failure.empty(); }) &&
         std::all_of(study.faults.begin(), study.faults.end(),
                     [](const auto& c) { return c.failure.empty(); });
}

}  // namespace

int validate_faults(const ValidateArguments& arguments, const Console& console) {
  const std::vector<SceneToMake> scenes = scenes_of(arguments, console);
  std::vector<Spoiled> renderers;
  for (const std::string& name : parse_list(arguments.against)) {
    renderers.push_back(
        about_option("--against", [&] { return spoiled(validation::renderer_named(name)); }));
  }
  expect_standard_output();
  if (!arguments.output.empty()) make_folder(arguments.output);
  const std::vector<Fault> faults = validation::fault_catalogue();
  std::vector<SpoiledMaps> maps;
  {
    Progress progress(console, "drawing");
    const auto report = progress.reporter();
    const auto count = static_cast<double>(scenes.size() * renderers.size());
    for (const SceneToMake& scene : scenes) {
      for (const Spoiled& renderer : renderers) {
        maps.push_back(drawn_maps(faults, scene, renderer, arguments.time_limit()));
        if (report) report(static_cast<double>(maps.size()) / count);
      }
    }
  }
  FaultStudy study;
  {
    Progress progress(console, "judging");
    for (std::size_t i = 0; i < maps.size(); ++i) {
      judge(maps[i], study);
      if (const auto report = progress.reporter(i, maps.size())) report(1);
    }
  }
  print(lines_of(study));
  if (!arguments.output.empty()) write_files(study, arguments.output);
  if (!study.is_good()) return answer_is_no;
  return all_drawn(study) ? done : unusable_input;
}

}  // namespace fathom::app
