#include "collision/volumes/triangle_tree.h"

#include <gtest/gtest.h>

namespace handway::geometric {
namespace {

const TriangleCorners kFlat{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0),
                            Eigen::Vector3d(0, 1, 0)};

TriangleCorners upright(double x, double y, double lowest) {
  return {Eigen::Vector3d(x, y, lowest), Eigen::Vector3d(x, y, lowest + 1),
          Eigen::Vector3d(x, y + 0.1, lowest + 1)};
}

TEST(TriangleContact, IsSureOfAnEdgeThroughAFace) {
  EXPECT_TRUE(surely_cross(kFlat, upright(0.2, 0.2, -0.5)));
  EXPECT_TRUE(surely_cross(upright(0.2, 0.2, -0.5), kFlat));
  EXPECT_TRUE(surely_cross(kFlat, upright(0.2, 0.2, -1e-6)));
}

TEST(TriangleContact, IsNotSureOfATouch) {
  EXPECT_FALSE(surely_cross(kFlat, upright(0.2, 0.2, 0.0)));
  EXPECT_FALSE(surely_cross(kFlat, upright(0.0, 0.2, -0.5)));  // at a border
  EXPECT_FALSE(surely_cross(kFlat, kFlat));
}

TEST(TriangleContact, IsNotSureOfWhatIsApart) {
  EXPECT_FALSE(surely_cross(kFlat, upright(0.2, 0.2, 0.1)));
  EXPECT_FALSE(surely_cross(kFlat, upright(0.8, 0.8, -0.5)));
}

TEST(TriangleContact, APlaneKeepsApartWhatIsBeyondTheTolerance) {
  EXPECT_TRUE(TrianglePlane(kFlat).is_beside(upright(0.2, 0.2, 0.1), 0.09));
  EXPECT_FALSE(TrianglePlane(kFlat).is_beside(upright(0.2, 0.2, 0.1), 0.11));
  EXPECT_FALSE(TrianglePlane(kFlat).is_beside(upright(0.2, 0.2, -0.5), 0.0));
}

TEST(TriangleContact, TrianglesWithoutAreaDecideNothing) {
  const TriangleCorners point{Eigen::Vector3d(0.2, 0.2, 0), Eigen::Vector3d(0.2, 0.2, 0),
                              Eigen::Vector3d(0.2, 0.2, 0)};
  EXPECT_FALSE(surely_cross(kFlat, point));
  EXPECT_FALSE(TrianglePlane(point).is_beside(point, 0.0));
}

}  // namespace
}  // namespace handway::geometric
