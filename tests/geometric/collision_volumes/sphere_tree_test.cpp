#include "collision/volumes/sphere_tree.h"

#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

namespace handway::geometric {
namespace {

constexpr double kLeaf = 0.01;  // m

// Returns whether the point of `triangle` is in a leaf's sphere that lists it, below spheres that
// contain it, too.
bool is_covered(const SphereTree& cover, std::uint32_t index, const Eigen::Vector3d& p,
                std::uint32_t triangle) {
  const SphereTree::Node& node = cover.node(index);
  for (std::size_t k = 0; k < node.count; ++k) {
    const Eigen::Vector3d centre(node.x[k], node.y[k], node.z[k]);
    const Eigen::Vector3d normal(node.normal_x[k], node.normal_y[k], node.normal_z[k]);
    if ((p - centre).norm() > node.radius[k] * (1.0 + 1e-6) ||
        std::abs((p - centre).dot(normal)) > node.thickness[k] + 1e-7) {
      continue;
    }
    const std::uint32_t child = node.child[k];
    if ((child & SphereTree::kLeaf) == 0
            ? is_covered(cover, child, p, triangle)
            : std::ranges::count(cover.triangles(child & ~SphereTree::kLeaf), triangle) > 0) {
      return true;
    }
  }
  return false;
}

TEST(SphereTree, ContainsTheWholeSurfaceOnEveryLevel) {
  for (const auto& [name, mesh] : test::sample_meshes()) {
    SCOPED_TRACE(name);
    const SphereTree cover(mesh, kLeaf);
    test::RandomPoints points(mesh, 1.0);
    for (int i = 0; i < 2000; ++i) {
      std::uint32_t triangle = 0;
      const Eigen::Vector3d p = points.next_on(mesh, triangle);
      ASSERT_LE((p - cover.root().centre.cast<double>()).norm(), cover.root().radius + 1e-7);
      ASSERT_TRUE(is_covered(cover, 0, p, triangle)) << p.transpose();
    }
  }
}

TEST(SphereTree, ContainsTheWholeSurfaceWhereItGrows) {
  for (const auto& [name, mesh] : test::sample_meshes()) {
    SCOPED_TRACE(name);
    const SphereTree cover = SphereTree::growing(std::make_shared<const TriangleMesh>(mesh), kLeaf);
    test::RandomPoints points(mesh, 1.0);
    for (int i = 0; i < 2000; ++i) {
      std::uint32_t triangle = 0;
      const Eigen::Vector3d p = points.next_on(mesh, triangle);
      ASSERT_LE((p - cover.root().centre.cast<double>()).norm(), cover.root().radius + 1e-7);
      ASSERT_TRUE(is_covered(cover, 0, p, triangle)) << p.transpose();
    }
  }
}

// Sums up the tree below a node, whatever its nodes' numbers are.
double fingerprint(const SphereTree& cover, std::uint32_t index) {
  const SphereTree::Node& node = cover.node(index);
  double sum = 0.0;
  for (std::size_t k = 0; k < node.count; ++k) {
    const bool is_leaf = (node.child[k] & SphereTree::kLeaf) != 0;
    sum +=
        static_cast<double>(k + 1) *
        (static_cast<double>(node.radius[k]) +
         (is_leaf ? static_cast<double>(cover.triangles(node.child[k] & ~SphereTree::kLeaf).size())
                  : 0.9 * fingerprint(cover, node.child[k])));
  }
  return sum;
}

// Visits the tree below a node, the last child first.
void visit_backwards(const SphereTree& cover, std::uint32_t index) {
  const SphereTree::Node& node = cover.node(index);
  for (std::size_t k = node.count; k-- > 0;) {
    if ((node.child[k] & SphereTree::kLeaf) == 0) {
      visit_backwards(cover, node.child[k]);
    }
  }
}

TEST(SphereTree, GrowsTheSameWhoeverComesFirst) {
  const auto mesh = tessellate(Box{{0.4, 0.3, 0.2}});
  const SphereTree forwards = SphereTree::growing(mesh, kLeaf);
  const SphereTree shared = SphereTree::growing(mesh, kLeaf);
  const double expected = fingerprint(forwards, 0);
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&, i] {
        i % 2 == 0 ? visit_backwards(shared, 0) : static_cast<void>(fingerprint(shared, 0));
      });
    }
  }
  EXPECT_EQ(fingerprint(shared, 0), expected);
}

TEST(SphereTree, GrowsAsFineAsItWouldBeComplete) {
  const auto mesh = tessellate(Box{{0.4, 0.3, 0.2}});
  const std::function<void(const SphereTree&, std::uint32_t)> look = [&](const SphereTree& cover,
                                                                         std::uint32_t index) {
    const SphereTree::Node& node = cover.node(index);
    for (std::size_t k = 0; k < node.count; ++k) {
      if ((node.child[k] & SphereTree::kLeaf) != 0) {
        EXPECT_LE(node.radius[k], 1.01 * kLeaf);
      } else {
        look(cover, node.child[k]);
      }
    }
  };
  look(SphereTree::growing(mesh, kLeaf), 0);
}

TEST(SphereTree, CutsLargeTriangles) {
  const SphereTree cover(*tessellate(Box{{0.4, 0.3, 0.2}}), kLeaf);
  for (const SphereTree::Node& node : cover.nodes()) {
    for (std::size_t k = 0; k < node.count; ++k) {
      if ((node.child[k] & SphereTree::kLeaf) != 0) {
        EXPECT_LE(node.radius[k], 1.01 * kLeaf);
      }
    }
  }
}

TEST(SphereTree, IsFlatWhereTheSurfaceIs) {
  const SphereTree cover(test::sample_meshes()[2].mesh, kLeaf);  // the plate
  for (const SphereTree::Node& node : cover.nodes()) {
    for (std::size_t k = 0; k < node.count; ++k) {
      EXPECT_LT(node.thickness[k], 1e-6F);
    }
  }
}

}  // namespace
}  // namespace handway::geometric
