#include "fathom/rendering/rendered.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace fathom {
namespace {

TEST(RenderStatistics, EveryCountHasANameOfItsOwn) {
  std::set<std::string> names;
  std::size_t count = 0;
  for_each_count([&](const std::string& name, auto) {
    names.insert(name);
    ++count;
  });
  EXPECT_EQ(names.size(), count);
}

TEST(RenderStatistics, EveryNumberIsAdded) {
  RenderStatistics sum, part;
  std::uint64_t next = 0;
  for_each_number(sum, [&](std::uint64_t& number) { number = ++next; });
  for_each_number(part, [&](std::uint64_t& number) { number = 100 * ++next; });
  const std::uint64_t numbers = next / 2;
  add(sum, part);
  std::uint64_t i = 0;
  for_each_number(sum, [&](std::uint64_t number) {
    ++i;
    EXPECT_EQ(number, i + 100 * (numbers + i)) << i;
  });
  EXPECT_EQ(sum.triangles, 1 + 100 * (numbers + 1));
}

}  // namespace
}  // namespace fathom
