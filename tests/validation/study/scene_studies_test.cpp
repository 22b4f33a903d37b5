#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/study/antialiasing/coverage.h"
#include "apps/study/study.h"
#include "apps/study/subpixel/subpixel.h"
#include "apps/study/z_fighting/scene_fights.h"
#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

nlohmann::json summary_of(const std::vector<StudyFile>& files) {
  for (const StudyFile& file : files) {
    if (file.name == "summary.json") return nlohmann::json::parse(file.content);
  }
  return {};
}

SceneView small_panels() {
  SceneView view = panels_with_decals();
  view.camera.width = 160;
  view.camera.height = 90;
  view.camera.projection.fx = view.camera.projection.fy = 75;
  view.camera.projection.cx = 80;
  view.camera.projection.cy = 45;
  return view;
}

const std::function<void(double)> no_tick = [](double) {};

/// The depth test over all layers, with an offset of nothing, is that of the depth buffer.
TEST(SceneStudies, LayersAgreeWithTheDepthBuffer) {
  const SceneView view = small_panels();
  const DepthFormat format{Mapping::standard, Storage::unorm24, 0.01, 1000};
  const std::vector<LayeredSample> samples = layered_samples(view);
  const OffsetCount none = count_with_offset({view, samples, format, 48}, {});
  const SceneFights fights = buffer_scene(view, visible_map(view), format).fights;
  EXPECT_GT(fights.fighting, 100U);
  EXPECT_EQ(none.fights, fights.fighting);
  EXPECT_EQ(none.shows_through, 0U);
}

/// Decals are pulled out of the panels, and then out from under the covers 0.05 before them.
TEST(SceneStudies, AnOffsetCuresFightsAndThenShowsWhatIsHidden) {
  const SceneView view = small_panels();
  const std::vector<LayeredSample> samples = layered_samples(view);
  const OffsetLayers layers(view, samples, {Mapping::standard, Storage::unorm24, 0.01, 1000}, 48);
  const OffsetCount little = count_with_offset(layers, {0, -2, 0});
  const OffsetCount much = count_with_offset(layers, {0, -4096, 0});
  EXPECT_LT(little.fights, count_with_offset(layers, {}).fights);
  EXPECT_GT(much.shows_through, little.shows_through);

  // What still fights is a cover with its panel, where there is no decal: they have no offset.
  const CertifiedFormat format({Mapping::standard, Storage::unorm24, 0.01, 1000});
  const auto fights_without_decal = [&](const LayeredSample& s) {
    const auto stored = [&](const Layer& layer) { return encode_layer(format, layer); };
    const auto winner =
        std::min_element(s.layers.begin(), s.layers.end(),
                         [&](const Layer& a, const Layer& b) { return stored(a) < stored(b); });
    return s.layers.back().number < 48 && winner->number != s.layers[s.visible].number;
  };
  EXPECT_EQ(much.fights, std::count_if(samples.begin(), samples.end(), fights_without_decal));
  EXPECT_GT(much.fights, 0U);
}

/// Two depths that are stored alike lie in one bin.
TEST(SceneStudies, NoLostSeparationExceedsTheBin) {
  const std::vector<LayeredSample> samples = layered_samples(small_panels());
  std::size_t lost = 0;
  for (const Mapping mapping : {Mapping::standard, Mapping::log, Mapping::linear}) {
    for (const Storage storage : {Storage::unorm16, Storage::unorm24, Storage::float32}) {
      // Bins of these grow with the depth, but that the bin at the end can be the shorter by the
      // rounding of its own ends: by less than one part in 2^10 where a bin holds so many numbers;
      // a class reaches a factor of √2 farther, and bins of standard grow by 2 over it.
      for (const LostSeparation& s : lost_separations(samples, {mapping, storage, 0.01, 1000})) {
        EXPECT_LE(s.greatest_lost, s.predicted * (1 + 0x1p-10));
        lost += s.greatest_lost > 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(lost, 10U);
}

/// Corners that lie on the grid do not move, and the map is the exact one: also where samples lie
/// on edges, by the top-left rule.
TEST(SnappedRaster, CornersOnTheGridGiveTheExactMap) {
  SceneView view;
  Mesh mesh;
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 3; ++k) {
      const int seed = 7919 * (3 * i + k + 1);
      mesh.vertices.push_back({seed % 97 * 0.25 - 2, seed % 89 * 0.25 - 2, 1 + i % 7 * 0.5});
    }
    const auto first = static_cast<std::uint32_t>(3 * i);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  mesh.face_count = mesh.triangles.size();
  view.scene.meshes = {mesh};
  view.scene.objects = {{.name = "triangles"}};
  view.camera.width = view.camera.height = 20;
  view.camera.projection.model = ProjectionModel::orthographic;
  const DepthMap exact = visible_map(view);
  for (const int bits : {2, 3, 8, 16}) {
    const SnappedMap snapped = draw_snapped(view, bits);
    const auto& id = *exact.values<std::uint32_t>("id");
    for (std::size_t i = 0; i < id.size(); ++i) ASSERT_EQ(snapped.id[i], id[i]) << bits << " " << i;
  }
}

/// With 0 bits corners at 2.6 move to 3, so that pixel 2 (centre 2.5) is lost and kept beyond 2.5.
TEST(SnappedRaster, CornersMoveToTheNearestPoint) {
  SceneView view;
  Mesh mesh;
  mesh.vertices = {{2.4, 2.6, 1}, {7.6, 2.6, 1}, {7.6, 7.4, 1}, {2.4, 7.4, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.face_count = 2;
  view.scene.meshes = {mesh};
  view.scene.objects = {{.name = "square"}};
  view.camera.width = view.camera.height = 10;
  view.camera.projection.model = ProjectionModel::orthographic;
  const auto covered = [&](int bits) {
    const SnappedMap map = draw_snapped(view, bits);
    return std::count_if(map.id.begin(), map.id.end(), [](auto id) { return id != no_surface; });
  };
  EXPECT_EQ(covered(0), 6 * 4);  // 2 to 8 by 3 to 7
  EXPECT_EQ(covered(8), 6 * 4);  // 2.4 to 7.6 by 2.6 to 7.4: centres 2.5 … 7.5 by 3.5 … 6.5
  view.scene.meshes[0].vertices = {{2.6, 2.6, 1}, {7.4, 2.6, 1}, {7.4, 7.4, 1}, {2.6, 7.4, 1}};
  EXPECT_EQ(covered(0), 4 * 4);
  view.scene.meshes[0].vertices = {{2.45, 2.45, 1}, {7.4, 2.45, 1}, {7.4, 7.4, 1}, {2.45, 7.4, 1}};
  EXPECT_EQ(covered(0), 5 * 5);
  EXPECT_EQ(covered(1), 5 * 5);  // 2.5 to 7.5: samples on the left and top edge belong to it
}

TEST(SceneStudies, SubpixelErrorsFallWithTheBits) {
  const auto summary = summary_of(study_subpixel({}, no_tick));
  const auto differing = [&](int bits) {
    const auto& row = summary["bits"][bits];
    return row["lost"].get<int>() + row["gained"].get<int>();
  };
  EXPECT_EQ(differing(0), 1002);
  EXPECT_EQ(differing(4), 36);
  EXPECT_GT(differing(0), 10 * differing(6));
  EXPECT_LE(differing(16), 1);
  const auto error = [&](int bits) {
    return summary["bits"][bits]["mean_relative_depth_error"].get<double>();
  };
  for (const int bits : {2, 5, 8, 11}) {  // three bits: an eighth
    EXPECT_GT(error(bits) / error(bits + 3), 5.0);
    EXPECT_LT(error(bits) / error(bits + 3), 13.0);
  }
}

TEST(SceneStudies, CoverageBySamplesConvergesToTheArea) {
  SceneView view = wheel();  // at a quarter of its size
  view.camera.width = view.camera.height = 80;
  view.camera.projection.fx = view.camera.projection.fy = view.camera.projection.cx =
      view.camera.projection.cy = 40;
  const CoverageBySamples measured =
      measure_coverage_by_samples(view, exact_coverage(view), no_tick);
  const auto rms = [&](const std::string& pattern) {
    const auto row = std::find_if(measured.patterns.begin(), measured.patterns.end(),
                                  [&](const PatternError& p) { return p.pattern == pattern; });
    return row == measured.patterns.end() ? 0.0 : row->root_mean_square;
  };
  EXPECT_GT(rms("1"), rms("2"));
  EXPECT_GT(rms("2"), rms("4"));
  EXPECT_GT(rms("4"), rms("8"));
  EXPECT_GT(rms("8"), rms("16"));
  EXPECT_GT(rms("regular:2"), rms("regular:4"));
  EXPECT_GT(rms("regular:4"), rms("regular:8"));
  EXPECT_GT(rms("regular:8"), rms("regular:16"));
  for (const EdgeSeen& edge : measured.edges) {
    EXPECT_GE(edge.partial, 64U);  // at least one pixel a column
    EXPECT_EQ(edge.seen[0], 0U);   // one sample sees no part
    EXPECT_LE(edge.seen[3], edge.partial);
    const auto error = [&](const std::string& pattern) {
      const auto at = std::find(std::begin(edge_patterns), std::end(edge_patterns), pattern);
      return edge.root_mean_square.at(static_cast<std::size_t>(at - std::begin(edge_patterns)));
    };
    if (edge.slope == 0.03) {  // nearly level: rows count
      EXPECT_LT(error("rotated-grid"), error("regular:2"));
      EXPECT_LT(error("16"), error("regular:4"));
    }
    if (edge.slope == 0.71) {
      EXPECT_GT(error("rotated-grid"), error("regular:2"));
      EXPECT_GT(error("16"), error("regular:4"));
    }
  }
}

TEST(SceneStudies, ReversedFloatsAndFartherNearPlanesHelp) {
  StudyOptions options;
  options.scene = small_panels();
  const auto summary = summary_of(study_mitigation(options, no_tick));
  const auto& nears = summary["near_planes"];
  EXPECT_GT(nears.front()["fighting_pixels"], nears.back()["fighting_pixels"]);
  for (const auto& format : summary["formats"]) {
    if (format["cure"] == "reversed float32") {
      EXPECT_EQ(format["fighting_pixels"], 0);
    }
  }
  EXPECT_EQ(summary["offsets"][0]["fights"], nears.front()["fighting_pixels"]);
}

/// What docs/studies.md says of the study's own scene.
TEST(SceneStudies, FiguresOfTheMitigation) {
  const auto summary = summary_of(study_mitigation({}, no_tick));
  std::vector<int> fights;
  for (const auto& cure : summary["near_planes"]) fights.push_back(cure["fighting_pixels"]);
  EXPECT_EQ(fights, (std::vector<int>{13644, 11088, 6894, 3924, 1890, 486, 0, 0}));
  for (const auto& cure : summary["formats"]) {
    const std::string name = cure["cure"];
    const bool as_before =
        name == "standard unorm24" || name == "standard float32" || name == "reversed unorm24";
    EXPECT_EQ(cure["surface_pixels"], 129601);
    EXPECT_EQ(cure["fighting_pixels"], as_before ? 13644 : 0) << name;
  }
  for (const auto& offset : summary["offsets"]) {
    const bool none = offset["factor"] == 0 && offset["units"] == 0;
    EXPECT_EQ(offset["fights"], none ? 13644 : 3546);
    const auto shows = [&](double factor, int units, int pixels) {
      if (offset["factor"] == factor && offset["units"] == units) {
        EXPECT_EQ(offset["hidden_surfaces_that_show"], pixels);
      }
    };
    shows(0, 0, 0);
    shows(0, -1, 8532);
    shows(0, -64, 19440);
    shows(-0.5, 0, 22382);
  }
}

/// Nothing lies behind anything, and nothing fights: figures without the plots that would be empty.
TEST(SceneStudies, OneSurfaceAlone) {
  StudyOptions options;
  options.scene = small_panels();
  options.scene->scene.meshes = {options.scene->scene.meshes[1]};
  options.scene->scene.objects = {{.mesh = 0, .name = "decals"}};
  const auto has = [](const std::vector<StudyFile>& files, const std::string& name) {
    return std::any_of(files.begin(), files.end(),
                       [&](const StudyFile& file) { return file.name == name; });
  };
  const auto fights = study_scene_fights(options, no_tick);
  EXPECT_EQ(summary_of(fights)["layered_samples"], 0);
  EXPECT_TRUE(has(fights, "index.html"));
  EXPECT_FALSE(has(fights, "separation.png"));
  const auto cures = study_mitigation(options, no_tick);
  EXPECT_EQ(summary_of(cures)["near_planes"][0]["fighting_pixels"], 0);
  EXPECT_TRUE(has(cures, "near.csv"));
  EXPECT_FALSE(has(cures, "near.png"));
}

TEST(SceneStudies, ASceneCanBeGiven) {
  StudyOptions options;
  options.scene = small_panels();
  const auto summary = summary_of(study_scene_fights(options, no_tick));
  EXPECT_EQ(summary["formats"].size(), 54U);
  EXPECT_EQ(summary["near"], 0.01);
  for (const double near : {5000.0, 0.0, -1.0}) {
    options.near = near;
    EXPECT_THROW(study_scene_fights(options, no_tick), UsageError);
    EXPECT_THROW(study_mitigation(options, no_tick), UsageError);
  }
  options.near.reset();
  options.samples = 10;
  EXPECT_THROW(study_scene_fights(options, no_tick), UsageError);
  EXPECT_THROW(study_mitigation(options, no_tick), UsageError);
}

}  // namespace
}  // namespace fathom::studies
