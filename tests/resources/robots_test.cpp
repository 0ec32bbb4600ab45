#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace handway::test {
namespace {

using geometric::RobotModel;

constexpr std::array kRobots = {
    "tx90",       "sah_right",           "tx90_sah",         "iiwa14_class",      "panda_class",
    "ur5e_class", "allegro_class_right", "leap_class_right", "shadow_class_right"};
constexpr std::array kArms = {"tx90", "iiwa14_class", "panda_class", "ur5e_class"};
constexpr std::array kHands = {"sah_right", "allegro_class_right", "leap_class_right",
                               "shadow_class_right"};

std::filesystem::path urdf_of(const std::string& robot) {
  return source_dir() / "resources/robots" / robot / (robot + ".urdf");
}

class ShippedRobot : public testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path urdf_ = urdf_of(GetParam());
  std::shared_ptr<const RobotModel> model_ = geometric::load_robot(urdf_);
};

TEST_P(ShippedRobot, LoadsWithoutWarnings) {
  EXPECT_EQ(model_->name(), GetParam());
  EXPECT_THAT(model_->description().warnings, testing::IsEmpty());
}

TEST_P(ShippedRobot, HasShapesOnEveryLinkButFramesAtFingertips) {
  for (const geometric::Link& link : model_->description().links) {
    const bool is_frame = link.name.ends_with("_tip");
    EXPECT_EQ(link.visual.empty(), is_frame) << link.name;
    EXPECT_EQ(link.collision.empty(), is_frame) << link.name;
  }
}

TEST_P(ShippedRobot, NamesFilesThatExistRelativeToItself) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file(urdf_.c_str()));
  int count = 0;
  for (const auto& found : document.select_nodes("//mesh/@filename")) {
    const std::filesystem::path file = found.attribute().value();
    EXPECT_TRUE(file.is_relative()) << file;
    EXPECT_TRUE(std::filesystem::is_regular_file(urdf_.parent_path() / file)) << file;
    ++count;
  }
  EXPECT_GT(count, 10);
}

TEST_P(ShippedRobot, HasAPictureToBeChosenBy) {
  EXPECT_TRUE(std::filesystem::is_regular_file(source_dir() / "resources/thumbnails/robots" /
                                               (std::string(GetParam()) + ".jpg")));
}

TEST_P(ShippedRobot, AllowsCollisionsOfLinksWithShapesOnly) {
  const auto& allowed = model_->description().allowed_collisions.entries();
  EXPECT_FALSE(allowed.empty());
  for (const auto& [pair, reason] : allowed) {
    for (const std::string& name : {pair.first, pair.second}) {
      const auto link = model_->find_link(name);
      ASSERT_TRUE(link) << name;
      EXPECT_FALSE(model_->link(*link).collision.empty()) << name;
    }
    EXPECT_NE(reason, geometric::AllowedReason::kAlways)
        << pair.first << " is stuck in " << pair.second;
  }
}

TEST_P(ShippedRobot, StandsClearOfItself) {
  geometric::Scene scene;
  scene.robots.push_back(
      {GetParam(), urdf_, model_, geometric::Pose::Identity(), model_->neutral()});
  geometric::FclChecker checker(std::make_shared<const geometric::CollisionWorld>(scene));
  const geometric::NamedPair closest = find_clearance(checker, model_->neutral());
  EXPECT_GT(closest.distance, 0.001) << closest.a << " and " << closest.b;
}

TEST_P(ShippedRobot, CollidesWithinAMillimetreOfWhatIsSeen) {
  for (const geometric::Link& link : model_->description().links) {
    if (link.visual.empty()) {
      continue;
    }
    const geometric::Aabb seen =
        geometric::bounding_box(geometric::collision_mesh({link.name, {}, link.visual}));
    const geometric::Aabb collides = geometric::bounding_box(geometric::collision_mesh(link));
    EXPECT_GT((seen.lower - collides.lower).minCoeff(), -0.001) << link.name;
    EXPECT_GT((collides.upper - seen.upper).minCoeff(), -0.001) << link.name;
  }
}

// A mesh in millimetres read as metres, or in a wrong frame, shows here.
TEST_P(ShippedRobot, IsAsLargeAsItsJointsAreApart) {
  for (const geometric::Link& link : model_->description().links) {
    const geometric::TriangleMesh mesh = geometric::collision_mesh(link);
    if (mesh.empty()) {
      continue;
    }
    const geometric::Aabb box = geometric::bounding_box(mesh);
    EXPECT_GT(box.size().maxCoeff(), 0.015) << link.name;
    EXPECT_LT(box.size().maxCoeff(), 0.7) << link.name;
    EXPECT_LT(mesh.triangles.size(), 1000U) << link.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Resources, ShippedRobot, testing::ValuesIn(kRobots),
                         [](const auto& test) { return std::string(test.param); });

TEST(ShippedRobots, AreAllTestedHere) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "resources/robots")) {
    if (entry.is_directory() && entry.path().filename() != "cad") {
      found.push_back(entry.path().filename().string());
    }
  }
  EXPECT_THAT(found, testing::UnorderedElementsAreArray(kRobots));
}

TEST(ShippedRobots, HaveTheirNumbersOfVariables) {
  const auto arm = geometric::load_robot(urdf_of("tx90"));
  const auto hand = geometric::load_robot(urdf_of("sah_right"));
  const auto both = geometric::load_robot(urdf_of("tx90_sah"));
  EXPECT_EQ(arm->variable_count(), 6);
  EXPECT_EQ(hand->variable_count(), 13);
  EXPECT_EQ(both->variable_count(), 19);
  EXPECT_THAT(both->find_group("arm").value(), testing::SizeIs(6));
  EXPECT_THAT(both->find_group("hand").value(), testing::SizeIs(13));
}

TEST(ShippedRobots, OfClassesHaveTheirNumbersOfVariables) {
  for (const auto& [name, count] : {std::pair{"iiwa14_class", 7},
                                    {"panda_class", 7},
                                    {"ur5e_class", 6},
                                    {"allegro_class_right", 16},
                                    {"leap_class_right", 16},
                                    {"shadow_class_right", 20}}) {
    EXPECT_EQ(geometric::load_robot(urdf_of(name))->variable_count(), count) << name;
  }
}

// Flanges and palms have the frames that this takes: z out of the flange, along the fingers.
TEST(ShippedRobots, MountEveryHandOnEveryArm) {
  for (const char* arm : kArms) {
    for (const char* hand : kHands) {
      const ScratchFolder folder;
      const std::filesystem::path file = folder.path() / "scene.yaml";
      std::ofstream(file) << "handway: 1\nrobots:\n  - {name: arm, model: " << arm
                          << "}\n  - {name: hand, model: " << hand
                          << ", mount: {robot: arm, link: flange_link}}\n";
      const geometric::Scene scene = geometric::read_scene(file);
      EXPECT_THAT(scene.warnings, testing::IsEmpty()) << arm << " with " << hand;
      const RobotModel& both = *scene.robots.front().model;
      const auto parts = {geometric::load_robot(urdf_of(arm)),
                          geometric::load_robot(urdf_of(hand))};
      EXPECT_EQ(both.variable_count(),
                std::accumulate(parts.begin(), parts.end(), 0, [](int count, const auto& part) {
                  return count + part->variable_count();
                }));
      EXPECT_EQ(both.find_group("hand").value().size(),
                static_cast<std::size_t>((*(parts.end() - 1))->variable_count()));
    }
  }
}

TEST(ShippedRobots, OfArmAndHandConsistOfTheTwo) {
  const auto both = geometric::load_robot(urdf_of("tx90_sah"));
  for (const char* name : {"tx90", "sah_right"}) {
    const auto part = geometric::load_robot(urdf_of(name));
    for (int link = 1; link < part->link_count(); ++link) {
      const geometric::Joint& expected = part->joint(link);
      const auto found = both->find_link(part->link(link).name);
      ASSERT_TRUE(found) << part->link(link).name;
      const geometric::Joint& joint = both->joint(*found);
      EXPECT_EQ(joint.name, expected.name);
      EXPECT_EQ(joint.parent, expected.parent);
      EXPECT_EQ(joint.X_PJ.matrix(), expected.X_PJ.matrix()) << joint.name;
      EXPECT_EQ(joint.axis, expected.axis) << joint.name;
      EXPECT_EQ(joint.limits.lower, expected.limits.lower) << joint.name;
      EXPECT_EQ(joint.limits.upper, expected.limits.upper) << joint.name;
      EXPECT_EQ(joint.mimic.has_value(), expected.mimic.has_value()) << joint.name;
    }
  }
}

}  // namespace
}  // namespace handway::test
