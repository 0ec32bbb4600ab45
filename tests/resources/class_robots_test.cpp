/// The robots that are models of a class, against published descriptions of that class.
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway_test/paths.h"
#include "handway_test/robots.h"

#include <gtest/gtest.h>

#include <memory>
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
  std::string file;   ///< File in the folder of reference data.
  std::string root;   ///< Their link that is where our root link is.
  Names joints;       ///< Reference joint, and ours of the same value.
  Names frames;       ///< Flange or fingertips: theirs, ours.
};

std::shared_ptr<const RobotModel> shipped(const std::string& robot) {
  return geometric::load_robot(source_dir() / "resources/robots" / robot / (robot + ".urdf"));
}

// Positions agree to 0.1 mm; frames may be turned against each other, but always the same.
void expect_same_places(const Published& published,
                        const std::shared_ptr<const RobotModel>& theirs_model) {
  const auto ours_model = shipped(published.robot);
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

Published arm(const std::string& robot, const std::string& file, const std::string& root,
              const std::string& joint, int count, const std::string& flange) {
  Published published{robot, file, root, {}, {{flange, "flange_link"}}};
  for (int i = 1; i <= count; ++i) {
    published.joints.emplace_back(joint + std::to_string(i), "joint_" + std::to_string(i));
  }
  return published;
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

// The distal joints of four fingers follow the medial ones.
Published shadow() {
  Published robot{"shadow_class_right",
                  "robots/shadow_hand/shadow_hand_right.urdf",
                  "world",
                  {{"WRJ2", "wrist_abduction"},
                   {"WRJ1", "wrist_flexion"},
                   {"THJ5", "thumb_base"},
                   {"THJ4", "thumb_proximal"},
                   {"THJ3", "thumb_hub"},
                   {"THJ2", "thumb_medial"},
                   {"THJ1", "thumb_distal"},
                   {"LFJ5", "little_metacarpal"}},
                  {{"thtip", "thumb_tip"}}};
  const Names fingers = {{"FF", "index"}, {"MF", "middle"}, {"RF", "ring"}, {"LF", "little"}};
  for (const auto& [theirs, ours] : fingers) {
    robot.joints.emplace_back(theirs + "J4", ours + "_abduction");
    robot.joints.emplace_back(theirs + "J3", ours + "_proximal");
    robot.joints.emplace_back(theirs + "J2", ours + "_medial");
    robot.joints.emplace_back(theirs + "J1", ours + "_medial");
  }
  robot.frames.insert(robot.frames.end(), {{"fftip", "index_tip"},
                                           {"mftip", "middle_tip"},
                                           {"rftip", "ring_tip"},
                                           {"lftip", "little_tip"}});
  return robot;
}

std::ostream& operator<<(std::ostream& stream, const Published& robot) {
  return stream << robot.robot;
}

class PublishedKinematics : public testing::TestWithParam<Published> {};

TEST_P(PublishedKinematics, AreThoseOfTheModel) {
  HANDWAY_NEED_REFERENCE(reference);
  expect_same_places(GetParam(), geometric::load_robot(reference / GetParam().file));
}

INSTANTIATE_TEST_SUITE_P(Robots, PublishedKinematics,
                         testing::Values(arm("iiwa14_class", "robots/iiwa14/iiwa14.urdf", "link_0",
                                             "A", 7, "ee_link"),
                                         arm("panda_class", "moveit/panda/panda.urdf",
                                             "panda_link0", "panda_joint", 7, "panda_link8"),
                                         allegro(), shadow()),
                         [](const auto& test) { return test.param.robot; });

// Denavit-Hartenberg tables as makers print them.
TEST(DenavitHartenbergTables, PutFlangesAtTheSamePlaces) {
  expect_same_places(arm("ur5e_class", "", "base", "joint_", 6, "link_6"),
                     std::make_shared<const RobotModel>(ur5e()));
  expect_same_places(arm("panda_class", "", "base", "joint_", 7, "link_7"),
                     std::make_shared<const RobotModel>(panda_arm()));
  expect_same_places(arm("iiwa14_class", "", "base", "joint_", 7, "link_7"),
                     std::make_shared<const RobotModel>(iiwa14()));
}

}  // namespace
}  // namespace handway::test
