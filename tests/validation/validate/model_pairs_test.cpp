#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "apps/validate/faults/fault_study.h"
#include "fathom/attribution/attribution.h"
#include "fathom/attribution/judgement.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/other_scene.h"
#include "validation/peers/drawing.h"

/// Maps of real renderers, each judged by every model: where the model is not the renderer's,
/// nothing but the model may be blamed, and where something is wrong with the map as well, that is
/// found too.
///   FATHOM_MODEL_PAIRS=all    all scenes, larger, and Blender (scripts/check-long). Otherwise each
///                             pair has one or two of five scenes in turn, and every fourth pair a
///                             shifted one
namespace fathom::validation {
namespace {

using attribution::Finding;
using attribution::Judgement;
using attribution::PixelClass;

bool all_are_wanted() {
  const char* wanted = std::getenv("FATHOM_MODEL_PAIRS");
  return wanted != nullptr && std::string(wanted) == "all";
}

struct Size {
  std::uint32_t width = 64, height = 48;
};

constexpr Size large{160, 120};

Size size_of_maps() {
  return all_are_wanted() ? large : Size{};
}

std::vector<std::string> scenes() {
  if (all_are_wanted()) return scene_names();
  return {"slivers", "coplanar", "sheets", "room", "range"};
}

/// One renderer for each named model, as far as there is one.
std::vector<Peer> peers() {
  std::vector<Peer> all;
  for (const char* variant : {"unorm16", "unorm24", "unorm32", "float32", "float32 reversed"}) {
    all.push_back(peer_named(Renderer::opengl, variant));
    all.push_back(peer_named(Renderer::vtk, variant));
  }
  all.push_back(peer_named(Renderer::embree, "robust"));
  if (all_are_wanted()) all.push_back(peer_named(Renderer::blender, "cycles"));
  return all;
}

std::vector<std::string> models_that_draw() {
  std::vector<std::string> names;
  for (const Peer& peer : peers()) names.push_back(matching_model(peer).value());
  return names;
}

std::vector<std::string> models_to_name() {
  std::vector<std::string> names;
  for (const attribution::RendererModel& model : attribution::named_models()) {
    names.push_back(model.name);
  }
  return names;
}

/// A map that a renderer drew, as it is brought.
struct BroughtMap {
  std::string scene, model;
  std::shared_ptr<const attribution::Truth> truth;
  attribution::OtherMap map;
};

/// `shift`: how far to the right samples lie of where they should, in pixels.
std::vector<BroughtMap> drawn(const std::vector<std::string>& scenes, double shift,
                              const Size& size = size_of_maps()) {
  std::vector<BroughtMap> maps;
  for (const std::string& scene : scenes) {
    for (const Peer& peer : peers()) {
      const Drawing drawing = draw_in_child(
          peer,
          [&] {
            ValidationScene made = make_validation_scene(scene, size.width, size.height);
            made.camera.projection.cx -= shift;
            return made;
          },
          300);
      const std::string model = matching_model(peer).value();
      // Blender cannot express a camera with skew.
      if (!drawing.drawn && model == "cycles") continue;
      if (!drawing.drawn) {
        ADD_FAILURE() << scene << " by " << model << ": " << drawing.failure;
        continue;
      }
      maps.push_back({scene, model, nullptr, as_brought(drawing.drawn->map)});
    }
  }
  return maps;
}

void set_truths(std::vector<BroughtMap>& maps) {
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (i > 0 && maps[i].scene == maps[i - 1].scene) {
      maps[i].truth = maps[i - 1].truth;
      continue;
    }
    const ValidationScene made =
        make_validation_scene(maps[i].scene, maps[i].map.width, maps[i].map.height);
    maps[i].truth =
        std::make_shared<attribution::Truth>(attribution::make_truth(made.scene, made.camera));
  }
}

/// Whether a pair is to judge the scene of this number.
bool is_its_turn(const std::string& drew, const std::string& named, std::size_t scene,
                 std::size_t every) {
  const auto number_in = [](const std::vector<std::string>& names, const std::string& name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const std::size_t turn = number_in(models_that_draw(), drew) + number_in(models_to_name(), named);
  return all_are_wanted() || (turn + scene) % every == 0;
}

Judgement judged(const BroughtMap& brought, const std::string& model) {
  Judgement found = attribution::judge(brought.truth, brought.map,
                                       attribution::model_for(model, brought.truth->camera));
  attribution::name_other_scene(brought.truth->camera, brought.map, found);
  return found;
}

std::string told(const BroughtMap& brought, const Judgement& found) {
  std::string text = brought.scene + ", judged as " + found.model.name + ": " +
                     std::to_string(found.attribution.count(PixelClass::unexplained)) +
                     " unexplained\n";
  for (const Finding& finding : found.attribution.findings) {
    text += "  " + attribution::finding_line(finding) + "\n";
  }
  return text;
}

/// Of a model that drew and one that was named.
class ModelPairs : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  /// Before any thread is started.
  static void SetUpTestSuite() {
    if (!right.empty()) return;
    right = drawn(scenes(), 0);
    shifted = drawn({"sphere"}, 0.5);
    far_away = drawn({"utm"}, 0, large);
    for (auto* maps : {&right, &shifted, &far_away}) set_truths(*maps);
  }

  static std::vector<BroughtMap> right, shifted, far_away;
};
std::vector<BroughtMap> ModelPairs::right, ModelPairs::shifted, ModelPairs::far_away;

void expect_that_model_is_blamed(const BroughtMap& brought, const std::string& named) {
  const Judgement found = judged(brought, named);
  EXPECT_EQ(found.attribution.count(PixelClass::unexplained), 0U) << told(brought, found);
  for (const Finding& finding : found.attribution.findings) {
    EXPECT_EQ(finding.kind, "model") << told(brought, found);
    EXPECT_NE(found.model.name, named) << told(brought, found);
  }
}

TEST_P(ModelPairs, NothingButTheModelIsBlamed) {
  const auto& [drew, named] = GetParam();
  std::size_t scene = 0;
  for (const BroughtMap& brought : right) {
    if (brought.model != drew || !is_its_turn(drew, named, scene++, 3)) continue;
    expect_that_model_is_blamed(brought, named);
  }
}

// Coordinates of some million units: without VTK's shift the bounds of OpenGL's models are wide, so
// that a map of 16 bits was said to have isolated wrong pixels.
TEST_F(ModelPairs, FarAwayNothingButTheModelIsBlamed) {
  for (const BroughtMap& brought : far_away) {
    if (brought.model == "gl-unorm16" || brought.model == "vtk-unorm16")
      expect_that_model_is_blamed(brought, "vtk-float32");
  }
}

bool says_shift(const Finding& finding) {
  return finding.kind == "shift" ||
         std::find(finding.alternatives.begin(), finding.alternatives.end(), "shift") !=
             finding.alternatives.end();
}

// What is wrong with the map comes first, and then perhaps the model.
TEST_P(ModelPairs, AShiftIsFoundByAnyModel) {
  const auto& [drew, named] = GetParam();
  std::size_t scene = 0;
  for (const BroughtMap& brought : shifted) {
    if (brought.model != drew || !is_its_turn(drew, named, scene++, 4)) continue;
    const Judgement found = judged(brought, named);
    const std::vector<Finding>& findings = found.attribution.findings;
    ASSERT_FALSE(findings.empty()) << told(brought, found);
    EXPECT_TRUE(says_shift(findings.front())) << told(brought, found);
    EXPECT_TRUE(std::all_of(findings.begin() + 1, findings.end(), [](const Finding& finding) {
      return finding.kind == "model";
    })) << told(brought, found);
  }
}

std::string name_of_pair(const testing::TestParamInfo<ModelPairs::ParamType>& info) {
  std::string name = std::get<0>(info.param) + "_named_" + std::get<1>(info.param);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Right, ModelPairs,
                         testing::Combine(testing::ValuesIn(models_that_draw()),
                                          testing::ValuesIn(models_to_name())),
                         name_of_pair);

}  // namespace
}  // namespace fathom::validation
