#include "collision/volumes/triangle_tree.h"

#include "collision/volumes/box_tree.h"
#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace handway::geometric {
namespace {

double distance(const TriangleMesh& mesh, std::uint32_t triangle, const Eigen::Vector3d& p) {
  return (p - nearest_on_triangle(corners(mesh, triangle), p)).norm();
}

// Distance by which the tree may underestimate.
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

// The corners are three points on a line that rounding bends, two or three at the same place, in
// any order.
TEST(NearestOnTriangle, IsOnAnEdgeWhereTheTriangleIsALine) {
  const Eigen::Vector3d a(0.0131, -0.0272, 0.0405);
  const Eigen::Vector3d along(0.0171, 0.0093, -0.0117);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.1, 0.1);
  for (const std::array<double, 3>& at : {std::array{0.0, 1.0, 0.3},
                                          {0.0, 0.3, 1.0},
                                          {0.3, 0.0, 1.0},
                                          {0.0, 0.0, 1.0},
                                          {0.0, 1.0, 0.0},
                                          {1.0, 0.0, 0.0},
                                          {0.5, 0.5, 0.5}}) {
    const std::array triangle{Eigen::Vector3d(a + at[0] * along),
                              Eigen::Vector3d(a + at[1] * along),
                              Eigen::Vector3d(a + at[2] * along)};
    const auto [first, last] = std::ranges::minmax(at);
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector3d p = a + Eigen::Vector3d(place(random), place(random), place(random));
      const double share = std::clamp((p - a).dot(along) / along.squaredNorm(), first, last);
      EXPECT_NEAR((p - nearest_on_triangle(triangle, p)).norm(), (p - a - share * along).norm(),
                  1e-12);
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

TEST(TriangleTree, GivesTheDistanceOfThePointsThatAreNearEnough) {
  at_points([](const TriangleMesh& mesh, const TriangleTree& tree, const Eigen::Vector3d& p, int) {
    double least = 1e9;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      least = std::min(least, distance(mesh, t, p));
    }
    const auto within = static_cast<float>(0.9 * least);
    ASSERT_NEAR(tree.distance(p.cast<float>(), 1e9F), least, kDoubt);
    ASSERT_EQ(tree.distance(p.cast<float>(), within), within);
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
