#include "handway/geometric/collision/volumes/preparation.h"

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway_test/paths.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

std::shared_ptr<const CollisionWorld> world_with(const Shape& shape) {
  Scene scene = test::scene_of(test::gantry(Box{{0.1, 0.1, 0.1}}));
  test::add_object(scene, "thing", shape, Eigen::Vector3d(-0.5, -0.5, 0.5));
  return std::make_shared<const CollisionWorld>(scene);
}

// Open, with 1250 triangles.
Mesh plate(double size) {
  constexpr std::uint32_t kCells = 25;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i <= kCells; ++i) {
    for (std::uint32_t k = 0; k <= kCells; ++k) {
      mesh.vertices.emplace_back(size * i / kCells, size * k / kCells, 0.0);
    }
  }
  for (std::uint32_t i = 0; i < kCells; ++i) {
    for (std::uint32_t k = 0; k < kCells; ++k) {
      const std::uint32_t at = i * (kCells + 1) + k;
      mesh.triangles.push_back({at, at + kCells + 1, at + 1});
      mesh.triangles.push_back({at + 1, at + kCells + 1, at + kCells + 2});
    }
  }
  return {"", Eigen::Vector3d::Ones(), std::make_shared<const TriangleMesh>(std::move(mesh))};
}

class CheckerPreparation : public testing::Test {
 protected:
  CheckerPreparation() { setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1); }
  ~CheckerPreparation() override {
    if (before_.empty()) {
      unsetenv("XDG_CACHE_HOME");
    } else {
      setenv("XDG_CACHE_HOME", before_.c_str(), 1);
    }
  }

  [[nodiscard]] int entries() const {
    std::error_code none;
    return static_cast<int>(
        std::distance(fs::directory_iterator(folder_.path() / "handway" / "meshes", none), {}));
  }

  handway::test::ScratchFolder folder_;
  std::string before_ = std::getenv("XDG_CACHE_HOME") ? std::getenv("XDG_CACHE_HOME") : "";
};

TEST_F(CheckerPreparation, EndsWhenItIsAskedTo) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(ExactCollisionChecker(world_with(plate(0.11)), {stop.get_token(), true}),
               PreparationStopped);
  EXPECT_EQ(entries(), 0);
}

TEST_F(CheckerPreparation, KeepsWhatIsOpened) {
  { const ExactCollisionChecker opened(world_with(plate(0.12))); }
  EXPECT_EQ(entries(), 1) << "the plate";
}

TEST_F(CheckerPreparation, KeepsNothingOfPrimitives) {
  for (const Shape& shape : {Shape(Box{{0.1, 0.2, 0.3}}), Shape(Sphere{0.1}),
                             Shape(Cylinder{0.1, 0.2}), Shape(Cone{0.1, 0.2})}) {
    ExactCollisionChecker opened(world_with(shape));
    opened.place(Eigen::Vector3d(0, 0, 0));
    EXPECT_GT(opened.pair_distance(0, 10.0), 0.0);
  }
  EXPECT_EQ(entries(), 0);
}

TEST_F(CheckerPreparation, LeavesNothingBehindOfWhatIsEdited) {
  for (int i = 1; i <= 3; ++i) {
    const double size = 0.1 * i;
    for (const Shape& shape : {Shape(plate(size)), Shape(Box{{size, size, 0.1}}),
                               Shape(Cylinder{size, 0.2}), Shape(Cone{size, 0.2})}) {
      const ExactCollisionChecker edited(world_with(shape), {{}, false});
    }
  }
  EXPECT_EQ(entries(), 0);
}

TEST_F(CheckerPreparation, DoesNotTrustTheEntryOfAnotherMesh) {
  const auto distance_of_large = [] {
    ExactCollisionChecker checker(world_with(plate(0.6)));
    checker.place(Eigen::Vector3d(0, 0, 0));
    return checker.pair_distance(0, 10.0);
  };
  const double distance = distance_of_large();
  { const ExactCollisionChecker other(world_with(plate(0.05))); }
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(folder_.path() / "handway" / "meshes")) {
    files.push_back(entry.path());
  }
  ASSERT_EQ(files.size(), 2U);
  for (std::size_t i = 0; i < files.size(); ++i) {  // each under the name of the one before
    fs::rename(files[i], folder_.path() / std::to_string(i));
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    fs::rename(folder_.path() / std::to_string((i + 1) % files.size()), files[i]);
  }
  EXPECT_DOUBLE_EQ(distance_of_large(), distance);
}

}  // namespace
}  // namespace handway::geometric
