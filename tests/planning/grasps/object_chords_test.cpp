#include "grasps/object_chords.h"

#include "handway/geometric/mesh/shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace handway::planning {
namespace {

using Eigen::Vector3d;

geometric::TriangleMesh box(const Vector3d& size) {
  return *geometric::tessellate(geometric::Box{size});
}

TEST(ObjectChords, GoThroughABoxFromSideToSide) {
  const ObjectChords chords(box({0.04, 0.06, 0.2}));
  sampling::RandomStream random(3);
  for (int i = 0; i < 200; ++i) {
    const Chord chord = chords.draw(random);
    Eigen::Index axis = 0;
    ASSERT_NEAR(chord.direction.cwiseAbs().maxCoeff(&axis), 1.0, 1e-9);
    EXPECT_NEAR(chord.length, Vector3d(0.04, 0.06, 0.2)[axis], 1e-9);
    EXPECT_NEAR(chord.centre[axis], 0.0, 1e-9);
  }
}

// A T, whose box is wide: fingers close around its stem or its bar, not around the box's middle.
TEST(ObjectChords, HoldALeverByItsStem) {
  geometric::TriangleMesh lever = box({0.03, 0.03, 0.2});
  const geometric::TriangleMesh bar = geometric::transformed(
      box({0.2, 0.03, 0.03}), geometric::Pose(Eigen::Translation3d(0.0, 0.0, 0.115)));
  const auto first = static_cast<std::uint32_t>(lever.vertices.size());
  lever.vertices.insert(lever.vertices.end(), bar.vertices.begin(), bar.vertices.end());
  for (auto triangle : bar.triangles) {
    for (auto& vertex : triangle) {
      vertex += first;
    }
    lever.triangles.push_back(triangle);
  }
  const ObjectChords chords(lever);
  sampling::RandomStream random(3);
  int through_stem = 0;
  for (int i = 0; i < 500; ++i) {
    const Chord chord = chords.draw(random);
    through_stem += std::abs(chord.direction.x()) > 0.99 && std::abs(chord.length - 0.03) < 1e-3 &&
                            std::abs(chord.centre.x()) < 1e-3 && chord.centre.z() < 0.1
                        ? 1
                        : 0;
  }
  EXPECT_GT(through_stem, 50);
  const geometric::Aabb core = chords.core({0.0, 0.0, -0.03}, 0.04);
  EXPECT_LT(core.size().x(), 1e-3);
  EXPECT_LT(core.size().y(), 1e-3);
  EXPECT_NEAR(core.centre().z(), -0.03, 0.01);
}

TEST(ObjectChords, AreNoneOfASheet) {
  geometric::TriangleMesh sheet;
  sheet.vertices = {{0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.0, 0.1, 0.0}};
  sheet.triangles = {{0, 1, 2}};
  sampling::RandomStream random(3);
  EXPECT_EQ(ObjectChords(sheet).draw(random).length, 0.0);
}

}  // namespace
}  // namespace handway::planning
