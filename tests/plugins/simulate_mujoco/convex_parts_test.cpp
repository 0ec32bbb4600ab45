#include "convex_parts.h"

#include "handway/geometric/mesh/convex_hull.h"
#include "handway/geometric/mesh/shape.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/sampling/sequences/random_stream.h"
#include "handway_test/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace handway::simulate_mujoco {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometric::TriangleMesh;

// A prism of height 1 over an outline that is seen as a whole from its first corner.
TriangleMesh prism(const std::vector<Vector2d>& outline) {
  TriangleMesh mesh;
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const double z : {0.0, 1.0}) {
    for (const Vector2d& p : outline) {
      mesh.vertices.emplace_back(p.x(), p.y(), z);
    }
  }
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({n, n + i, n + i + 1});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.triangles.push_back({i, next, n + next});
    mesh.triangles.push_back({i, n + next, n + i});
  }
  return mesh;
}

TriangleMesh angle_iron() { return prism({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}); }

// A pipe of square section along z: 4 wide outside, 2 inside, 1 long.
TriangleMesh square_pipe() {
  TriangleMesh mesh;
  for (const double z : {0.0, 1.0}) {
    for (const double half : {2.0, 1.0}) {
      for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
        mesh.vertices.emplace_back(half * x, half * y, z);
      }
    }
  }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    quad(i, next, 8 + next, 8 + i);            // outside
    quad(4 + next, 4 + i, 12 + i, 12 + next);  // inside
    quad(8 + i, 8 + next, 12 + next, 12 + i);  // top
    quad(next, i, 4 + i, 4 + next);            // bottom
  }
  return mesh;
}

double volume_of(const std::vector<ConvexPart>& parts) {
  return std::accumulate(parts.begin(), parts.end(), 0.0,
                         [](double sum, const ConvexPart& part) { return sum + part.volume; });
}

bool has_corner_at(const std::vector<ConvexPart>& parts, const Vector3d& p) {
  return std::ranges::any_of(parts, [&](const ConvexPart& part) {
    return std::ranges::any_of(part.corners,
                               [&](const Vector3d& corner) { return (corner - p).norm() < 1e-9; });
  });
}

TEST(ConvexParts, LeaveAConvexSolidWhole) {
  const auto ball = geometric::tessellate(geometric::Sphere{0.05});
  const std::vector<ConvexPart> parts = convex_parts(*ball);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_NEAR(parts[0].volume, enclosed_volume(*ball), 1e-12);
}

TEST(ConvexParts, CutAnAngleIronWhereItsFacesMeet) {
  const std::vector<ConvexPart> parts = convex_parts(angle_iron());
  EXPECT_EQ(parts.size(), 2U);
  EXPECT_NEAR(volume_of(parts), 3.0, 1e-9);
}

TEST(ConvexParts, KeepTheHoleOfAPipe) {
  const std::vector<ConvexPart> parts = convex_parts(square_pipe());
  EXPECT_LE(parts.size(), 8U);
  EXPECT_NEAR(volume_of(parts), 12.0, 1e-9);
}

TEST(ConvexParts, KeepTheWallOfARoundPipeThin) {
  constexpr int kSides = 48;
  constexpr double kWall = 0.004;
  TriangleMesh mesh;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSides;
    for (const double radius : {0.04, 0.04 - kWall}) {
      for (const double z : {0.0, 0.1}) {
        mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
      }
    }
  }
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t a = 4 * i;
    const std::uint32_t b = 4 * ((i + 1) % kSides);
    for (const auto& [p, q, r, s] :
         {std::array{a, b, b + 1, a + 1}, std::array{b + 2, a + 2, a + 3, b + 3},
          std::array{a + 1, b + 1, b + 3, a + 3}, std::array{b, a, a + 2, b + 2}}) {
      mesh.triangles.push_back({p, q, r});
      mesh.triangles.push_back({p, r, s});
    }
  }
  const std::vector<ConvexPart> parts = convex_parts(mesh, {.depth = 1e-4, .most = 64});
  const double volume = enclosed_volume(mesh);
  EXPECT_GE(volume_of(parts), volume - 1e-12);
  EXPECT_LE(volume_of(parts), 1.06 * volume);
  for (const ConvexPart& part : parts) {
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& corner : part.corners) {
      middle += corner / static_cast<double>(part.corners.size());
    }
    EXPECT_GT(middle.head<2>().norm(), 0.03) << "a part is of the wall, not across the hole";
  }
}

TEST(ConvexParts, AreTheSameOfAMeshThatIsWoundInwards) {
  TriangleMesh inwards = angle_iron();
  for (auto& triangle : inwards.triangles) {
    std::swap(triangle[1], triangle[2]);
  }
  EXPECT_EQ(convex_parts(inwards).size(), 2U);
  EXPECT_NEAR(volume_of(convex_parts(inwards)), 3.0, 1e-9);
}

TEST(ConvexParts, HaveEveryCornerOfAnOpenSurface) {
  TriangleMesh open = angle_iron();
  open.triangles.erase(open.triangles.begin());
  const std::vector<ConvexPart> parts = convex_parts(open);
  EXPECT_GT(parts.size(), 1U);
  for (const Vector3d& p : open.vertices) {
    EXPECT_TRUE(has_corner_at(parts, p)) << p.transpose();
  }
}

// Returns how often the surface winds around a point: ±1 inside, 0 outside.
double winding_number(const TriangleMesh& mesh, const Vector3d& p) {
  double solid_angle = 0.0;  // Van Oosterom and Strackee, 1983
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3d a = mesh.vertices[i] - p;
    const Vector3d b = mesh.vertices[j] - p;
    const Vector3d c = mesh.vertices[k] - p;
    solid_angle +=
        2.0 * std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                                a.dot(c) * b.norm() + b.dot(c) * a.norm());
  }
  return solid_angle / (4.0 * std::numbers::pi);
}

bool is_inside(const TriangleMesh& convex, const Vector3d& p) {
  return std::ranges::all_of(convex.triangles, [&](const auto& corners) {
    const Vector3d& a = convex.vertices[corners[0]];
    const Vector3d normal =
        (convex.vertices[corners[1]] - a).cross(convex.vertices[corners[2]] - a);
    return normal.dot(p - a) <= 0.0;
  });
}

TEST(ConvexParts, CoverTheLinksOfAHandAndLittleMore) {
  const planning::SceneState loaded =
      planning::load_scene(test::source_dir() / "scenes" / "can_on_table.yaml", {});
  const geometric::RobotModel& robot = *loaded.scene->robots.front().model;
  for (const char* name : {"palm", "thumb_distal_link", "ring_distal_link", "index_medial_link"}) {
    const geometric::Link& link = robot.link(robot.find_link(name).value());
    const auto mesh = geometric::tessellate(link.collision.front().shape);
    std::vector<TriangleMesh> hulls;
    for (const ConvexPart& part : convex_parts(*mesh)) {
      hulls.push_back(geometric::convex_hull(part.corners));
    }
    const geometric::Aabb box = geometric::bounding_box(*mesh);
    sampling::RandomStream random(1);
    int beyond = 0;
    constexpr int kPoints = 2000;
    for (int i = 0; i < kPoints; ++i) {
      const Vector3d share(random.uniform(), random.uniform(), random.uniform());
      const Vector3d p = box.lower + box.size().cwiseProduct(share);
      const bool is_covered =
          std::ranges::any_of(hulls, [&](const auto& hull) { return is_inside(hull, p); });
      const bool is_solid = std::abs(winding_number(*mesh, p)) > 0.5;
      EXPECT_TRUE(is_covered || !is_solid) << name << " at " << p.transpose();
      beyond += static_cast<int>(is_covered && !is_solid);
    }
    EXPECT_LT(beyond, kPoints / 25) << name;
  }
}

TEST(ConvexParts, AreNoMoreThanAllowed) {
  EXPECT_EQ(convex_parts(square_pipe(), {.most = 2}).size(), 2U);
}

TEST(ConvexParts, OfNothingAreNone) {
  EXPECT_TRUE(convex_parts({}).empty());
  TriangleMesh flat;
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  flat.triangles = {{0, 1, 2}};
  EXPECT_TRUE(convex_parts(flat).empty()) << "without a volume";
}

}  // namespace
}  // namespace handway::simulate_mujoco
