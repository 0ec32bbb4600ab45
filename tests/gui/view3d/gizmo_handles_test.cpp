#include "handway/geometric/math/units.h"
#include "view3d/gizmo_drag.h"

#include <gtest/gtest.h>

#include <cmath>

namespace handway::test {
namespace {

using Eigen::Vector3d;
using geometric::Pose;
using gui::GizmoDrag;
using gui::GizmoFrame;
using gui::GizmoHandle;
using gui::Ray;
using Kind = GizmoHandle::Kind;

Ray through(const Vector3d& p) {
  const Vector3d eye(3.0, -4.0, 2.5);
  return {eye, (p - eye).normalized()};
}

Pose at(double x, double y, double z) { return Pose(Eigen::Translation3d(x, y, z)); }

TEST(GizmoHandles, AreHitWhereTheyAre) {
  const GizmoFrame frame;
  EXPECT_EQ(gui::handle_at(frame, through({0.95, 0.0, 0.0})), (GizmoHandle{Kind::kArrow, 0}));
  EXPECT_EQ(gui::handle_at(frame, through({0.0, 0.0, 0.9})), (GizmoHandle{Kind::kArrow, 2}));
  const double r = GizmoFrame::kRingRadius * std::sqrt(0.5);
  EXPECT_EQ(gui::handle_at(frame, through({r, r, 0.0})), (GizmoHandle{Kind::kRing, 2}));
  EXPECT_EQ(gui::handle_at(frame, through({0.32, 0.32, 0.0})), (GizmoHandle{Kind::kPlate, 2}));
  EXPECT_EQ(gui::handle_at(frame, through({1.5, 1.5, 1.5})), std::nullopt);
}

TEST(GizmoDrag, MovesAlongItsAxisWithThePointer) {
  GizmoDrag drag({Kind::kArrow, 0}, {}, at(0.1, 0.2, 0.3), through({0.8, 0.0, 0.0}));
  const Pose moved = drag.moved_to(through({1.05, 0.0, 0.0}), false);
  EXPECT_TRUE(moved.translation().isApprox(Vector3d(0.35, 0.2, 0.3), 1e-9));
  EXPECT_NEAR(drag.amount().x(), 0.25, 1e-9);
}

TEST(GizmoDrag, MovesInAPlane) {
  GizmoDrag drag({Kind::kPlate, 2}, {}, Pose::Identity(), through({0.3, 0.3, 0.0}));
  const Pose moved = drag.moved_to(through({0.5, 0.2, 0.0}), false);
  EXPECT_TRUE(moved.translation().isApprox(Vector3d(0.2, -0.1, 0.0), 1e-9));
}

TEST(GizmoDrag, TurnsAboutItsCentre) {
  GizmoDrag drag({Kind::kRing, 2}, {}, at(0.1, 0.2, 0.3), through({0.78, 0.0, 0.0}));
  const Pose moved = drag.moved_to(through({0.0, 0.78, 0.0}), false);
  EXPECT_TRUE(moved.linear().isApprox(
      geometric::pose_from_rpy(Vector3d::Zero(), 0.0, 0.0, geometric::radians(90.0)).linear(),
      1e-9));
  EXPECT_TRUE(moved.translation().isApprox(Vector3d(-0.2, 0.1, 0.3), 1e-9));
}

TEST(GizmoDrag, SnapsToRoundPlacesInTheWorld) {
  GizmoDrag drag({Kind::kArrow, 1}, {}, at(0.1, 0.2034, 0.3), through({0.0, 0.8, 0.0}));
  const Pose moved = drag.moved_to(through({0.0, 0.8361, 0.0}), true);
  EXPECT_NEAR(moved.translation().y(), 0.24, 1e-12);
}

TEST(GizmoDrag, SnapsAnglesToFifteenDegrees) {
  GizmoDrag drag({Kind::kRing, 2}, {}, Pose::Identity(), through({0.78, 0.0, 0.0}));
  const double angle = geometric::radians(33.0);
  (void)drag.moved_to(through({0.78 * std::cos(angle), 0.78 * std::sin(angle), 0.0}), true);
  EXPECT_NEAR(geometric::degrees(drag.amount().z()), 30.0, 1e-9);
}

// A ring seen from the side is pulled like a rope.
TEST(GizmoDrag, TurnsARingSeenFromTheSide) {
  const Ray ahead{{5.0, 0.0, 0.0}, -Vector3d::UnitX()};
  GizmoDrag drag({Kind::kRing, 2}, {}, Pose::Identity(), ahead);
  const Ray aside{{5.0, 0.39, 0.0}, -Vector3d::UnitX()};
  (void)drag.moved_to(aside, false);
  EXPECT_NEAR(drag.amount().z(), 0.5, 1e-9);
}

}  // namespace
}  // namespace handway::test
