/// Scenes for other programs: that they are read back as they were.
#include "scene_exporters.h"

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"
#include "moveit_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace handway::export_scene {
namespace {

using geometric::Scene;
using testing::HasSubstr;
using testing::SizeIs;

Scene can_on_table() {
  Scene scene = geometric::read_scene(test::source_dir() / "scenes" / "can_on_table.yaml");
  scene.robots.front().X_WB = geometric::pose_from_rpy({0.1, 0.2, 0.0}, 0.0, 0.0, 0.3);
  scene.objects.push_back(
      {"held", geometric::Box{{0.02, 0.02, 0.02}}, geometric::Pose::Identity(), {}, {}});
  scene.objects.back().attachment = geometric::Attachment{"tx90_sah", "palm", {"palm"}};
  scene.objects.back().X_PO.translation() = Eigen::Vector3d(0.0, 0.0, 0.3);
  scene.allowed_collisions[{"can", "table"}] = true;
  scene.robots.front().padding["palm"] = {1.0, 0.002};
  return scene;
}

std::vector<double> clearances(const Scene& scene, const geometric::Configuration& q) {
  auto checker =
      geometric::make_collision_checker(std::make_shared<const geometric::CollisionWorld>(scene));
  checker->place(q);
  std::map<std::pair<std::string, std::string>, double> found;
  for (int pair = 0; pair < static_cast<int>(checker->world().pairs().size()); ++pair) {
    const auto named =
        geometric::named_pair(checker->world(), pair, checker->pair_distance(pair, 5.0));
    found[std::minmax(named.a, named.b)] = named.distance;
  }
  std::vector<double> values;
  for (const auto& [names, distance] : found) {
    values.push_back(distance);
  }
  return values;
}

TEST(MoveitSceneExporter, WritesWhatTheImporterReadsBack) {
  const test::ScratchFolder folder;
  const Scene scene = can_on_table();
  const auto files = MoveitSceneExporter().write(scene, folder.path());
  ASSERT_THAT(files, SizeIs(4)) << "URDF, SRDF, scene and request";
  const auto again = import_moveit::MoveitImporter().read(folder.path() / "scene.yaml").scene;
  ASSERT_EQ(again->objects.size(), scene.objects.size());
  ASSERT_TRUE(again->start && again->goal);
  EXPECT_TRUE(again->start->isApprox(*scene.start, 1e-12));
  EXPECT_TRUE(again->goal->isApprox(*scene.goal, 1e-12));
  const std::vector<double> before = clearances(scene, *scene.start);
  const std::vector<double> after = clearances(*again, *again->start);
  ASSERT_EQ(before.size(), after.size()) << "the same pairs are checked";
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(before[i], after[i], 1e-6);
  }
}

TEST(MoveitSceneExporter, KeepsGoalsAsPoses) {
  const test::ScratchFolder folder;
  Scene scene = can_on_table();
  geometric::PoseGoal goal;
  goal.link = "palm";
  goal.X_WG = geometric::pose_from_rpy({0.7, 0.1, 0.6}, 0.1, 0.2, 0.3);
  goal.X_LT.translation() = Eigen::Vector3d(0.0, 0.0, 0.1);
  goal.position_tolerance = Eigen::Vector3d(0.001, 0.002, 0.003);
  goal.rotation_tolerance = Eigen::Vector3d(0.1, 0.2, 4.0);
  scene.goal_poses = {goal};
  static_cast<void>(MoveitSceneExporter().write(scene, folder.path()));
  const auto again = import_moveit::MoveitImporter().read(folder.path() / "request.yaml").scene;
  ASSERT_THAT(again->goal_poses, SizeIs(1));
  const geometric::PoseGoal& read = again->goal_poses.front();
  // The exported scene is in the frame of the robot's base.
  const geometric::Pose X_WG = scene.robots.front().X_WB * read.X_WG;
  EXPECT_TRUE(X_WG.isApprox(goal.X_WG, 1e-9));
  EXPECT_TRUE(read.X_LT.isApprox(goal.X_LT, 1e-12));
  EXPECT_TRUE(read.position_tolerance.isApprox(goal.position_tolerance, 1e-9));
  EXPECT_TRUE(read.rotation_tolerance.isApprox(goal.rotation_tolerance, 1e-9));
}

TEST(GltfExporter, WritesWhatMeshReadersRead) {
  const test::ScratchFolder folder;
  const Scene scene = can_on_table();
  const auto files = GltfExporter().write(scene, folder.path());
  ASSERT_THAT(files, SizeIs(1));
  EXPECT_EQ(files.front().filename(), "can_on_table.glb");
  const auto mesh = geometric::read_mesh(files.front());
  const auto* table = geometric::find_object(scene, "table");
  ASSERT_TRUE(table);
  const geometric::Aabb seen = geometric::bounding_box(*mesh);
  EXPECT_LT(seen.lower.y(), 0.01) << "y is up: the pedestal stands on the floor";
  EXPECT_GT(seen.upper.y(), 1.0) << "the arm";
  EXPECT_GT(mesh->triangles.size(), 1000U);
  std::ifstream stream(files.front(), std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  EXPECT_THAT(bytes, HasSubstr("\"name\":\"can\""));
  EXPECT_THAT(bytes, HasSubstr("tx90_sah/palm"));
}

TEST(SceneExporters, RefuseASceneWithoutARobot) {
  const test::ScratchFolder folder;
  EXPECT_THAT(
      test::refusal_of([&] { static_cast<void>(GltfExporter().write(Scene(), folder.path())); }),
      HasSubstr("a scene without a robot"));
}

}  // namespace
}  // namespace handway::export_scene
