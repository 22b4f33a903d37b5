// Weiler–Atherton against CGAL's Boolean set operations, as point sets and in exact areas.

#include "fathom/clipping/weiler_atherton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "fathom/clipping/boolean_by_cgal.h"
#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/failures/errors.h"
#include "tests/clipping/cgal_judge.h"
#include "tests/clipping/pieces.h"
#include "tests/clipping/print.h"
#include "tests/clipping/random_polygons.h"
#include "tests/effort.h"
#include "tests/places.h"

namespace fathom::clipping::test {
namespace {

std::string to_text(const Rings<double>& rings) {
  std::ostringstream text;
  for (const Ring<double>& ring : rings) {
    text << (&ring == rings.data() ? "[[" : ", [");
    for (std::size_t i = 0; i < ring.size(); ++i)
      text << (i == 0 ? "[" : ", [") << ring[i].x << ", " << ring[i].y << "]";
    text << "]";
  }
  return text.str() + "]";
}

std::string to_text(const Rings<double>& subject, const Rings<double>& clip) {
  return "{\"subject\": " + to_text(subject) + ", \"clip\": " + to_text(clip) + "}";
}

bool cross_each_other(const Rings<double>& rings) {
  try {
    checked_rings(rings, "random");
    return false;
  } catch (const InputError&) {
    return true;
  }
}

bool is_same(const std::vector<Polygon<Rational>>& p, const std::vector<Polygon<Rational>>& q) {
  return std::equal(p.begin(), p.end(), q.begin(), q.end(), [](const auto& a, const auto& b) {
    return a.outline == b.outline && a.holes == b.holes;
  });
}

constexpr SetOperation all_operations[] = {SetOperation::intersection, SetOperation::difference,
                                           SetOperation::join};

/// All operations on one pair, beside CGAL as a judge of regions and as another way to the answer.
/// Intersection and difference add up to the subject, the union and the intersection to both sides.
void expect_as_cgal(const Rings<double>& subject, const Rings<double>& clip) {
  const Judge judge(to_exact(subject), to_exact(clip));
  std::array<Rational, 3> areas;
  for (const SetOperation operation : all_operations) {
    const auto number = static_cast<std::size_t>(operation);
    constexpr const char* names[] = {"intersection", "difference", "union"};
    SCOPED_TRACE(names[number]);
    const auto answer = weiler_atherton(to_exact(subject), to_exact(clip), operation);
    ASSERT_EQ(area_of(answer), judge.area(operation)) << to_text(subject, clip);
    ASSERT_EQ(judge.fault(operation, answer), std::nullopt) << to_text(subject, clip);
    ASSERT_EQ(piece_fault(answer), std::nullopt) << to_text(subject, clip);
    ASSERT_TRUE(is_same(answer, boolean_by_cgal(to_exact(subject), to_exact(clip), operation)))
        << to_text(subject, clip);
    areas[number] = area_of(answer);
  }
  const auto area_of_side = [](const Rings<double>& rings) {
    return signed_area(checked_rings(to_exact(rings), "side"));
  };
  const auto& [common, rest, all] = areas;
  ASSERT_EQ(common + rest, area_of_side(subject)) << to_text(subject, clip);
  ASSERT_EQ(all + common, area_of_side(subject) + area_of_side(clip)) << to_text(subject, clip);
}

/// Random pairs on a grid from 0 to `size`: the smaller it is, the more they touch.
struct RandomPairs {
  std::uint64_t seed;
  int pairs, size, corners;
};

void PrintTo(const RandomPairs& r, std::ostream* stream) {
  *stream << r.pairs << " pairs on a grid of " << r.size << ", seed " << r.seed;
}

class WeilerAthertonRandom : public ::testing::TestWithParam<RandomPairs> {};

TEST_P(WeilerAthertonRandom, IsAsCgal) {
  const RandomPairs& random = GetParam();
  PolygonMaker maker(random.seed);
  for (int i = 0; i < checks::cases_to_draw(random.pairs, 4) && !HasFatalFailure(); ++i) {
    const auto side = [&] {
      return maker.polygon(random.size, 3 + maker.below(random.corners - 2), cross_each_other);
    };
    const Rings<double> subject = side(), clip = side();
    expect_as_cgal(subject, clip);
  }
}

// 21,000 pairs or a quarter of them, each with all operations; a twentieth under sanitizers.
INSTANTIATE_TEST_SUITE_P(Grids, WeilerAthertonRandom,
                         ::testing::Values(RandomPairs{1, 6000, 3, 8}, RandomPairs{2, 5000, 4, 10},
                                           RandomPairs{3, 4000, 5, 8}, RandomPairs{4, 3000, 6, 12},
                                           RandomPairs{5, 2000, 8, 16},
                                           RandomPairs{6, 1000, 20, 24}),
                         [](const auto& test) { return "Seed" + std::to_string(test.param.seed); });

using Json = nlohmann::json;

std::vector<Json> lines_of(const std::string& file) {
  std::ifstream stream(fathom::test::source_dir() / "data/clipping" / file);
  std::vector<Json> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(Json::parse(line));
  return lines;
}

Rings<double> rings_of(const Json& json) {
  Rings<double> rings;
  for (const Json& ring : json) {
    rings.emplace_back();
    for (const Json& p : ring) rings.back().push_back({p[0].get<double>(), p[1].get<double>()});
  }
  return rings;
}

SetOperation operation_of(const std::string& name) {
  if (name == "union") return SetOperation::join;
  return name == "difference" ? SetOperation::difference : SetOperation::intersection;
}

// The named degenerate contacts of data/: CGAL has the same point set, and the file of answers the
// same area.
TEST(WeilerAtherton, NamedDegenerateCases) {
  const auto cases = lines_of("degenerate.jsonl"), answers = lines_of("degenerate.answers.jsonl");
  ASSERT_GE(cases.size(), 200u);
  ASSERT_EQ(cases.size(), answers.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE(cases[i]["name"]);
    const auto operation = operation_of(cases[i]["op"]);
    const Rings<Rational> subject = to_exact(rings_of(cases[i]["subject"]));
    const Rings<Rational> clip = to_exact(rings_of(cases[i]["clip"]));
    const auto answer = weiler_atherton(subject, clip, operation);
    const Judge judge(subject, clip);
    EXPECT_EQ(judge.fault(operation, answer), std::nullopt);
    EXPECT_EQ(piece_fault(answer), std::nullopt);
    EXPECT_EQ(to_fraction(judge.area(operation)), answers[i]["area_exact"]);
    EXPECT_EQ(area_of(answer), judge.area(operation));
  }
}

Ring<Rational> rectangle(int x0, int y0, int x1, int y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// The borders that a walk follows one after the other.
std::string borders_of(const std::vector<WalkStep<Rational>>& walk) {
  std::string borders;
  for (const auto& step : walk) borders += "sc"[static_cast<int>(step.along)];
  return borders;
}

/// The contacts of a list by their kinds: entering, leaving, touching, along.
std::string kinds_of(const ContactList<Rational>& list) {
  std::string kinds;
  for (const auto& ring : list)
    for (const auto& place : ring)
      if (place.kind) kinds += "elta"[static_cast<int>(*place.kind)];
  return kinds;
}

// The lecture closes a piece at 'the most recently entered point'. A diamond whose four corners
// stick out of a square enters it four times before its first piece is closed: the walk follows the
// clip polygon to the next entering point and goes on along the subject.
TEST(WeilerAtherton, WalksToTheNextEnteringPointNotToTheLastOne) {
  const Ring<Rational> diamond{{3, -1}, {7, 3}, {3, 7}, {-1, 3}};
  WeilerAthertonTrace<Rational> trace;
  const auto answer = weiler_atherton<Rational>({diamond}, {rectangle(0, 0, 6, 6)},
                                                SetOperation::intersection, &trace);
  ASSERT_EQ(trace.walks.size(), 1u);
  EXPECT_EQ(borders_of(trace.walks[0]), "scscscsc");
  EXPECT_EQ(area_of(answer), 32 - 4);
  // Closed at the point last entered, each of the four pieces would be a subject edge and the clip
  // edge beside it: a quarter of the octagon's border each, with no area at all.
  EXPECT_EQ(kinds_of(trace.subject), "elelelel");
}

std::string kinds_of(const Ring<Rational>& subject, const Ring<Rational>& clip) {
  WeilerAthertonTrace<Rational> trace;
  weiler_atherton<Rational>({subject}, {clip}, SetOperation::intersection, &trace);
  return kinds_of(trace.subject);
}

// Foster, Hormann and Popa's cases as labels: crossing, touching, and both behind a shared piece.
TEST(WeilerAtherton, ContactsAreLabelled) {
  const Ring<Rational> clip = rectangle(0, 0, 6, 6);
  EXPECT_EQ(kinds_of({{3, 2}, {9, 2}, {9, 4}, {3, 4}}, clip), "le");
  EXPECT_EQ(kinds_of({{6, 3}, {9, 1}, {9, 5}}, clip), "t");   // from outside
  EXPECT_EQ(kinds_of({{6, 3}, {3, 5}, {3, 1}}, clip), "t");   // from inside
  EXPECT_EQ(kinds_of({{6, 2}, {6, 4}, {3, 3}}, clip), "at");  // a piece shared from inside
  EXPECT_EQ(kinds_of({{6, 4}, {6, 2}, {9, 3}}, clip), "at");  // and from outside
  // Through a shared piece: the crossing is where it ends, if both run the same way, or begins.
  EXPECT_EQ(kinds_of({{3, 3}, {6, 2}, {6, 4}, {9, 9}, {3, 9}}, clip), "ale");
  EXPECT_EQ(kinds_of({{3, 3}, {3, -3}, {9, -3}, {6, 4}, {6, 2}}, clip), "lae");
  EXPECT_EQ(kinds_of(clip, clip), "aaaa");
}

// A union begins at a leaving contact, and follows the clip list forwards to the next leaving one.
TEST(WeilerAtherton, AUnionWalksOutsideOfTheOther) {
  WeilerAthertonTrace<Rational> trace;
  const auto answer = weiler_atherton<Rational>({rectangle(0, 0, 4, 4)}, {rectangle(2, 2, 6, 6)},
                                                SetOperation::join, &trace);
  ASSERT_EQ(answer.size(), 1u);
  EXPECT_EQ(answer[0].outline,
            (Ring<Rational>{{0, 0}, {4, 0}, {4, 2}, {6, 2}, {6, 6}, {2, 6}, {2, 4}, {0, 4}}));
  ASSERT_EQ(trace.walks.size(), 1u);
  EXPECT_EQ(trace.walks[0][0].from, (Point2<Rational>{2, 4}));  // where the subject leaves the clip
  EXPECT_EQ(borders_of(trace.walks[0]), "ssssccc" + std::string("c"));
  // Side by side they become one; corner to corner they stay two; around a gap there is a hole.
  const auto join = [](const Rings<Rational>& a, const Rings<Rational>& b) {
    return weiler_atherton(a, b, SetOperation::join);
  };
  EXPECT_EQ(join({rectangle(0, 0, 2, 2)}, {rectangle(2, 0, 4, 2)}).size(), 1u);
  EXPECT_EQ(join({rectangle(0, 0, 2, 2)}, {rectangle(2, 2, 4, 4)}).size(), 2u);
  const auto ring = join({{{0, 0}, {6, 0}, {6, 6}, {4, 6}, {4, 2}, {2, 2}, {2, 6}, {0, 6}}},
                         {rectangle(0, 4, 6, 6)});
  ASSERT_EQ(ring.size(), 1u);
  EXPECT_EQ(ring[0].holes, (Rings<Rational>{{{2, 2}, {2, 4}, {4, 4}, {4, 2}}}));
}

TEST(WeilerAtherton, Laws) {
  PolygonMaker maker(7);
  for (int i = 0; i < 500 / checks::effort; ++i) {
    const auto A = to_exact(maker.polygon(5, 9, cross_each_other));
    const auto B = to_exact(maker.polygon(5, 9, cross_each_other));
    const auto both = weiler_atherton(A, B, SetOperation::intersection);
    EXPECT_TRUE(is_same(both, weiler_atherton(B, A, SetOperation::intersection)));
    EXPECT_TRUE(weiler_atherton(A, A, SetOperation::difference).empty());
    EXPECT_TRUE(is_same(weiler_atherton(A, A, SetOperation::intersection),
                        weiler_atherton(A, Rings<Rational>{}, SetOperation::difference)));
    EXPECT_TRUE(weiler_atherton(A, Rings<Rational>{}, SetOperation::intersection).empty());
    const auto joined = weiler_atherton(A, B, SetOperation::join);
    EXPECT_TRUE(is_same(joined, weiler_atherton(B, A, SetOperation::join)));
    EXPECT_TRUE(is_same(weiler_atherton(A, A, SetOperation::join),
                        weiler_atherton(A, Rings<Rational>{}, SetOperation::join)));
    EXPECT_TRUE(is_same(weiler_atherton(A, Rings<Rational>{}, SetOperation::join),
                        weiler_atherton(Rings<Rational>{}, A, SetOperation::join)));
    // A − B and A ∩ B have nothing in common; the answers are rings that can be clipped again.
    Rings<Rational> rest, common;
    for (auto* list : {&rest, &common})
      for (const auto& polygon :
           list == &common ? both : weiler_atherton(A, B, SetOperation::difference)) {
        list->push_back(polygon.outline);
        list->insert(list->end(), polygon.holes.begin(), polygon.holes.end());
      }
    EXPECT_TRUE(weiler_atherton(rest, common, SetOperation::intersection).empty());
    // A − B beside B has no gap, along whichever edges they touch.
    EXPECT_TRUE(is_same(weiler_atherton(rest, B, SetOperation::join), joined));
    EXPECT_TRUE(is_same(weiler_atherton(rest, common, SetOperation::difference),
                        weiler_atherton(A, B, SetOperation::difference)));
  }
}

// Binary64 agrees where nothing is rounded.
TEST(WeilerAtherton, WithoutRoundingBothKernelsAgree) {
  PolygonMaker maker(8);
  for (int i = 0; i < 500 / checks::effort; ++i) {
    // Axis-parallel rectangles: all crossings have integer coordinates.
    const auto box = [&] {
      const double x = maker.below(6), y = maker.below(6);
      const double w = 1 + maker.below(4), h = 1 + maker.below(4);
      return Rings<double>{{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}};
    };
    const Rings<double> a = box(), b = box();
    for (const SetOperation operation : all_operations) {
      const auto exact = weiler_atherton(to_exact(a), to_exact(b), operation);
      const auto rounded = weiler_atherton(a, b, operation);
      ASSERT_EQ(exact.size(), rounded.size());
      for (std::size_t k = 0; k < exact.size(); ++k) {
        EXPECT_EQ(exact[k].outline, to_exact(Rings<double>{rounded[k].outline})[0]);
        EXPECT_EQ(exact[k].holes, to_exact(rounded[k].holes));
      }
    }
  }
}

}  // namespace
}  // namespace fathom::clipping::test
