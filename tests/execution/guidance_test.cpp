/// From the place of a tool to the place of a path, and along it.
#include "handway/execution/guidance/guided_motion.h"
#include "handway/execution/guidance/path_tool_curve.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway_test/robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

namespace handway::execution {
namespace {

/// A TX90 that turns its base by half a radian, moves its last joint alone, and turns back a bit.
class Guidance : public testing::Test {
 protected:
  Guidance() {
    const Eigen::VectorXd q = Eigen::VectorXd::Constant(6, 0.3);
    path_.waypoints.assign(4, q);
    path_.waypoints[1][0] += 0.5;
    path_.waypoints[2][0] += 0.5;
    path_.waypoints[2][5] += 0.4;
    path_.waypoints[3][0] += 0.3;
    path_.waypoints[3][5] += 0.4;
  }

  std::shared_ptr<const geometric::RobotModel> model_ =
      std::make_shared<geometric::RobotModel>(test::tx90_urdf_style());
  planning::Path path_;
};

TEST_F(Guidance, FindsThePlacesOfAPathByTheWayOfALink) {
  // The origin of the last link is on the last joint's axis: it stands while that one turns.
  const std::string link = tool_link(*model_, {0, 1, 2, 3, 4, 5});
  const PathToolCurve way(model_, path_, link);
  const double first = way.arc_length_at(1.0);
  EXPECT_GT(first, 0.1);
  EXPECT_NEAR(way.arc_length_at(2.0), first, 1e-12);
  EXPECT_NEAR(way.place_at(first), 2.0, 1e-6) << "the last place there";
  EXPECT_NEAR(way.place_at(0.5 * first), 0.5, 0.01);
  EXPECT_EQ(way.place_at(99.0), 3.0);
  geometric::RobotState robot(model_);
  robot.set_configuration(way.configuration(0.3));
  EXPECT_LT((robot.link_pose(link).translation() - way.curve()->at(way.arc_length_at(0.3))).norm(),
            1e-4);
  EXPECT_THROW(PathToolCurve(model_, path_, "leg"), geometric::InputError);
  EXPECT_THROW(PathToolCurve(model_, {}, link), geometric::InputError);
}

TEST_F(Guidance, GoesNoFasterThanTheJointsMay) {
  GuidedMotion motion(path_, Eigen::VectorXd::Constant(6, 0.5));
  EXPECT_NEAR(motion.advance(3.0, 0.5), 0.5, 1e-12);
  EXPECT_NEAR(motion.advance(3.0, 0.9), 1.5, 1e-12) << "0.5 s, and then 0.4 of 0.8 s";
  EXPECT_NEAR(motion.advance(0.9, 0.5), 0.9, 1e-12) << "back again, and not farther than asked";
  EXPECT_NEAR(motion.advance(3.0, 100.0), 3.0, 1e-12);
  EXPECT_NEAR(motion.advance(99.0, 1.0), 3.0, 1e-12);
  EXPECT_NEAR(motion.advance(-1.0, 100.0), 0.0, 1e-12);
  EXPECT_THROW(GuidedMotion(path_, Eigen::VectorXd::Zero(6)), std::invalid_argument);
  EXPECT_THROW(GuidedMotion(path_, Eigen::VectorXd::Ones(5)), std::invalid_argument);
}

}  // namespace
}  // namespace handway::execution
