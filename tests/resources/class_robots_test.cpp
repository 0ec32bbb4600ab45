/// The robots that are models of a class, against published descriptions of that class.
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway_test/paths.h"

#include <gtest/gtest.h>

#include <ostream>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace handway::test {
namespace {

using geometric::Pose;
using geometric::RobotModel;
using geometric::RobotState;
using Names = std::vector<std::pair<std::string, std::string>>;

struct Published {
  std::string robot;  ///< Ours.
  std::string file;   ///< Theirs, in the folder of reference data.
  std::string root;   ///< Their link that is where our root link is.
  Names joints;       ///< Theirs, and ours that has the same value.
  Names frames;       ///< Flange or fingertips: theirs, ours.
};

std::ostream& operator<<(std::ostream& stream, const Published& robot) {
  return stream << robot.robot;
}

Published iiwa14() {
  Published robot{"iiwa14_class", "robots/iiwa14/iiwa14.urdf", "link_0", {}, {}};
  for (int i = 1; i <= 7; ++i) {
    robot.joints.emplace_back("A" + std::to_string(i), "joint_" + std::to_string(i));
  }
  robot.frames = {{"ee_link", "flange_link"}};
  return robot;
}

Published allegro() {
  Published robot{"allegro_class_right",
                  "robots/allegro_hand/allegro_hand_right.urdf",
                  "wrist",
                  {{"joint_12.0", "thumb_base"},
                   {"joint_13.0", "thumb_abduction"},
                   {"joint_14.0", "thumb_proximal"},
                   {"joint_15.0", "thumb_distal"}},
                  {{"link_15.0_tip", "thumb_tip"}}};
  int number = 0;
  for (const std::string finger : {"index", "middle", "ring"}) {
    for (const char* joint : {"_abduction", "_proximal", "_medial", "_distal"}) {
      robot.joints.emplace_back("joint_" + std::to_string(number++) + ".0", finger + joint);
    }
    robot.frames.emplace_back("link_" + std::to_string(number - 1) + ".0_tip", finger + "_tip");
  }
  return robot;
}

class PublishedKinematics : public testing::TestWithParam<Published> {};

// Positions agree to 0.1 mm; frames may be turned against each other, but always the same.
TEST_P(PublishedKinematics, AreThoseOfTheModel) {
  HANDWAY_NEED_REFERENCE(reference);
  const Published& published = GetParam();
  const auto ours_model = geometric::load_robot(source_dir() / "resources/robots" /
                                                published.robot / (published.robot + ".urdf"));
  const auto theirs_model = geometric::load_robot(reference / published.file);
  RobotState ours(ours_model);
  RobotState theirs(theirs_model);
  std::vector<Eigen::Matrix3d> turned(published.frames.size(), Eigen::Matrix3d::Zero());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int sample = 0; sample < 1000; ++sample) {
    geometric::Configuration q = ours_model->lower();
    for (int i = 0; i < q.size(); ++i) {
      q[i] += unit(random) * (ours_model->upper()[i] - ours_model->lower()[i]);
    }
    ours.set_configuration(q);
    for (const auto& [their_joint, our_joint] : published.joints) {
      theirs.set_joint(their_joint, q[ours_model->find_variable(our_joint).value()]);
    }
    const Pose X_RootWorld = theirs.link_pose(published.root).inverse();
    for (std::size_t f = 0; f < published.frames.size(); ++f) {
      const auto& [their_frame, our_frame] = published.frames[f];
      const Pose expected = X_RootWorld * theirs.link_pose(their_frame);
      const Pose found = ours.link_pose(our_frame);
      ASSERT_LT((found.translation() - expected.translation()).norm(), 1e-4) << our_frame;
      const Eigen::Matrix3d R = found.linear().transpose() * expected.linear();
      if (sample == 0) {
        turned[f] = R;
      }
      ASSERT_LT((R - turned[f]).norm(), 1e-4) << our_frame;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, PublishedKinematics, testing::Values(iiwa14(), allegro()),
                         [](const auto& test) { return test.param.robot; });

}  // namespace
}  // namespace handway::test
