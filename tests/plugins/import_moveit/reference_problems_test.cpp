/// Tests published problems with variations of their folders: they load, with a summary.
#include "handway/geometric/io/input_error.h"
#include "handway_test/paths.h"
#include "moveit_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace handway::import_moveit {
namespace {

namespace fs = std::filesystem;

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

std::string read_text(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_text(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

// The text with something added to the list that this key of the joint state has.
std::string with_addition(std::string text, const std::string& key, const std::string& addition) {
  const std::size_t state = text.find("\n  joint_state:");
  const std::size_t begin = text.find(" " + key + ": [", state);
  return text.insert(text.find(']', begin), addition);
}

/// A copy of the published folder of the Panda.
class ReferencePanda : public testing::Test {
 protected:
  void SetUp() override {
    HANDWAY_NEED_REFERENCE(reference);
    test::copy_folder(reference / "moveit/panda", panda_);
  }

  // Returns every tenth problem of each kind: its scene and its request.
  [[nodiscard]] std::vector<fs::path> scenes() const {
    std::vector<fs::path> all;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(panda_ / "problems")) {
      if (entry.path().filename().string().starts_with("scene") &&
          entry.path().stem().string().ends_with("1")) {
        all.push_back(entry.path());
      }
    }
    return all;
  }
  [[nodiscard]] static fs::path request_of(const fs::path& scene) {
    return scene.parent_path() / ("request" + scene.filename().string().substr(5));
  }

  test::ScratchFolder scratch_;
  fs::path panda_ = scratch_.path() / "panda";
};

TEST_F(ReferencePanda, LoadsWithLinesOfTheSrdfAboutUnknownLinks) {
  const std::string srdf = read_text(panda_ / "panda.srdf");
  write_text(panda_ / "panda.srdf",
             srdf.substr(0, srdf.rfind("</robot>")) +
                 "<disable_collisions link1=\"panda_link0\" link2=\"gripper\" reason=\"Never\"/>"
                 "<group name=\"rails\"><joint name=\"rail\"/></group>"
                 "<group name=\"chain\"><chain base_link=\"mast\" tip_link=\"boom\"/></group>"
                 "</robot>");
  ASSERT_FALSE(scenes().empty());
  for (const fs::path& file : scenes()) {
    const planning::SceneState loaded = MoveitImporter().read(file);
    EXPECT_THAT(loaded.scene->warnings,
                Contains(AllOf(HasSubstr("4 lines of the SRDF"), HasSubstr("mast"))).Times(1));
  }
}

TEST_F(ReferencePanda, LoadsWithJointsInItsStateThatTheRobotHasNot) {
  for (const fs::path& scene : scenes()) {
    for (const fs::path& file : {scene, request_of(scene)}) {
      const std::string joints = with_addition(read_text(file), "name", ", wheel");
      write_text(file, with_addition(joints, "position", ", 0.5"));
    }
    const planning::SceneState loaded = MoveitImporter().read(scene);
    EXPECT_THAT(loaded.scene->warnings, Contains(HasSubstr("wheel"))) << scene;
    EXPECT_TRUE(loaded.scene->start);
  }
}

TEST_F(ReferencePanda, FindsItsFilesInOtherLetters) {
  for (const fs::directory_entry& entry : fs::directory_iterator(panda_ / "meshes/collision")) {
    std::string name = entry.path().filename().string();
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
    fs::rename(entry.path(), entry.path().parent_path() / name);
  }
  fs::rename(panda_ / "panda.srdf", panda_ / "Panda.SRDF");
  const fs::path scene = scenes().front();
  fs::rename(scene, fs::path(scene).replace_extension(".YAML"));
  const MoveitImporter importer;
  ASSERT_TRUE(importer.can_read(fs::path(scene).replace_extension(".YAML")));
  const planning::SceneState loaded = importer.read(request_of(scene));
  EXPECT_THAT(loaded.scene->warnings, Contains(HasSubstr("other letters")).Times(1));
}

TEST_F(ReferencePanda, IsRefusedWithoutAMeshThatCollides) {
  fs::remove(panda_ / "meshes/collision/finger.obj");
  try {
    static_cast<void>(MoveitImporter().read(scenes().front()));
    ADD_FAILURE() << "read";
  } catch (const geometric::InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("panda.urdf:"), HasSubstr("finger.obj")));
  }
}

}  // namespace
}  // namespace handway::import_moveit
