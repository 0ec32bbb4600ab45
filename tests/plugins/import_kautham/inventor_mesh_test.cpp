#include "handway/geometric/io/input_error.h"
#include "inventor_meshes.h"
#include "small_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::import_kautham {
namespace {

using geometric::InputError;
using test::SmallProblem;
using test::write_text;
using testing::HasSubstr;

std::string complaint(const std::filesystem::path& file) {
  try {
    static_cast<void>(read_inventor_mesh(file, 1.0));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(InventorMesh, ScalesMillimetresToMetres) {
  const SmallProblem files;
  const InventorMesh mesh = read_inventor_mesh(files.cube(), 5.0);
  EXPECT_EQ(mesh.triangles->triangles.size(), 12U);
  EXPECT_EQ(mesh.triangles->vertices.size(), 8U);
  EXPECT_LT(
      (geometric::bounding_box(*mesh.triangles).size() - Eigen::Vector3d::Constant(0.1)).norm(),
      1e-7);
  EXPECT_FLOAT_EQ(mesh.color.red, 1.0F);
  EXPECT_FLOAT_EQ(mesh.color.blue, 0.25F);
}

TEST(InventorMesh, FollowsFilesFromTheirOwnFolder) {
  const SmallProblem files;
  const auto outer = files.folder() / "robots" / "outer.iv";
  write_text(outer,
             "#Inventor V2.1 ascii\nSeparator { Translation { translation 1000 0 0 } "
             "File { name \"cube.iv\" } }\n");
  const InventorMesh mesh = read_inventor_mesh(outer, 1.0);
  EXPECT_NEAR(geometric::bounding_box(*mesh.triangles).centre().x(), 1.0, 1e-6);
}

TEST(InventorMesh, NamesTheLineOfABrokenFile) {
  const SmallProblem files;
  SmallProblem::edit(files.cube(), "width 20", "width twenty");
  testing::internal::CaptureStderr();
  const std::string message = complaint(files.cube());
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(message, HasSubstr("cube.iv:4: found Couldn't read value for field \"width\""));
}

TEST(InventorMesh, RefusesAnIncludedFileThatIsMissing) {
  const SmallProblem files;
  SmallProblem::edit(files.cube(), "Cube { width 20 height 20 depth 20 }",
                     "Cube {} File { name \"nowhere.iv\" }");
  testing::internal::CaptureStderr();
  EXPECT_THAT(complaint(files.cube()), HasSubstr("nowhere.iv"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(InventorMesh, RefusesWhatIsNoInventorFile) {
  const SmallProblem files;
  write_text(files.cube(), "solid cube\nendsolid\n");
  EXPECT_THAT(complaint(files.cube()), HasSubstr("expected an Open Inventor or VRML file"));
  write_text(files.cube(), "");
  EXPECT_THAT(complaint(files.cube()), HasSubstr("found an empty file"));
  EXPECT_THAT(complaint(files.folder() / "absent.iv"), HasSubstr("no such file"));
}

TEST(InventorMesh, RefusesFilesWithoutTriangles) {
  const SmallProblem files;
  write_text(files.cube(), "#Inventor V2.1 ascii\nSeparator { }\n");
  EXPECT_THAT(complaint(files.cube()), HasSubstr("no triangles"));
}

}  // namespace
}  // namespace handway::import_kautham
