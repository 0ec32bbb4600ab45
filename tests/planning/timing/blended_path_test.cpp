#include "handway/planning/timing/blended_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace handway::planning {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Path kSquareCorner = {{Vector2d(0, 0), Vector2d(2, 0), Vector2d(2, 2)}};

TEST(BlendedPath, PassesACornerAtTheDeviationAsked) {
  const BlendedPath path(kSquareCorner, {0.0, 0.1, 0.0});
  ASSERT_EQ(path.pieces().size(), 3U);
  const PathPiece& arc = path.pieces()[1];
  EXPECT_TRUE(arc.is_arc());
  EXPECT_NEAR(arc.length, arc.radius * std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR((arc.derivative(0, arc.length / 2) - Vector2d(2, 0)).norm(), 0.1, 1e-12);
  EXPECT_NEAR(path.deviations()[1], 0.1, 1e-12);
  EXPECT_FALSE(path.pieces()[0].ends_in_corner);
  EXPECT_TRUE(path.pieces()[2].ends_in_corner) << "the end";
}

TEST(BlendedPath, TakesAtMostHalfOfAnEdge) {
  const BlendedPath path(kSquareCorner, {0.0, 10.0, 0.0});
  ASSERT_EQ(path.pieces().size(), 3U);
  EXPECT_NEAR(path.pieces()[1].radius, 1.0, 1e-12);
  EXPECT_NEAR(path.deviations()[1], std::sqrt(2.0) - 1.0, 1e-12);
  EXPECT_NEAR(path.length(), 2.0 + std::numbers::pi / 2, 1e-12);
}

TEST(BlendedPath, IsContinuousWithItsTangent) {
  const BlendedPath path(
      {{Vector3d(0, 0, 0), Vector3d(1, 0.2, 0), Vector3d(1.5, 1, -0.3), Vector3d(0, 1, 0)}},
      {0.0, 0.05, 0.2, 0.0});
  for (std::size_t i = 0; i + 1 < path.pieces().size(); ++i) {
    const PathPiece& piece = path.pieces()[i];
    const PathPiece& next = path.pieces()[i + 1];
    EXPECT_LT((piece.derivative(0, piece.length) - next.derivative(0, 0)).norm(), 1e-12) << i;
    EXPECT_LT((piece.derivative(1, piece.length) - next.derivative(1, 0)).norm(), 1e-12);
    EXPECT_NEAR(piece.derivative(1, 0.5 * piece.length).norm(), 1.0, 1e-12);
  }
}

TEST(BlendedPath, HasTheDerivativesOfItsPositions) {
  const BlendedPath path(kSquareCorner, {0.0, 0.3, 0.0});
  constexpr double kStep = 1e-5;
  for (const PathPiece& piece : path.pieces()) {
    const double s = 0.4 * piece.length;
    const Eigen::VectorXd slope =
        (piece.derivative(0, s + kStep) - piece.derivative(0, s - kStep)) / (2 * kStep);
    const Eigen::VectorXd bend =
        (piece.derivative(1, s + kStep) - piece.derivative(1, s - kStep)) / (2 * kStep);
    EXPECT_LT((slope - piece.derivative(1, s)).norm(), 1e-8);
    EXPECT_LT((bend - piece.derivative(2, s)).norm(), 1e-8);
  }
}

TEST(BlendedPath, LeavesCornersWithoutDeviation) {
  const BlendedPath path(kSquareCorner, {0.0, 0.0, 0.0});
  ASSERT_EQ(path.pieces().size(), 2U);
  EXPECT_TRUE(path.pieces()[0].ends_in_corner);
  EXPECT_NEAR(path.length(), 4.0, 1e-12);
}

TEST(BlendedPath, GoesStraightOnWithoutStopping) {
  const BlendedPath path({{Vector2d(0, 0), Vector2d(1, 1), Vector2d(3, 3)}}, {0.0, 0.0, 0.0});
  ASSERT_EQ(path.pieces().size(), 1U) << "a waypoint on the line adds nothing";
  EXPECT_NEAR(path.passages()[1], std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(path.passages()[2], 3.0 * std::sqrt(2.0), 1e-12);
}

TEST(BlendedPath, RoundsACornerAlikeWithWaypointsOnItsEdges) {
  const BlendedPath plain({{Vector2d(0, 0), Vector2d(2, 0), Vector2d(2, 2)}}, {0.0, 0.3, 0.0});
  const BlendedPath fine({{Vector2d(0, 0), Vector2d(1.5, 0), Vector2d(1.9, 0), Vector2d(2, 0),
                           Vector2d(2, 0.2), Vector2d(2, 2)}},
                         {0.0, 0.3, 0.3, 0.3, 0.3, 0.0});
  EXPECT_EQ(fine.pieces().size(), plain.pieces().size());
  EXPECT_NEAR(fine.length(), plain.length(), 1e-12);
  EXPECT_TRUE(std::ranges::is_sorted(fine.passages()));
}

TEST(BlendedPath, StopsWhereItTurnsBack) {
  const BlendedPath path({{Vector2d(0, 0), Vector2d(1, 1), Vector2d(0, 0)}}, {0.0, 1.0, 0.0});
  ASSERT_EQ(path.pieces().size(), 2U);
  EXPECT_TRUE(path.pieces()[0].ends_in_corner);
  EXPECT_EQ(path.deviations()[1], 0.0);
}

TEST(BlendedPath, SkipsWaypointsInTheSamePlace) {
  const BlendedPath path(
      {{Vector2d(0, 0), Vector2d(0, 0), Vector2d(2, 0), Vector2d(2, 0), Vector2d(2, 2)}},
      {0.0, 0.1, 0.1, 0.1, 0.0});
  EXPECT_EQ(path.pieces().size(), 3U);
  EXPECT_TRUE(BlendedPath({{Vector2d(1, 1), Vector2d(1, 1)}}, {0.0, 0.0}).pieces().empty());
}

TEST(BlendedPath, RefusesWhatIsNoPath) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(BlendedPath({}, {}), std::invalid_argument);
  EXPECT_THROW(BlendedPath(kSquareCorner, {0.0}), std::invalid_argument);
  EXPECT_THROW(BlendedPath(kSquareCorner, {0.0, -1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(BlendedPath({{Vector2d(0, nan), Vector2d(1, 1)}}, {0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace handway::planning
