#include "collision/volumes/triangle_tree.h"

#include "collision/volumes/box_tree.h"
#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace handway::geometric {
namespace {

double distance(const TriangleMesh& mesh, std::uint32_t triangle, const Eigen::Vector3d& p) {
  return (p - nearest_on_triangle(corners(mesh, triangle), p)).norm();
}

// What the tree may take for nearer though it is not.
constexpr double kDoubt = 2e-5;  // m

// Shows `look` each sample's tree with points in and around it, numbered.
template <typename Look>
void at_points(const Look& look) {
  for (const auto& [name, mesh] : test::sample_meshes()) {
    SCOPED_TRACE(name);
    const TriangleTree tree(mesh);
    test::RandomPoints points(mesh, 2.0);
    for (int i = 0; i < 500 && !::testing::Test::HasFatalFailure(); ++i) {
      look(mesh, tree, points.next(), i);
    }
  }
}

TEST(TriangleTree, FindsEveryTriangleThatIsNearAndHardlyAnother) {
  at_points(
      [](const TriangleMesh& mesh, const TriangleTree& tree, const Eigen::Vector3d& p, int i) {
        const double within = 0.0004 * i;
        std::vector<std::uint32_t> found;
        tree.append_within(p, within, found);
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
          const double d = distance(mesh, t, p);
          const auto times = std::ranges::count(found, t);
          ASSERT_TRUE(d >= within || times == 1) << "misses triangle " << t;
          ASSERT_TRUE(d < within + kDoubt || times == 0) << "takes triangle " << t;
        }
      });
}

TEST(TriangleTree, KnowsWhetherASurfaceIsNear) {
  at_points([](const TriangleMesh& mesh, const TriangleTree& tree, const Eigen::Vector3d& p, int) {
    double least = 1e9;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      least = std::min(least, distance(mesh, t, p));
    }
    ASSERT_TRUE(tree.is_nearer_than(p, least + 1e-7));
    ASSERT_FALSE(tree.is_nearer_than(p, least - kDoubt));
  });
}

TEST(TriangleTree, KeepsApartWhatIsFarFromTheOrigin) {
  const TriangleMesh far =
      transformed(*tessellate(Sphere{0.05}), Pose(Eigen::Translation3d(3.0, -2.0, 1.0)));
  const TriangleTree tree(far);
  EXPECT_TRUE(tree.is_nearer_than({3.0, -2.0, 1.1}, 0.0501));
  EXPECT_FALSE(tree.is_nearer_than({3.0, -2.0, 1.1}, 0.0498));
}

}  // namespace
}  // namespace handway::geometric
