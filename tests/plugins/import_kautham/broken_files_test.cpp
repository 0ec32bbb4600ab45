#include "handway/geometric/io/input_error.h"
#include "handway_test/input_errors.h"
#include "kautham_importer.h"
#include "small_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace handway::import_kautham {
namespace {

using test::SmallProblem;
using testing::HasSubstr;

// One thing to break in the small problem, and what must be said about it.
struct Break {
  std::string name;
  bool in_robot;
  std::string from;
  std::string to;
  std::vector<std::string> said;
};

class BrokenFile : public testing::TestWithParam<Break> {};

TEST_P(BrokenFile, IsRefusedWithPlaceFindingAndExpectation) {
  const SmallProblem files;
  const Break& broken = GetParam();
  SmallProblem::edit(broken.in_robot ? files.robot() : files.problem(), broken.from, broken.to);
  try {
    static_cast<void>(KauthamImporter().read(files.problem()));
    FAIL() << "was read";
  } catch (const geometric::InputError& error) {
    for (const std::string& part : broken.said) {
      EXPECT_THAT(error.what(), HasSubstr(part));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kautham, BrokenFile,
    testing::Values(
        Break{"UnclosedElement", false, "</Scene>", "", {"problem.xml:", "well-formed XML"}},
        Break{"OtherRoot", true, "<Robot name=\"Small\"", "<Arm name=\"Small\"", {"small.rob:"}},
        Break{"NoRobot",
              false,
              "<Robot robot=\"robots/small.rob\" scale=\"1.0\">",
              "<X>",
              {"problem.xml:"}},
        Break{"MissingRobotFile",
              false,
              "robots/small.rob",
              "robots/big.rob",
              {"robots/big.rob", "no such file"}},
        Break{"MissingMesh",
              true,
              "ivFile=\"cube.iv\"",
              "ivFile=\"sphere.iv\"",
              {"robots/sphere.iv", "no such file", "correct the name"}},
        Break{"MissingSceneMesh",
              false,
              "robots/cube.iv",
              "robots/box.iv",
              {"robots/box.iv", "no such file"}},
        Break{"NoHomeNumber",
              false,
              "X=\"100\" Y=\"0\"",
              "X=\"100\"",
              {"problem.xml:4", "Robot/Home, attribute Y", "no such attribute"}},
        Break{"ScaleZero",
              false,
              "scale=\"5\"",
              "scale=\"0\"",
              {"problem.xml:6", "Scene, attribute scale", "found 0", "a number above 0"}},
        Break{"ScaleNegative", false, "scale=\"1.0\"", "scale=\"-1\"", {"found -1"}},
        Break{"ScaleNotANumber", false, "scale=\"5\"", "scale=\"nan\"", {"\"nan\"", "finite"}},
        Break{"WrongDimension",
              false,
              "<Init dim=\"5\">",
              "<Init dim=\"6\">",
              {"problem.xml:19", "Init, attribute dim", "found 6", "5"}},
        Break{"TooFewControls",
              false,
              "<Goal dim=\"5\">1 0.25 0 1 0.5",
              "<Goal>1 0.25",
              {"5 controls in <Init> and 2 in <Goal>"}},
        Break{"ControlOutOfRange",
              false,
              "1 0.25 0 1 0.5",
              "1 0.25 0 1.5 0.5",
              {"\"1.5\" as control 4", "from 0 to 1"}},
        Break{"ControlNotANumber",
              false,
              "1 0.25 0 1 0.5",
              "1 0.25 0 nan 0.5",
              {"\"nan\" as control 4"}},
        Break{"RobotWithMoreControls",
              true,
              "<Control name=\"Close\"",
              "<Control name=\"Extra\" eigValue=\"1\"/><Control name=\"Close\"",
              {"problem.xml:18", "5 controls in <Init> and <Goal>", "6, one for each"}},
        Break{"StandardConvention",
              true,
              "DHType=\"Modified\"",
              "DHType=\"Standard\"",
              {"small.rob:2", "attribute DHType", "\"Standard\"", "\"Modified\""}},
        Break{"FreeFlyingRobot",
              true,
              "robType=\"Tree\"",
              "robType=\"FreeFlying\"",
              {"attribute robType"}},
        Break{"UnknownParent",
              true,
              "<Parent name=\"Turn\"/>",
              "<Parent name=\"Tern\"/>",
              {"Joint \"Lift\"/Parent \"Tern\", attribute name", "further up"}},
        Break{"RepeatedJoint",
              true,
              "Joint name=\"Lift\"",
              "Joint name=\"Turn\"",
              {"a second joint of this name"}},
        Break{"MissingDhParameter",
              true,
              "alpha=\"-90\" a=\"50\"",
              "alpha=\"-90\"",
              {"small.rob:17", "Joint \"Lift\"/DHPars, attribute a", "no such attribute"}},
        Break{"DhParameterNotANumber",
              true,
              "theta=\"30\"",
              "theta=\"3o\"",
              {"small.rob:11", "Joint \"Turn\"/DHPars, attribute theta", "\"3o\""}},
        Break{"InfiniteLimit", true, "Hi=\"90\"", "Hi=\"inf\"", {"\"inf\"", "a finite number"}},
        Break{"InvertedLimits",
              true,
              "Hi=\"90\" Low=\"-90\"",
              "Hi=\"-90\" Low=\"90\"",
              {"Joint \"Turn\"/Limits, attribute Low", "Low ≤ Hi"}},
        Break{"NoLimits",
              true,
              "<Limits Hi=\"90\" Low=\"-90\"/>",
              "",
              {"Joint \"Turn\"", "no <Limits> in it"}},
        Break{"OddFlag",
              true,
              "rotational=\"true\"",
              "rotational=\"perhaps\"",
              {"\"perhaps\"", "true or false"}},
        Break{"UnknownControlledJoint",
              true,
              "<DOF name=\"Spread\" value=\"0.8\"/>",
              "<DOF name=\"Sprd\" value=\"0.8\"/>",
              {"Control \"Spread\"/DOF \"Sprd\", attribute name",
               "the name of a joint of the robot, or X"}},
        Break{"NegativeEigValue",
              true,
              "eigValue=\"0.9\"",
              "eigValue=\"-0.9\"",
              {"Control \"Close\", attribute eigValue"}},
        Break{"TooManyTrunkControls",
              true,
              "nTrunk=\"2\"",
              "nTrunk=\"6\"",
              {"attribute nTrunk", "from 0 to the number of controls, 5"}}),
    [](const auto& test) { return test.param.name; });

TEST(BrokenFile, WithAMisspeltElementIsRefusedWithTheRightName) {
  const auto refusal = [](const SmallProblem& files) {
    return handway::test::refusal_of(
        [&] { static_cast<void>(KauthamImporter().read(files.problem())); });
  };
  const SmallProblem lost_obstacle;
  SmallProblem::edit(lost_obstacle.problem(), "<Scene ", "<Scen ");
  SmallProblem::edit(lost_obstacle.problem(), "</Scene>", "</Scen>");
  EXPECT_THAT(refusal(lost_obstacle), HasSubstr("Did you mean <Scene>?"));
  const SmallProblem lost_transform;
  SmallProblem::edit(lost_transform.robot(), "<PreTrans ", "<PreTran ");
  EXPECT_THAT(refusal(lost_transform), HasSubstr("Did you mean <PreTrans>?"));
  const SmallProblem lost_control;
  SmallProblem::edit(lost_control.robot(), "<Control ", "<Controll ");
  SmallProblem::edit(lost_control.robot(), "</Control>", "</Controll>");
  EXPECT_THAT(refusal(lost_control), HasSubstr("Did you mean <Control>?"));
}

TEST(TolerantReading, FindsFilesWhoseNamesHaveOtherLetters) {
  const SmallProblem files;
  SmallProblem::edit(files.robot(), "ivFile=\"cube.iv\"", "ivFile=\"CUBE.IV\"");
  SmallProblem::edit(files.problem(), "scene=\"robots/cube.iv\"", "scene=\"Robots\\Cube.iv\"");
  SmallProblem::edit(files.problem(), "robot=\"robots/small.rob\"", "robot=\"robots/Small.rob\"");
  EXPECT_THAT(KauthamImporter().read(files.problem()).scene->warnings,
              testing::IsSupersetOf(
                  {HasSubstr("CUBE.IV"), HasSubstr("Robots\\Cube.iv"), HasSubstr("Small.rob")}));
}

TEST(TolerantReading, DoesWithoutTexturesThatAreMissing) {
  const SmallProblem files;
  SmallProblem::edit(files.cube(), "#Inventor V2.1 ascii\n",
                     "#Inventor V2.1 ascii\nTexture2 { filename \"lost.png\" }\n");
  const auto loaded = KauthamImporter().read(files.problem());
  EXPECT_FALSE(loaded.scene->objects.empty());
  EXPECT_THAT(loaded.scene->warnings,
              testing::Contains(testing::AllOf(HasSubstr("textures"), HasSubstr("lost.png"))));
}

TEST(BrokenFile, CountsThatDontMatchAreWarnedOf) {
  const SmallProblem files;
  SmallProblem::edit(files.robot(), "<Joints size=\"8\">", "<Joints size=\"9\">");
  const auto loaded = KauthamImporter().read(files.problem());
  EXPECT_THAT(loaded.scene->warnings,
              testing::Contains(HasSubstr("small.rob:3: Joints says size 9 but has 8")));
}

}  // namespace
}  // namespace handway::import_kautham
