// Every step of a Boolean operation that takes long for large rings ends early when it is asked to.
#include "fathom/threads/interruption.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <utility>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/weiler_atherton.h"
#include "fathom/clipping/weiler_atherton/contacts.h"
#include "fathom/clipping/weiler_atherton/edge_order.h"
#include "fathom/clipping/weiler_atherton/nesting.h"
#include "fathom/clipping/weiler_atherton/side_contacts.h"
#include "fathom/clipping/weiler_atherton/weiler_atherton_lists.h"

namespace fathom::clipping {
namespace {

using Exact = Rings<Rational>;

const Exact square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
const Exact moved{{{2, 2}, {6, 2}, {6, 6}, {2, 6}}};
/// Two rings of one side that share an edge.
const Exact neighbours{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{4, 0}, {8, 0}, {8, 4}, {4, 4}}};

/// A ring of so many corners that sorting them takes hundreds of comparisons.
Ring<Rational> fan_of(int corners) {
  Ring<Rational> ring{{0, 0}};
  for (int i = 0; i < corners; ++i) ring.push_back({i + 1, i * i + 1});
  return ring;
}
const Ring<Rational> fan = fan_of(100);

class Step : public testing::TestWithParam<std::pair<const char*, std::function<void()>>> {};

TEST_P(Step, EndsEarly) {
  const auto& step = GetParam().second;
  EXPECT_NO_THROW(step());
  const std::atomic<bool> request{true};
  const Interruptible here(&request);
  EXPECT_THROW(step(), Interrupted);
}

std::vector<UndirectedEdge> undirected_edges(const Exact& rings) {
  std::vector<UndirectedEdge> edges;
  for (const auto& [from, to] : edges_of(numbered(rings).rings))
    edges.push_back(undirected(from, to));
  return edges;
}

const auto corners = numbered(neighbours);
const PointOrder points(corners.points);
const auto edges = undirected_edges(square);
const auto side = numbered(square);
const PointOrder points_of_side(side.points);

INSTANTIATE_TEST_SUITE_P(
    OfClipping, Step,
    testing::Values(
        std::pair{"whole", [] { weiler_atherton(square, moved, SetOperation::intersection); }},
        std::pair{"self_contact", [] { self_contact(fan); }},
        std::pair{"signed_area", [] { signed_area(square[0]); }},
        std::pair{"numbered", [] { numbered(neighbours); }},
        std::pair{"PointOrder", [] { PointOrder(corners.points); }},
        std::pair{"enter_touches", [] { enter_touches(corners.rings, points); }},
        std::pair{"ring_crossing", [] { ring_crossing(corners.rings, points); }},
        std::pair{"sweep", [] { sweep(edges, points_of_side); }},
        std::pair{"enter_contacts",
                  [] {
                    enter_contacts(Sides<Rational>{square, moved});
                  }},
        std::pair{
            "enter_crossings",
            [] {
              enter_crossings({side.rings, side.rings}, points_of_side, SetOperation::intersection);
            }},
        std::pair{"joined_by_wedges",
                  [] { joined_by_wedges(edges_of(side.rings), points_of_side); }}),
    [](const auto& step) { return step.param.first; });

}  // namespace
}  // namespace fathom::clipping
