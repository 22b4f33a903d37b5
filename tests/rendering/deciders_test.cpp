#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "fathom/rendering/rendered.h"
#include "tests/places.h"

namespace fathom {
namespace {

std::string page(const std::string& path) {
  const std::ifstream file(test::source_dir() / path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string cell(std::string_view decider) {
  return decider.empty() ? "–" : std::string(decider);
}

TEST(Deciders, ThePageHasARowForEachDecisionOfEachEngine) {
  const std::string architecture = page("docs/architecture.md");
  for (const Engine engine : {Engine::reference, Engine::fast}) {
    for (const Deciders& d : deciders_of(engine)) {
      const std::string row = "| " + std::string(name_of(engine)) + " | `" +
                              std::string(d.decision) + "` | " + cell(d.interval) + " | " +
                              cell(d.exact) + " |";
      EXPECT_THAT(architecture, testing::HasSubstr(row));
    }
  }
}

TEST(Deciders, TheSpecificationNamesThem) {
  const std::string specification = page("docs/specification.md");
  for (const std::string_view decider :
       {cgal_determinant, cgal_form, cgal_quotient, dyadic_numbers})
    EXPECT_THAT(specification, testing::HasSubstr(std::string(decider)));
}

TEST(Deciders, BothEnginesHaveTheSameDecisions) {
  const auto reference = deciders_of(Engine::reference), fast = deciders_of(Engine::fast);
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    EXPECT_EQ(reference[i].decision, fast[i].decision);
    names.insert(reference[i].decision);
  }
  EXPECT_EQ(names.size(), reference.size());
}

}  // namespace
}  // namespace fathom
