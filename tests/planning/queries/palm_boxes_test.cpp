#include "handway/planning/queries/region_draws.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <handway_test/planar_problems.h>

#include <algorithm>

namespace handway::planning {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr int kMany = 1000;

class PalmBoxesOfTheFlatArm : public testing::Test {
 protected:
  [[nodiscard]] int palm() const { return problem_.model().find_link("palm").value(); }
  [[nodiscard]] std::vector<PalmBox> boxes(double rho, int most = kMany) const {
    return palm_boxes(problem_, palm(), {.rho_a = rho}, most);
  }

  PlanningProblem problem_ = test::open_problem();
};

TEST_F(PalmBoxesOfTheFlatArm, AreOneForEveryHypercubeFromStartToGoal) {
  const std::vector<PalmBox> all = boxes(0.02);
  const RegionDraws draws = draw_region(problem_, palm(), {.rho_a = 0.02}, 1);
  ASSERT_THAT(all, SizeIs(draws.hypercubes));
  EXPECT_EQ(all.front().step, 0.0);
  EXPECT_EQ(all.back().step, 1.0);
  EXPECT_TRUE(std::ranges::is_sorted(all, {}, &PalmBox::step));
}

TEST_F(PalmBoxesOfTheFlatArm, HoldThePalmsThatAreDrawn) {
  const double rho = 0.03;
  const std::vector<PalmBox> all = boxes(rho);
  const RegionDraws draws = draw_region(problem_, palm(), {.rho_a = rho}, 400);
  const auto is_inside = [](const PalmBox& box, const Eigen::Vector3d& palm) {
    const Eigen::Vector3d inside = box.X_WC.inverse() * palm;
    return (inside.cwiseAbs().array() <= 1.05 * box.half_size.array() + 1e-9).all();
  };
  const auto held = std::ranges::count_if(draws.palms, [&](const Eigen::Vector3d& palm) {
    return std::ranges::any_of(all, [&](const PalmBox& box) { return is_inside(box, palm); });
  });
  EXPECT_GE(held, 390) << "of 400";
}

TEST_F(PalmBoxesOfTheFlatArm, GrowWithTheHypercubes) {
  const Eigen::Vector3d narrow = boxes(0.01).front().half_size;
  const Eigen::Vector3d wide = boxes(0.02).front().half_size;
  EXPECT_NEAR(wide.maxCoeff() / narrow.maxCoeff(), 2.0, 0.1);
  EXPECT_NEAR(wide.minCoeff(), 0.0, 1e-12) << "a flat arm leaves its plane";
}

TEST_F(PalmBoxesOfTheFlatArm, HaveRightHandedAxes) {
  for (const PalmBox& box : boxes(0.02)) {
    EXPECT_NEAR(box.X_WC.linear().determinant(), 1.0, 1e-9);
  }
}

TEST_F(PalmBoxesOfTheFlatArm, AreNoMoreThanAskedFor) {
  EXPECT_GT(boxes(0.001).size(), 100U);
  const std::vector<PalmBox> few = boxes(0.001, 20);
  EXPECT_LE(few.size(), 21U);
  EXPECT_GE(few.size(), 10U);
  EXPECT_EQ(few.front().step, 0.0);
}

TEST_F(PalmBoxesOfTheFlatArm, EndWhenNobodyWaitsForThem) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THAT(palm_boxes(problem_, palm(), {}, kMany, stop.get_token()), IsEmpty());
}

}  // namespace
}  // namespace handway::planning
