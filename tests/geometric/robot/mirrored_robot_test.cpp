#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/formats/urdf.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/robot/robot_description.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway_test/paths.h"
#include "random_configurations.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace handway::geometric {
namespace {

const Eigen::Vector3d kMirror(1.0, -1.0, 1.0);

std::shared_ptr<const RobotModel> right_hand() {
  return load_robot(find_resource(ResourceKind::kRobot, "sah_right", test::source_dir()));
}

/// Returns for each shape that collides, at a posture, the mean, least and most of its corners, in
/// any order.
std::vector<Eigen::Matrix3d> places(const RobotModel& model, const Configuration& q,
                                    const Eigen::Vector3d& scale) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(q, X_BL);
  std::vector<Eigen::Matrix3d> result;
  for (int link = 0; link < model.link_count(); ++link) {
    for (const LinkGeometry& geometry : model.link(link).collision) {
      const auto triangles = tessellate(geometry.shape);
      Eigen::Matrix3Xd corners(3, static_cast<Eigen::Index>(triangles->vertices.size()));
      for (Eigen::Index i = 0; i < corners.cols(); ++i) {
        corners.col(i) = scale.cwiseProduct(
            Eigen::Vector3d(X_BL[static_cast<std::size_t>(link)] * geometry.X_LG *
                            triangles->vertices[static_cast<std::size_t>(i)]));
      }
      Eigen::Matrix3d& place = result.emplace_back();
      place << corners.rowwise().mean(), corners.rowwise().minCoeff(), corners.rowwise().maxCoeff();
    }
  }
  return result;
}

void expect_mirror_images(const RobotModel& right, const RobotModel& left) {
  test::RandomConfigurations random(right, 1);
  for (int k = 0; k < 5; ++k) {
    const Configuration q = random.next();
    const std::vector<Eigen::Matrix3d> expected = places(right, q, kMirror);
    const std::vector<Eigen::Matrix3d> found = places(left, q, Eigen::Vector3d::Ones());
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_LT((found[i] - expected[i]).norm(), 1e-5) << i;
    }
  }
}

TEST(MirroredRobot, TakesTheMirrorImageOfEveryPosture) {
  const auto right = right_hand();
  const RobotModel left(mirrored(right->description()));
  EXPECT_EQ(left.name(), "sah_left");
  expect_mirror_images(*right, left);
}

TEST(MirroredRobot, IsItselfWhenMirroredTwice) {
  const auto right = right_hand();
  const RobotDescription again = mirrored(mirrored(right->description()));
  EXPECT_EQ(again.name, right->name());
  for (std::size_t j = 0; j < again.joints.size(); ++j) {
    EXPECT_TRUE(again.joints[j].X_PJ.isApprox(right->description().joints[j].X_PJ, 1e-12));
    EXPECT_TRUE(again.joints[j].axis.isApprox(right->description().joints[j].axis, 1e-12));
  }
}

TEST(MirroredRobot, IsReadBackFromAFile) {
  const test::ScratchFolder folder;
  const auto right = right_hand();
  const auto file = folder.path() / "left.urdf";
  write_urdf(RobotModel(mirrored(right->description())), file);
  expect_mirror_images(*right, *load_robot(file));
}

TEST(MirroredRobot, SaysSoInItsNameWhereThatNamesNoSide) {
  RobotDescription robot;
  robot.name = "gripper";
  EXPECT_EQ(mirrored(robot).name, "gripper_mirrored");
  robot.name = "Right_Hand";
  EXPECT_EQ(mirrored(robot).name, "Left_Hand");
}

}  // namespace
}  // namespace handway::geometric
