#include "collision/narrow_phase/fcl_bodies.h"
#include "collision/volumes/box_cover.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "sample_meshes.h"

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

namespace handway::geometric {
namespace {

/// A surface with what its sides are asked with.
struct Body {
  explicit Body(const TriangleMesh& surface)
      : mesh(surface),
        points(pieces_of(surface).front()),
        sides(make_box_cover(pieces_of(surface))),
        tree(make_fcl_tree(surface)) {
    const Aabb box = bounding_box(surface);
    centre = box.centre().cast<float>();
    half = (0.5 * box.size()).cast<float>();
  }

  [[nodiscard]] BoundingSphere around() const { return {centre, half.norm()}; }

  TriangleMesh mesh;
  SurfacePoints points;
  SurfaceSides sides;
  std::shared_ptr<FclTree> tree;
  Eigen::Vector3f centre;
  Eigen::Vector3f half;
};

FloatPose float_pose(const Pose& X) { return {X, 1.0F}; }

bool collide(const Body& a, const Pose& X_BA, const Body& b) {
  fcl::CollisionResultd result;
  return fcl::collide(a.tree.get(), X_BA, b.tree.get(), Pose::Identity(), {}, result) > 0;
}

double distance(const Body& a, const Pose& X_BA, const Body& b) {
  fcl::DistanceResultd result;
  return fcl::distance(a.tree.get(), X_BA, b.tree.get(), Pose::Identity(), fcl::DistanceRequestd(),
                       result);
}

Pose random_pose(test::RandomPoints& points) {
  const Eigen::Vector3d p = points.next();
  const Eigen::Vector3d axis = points.next() + Eigen::Vector3d(1e-3, 0.0, 0.0);
  return Eigen::Translation3d(p) * Eigen::AngleAxisd(20.0 * points.next().x(), axis.normalized());
}

// An open tray, as many pieces as sides.
TriangleMesh tray() {
  TriangleMesh mesh = *tessellate(Box{{0.3, 0.3, 0.01}});
  for (const double side : {-1.0, 1.0}) {
    append(mesh, transformed(*tessellate(Box{{0.01, 0.3, 0.1}}),
                             Pose(Eigen::Translation3d(0.16 * side, 0.0, 0.05))));
    append(mesh, transformed(*tessellate(Box{{0.3, 0.01, 0.1}}),
                             Pose(Eigen::Translation3d(0.0, 0.16 * side, 0.05))));
  }
  return mesh;
}

TEST(SideTests, AgreeWithFcl) {
  const Body finger(*tessellate(Cylinder{0.012, 0.05}));
  for (const TriangleMesh& mesh : {*tessellate(Box{{0.4, 0.1, 0.02}}), *tessellate(Sphere{0.05}),
                                   test::sample_meshes().back().mesh, tray()}) {
    const Body other(mesh);
    test::RandomPoints points(mesh, 1.3);
    int crossings = 0;
    int found = 0;
    int apart = 0;
    int cleared = 0;
    for (int i = 0; i < 2000; ++i) {
      const Pose X = random_pose(points);
      const bool pierces =
          surely_pierces(finger.points, finger.around(), other.sides, float_pose(X));
      const float gap = gap_outside(finger.centre, finger.half, other.sides, float_pose(X));
      const bool touches = collide(finger, X, other);
      ASSERT_FALSE(pierces && !touches) << X.matrix();
      ASSERT_LE(gap, touches ? 0.0 : distance(finger, X, other) + 1e-9) << X.matrix();
      (touches ? crossings : apart) += 1;
      found += pierces ? 1 : 0;
      cleared += gap > 0.0F ? 1 : 0;
    }
    EXPECT_GT(found, crossings / 2);
    EXPECT_GT(cleared, apart / 12);
  }
}

TEST(SideTests, DoNotTakeWhatIsWithinForACrossing) {
  const Body pea(*tessellate(Sphere{0.005}));
  const Body box(*tessellate(Box{{0.1, 0.1, 0.1}}));
  const FloatPose X = float_pose(Pose(Eigen::Translation3d(0.01, 0.02, 0.0)));
  EXPECT_FALSE(surely_pierces(pea.points, pea.around(), box.sides, X));
  EXPECT_LE(gap_outside(pea.centre, pea.half, box.sides, X), 0.0F);
}

TEST(SideTests, KnowNothingOfOpenSurfaces) {
  const Body finger(*tessellate(Cylinder{0.012, 0.05}));
  const Body plate(test::sample_meshes()[2].mesh);
  const FloatPose X = float_pose(Pose(Eigen::Translation3d(0.5, 0.2, 1.0)));
  EXPECT_FALSE(surely_pierces(finger.points, finger.around(), plate.sides, X));
  EXPECT_LE(gap_outside(finger.centre, finger.half, plate.sides, X), 0.0F);
}

}  // namespace
}  // namespace handway::geometric
