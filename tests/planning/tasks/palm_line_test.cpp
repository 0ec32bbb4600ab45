#include "handway/planning/tasks/palm_line.h"

#include "handway_test/motions.h"
#include "handway_test/planar_problems.h"
#include "handway_test/robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::planning {
namespace {

using Eigen::Vector3d;
using geometric::Pose;
using ::testing::HasSubstr;

class PalmLines : public ::testing::Test {
 protected:
  [[nodiscard]] PalmLine line(const Vector3d& shift) const {
    return palm_line(problem_.model(), ik_, problem_.joints.arm, q_, shift);
  }

  PlanningProblem problem_ = test::tx90_sah_problem();
  PalmIk ik_{problem_.scene->robots.front().model, problem_.hand.palm, problem_.joints.arm};
  Configuration q_ = test::tx90_sah_path().waypoints[1];
};

TEST_F(PalmLines, StayOnTheLineAlsoBetweenWaypoints) {
  const Pose begin = ik_.pose(q_);
  for (const Vector3d& shift : {Vector3d(0.0, 0.0, 0.1), Vector3d(-0.15, 0.05, 0.02)}) {
    const PalmLine line = this->line(shift);
    ASSERT_EQ(line.fault, "");
    EXPECT_LE(line.deviation, kLineDeviation);
    const auto& waypoints = line.path.waypoints;
    EXPECT_EQ(waypoints.front(), q_);
    EXPECT_TRUE(ik_.pose(waypoints.back()).isApprox(Eigen::Translation3d(shift) * begin, 1e-4));
    double worst = 0.0;
    for (std::size_t w = 1; w < waypoints.size(); ++w) {
      for (int k = 0; k <= 20; ++k) {
        const Pose pose = ik_.pose(waypoints[w - 1] + (waypoints[w] - waypoints[w - 1]) * k / 20.0);
        const Vector3d way = pose.translation() - begin.translation();
        worst = std::max(worst, way.cross(shift.normalized()).norm());
        EXPECT_TRUE(pose.linear().isApprox(begin.linear(), 2e-3));
      }
    }
    EXPECT_LE(worst, line.deviation) << "the bound holds";
    EXPECT_GT(worst, 0.0);
  }
}

TEST_F(PalmLines, AreDividedWhereTheArmTurnsALot) {
  const PalmLine coarse = line({0.0, 0.0, 0.02});
  ASSERT_EQ(coarse.fault, "");
  EXPECT_GE(coarse.path.waypoints.size(), 5U) << "a waypoint each 5 mm at least";
}

TEST_F(PalmLines, SayHowFarTheArmReaches) {
  const PalmLine line = this->line({3.0, 0.0, 0.0});
  EXPECT_TRUE(line.path.empty());
  EXPECT_THAT(line.fault, HasSubstr("of 3000 mm of the line"));
}

TEST_F(PalmLines, OfNoLengthStay) {
  const PalmLine line = this->line(Vector3d::Zero());
  EXPECT_EQ(line.fault, "");
  EXPECT_TRUE(line.path.waypoints.back().isApprox(q_, 1e-6));
}

}  // namespace
}  // namespace handway::planning
