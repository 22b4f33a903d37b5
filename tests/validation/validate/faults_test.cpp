#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/validate/faults/fault_study.h"
#include "fathom/attribution/model/named_models.h"
#include "tests/effort.h"

/// The catalogue's faults in the map of an ideal renderer, which rounds depths to binary32 and
/// nothing else: all that are large enough are found and rightly named. (`fathom validate --faults`
/// does the same with maps of real ones.)
namespace fathom::validation {
namespace {

TEST(FaultCatalogue, HasSixtyFaultsOfDifferentNames) {
  std::set<std::pair<std::string, std::string>> names;
  for (const Fault& fault : fault_catalogue()) {
    EXPECT_TRUE(names.insert({fault.group, fault.name}).second) << fault.name;
    EXPECT_FALSE(fault.kinds.empty());
    EXPECT_NE(fault.drawn == nullptr, fault.changed == nullptr) << fault.name;
  }
  EXPECT_GE(names.size(), 60U);
}

const ValidationScene& spot() {
  static const ValidationScene scene = make_validation_scene("spot", 160, 120);
  return scene;
}

attribution::OtherMap spoiled(const Fault& fault, const FaultSubject& subject, double size) {
  if (!fault.drawn) return changed_map(fault, subject, size);
  return as_brought(exact_map_of(fault.drawn(spot(), size)));
}

using Group = std::pair<std::string, std::string>;  // and the model

class FaultGroups : public ::testing::TestWithParam<Group> {};

TEST_P(FaultGroups, AreFoundAndRightlyNamed) {
  const auto& [group, model] = GetParam();
  const FaultSubject subject =
      fault_subject(spot(), exact_map_of(spot()), attribution::model_named(model));
  const std::vector<Fault> faults = fault_catalogue();
  // Under sanitizers one of the group's faults in four.
  constexpr int every = checks::effort > 1 ? 4 : 1;
  int number = 0;
  FaultStudy study;
  for (const Fault& fault : faults) {
    if (fault.group != group || (fault.raster_only && model == "float32-ray")) continue;
    if (number++ % every != 0) continue;
    for (const double size : sizes_of(fault, subject)) {
      study.faults.push_back({&fault, "spot", "ideal", "",
                              judged(fault, subject, spoiled(fault, subject, size), size)});
    }
  }
  EXPECT_FALSE(study.faults.empty());
  EXPECT_TRUE(study.is_good()) << lines_of(study);
  EXPECT_TRUE(subject.found.findings.empty());
  EXPECT_TRUE(subject.found.notes.empty());
}

INSTANTIATE_TEST_SUITE_P(
    All, FaultGroups,
    ::testing::Values(Group{"background", "gl-unorm24"}, Group{"storage", "gl-unorm24"},
                      Group{"units", "gl-unorm24"}, Group{"decoding", "gl-unorm24"},
                      Group{"camera", "gl-unorm24"}, Group{"camera", "float32-ray"},
                      Group{"image", "float32-ray"}, Group{"surfaces", "gl-unorm24"},
                      Group{"pixels", "float32-ray"}),
    [](const auto& g) {
      return g.param.first + (g.param.second == "gl-unorm24" ? "OfARasterizer" : "OfARayTracer");
    });

}  // namespace
}  // namespace fathom::validation
