/// The option `--xacro`: arguments of the robot files that a command reads.
#include "command_line.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway_test/fake_xacro.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace handway::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class XacroOption : public testing::Test {
 protected:
  XacroOption() { line_.write("box.xacro", kXacroBox); }

  CommandLine line_;
  FakeXacro program_;
};

TEST_F(XacroOption, GivesARobotFileItsArguments) {
  const Outcome plain = line_.run("info box.xacro");
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_THAT(plain.out, HasSubstr("left_box"));
  const Outcome other = line_.run("info box.xacro --xacro prefix:=right_ --xacro size:=0.2");
  EXPECT_EQ(other.exit_code, 0) << other.err;
  EXPECT_THAT(other.out, HasSubstr("right_box"));
}

TEST_F(XacroOption, ReplacesTheArgumentsOfAScene) {
  line_.write("scene.yaml",
              "handway: 1\nrobots:\n  - model: box.xacro\n"
              "    xacro: {prefix: a_, size: 0.3}\n");
  const Outcome run =
      line_.run("edit frame scene.yaml spot --xyz 0 0 1 --out edited.yaml --xacro prefix:=b_");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const geometric::Scene scene = geometric::read_scene(line_.folder() / "edited.yaml");
  EXPECT_EQ(scene.robots.front().model->name(), "b_box");
  EXPECT_EQ(scene.robots.front().model->description().xacro_arguments.at("size"), "0.3");
}

TEST_F(XacroOption, NamesWhatNoFileTakes) {
  const Outcome unknown = line_.run("info box.xacro --xacro sise:=0.2");
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.err, AllOf(HasSubstr("\"sise\""), HasSubstr("Did you mean \"size\"?")));
  const Outcome scene = line_.run("info open.yaml --xacro size:=0.2");
  EXPECT_EQ(scene.exit_code, 3);
  EXPECT_THAT(scene.err, AllOf(HasSubstr("\"size\""), HasSubstr("no xacro file that takes it")));
  const Outcome form = line_.run("info box.xacro --xacro size=0.2");
  EXPECT_EQ(form.exit_code, 3);
  EXPECT_THAT(form.err, HasSubstr("NAME:=VALUE"));
}

}  // namespace
}  // namespace handway::test
