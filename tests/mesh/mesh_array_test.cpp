#include "fathom/mesh/mesh_array.h"

#include "fathom/mesh/mesh.h"

namespace fathom {
namespace {

/// Elements of another owner, who is told when they are no longer needed.
struct Lender {
  std::vector<MeshPoint> points{{1, 2, 3}, {4, 5, 6}};
  std::shared_ptr<const int> keeper = std::make_shared<const int>(0);

  [[nodiscard]] MeshArray<MeshPoint> lend() const {
    return MeshArray<MeshPoint>::of_lent(points, keeper);
  }
  [[nodiscard]] long users() const { return keeper.use_count() - 1; }
};

TEST(MeshArray, ReadsLentElementsWhereTheyAre) {
  const Lender lender;
  const MeshArray<MeshPoint> lent = lender.lend();
  const MeshArray<MeshPoint> copy = lent;
  EXPECT_EQ(lent.data(), lender.points.data());
  EXPECT_EQ(copy.data(), lender.points.data());
  EXPECT_EQ(copy.size(), 2U);
  EXPECT_EQ(&copy[1], &lender.points[1]);
  EXPECT_EQ(copy.back(), lender.points.back());
  EXPECT_EQ(lender.users(), 2);
}

TEST(MeshArray, LeavesLentElementsAloneWhenItIsChanged) {
  Lender lender;
  MeshArray<MeshPoint> changed = lender.lend();
  changed[0].x = 7;
  changed.push_back({8, 8, 8});
  EXPECT_EQ(lender.points, (std::vector<MeshPoint>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(changed, (MeshArray<MeshPoint>{{7, 2, 3}, {4, 5, 6}, {8, 8, 8}}));
  EXPECT_EQ(lender.users(), 0) << "what is copied is not kept";
}

TEST(MeshArray, LetsGoWhenItIsCleared) {
  const Lender lender;
  MeshArray<MeshPoint> array = lender.lend();
  array.clear();
  EXPECT_TRUE(array.empty());
  EXPECT_EQ(lender.users(), 0);
}

TEST(MeshArray, IsNotReadBeyondItsEnd) {
  const Lender lender;
  const MeshArray<MeshPoint> lent = lender.lend();
  EXPECT_THROW(static_cast<void>(lent.at(2)), std::out_of_range);
}

}  // namespace
}  // namespace fathom
