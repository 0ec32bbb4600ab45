#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway_test/paths.h"
#include "kautham_importer.h"
#include "reference_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

namespace handway::test {
namespace {

using geometric::Configuration;
using geometric::Pose;
using geometric::RobotModel;
using geometric::RobotState;

namespace fs = std::filesystem;

class ReferenceHandArm : public testing::Test {
 protected:
  void SetUp() override {
    HANDWAY_NEED_REFERENCE(reference);
    theirs_ = import_kautham::KauthamImporter()
                  .read(reference / "auro/robots/TX90_RHand_5PMD_thumb2.rob")
                  .scene->robots.front()
                  .model;
    ours_ = geometric::load_robot(source_dir() / "resources/robots/tx90_sah/tx90_sah.urdf");
  }

  std::shared_ptr<const RobotModel> theirs_;
  std::shared_ptr<const RobotModel> ours_;
};

TEST_F(ReferenceHandArm, HasTheSameLimits) {
  ASSERT_EQ(theirs_->variable_count(), ours_->variable_count());
  for (int i = 0; i < theirs_->variable_count(); ++i) {
    const geometric::Joint& theirs = theirs_->variable(i);
    const auto variable = ours_->find_variable(joint_name_of(theirs.name));
    ASSERT_TRUE(variable) << theirs.name;
    EXPECT_NEAR(ours_->lower()[*variable], theirs.limits.lower, 1e-12) << theirs.name;
    EXPECT_NEAR(ours_->upper()[*variable], theirs.limits.upper, 1e-12) << theirs.name;
  }
}

TEST_F(ReferenceHandArm, PutsFingertipsAtTheSamePlaces) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  RobotState theirs(theirs_);
  RobotState ours(ours_);
  for (int sample = 0; sample < 1000; ++sample) {
    Configuration q = theirs_->lower();
    for (int i = 0; i < q.size(); ++i) {
      q[i] += unit(random) * (theirs_->upper()[i] - theirs_->lower()[i]);
      ours.set_joint(joint_name_of(theirs_->variable(i).name), q[i]);
    }
    theirs.set_configuration(q);
    for (const char* finger : {"Thumb", "Index", "Mid", "Ring"}) {
      const std::string last = std::string(finger) + "-Dist";
      const std::string name = joint_name_of(last);
      const std::string tip = name.substr(0, name.find('_')) + "_tip";
      const Pose X_DistTip = ours.link_pose(name + "_link").inverse() * ours.link_pose(tip);
      const Pose X_BTip = theirs.link_pose(last) * X_DistTip;
      const Pose difference = X_BTip.inverse() * ours.link_pose(tip);
      EXPECT_LT(difference.translation().norm(), 1e-9) << tip;
      EXPECT_LT((difference.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-9) << tip;
    }
  }
}

// Fingers of 29.5 mm behind the distal joint end in a ball of 10 mm.
TEST_F(ReferenceHandArm, EndsFingersWhereTheirMeshesEnd) {
  for (const char* finger : {"Thumb", "Index", "Mid", "Ring"}) {
    const std::string last = std::string(finger) + "-Dist";
    const geometric::Link& theirs = theirs_->link(theirs_->find_link(last).value());
    const geometric::Link& ours =
        ours_->link(ours_->find_link(joint_name_of(last) + "_link").value());
    const double end = geometric::bounding_box(geometric::collision_mesh(theirs)).upper.y();
    EXPECT_NEAR(geometric::bounding_box(geometric::collision_mesh(ours)).upper.y(), end, 0.002);
  }
}

/// A copy of a published robot's folder, to be varied like the folders of users.
class ReferenceRobot : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    HANDWAY_NEED_REFERENCE(reference);
    const fs::path original = reference / "robots" / GetParam();
    test::copy_folder(original.parent_path(), folder_);
    urdf_ = folder_ / original.filename();
  }

  // Returns whether the robot has this visual mesh of a folder as a collision mesh, too.
  [[nodiscard]] bool collides_with(const fs::path& file) const {
    std::ifstream stream(urdf_);
    const std::string urdf{std::istreambuf_iterator<char>(stream), {}};
    const std::size_t last = urdf.rfind(file.filename().string());
    return last != std::string::npos && urdf.rfind("<collision", last) != std::string::npos &&
           urdf.rfind("<collision", last) > urdf.rfind("<visual", last);
  }

  ScratchFolder scratch_;
  fs::path folder_ = scratch_.path() / "robot";
  fs::path urdf_;
};

TEST_P(ReferenceRobot, LoadsWithoutWhatIsOnlyDrawn) {
  const auto whole = geometric::load_robot(urdf_);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "meshes/visual")) {
    if (!collides_with(entry.path())) {
      fs::remove(entry.path());
    }
  }
  const auto robot = geometric::load_robot(urdf_);
  EXPECT_EQ(robot->link_count(), whole->link_count());
  EXPECT_EQ(robot->description().warnings.size(), whole->description().warnings.size() + 1)
      << "one summary";
}

TEST_P(ReferenceRobot, FindsItsFilesInOtherLetters) {
  const auto whole = geometric::load_robot(urdf_);
  for (const char* meshes : {"meshes/visual", "meshes/collision"}) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / meshes)) {
      std::string name = entry.path().filename().string();
      std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
      fs::rename(entry.path(), entry.path().parent_path() / name);
    }
  }
  fs::rename(folder_ / "meshes", folder_ / "Meshes");
  fs::rename(urdf_, fs::path(urdf_).replace_extension(".URDF"));
  const auto robot = geometric::load_robot(fs::path(urdf_).replace_extension(".URDF"));
  EXPECT_EQ(robot->description().warnings.size(), whole->description().warnings.size() + 1)
      << "one summary";
  for (int i = 0; i < robot->link_count(); ++i) {
    EXPECT_EQ(geometric::collision_mesh(robot->link(i)).triangles.size(),
              geometric::collision_mesh(whole->link(i)).triangles.size());
  }
}

TEST_P(ReferenceRobot, IsRefusedWithoutAMeshThatCollides) {
  fs::remove_all(folder_ / "meshes/collision");
  try {
    static_cast<void>(geometric::load_robot(urdf_));
    ADD_FAILURE() << "read";
  } catch (const geometric::InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr(".urdf:"),
                                             testing::HasSubstr("meshes/collision/")));
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, ReferenceRobot,
                         testing::Values("shadow_hand/shadow_hand_right.urdf", "iiwa14/iiwa14.urdf",
                                         "allegro_hand/allegro_hand_right.urdf"),
                         [](const auto& test) { return fs::path(test.param).stem().string(); });

}  // namespace
}  // namespace handway::test
