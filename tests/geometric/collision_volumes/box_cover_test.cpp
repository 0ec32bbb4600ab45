#include "collision/volumes/box_cover.h"

#include "handway/geometric/mesh/triangle_mesh.h"
#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace handway::geometric {
namespace {

SurfaceSides sides_of(const TriangleMesh& mesh) { return make_box_cover(pieces_of(mesh)); }

bool is_in(const BoxCover& piece, const BoxCover::Boxes& boxes, const Eigen::Vector3d& p) {
  const Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>> R_PB(piece.R_PB.data());
  const Eigen::Vector3f at = R_PB * p.cast<float>();
  for (std::size_t k = 0; k < BoxCover::kMost; ++k) {
    bool within = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      within = within && std::abs(at[static_cast<Eigen::Index>(axis)] - boxes.centre[axis][k]) <=
                             boxes.half[axis][k];
    }
    if (within) {
      return true;
    }
  }
  return false;
}

TEST(BoxCover, AreNotEnteredByTheSurface) {
  for (const auto& [name, mesh] : test::sample_meshes()) {
    SCOPED_TRACE(name);
    const SurfaceSides sides = sides_of(mesh);
    test::RandomPoints points(mesh, 1.0);
    for (int i = 0; i < 2000; ++i) {
      std::uint32_t triangle = 0;
      const Eigen::Vector3d p = points.next_on(mesh, triangle);
      // Of its own piece; other pieces' boxes it may be in.
      const BoxCover* piece = sides.pieces.empty()
                                  ? nullptr
                                  : &sides.pieces[sides.pieces.size() > 1 && p.x() > 0.1 ? 1 : 0];
      ASSERT_FALSE(piece != nullptr && is_in(*piece, piece->inside, p)) << p.transpose();
      ASSERT_FALSE(piece != nullptr && is_in(*piece, piece->outside, p)) << p.transpose();
    }
  }
}

TEST(BoxCover, KnowTheSides) {
  const SurfaceSides sides = sides_of(*tessellate(Cylinder{0.03, 0.12}));
  ASSERT_TRUE(sides.has_all);
  const BoxCover& can = sides.pieces.front();
  test::RandomPoints points(*tessellate(Cylinder{0.03, 0.12}), 1.5);
  int inside = 0;
  int outside = 0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d p = points.next();
    const bool within = p.head<2>().norm() < 0.03 && std::abs(p.z()) < 0.06;
    const bool says_inside = is_in(can, can.inside, p);
    const bool says_outside = is_in(can, can.outside, p);
    ASSERT_FALSE(says_inside && !within) << p.transpose();
    ASSERT_FALSE(says_outside && within && p.head<2>().norm() < 0.0298) << p.transpose();
    inside += says_inside ? 1 : 0;
    outside += says_outside ? 1 : 0;
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 1000);
}

TEST(BoxCover, FillAPlateThatLiesAskew) {
  const Pose X(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()));
  const TriangleMesh plate = transformed(*tessellate(Box{{1.0, 0.6, 0.004}}), X);
  const SurfaceSides sides = sides_of(plate);
  ASSERT_TRUE(sides.has_all);
  const BoxCover& boxes = sides.pieces.front();
  EXPECT_TRUE(is_in(boxes, boxes.inside, X * Eigen::Vector3d(0.49, 0.29, 0.0019)));
  EXPECT_FALSE(is_in(boxes, boxes.inside, X * Eigen::Vector3d(0.49, 0.29, 0.0021)));
}

// A bar bent to a ring of four sides, one piece: its hole is outside.
TriangleMesh frame() {
  TriangleMesh mesh;
  const auto corner = [&](int i, double width, double z) {
    const double x = (i == 1 || i == 2 ? 0.5 : -0.5) * width;
    const double y = (i >= 2 ? 0.5 : -0.5) * width;
    mesh.vertices.emplace_back(x, y, z);
  };
  for (const double z : {-0.01, 0.01}) {
    for (const double width : {0.2, 0.3}) {
      for (int i = 0; i < 4; ++i) {
        corner(i, width, z);
      }
    }
  }
  // Rings of vertices 0-3 (below, inner), 4-7 (below, outer), 8-11 and 12-15 above.
  for (const auto& [first, second] :
       std::vector<std::pair<std::uint32_t, std::uint32_t>>{{0, 4}, {4, 12}, {12, 8}, {8, 0}}) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t next = (i + 1) % 4;
      mesh.triangles.push_back({first + i, second + i, second + next});
      mesh.triangles.push_back({first + i, second + next, first + next});
    }
  }
  return mesh;
}

TEST(BoxCover, FillAHole) {
  const SurfaceSides sides = sides_of(frame());
  ASSERT_TRUE(sides.has_all);
  const BoxCover& boxes = sides.pieces.front();
  EXPECT_TRUE(is_in(boxes, boxes.outside, {0.09, -0.09, 0.0}));
  EXPECT_TRUE(is_in(boxes, boxes.outside, {0.0, 0.0, 0.5})) << "it goes on above";
  EXPECT_TRUE(is_in(boxes, boxes.inside, {0.13, 0.13, 0.0}));
  EXPECT_FALSE(is_in(boxes, boxes.inside, {0.09, -0.09, 0.0}));
}

TEST(BoxCover, AreOfEachClosedPiece) {
  const SurfaceSides two_balls = sides_of(test::sample_meshes().back().mesh);
  EXPECT_TRUE(two_balls.has_all);
  EXPECT_EQ(two_balls.pieces.size(), 2U);

  TriangleMesh mesh = *tessellate(Box{{0.4, 0.1, 0.02}});
  append(mesh, test::sample_meshes()[3].mesh);  // a single triangle: it has no inside
  const SurfaceSides mixed = sides_of(mesh);
  EXPECT_FALSE(mixed.has_all);
  EXPECT_EQ(mixed.pieces.size(), 1U);
}

}  // namespace
}  // namespace handway::geometric
