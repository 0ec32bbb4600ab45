#include "scratch_files.h"

#include <handway/geometric/io/resources.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace handway::geometric {
namespace {

using test::input_error_of;
using test::ScratchFiles;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A library of one robot, two objects and a basis, and $HANDWAY_RESOURCE_DIR on it.
class Resources : public testing::Test {
 protected:
  Resources() {
    files_.write("library/robots/arm/arm.urdf", "<robot/>");
    files_.write("library/objects/can.stl", "x");
    files_.write("library/objects/box.obj", "x");
    files_.write("library/bases/sah.yaml", "x");
    files_.write("work/own.urdf", "<robot/>");
    ::setenv("HANDWAY_RESOURCE_DIR", library().c_str(), 1);
  }
  ~Resources() override { ::unsetenv("HANDWAY_RESOURCE_DIR"); }

  [[nodiscard]] std::filesystem::path library() const { return files_.folder() / "library"; }
  [[nodiscard]] std::filesystem::path work() const { return files_.folder() / "work"; }

  ScratchFiles files_;
};

TEST_F(Resources, AreFoundByName) {
  EXPECT_EQ(resource_dir(), library());
  EXPECT_EQ(find_resource(ResourceKind::kRobot, "arm", work()), library() / "robots/arm/arm.urdf");
  EXPECT_EQ(find_resource(ResourceKind::kObject, "can.stl", work()), library() / "objects/can.stl");
  EXPECT_EQ(find_resource(ResourceKind::kObject, "box", work()), library() / "objects/box.obj");
  EXPECT_EQ(find_resource(ResourceKind::kHandBasis, "sah", work()), library() / "bases/sah.yaml");
}

TEST_F(Resources, ComeAfterFilesBesideTheScene) {
  const auto own = files_.write("work/can.stl", "y");
  EXPECT_EQ(find_resource(ResourceKind::kObject, "can.stl", work()), own);
  EXPECT_EQ(find_resource(ResourceKind::kRobot, "own.urdf", work()), work() / "own.urdf");
}

TEST_F(Resources, AreListed) {
  EXPECT_THAT(resource_names(ResourceKind::kRobot), ElementsAre("arm"));
  EXPECT_THAT(resource_names(ResourceKind::kObject), ElementsAre("box", "can"));
  EXPECT_THAT(resource_names(ResourceKind::kHandBasis), ElementsAre("sah"));
}

TEST_F(Resources, AreNamedAsShortAsTheyAreFound) {
  const auto reference = [&](ResourceKind kind, const std::filesystem::path& file) {
    return resource_reference(kind, file, work());
  };
  EXPECT_EQ(reference(ResourceKind::kRobot, library() / "robots/arm/arm.urdf"), "arm");
  EXPECT_EQ(reference(ResourceKind::kObject, library() / "objects/can.stl"), "can.stl");
  EXPECT_EQ(reference(ResourceKind::kHandBasis, library() / "bases/sah.yaml"), "sah");
  EXPECT_EQ(reference(ResourceKind::kRobot, work() / "own.urdf"), "own.urdf");
  EXPECT_EQ(reference(ResourceKind::kObject, "/proc/version"), "/proc/version");
}

TEST_F(Resources, AreNamedByPathWhereAFileBesideTheSceneHasTheName) {
  files_.write("work/can.stl", "y");
  EXPECT_EQ(resource_reference(ResourceKind::kObject, library() / "objects/can.stl", work()),
            "../library/objects/can.stl");
}

TEST_F(Resources, ThatDoNotExistAreRefusedWithThePlacesLookedAt) {
  EXPECT_THAT(input_error_of([&] {
                static_cast<void>(find_resource(ResourceKind::kRobot, "arn", work(), "s.yaml:3"));
              }),
              AllOf(HasSubstr("s.yaml:3"), HasSubstr((work() / "arn").string()),
                    HasSubstr("robots/arn/arn.urdf"), HasSubstr("Did you mean \"arm\"?")));
}

TEST_F(Resources, NeedAFolderThatIsALibrary) {
  ::setenv("HANDWAY_RESOURCE_DIR", work().c_str(), 1);
  EXPECT_THAT(input_error_of([] { static_cast<void>(resource_dir()); }),
              HasSubstr("HANDWAY_RESOURCE_DIR"));
}

}  // namespace
}  // namespace handway::geometric
