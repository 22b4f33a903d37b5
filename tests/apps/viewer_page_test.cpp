// The page of `fathom view`, as it is written; tests/browser shows it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "apps/view/page.h"
#include "fathom/failures/errors.h"

namespace fathom::view {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

/// A map without two equal values.
std::vector<ViewedMap> some_maps() {
  ViewedMap viewed;
  viewed.name = "ramp.npy";
  viewed.map.width = 600;
  viewed.map.height = 20;
  Samples<float> values(std::size_t{600} * 20);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = 1 + static_cast<float>(k * k) / 7;
  viewed.map.channels.push_back({"Z", std::move(values)});
  return {viewed};
}

std::string page_of(const std::vector<ViewedMap>& maps, std::uint64_t most_bytes) {
  std::string page;
  write_page(
      maps, Questions::none, [&](std::string_view part) { page += part; }, {}, most_bytes);
  return page;
}

TEST(ViewerPage, IsRefusedWhereItWouldBeTooLarge) {
  const std::vector<ViewedMap> maps = some_maps();
  const std::string page = page_of(maps, most_page_bytes);
  EXPECT_EQ(page_of(maps, page.size()), page);
  EXPECT_THAT(
      [&] { page_of(maps, page.size() - 1); },
      ThrowsMessage<OutputError>(AllOf(StartsWith("the maps need a page of more than 0.0 GiB"),
                                       HasSubstr("fathom convert --channel"))));
}

TEST(ViewerPage, ReportsHowMuchIsDone) {
  std::vector<double> shares;
  write_page(
      some_maps(), Questions::none, [](std::string_view) {},
      [&](double share) { shares.push_back(share); });
  EXPECT_THAT(shares, ::testing::ElementsAre(0.5, 1.0));  // of two tiles
}

}  // namespace
}  // namespace fathom::view
