#include "scratch_files.h"

#include <handway/geometric/formats/robot_loader.h>
#include <handway/geometric/formats/urdf.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace handway::geometric {
namespace {

using test::ScratchFiles;
using testing::ElementsAre;

template <typename S>
LinkGeometry geometry_of(const S& shape) {
  LinkGeometry geometry;
  geometry.shape = shape;
  geometry.X_LG = pose_from_rpy({0.1, 1.0 / 3.0, -2e-7}, 0.3, -0.7, 2.9);
  geometry.color = {0.1F, 0.2F, 0.3F, 0.5F};
  return geometry;
}

/// Every kind of joint and shape, one mesh with and one without a file.
RobotModel full_robot(const ScratchFiles& files) {
  RobotDescription robot;
  robot.name = "full";
  for (const char* name : {"base", "turned", "slid", "coupled"}) {
    robot.links.emplace_back().name = name;
  }
  auto square = std::make_shared<TriangleMesh>();
  square->vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square->triangles = {{0, 1, 2}, {0, 2, 3}};
  robot.links[0].visual = {geometry_of(Box{{1, 2, 3}}), geometry_of(Sphere{0.1})};
  robot.links[1].collision = {geometry_of(Cylinder{0.1, 0.2}), geometry_of(Cone{0.25, 0.5})};
  robot.links[2].collision = {
      geometry_of(Mesh{files.write("parts/s.obj", test::kSquareObj), {1, 1, 1}, square}),
      geometry_of(Mesh{"made.wrl", {2, 2, 2}, square})};
  const auto add = [&](JointType type, const std::string& parent, const std::string& child) {
    Joint& joint = robot.joints.emplace_back();
    joint.name = child + "_joint";
    joint.type = type;
    joint.parent = parent;
    joint.child = child;
    joint.X_PJ = pose_from_rpy({0.1, 0.2, 0.3}, 1.0, 0.5, -1.0);
    joint.axis = Eigen::Vector3d(1, 2, 3).normalized();
    joint.limits = {-1.0 / 3.0, 2.5, 4.0};
  };
  add(JointType::kRevolute, "base", "turned");
  add(JointType::kPrismatic, "turned", "slid");
  add(JointType::kRevolute, "slid", "coupled");
  robot.joints[1].limits.velocity = std::numeric_limits<double>::infinity();
  robot.joints[2].mimic = Mimic{"turned_joint", 0.5, 0.1};
  robot.groups = {{"arm", {"turned_joint", "slid_joint"}}};
  robot.postures = {{"home", "arm", {{"turned_joint", 0.2}, {"slid_joint", 1.0 / 3.0}}}};
  robot.allowed_collisions.allow("turned", "slid", AllowedReason::kUser);
  return RobotModel(robot);
}

TEST(UrdfWriter, WritesWhatTheLoaderReadsBack) {
  const ScratchFiles files;
  const RobotModel model = full_robot(files);
  write_urdf(model, files.folder() / "full.urdf");
  const RobotDescription& a = model.description();
  const RobotDescription b = load_robot(files.folder() / "full.urdf")->description();
  EXPECT_EQ(b.name, "full");
  ASSERT_EQ(b.joints.size(), a.joints.size());
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    EXPECT_EQ(b.joints[i].name, a.joints[i].name);
    EXPECT_EQ(b.joints[i].type, a.joints[i].type);
    EXPECT_TRUE(b.joints[i].X_PJ.isApprox(a.joints[i].X_PJ, 1e-14));
    EXPECT_TRUE(b.joints[i].axis.isApprox(a.joints[i].axis, 1e-15));
    EXPECT_EQ(b.joints[i].limits.lower, a.joints[i].limits.lower);
    EXPECT_EQ(b.joints[i].limits.upper, a.joints[i].limits.upper);
    EXPECT_EQ(b.joints[i].limits.velocity, a.joints[i].limits.velocity);
  }
  ASSERT_TRUE(b.joints[2].mimic);
  EXPECT_EQ(b.joints[2].mimic->joint, "turned_joint");
  EXPECT_EQ(b.joints[2].mimic->offset, 0.1);
  EXPECT_EQ(b.allowed_collisions.entries(), a.allowed_collisions.entries());
  ASSERT_EQ(b.groups.size(), 1U);
  EXPECT_THAT(b.groups[0].joints, ElementsAre("turned_joint", "slid_joint"));
  EXPECT_EQ(b.postures.at(0).values, a.postures[0].values);
}

TEST(UrdfWriter, KeepsShapesAndSavesThoseThatUrdfDoesNotKnow) {
  const ScratchFiles files;
  const RobotModel model = full_robot(files);
  write_urdf(model, files.folder() / "full.urdf");
  const auto copy = load_robot(files.folder() / "full.urdf");
  for (int i = 0; i < model.link_count(); ++i) {
    ASSERT_EQ(copy->link(i).visual.size(), model.link(i).visual.size());
    ASSERT_EQ(copy->link(i).collision.size(), model.link(i).collision.size());
    for (std::size_t k = 0; k < model.link(i).visual.size(); ++k) {
      EXPECT_EQ(copy->link(i).visual[k].color, model.link(i).visual[k].color);
    }
    for (std::size_t k = 0; k < model.link(i).collision.size(); ++k) {
      const LinkGeometry& a = model.link(i).collision[k];
      const LinkGeometry& b = copy->link(i).collision[k];
      EXPECT_TRUE(b.X_LG.isApprox(a.X_LG, 1e-14));
      const Aabb box_a = bounding_box(*tessellate(a.shape));
      const Aabb box_b = bounding_box(*tessellate(b.shape));
      EXPECT_TRUE(box_a.upper.isApprox(box_b.upper, 1e-6));
    }
  }
  EXPECT_EQ(std::get<Mesh>(copy->link(2).collision[0].shape).file, files.folder() / "parts/s.obj");
  EXPECT_TRUE(std::filesystem::exists(files.folder() / "full_meshes/turned_collision.obj"));
}

}  // namespace
}  // namespace handway::geometric
