#include "collision/cache/surface.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "sample_meshes.h"

#include <gtest/gtest.h>

namespace handway::geometric {
namespace {

TEST(VolumeArchive, GivesBackTheSameVolumes) {
  const TriangleMesh mesh = *tessellate(Cylinder{0.03, 0.12});
  const MeshVolumes made{SphereTree(mesh, 0.01), ConvexCover(mesh, 1e-4),
                         DistanceField(mesh, TriangleTree(mesh), 4096),
                         inner_balls(mesh, TriangleTree(mesh))};
  const MeshVolumes read = unarchive_volumes(archive_volumes(made));

  EXPECT_EQ(read.cover.root().radius, made.cover.root().radius);
  ASSERT_EQ(read.cover.nodes().size(), made.cover.nodes().size());
  EXPECT_EQ(read.cover.nodes().back().x, made.cover.nodes().back().x);
  EXPECT_EQ(read.hull.margin(), made.hull.margin());
  EXPECT_EQ(read.hull.support(Eigen::Vector3f(1, 2, 3)),
            made.hull.support(Eigen::Vector3f(1, 2, 3)));
  ASSERT_EQ(read.field.cell_count(), made.field.cell_count());
  ASSERT_EQ(read.field.block_count(), made.field.block_count());
  ASSERT_FALSE(made.balls.empty());
  ASSERT_EQ(read.balls.size(), made.balls.size());
  EXPECT_EQ(read.balls.back().radius, made.balls.back().radius);
  test::RandomPoints points(mesh, 2.0);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3f p = points.next().cast<float>();
    EXPECT_EQ(read.field.bound(p), made.field.bound(p));
  }
}

}  // namespace
}  // namespace handway::geometric
