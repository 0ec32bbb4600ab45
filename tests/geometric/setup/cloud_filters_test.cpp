/// Points of a camera without noise, robot and target.
#include "handway/geometric/setup/cloud_filters.h"

#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway_test/paths.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace handway::geometric {
namespace {

Scene shipped() { return read_scene(test::source_dir() / "scenes" / "can_on_table.yaml"); }

// Vertices of all bodies at the start, in the frame X_WC.
PointCloud seen(const Scene& scene, const Pose& X_WC) {
  const CollisionWorld world(scene);
  std::vector<Pose> X_BL(static_cast<std::size_t>(world.model().link_count()));
  std::vector<Pose> X_WBody(world.bodies().size());
  world.place(*scene.start, X_BL, X_WBody);
  PointCloud cloud;
  for (std::size_t i = 0; i < world.bodies().size(); ++i) {
    for (const Eigen::Vector3d& vertex : world.bodies()[i].mesh->vertices) {
      cloud.points.emplace_back((X_WC.inverse() * X_WBody[i] * vertex).cast<float>());
    }
  }
  return cloud;
}

std::size_t vertices_of(const Scene& scene, const char* object) {
  return tessellate(find_object(scene, object)->shape)->vertices.size();
}

TEST(CloudFilters, LeaveOutTheRobotAndWhatIsCutOut) {
  const Scene scene = shipped();
  const Pose X_WC = pose_from_rpy({1.0, -2.0, 0.5}, 0.3, -0.4, 2.0);
  const PointCloud cloud = seen(scene, X_WC);
  const std::size_t objects = vertices_of(scene, "pedestal") + vertices_of(scene, "table");
  // The arm stands on the pedestal: points of its top are the arm's too.
  const PointCloud without_can =
      without_bodies(cloud, X_WC, scene, *scene.start, {true, {"can"}, 1e-5});
  EXPECT_EQ(without_can.size(), objects);
  const PointCloud with_can = without_bodies(cloud, X_WC, scene, *scene.start, {true, {}, 1e-5});
  EXPECT_EQ(with_can.size(), objects + vertices_of(scene, "can"));
  const PointCloud objects_alone =
      without_bodies(cloud, X_WC, scene, *scene.start, {false, {"can"}, 1e-5});
  EXPECT_EQ(objects_alone.size(), cloud.size() - vertices_of(scene, "can"));
  EXPECT_THROW(
      static_cast<void>(without_bodies(cloud, X_WC, scene, *scene.start, {true, {"cup"}, 0.01})),
      InputError);
}

TEST(CloudFilters, LeaveOutWhatIsInsideOrNearerThanTheMargin) {
  Scene scene = shipped();
  const Pose X_WO = find_object(scene, "can")->X_PO;
  const Eigen::Vector3f above = (X_WO.translation() + Eigen::Vector3d(0, 0, 0.5)).cast<float>();
  const PointCloud cloud{
      {X_WO.translation().cast<float>(), above}, {{{1, 2, 3}}, {{4, 5, 6}}}, 0.0};
  const PointCloud kept =
      without_bodies(cloud, Pose::Identity(), scene, *scene.start, {true, {"can"}, 0.01});
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept.points[0], above);
  EXPECT_EQ(kept.colors[0][0], 4);
}

TEST(CloudFilters, LeaveOutSinglePoints) {
  PointCloud cloud;
  for (int i = 0; i < 2500; ++i) {
    cloud.points.emplace_back(0.01F * static_cast<float>(i % 50),
                              0.01F * static_cast<float>(i / 50), 0.0F);
  }
  cloud.points.emplace_back(0.2F, 0.2F, 0.3F);
  cloud.points.emplace_back(0.9F, 0.1F, -0.2F);
  EXPECT_EQ(without_outliers(cloud, {}).points.size(), 2500U);
  const PointCloud few{{{0, 0, 0}, {1, 0, 0}}, {}, 0.0};
  EXPECT_EQ(without_outliers(few, {}).size(), 2U);
}

}  // namespace
}  // namespace handway::geometric
