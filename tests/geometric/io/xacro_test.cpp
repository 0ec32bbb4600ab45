#include "scratch_files.h"

#include <handway/geometric/formats/robot_loader.h>
#include <handway/geometric/formats/scene_file.h>
#include <handway/geometric/formats/xacro_file.h>
#include <handway/geometric/io/package_path.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <handway_test/fake_xacro.h>

#include <cstdlib>

namespace handway::geometric {
namespace {

using test::FakeXacro;
using test::input_error_of;
using test::kXacroBox;
using test::ScratchFiles;
using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::Optional;

std::string xacro(const std::string& body) {
  return "<robot xmlns:xacro=\"http://ros.org/wiki/xacro\">\n" + body + "</robot>\n";
}

double size_of(const RobotModel& model) {
  return std::get<Box>(model.link(0).collision.front().shape).size.x();
}

class Xacro : public testing::Test {
 protected:
  ~Xacro() override { ::unsetenv("HANDWAY_XACRO"); }

  [[nodiscard]] std::string refusal(const std::filesystem::path& file,
                                    const XacroArguments& arguments = {}) const {
    return input_error_of([&] { static_cast<void>(load_robot(file, arguments)); });
  }

  ScratchFiles files_;
  FakeXacro program_;
};

TEST_F(Xacro, ArgumentsAreReadWithThoseOfIncludedFiles) {
  files_.write("arms/urdf/parts/limits.xacro",
               xacro("<xacro:arg name=\"limits\" default=\"$(find arms)/limits.yaml\"/>"));
  files_.write("arms/urdf/hand.xacro",
               xacro("<xacro:arg name=\"side\"/><xacro:arg name=\"prefix\" default=\"late\"/>"));
  files_.write("hands/urdf/palm.xacro", xacro("<xacro:arg name=\"palm\" default=\"\"/>"));
  const XacroFile read = read_xacro_file(files_.write(
      "arms/urdf/arm.xacro", xacro("<!-- $(arg not_this) -->\n"
                                   "<xacro:arg name=\"prefix\" default=\"a_\"/>\n"
                                   "<xacro:arg name=\"which\" default=\"hand\"/>\n"
                                   "<xacro:include filename=\"parts/limits.xacro\"/>\n"
                                   "<xacro:include filename=\"$(arg which).xacro\"/>\n"
                                   "<xacro:include filename=\"$(find hands)/urdf/palm.xacro\"/>\n"
                                   "<link name=\"$(arg used)\"/>\n"
                                   "<xacro:if value=\"${xacro.arg('called')}\"/>")));
  const auto has = [](const std::string& name, const std::optional<std::string>& value) {
    return AllOf(Field(&XacroArgument::name, name), Field(&XacroArgument::default_text, value));
  };
  EXPECT_THAT(read.arguments,
              ElementsAre(has("prefix", "a_"), has("which", "hand"),
                          has("limits", "$(find arms)/limits.yaml"), has("side", std::nullopt),
                          has("palm", ""), has("used", std::nullopt), has("called", std::nullopt)));
  EXPECT_THAT(read.packages, ElementsAre("arms", "hands"));
  EXPECT_THAT(read.unread, IsEmpty());
}

TEST_F(Xacro, IncludesThatDependOnGivenArgumentsAreFollowed) {
  files_.write("left.xacro", xacro("<xacro:arg name=\"only_left\" default=\"1\"/>"));
  const auto file = files_.write("r.xacro", xacro("<xacro:arg name=\"side\"/>"
                                                  "<xacro:include filename=\"$(arg side).xacro\"/>"
                                                  "<xacro:include filename=\"${side}_more.xacro\"/>"
                                                  "<xacro:include filename=\"r.xacro\"/>"));
  EXPECT_THAT(read_xacro_file(file).unread, ElementsAre("$(arg side).xacro", "${side}_more.xacro"));
  const XacroFile left = read_xacro_file(file, {{"side", "left"}});
  ASSERT_EQ(left.arguments.size(), 2U);
  EXPECT_EQ(left.arguments[1].name, "only_left");
  EXPECT_THAT(left.unread, ElementsAre("${side}_more.xacro"));
}

TEST_F(Xacro, ArgumentsArePassedToTheProgram) {
  const auto file = files_.write("r.xacro", kXacroBox);
  const auto plain = load_robot(file);
  EXPECT_EQ(plain->name(), "left_box");
  EXPECT_DOUBLE_EQ(size_of(*plain), 0.1);
  EXPECT_THAT(plain->description().xacro_arguments, IsEmpty());
  const auto other = load_robot(file, {{"size", "0.25"}});
  EXPECT_EQ(other->name(), "left_box");
  EXPECT_DOUBLE_EQ(size_of(*other), 0.25);
  EXPECT_EQ(other->description().xacro_arguments, (XacroArguments{{"size", "0.25"}}));
}

TEST_F(Xacro, ArgumentsOfTheEnvironmentComeFirst) {
  const auto file = files_.write("r.xacro", kXacroBox);
  ::setenv("HANDWAY_XACRO", "size:=0.3\nprefix:=my ", 1);
  const auto model = load_robot(file, {{"size", "0.25"}});
  EXPECT_DOUBLE_EQ(size_of(*model), 0.3);
  EXPECT_EQ(model->name(), "my box");
  ::setenv("HANDWAY_XACRO", "size=0.3", 1);
  EXPECT_EQ(
      refusal(file),
      "--xacro: found \"size=0.3\", expected an argument of a xacro file, NAME:=VALUE. Put it "
      "in quotes if the value has blanks.");
}

TEST_F(Xacro, UnknownArgumentsAreNamed) {
  const auto file = files_.write("r.xacro", kXacroBox);
  EXPECT_EQ(refusal(file, {{"prefx", "x"}}),
            file.string() +
                ": xacro argument \"prefx\": found no declaration of it in the file, expected an "
                "argument of the file. Did you mean \"prefix\"?");
  EXPECT_THAT(refusal(files_.write("none.xacro", xacro("")), {{"prefix", "x"}}),
              HasSubstr("it declares none"));
  EXPECT_THAT(refusal(files_.write("r.urdf", "<robot name=\"r\"/>"), {{"prefix", "x"}}),
              AllOf(HasSubstr("\"prefix\""), HasSubstr("*.xacro")));
  // It may be declared in a file that only the program finds.
  const auto open = files_.write(
      "open.xacro", xacro("<!-- <xacro:include filename=\"x\"/> -->"
                          "<xacro:include filename=\"${nowhere}\"/><link name=\"a\"/>"));
  EXPECT_THAT(refusal(open, {{"prefix", "x"}}), Not(HasSubstr("declar")));
}

TEST_F(Xacro, MissingArgumentsAndPackagesAreNamed) {
  EXPECT_THAT(refusal(files_.write("r.xacro", xacro("<xacro:arg name=\"ip\"/>\n"
                                                    "<link name=\"$(arg ip)\"/>"))),
              AllOf(HasSubstr("Undefined substitution argument"),
                    HasSubstr("without a default (ip)"), HasSubstr("--xacro NAME:=VALUE")));
  EXPECT_THAT(
      refusal(files_.write("p.xacro", xacro("<link name=\"$(find lost_description)\"/>"))),
      AllOf(HasSubstr("not near the file (lost_description)"), HasSubstr("--package-path")));
}

TEST_F(Xacro, PackagesNearTheFileAreFound) {
  files_.write("work/hand_description/meshes/s.obj", test::kSquareObj);
  files_.write("work/arm-main/package.xml",
               "<?xml version=\"1.0\"?>\n<package><name> arm_description </name></package>");
  const auto mesh = files_.write("work/arm-main/meshes/s.obj", test::kSquareObj);
  const auto link = [](const std::string& name, const std::string& package) {
    return "<link name=\"" + name + "\"><collision><geometry><mesh filename=\"file://$(find " +
           package + ")/meshes/s.obj\"/></geometry></collision></link>\n";
  };
  const auto file = files_.write("work/arm-main/urdf/arm.xacro",
                                 "<robot name=\"r\">" + link("a", "arm_description") +
                                     link("b", "hand_description") +
                                     "<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/>"
                                     "<child link=\"b\"/></joint></robot>");
  EXPECT_THAT(find_package("arm_description", file.parent_path()),
              Optional(files_.folder() / "work/arm-main"));
  const auto model = load_robot(file);
  EXPECT_EQ(std::get<Mesh>(model->link(0).collision.front().shape).file, mesh)
      << "not in the folder that the program was given";
  EXPECT_EQ(std::get<Mesh>(model->link(1).collision.front().shape).file,
            files_.folder() / "work/hand_description/meshes/s.obj");
}

TEST_F(Xacro, ScenesKeepArguments) {
  files_.write("r.xacro", kXacroBox);
  const auto file = files_.write("scene.yaml",
                                 "handway: 1\nrobots:\n"
                                 "  - name: a\n    model: r.xacro\n"
                                 "    xacro: {size: 0.250, prefix: \"1e3: \"}\n"
                                 "  - name: b\n    model: r.xacro\n");
  const Scene scene = read_scene(file);
  ASSERT_EQ(scene.robots.size(), 2U);
  EXPECT_DOUBLE_EQ(size_of(*scene.robots[0].model), 0.25);
  EXPECT_EQ(scene.robots[0].model->name(), "1e3: box");
  EXPECT_EQ(scene.robots[1].model->name(), "left_box");
  const auto copy = files_.folder() / "copy.yaml";
  write_scene(scene, copy);
  const Scene again = read_scene(copy);
  EXPECT_EQ(again.robots[0].model->description().xacro_arguments,
            (XacroArguments{{"prefix", "1e3: "}, {"size", "0.250"}}));
  EXPECT_EQ(again.robots[0].model->name(), "1e3: box");
  EXPECT_THAT(again.robots[1].model->description().xacro_arguments, IsEmpty());
}

TEST_F(Xacro, MountedRobotsKeepArguments) {
  files_.write("r.xacro", kXacroBox);
  const auto file = files_.write("scene.yaml",
                                 "handway: 1\nrobots:\n"
                                 "  - {name: a, model: r.xacro}\n"
                                 "  - name: b\n    model: r.xacro\n    xacro: {prefix: right_}\n"
                                 "    mount: {robot: a, link: left_base}\n");
  const auto copy = files_.folder() / "copy.yaml";
  write_scene(read_scene(file), copy);
  const Scene again = read_scene(copy);
  ASSERT_EQ(again.robots.size(), 1U);
  EXPECT_TRUE(again.robots[0].model->find_link("right_base"));
}

TEST_F(Xacro, ScenesNameArgumentsThatAreNoText) {
  files_.write("r.xacro", kXacroBox);
  const auto file = files_.write(
      "scene.yaml", "handway: 1\nrobots:\n  - model: r.xacro\n    xacro: {size: [1, 2]}\n");
  EXPECT_THAT(input_error_of([&] { static_cast<void>(read_scene(file)); }),
              AllOf(HasSubstr("scene.yaml:4"), HasSubstr("xacro.size")));
}

TEST(XacroArgument, IsANameAndAValue) {
  using Pair = std::pair<std::string, std::string>;
  EXPECT_EQ(xacro_argument_of("a:=b", "--xacro"), (Pair{"a", "b"}));
  EXPECT_EQ(xacro_argument_of("a:=b:=c d", "--xacro"), (Pair{"a", "b:=c d"}));
  EXPECT_EQ(xacro_argument_of("a:=", "--xacro"), (Pair{"a", ""}));
  for (const char* text : {"", "a", "a=b", ":=b", "-o:=b", "a b:=c"}) {
    EXPECT_THROW(static_cast<void>(xacro_argument_of(text, "--xacro")), InputError) << text;
  }
}

}  // namespace
}  // namespace handway::geometric
