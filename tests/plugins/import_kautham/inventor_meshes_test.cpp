/// Meshes that were read before, in this run or in one before it.
#include "inventor_meshes.h"

#include "handway/geometric/io/input_error.h"
#include "small_problem.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace handway::import_kautham {
namespace {

using test::SmallProblem;
using test::write_text;

class InventorMeshesTest : public testing::Test {
 protected:
  // Begins with an empty cache.
  void SetUp() override { setenv("XDG_CACHE_HOME", (files_.folder() / "cache").c_str(), 1); }
  void TearDown() override {
    before_.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", before_.c_str(), 1);
  }

  [[nodiscard]] std::size_t files_in_cache() const {
    const std::filesystem::path folder = files_.folder() / "cache" / "handway" / "meshes";
    return std::filesystem::exists(folder) ? static_cast<std::size_t>(std::distance(
                                                 std::filesystem::directory_iterator(folder), {}))
                                           : 0;
  }

  SmallProblem files_;

 private:
  std::string before_ = std::getenv("XDG_CACHE_HOME") ? std::getenv("XDG_CACHE_HOME") : "";
};

TEST_F(InventorMeshesTest, ReadEachFileOnce) {
  InventorMeshes meshes;
  const auto first = meshes.load(files_.cube(), 1.0).triangles;
  EXPECT_EQ(meshes.load(files_.folder() / "robots/../robots/cube.iv", 1.0).triangles, first);
  EXPECT_NE(meshes.load(files_.cube(), 2.0).triangles, first);
}

TEST_F(InventorMeshesTest, GiveInLaterRunsWhatWasRead) {
  const InventorMesh read = read_inventor_mesh(files_.cube(), 5.0);
  for (int run = 0; run < 2; ++run) {
    InventorMeshes meshes;
    const InventorMesh& mesh = meshes.load(files_.cube(), 5.0);
    EXPECT_EQ(mesh.triangles->vertices, read.triangles->vertices);
    EXPECT_EQ(mesh.triangles->triangles, read.triangles->triangles);
    EXPECT_EQ(mesh.color, read.color);
    EXPECT_EQ(files_in_cache(), 1U);
  }
}

TEST_F(InventorMeshesTest, AreReadAnewWhenTheFileHasChanged) {
  const auto size = [&] {
    InventorMeshes meshes;
    return geometric::bounding_box(*meshes.load(files_.cube(), 1.0).triangles).size().x();
  };
  EXPECT_NEAR(size(), 0.02, 1e-7);
  SmallProblem::edit(files_.cube(), "width 20", "width 30");
  EXPECT_NEAR(size(), 0.03, 1e-7);
}

TEST_F(InventorMeshesTest, AreNotKeptIfOtherFilesBelongToThem) {
  const auto outer = files_.folder() / "robots" / "outer.iv";
  write_text(outer, "#Inventor V2.1 ascii\nFile { name \"cube.iv\" }\n");
  InventorMeshes meshes;
  static_cast<void>(meshes.load(outer, 1.0));
  EXPECT_EQ(files_in_cache(), 0U);
}

TEST_F(InventorMeshesTest, AreRefusedEachTimeIfTheFileIsBroken) {
  SmallProblem::edit(files_.cube(), "width 20", "width twenty");
  InventorMeshes meshes;
  EXPECT_THROW(static_cast<void>(meshes.load(files_.cube(), 1.0)), geometric::InputError);
  EXPECT_THROW(static_cast<void>(meshes.load(files_.cube(), 1.0)), geometric::InputError);
  EXPECT_EQ(files_in_cache(), 0U);
}

}  // namespace
}  // namespace handway::import_kautham
