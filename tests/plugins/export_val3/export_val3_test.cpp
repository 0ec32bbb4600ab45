#include "handway/geometric/math/units.h"
#include "handway_test/input_errors.h"
#include "handway_test/motions.h"
#include "val3_exporter.h"
#include "val3_grammar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace handway::export_val3 {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// An application as a controller would read it.
class Application {
 public:
  explicit Application(const planning::Motion& motion,
                       const planning::ExportOptions& options = {}) {
    for (const planning::ExportedFile& file : Val3Exporter().files(motion, options)) {
      if (file.name == "wave_hand_targets.csv") {
        continue;
      }
      EXPECT_EQ(file.name.parent_path(), motion.name);
      pugi::xml_document& document = documents_[file.name.filename().string()];
      EXPECT_TRUE(document.load_string(file.content.c_str(),
                                       pugi::parse_default | pugi::parse_declaration));
      EXPECT_STREQ(document.first_child().attribute("encoding").value(), "utf-8");
    }
  }

  [[nodiscard]] const pugi::xml_document& file(const std::string& name) const {
    return documents_.at(name);
  }

  [[nodiscard]] std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& [name, document] : documents_) {
      all.insert(name);
    }
    return all;
  }

  [[nodiscard]] pugi::xml_node data(const char* name) const {
    return file("wave.dtx").child("Database").child("Datas").find_child_by_attribute("name", name);
  }

  /// Returns the elements of an array of the data file.
  [[nodiscard]] std::vector<pugi::xml_node> values(const char* name) const {
    const auto all = data(name).children("Value");
    return {all.begin(), all.end()};
  }

  /// The variables that the data file declares.
  [[nodiscard]] std::set<std::string> variables() const {
    std::set<std::string> all;
    for (const pugi::xml_node data : file("wave.dtx").child("Database").child("Datas")) {
      all.insert(data.attribute("name").value());
    }
    return all;
  }

 private:
  std::map<std::string, pugi::xml_document> documents_;
};

const planning::Motion& motion() {
  static const planning::Motion kMotion = test::tx90_sah_motion(false, 0.5);
  return kMotion;
}

TEST(Val3Application, IsMadeOfTheFilesThatItsProjectNames) {
  const Application application(motion());
  const pugi::xml_node project = application.file("wave.pjx").child("Project");
  EXPECT_STREQ(project.attribute("xmlns").value(),
               "http://www.staubli.com/robotics/VAL3/Project/3");
  EXPECT_STREQ(project.child("Parameters").attribute("millimeterUnit").value(), "true");
  std::set<std::string> named = {"wave.pjx"};
  for (const pugi::xml_node program : project.child("Programs")) {
    named.insert(program.attribute("file").value());
  }
  named.insert(project.child("Database").child("Data").attribute("file").value());
  EXPECT_EQ(named, application.names());
  EXPECT_TRUE(named.contains("start.pgx") && named.contains("stop.pgx")) << "mandatory";
}

TEST(Val3Exporter, ObjectsToArmsOfOtherMakersUnlessItIsKnownBetter) {
  for (const char* robot : {"tx90_sah", "TX90 SA Hand Right", "cell_tx2-60l", "staubli", "RX160"}) {
    EXPECT_THAT(Val3Exporter().robot_objection(test::with_robot_name(motion(), robot)), IsEmpty())
        << robot;
  }
  for (const char* robot : {"ur5", "iiwa14", "matrix600", "tx"}) {
    const planning::Motion other = test::with_robot_name(motion(), robot);
    EXPECT_THAT(test::refusal_of([&] { static_cast<void>(Val3Exporter().files(other)); }),
                AllOf(HasSubstr(robot), HasSubstr("Stäubli"), HasSubstr("--any-robot")));
    EXPECT_EQ(Val3Exporter().files(other, {.any_robot = true}).size(), 6U);
  }
}

TEST(Val3Application, HoldsTheWaypointsOfTheArmInDegrees) {
  const Application application(motion());
  const pugi::xml_node points = application.data("jPath");
  EXPECT_STREQ(points.attribute("type").value(), "jointRx");
  EXPECT_EQ(points.attribute("size").as_uint(), motion().path.waypoints.size());
  std::size_t w = 0;
  for (const pugi::xml_node value : points.children("Value")) {
    ASSERT_LT(w, motion().path.waypoints.size());
    EXPECT_EQ(value.attribute("key").as_uint(), w);
    for (std::size_t i = 0; i < 6; ++i) {
      constexpr std::array<const char*, 6> kJoints = {"j1", "j2", "j3", "j4", "j5", "j6"};
      EXPECT_NEAR(geometric::radians(value.attribute(kJoints[i]).as_double()),
                  motion().path.waypoints[w][motion().arm[i]], 1e-8);
    }
    ++w;
  }
  EXPECT_EQ(w, motion().path.waypoints.size());
  EXPECT_EQ(application.data("nPoints").child("Value").attribute("value").as_uint(), w);
}

TEST(Val3Application, DescribesEveryMoveAndBlendsNone) {
  const Application application(motion());
  const pugi::xml_node moves = application.data("mMove");
  EXPECT_STREQ(moves.attribute("type").value(), "mdesc");
  EXPECT_EQ(moves.attribute("size").as_uint(), motion().path.waypoints.size());
  for (const pugi::xml_node value : moves.children("Value")) {
    std::vector<std::string> names;
    for (const pugi::xml_attribute attribute : value.attributes()) {
      names.emplace_back(attribute.name());
    }
    EXPECT_THAT(names, ElementsAre("key", "accel", "vel", "decel", "tmax", "rmax", "blend", "leave",
                                   "reach"));
    EXPECT_STREQ(value.attribute("blend").value(), "off");
    EXPECT_GT(value.attribute("vel").as_double(), 0.0);
    EXPECT_LE(value.attribute("vel").as_double(), 50.0) << "of half speed";
    EXPECT_NEAR(value.attribute("accel").as_double(), 25.0, 1e-6) << "the square of it";
    EXPECT_EQ(value.attribute("accel").as_double(), value.attribute("decel").as_double());
  }
}

TEST(Val3Application, DeclaresArraysOfTheSizesThatTheyHave) {
  const Application application(motion());
  EXPECT_THAT(application.variables(),
              UnorderedElementsAre("jPath", "mMove", "nPause", "nPoints", "nTolerance", "tHand"));
  for (const std::string& name : application.variables()) {
    const pugi::xml_node data = application.data(name.c_str());
    EXPECT_STREQ(data.attribute("xsi:type").value(), "array") << name;
    const auto values = data.children("Value");
    EXPECT_EQ(std::distance(values.begin(), values.end()), data.attribute("size").as_int()) << name;
  }
}

TEST(Val3Application, HasProgramsThatKeepTheGrammar) {
  const Application application(motion());
  for (const char* name : {"start", "stop", "runPath"}) {
    const pugi::xml_node program =
        application.file(std::string(name) + ".pgx").child("Programs").child("Program");
    EXPECT_STREQ(program.attribute("name").value(), name);
    std::set<std::string> known = application.variables();
    for (const pugi::xml_node local : program.child("Locals")) {
      known.insert(local.attribute("name").value());
    }
    EXPECT_THAT(test::val3_faults(program.child_value("Code"), known), IsEmpty()) << name;
  }
}

TEST(Val3Application, NamesStagesAndDrivesTheHand) {
  const planning::Motion staged = test::with_stages(motion());
  const auto code_of = [&](const planning::ExportOptions& options) {
    const Application application(staged, options);
    const std::string code =
        application.file("runPath.pgx").child("Programs").child("Program").child_value("Code");
    std::set<std::string> known = application.variables();
    known.insert({"l_i", "l_jHere"});
    EXPECT_THAT(test::val3_faults(code, known), IsEmpty());
    return code;
  };
  const std::string without = code_of({});
  EXPECT_THAT(without, AllOf(HasSubstr("  // stage: approach (pick can)\n  for l_i=1 to 1\n"),
                             HasSubstr("  // hand: closes, see wave_hand_targets.csv\n"
                                       "  for l_i=2 to 2\n"),
                             HasSubstr("  // stage: lift (pick can)\n  for l_i=3 to 3\n")));
  EXPECT_THAT(without, testing::Not(HasSubstr("close(")));
  const std::string with = code_of({.gripper_output = 2, .gripper_time = 9.0});
  EXPECT_THAT(with, AllOf(HasSubstr("  close(tHand)\n  for l_i=2 to 2\n"), HasSubstr("delay(")));
  EXPECT_STREQ(Application(staged, {.gripper_output = 2})
                   .data("tHand")
                   .child("Value")
                   .attribute("ioLink")
                   .value(),
               "ValveIO\\valve2");
  EXPECT_THAT(test::refusal_of(
                  [&] { static_cast<void>(Val3Exporter().files(staged, {.gripper_output = 3})); }),
              HasSubstr("1 or 2"));
}

TEST(Val3Application, SetsOutputsAndWaits) {
  const planning::Motion staged = test::with_outputs_and_wait(test::with_stages(motion()),
                                                              {{"do3", true},
                                                               {"Fieldbus\\lamp", true},
                                                               {"do3", false},
                                                               {"Fieldbus\\heat", 2.5},
                                                               {"lamp", true},
                                                               {"do16", true},
                                                               {"ao1", 1.0}},
                                                              2.5);
  const Application application(staged);
  const std::string code =
      application.file("runPath.pgx").child("Programs").child("Program").child_value("Code");
  std::set<std::string> known = application.variables();
  known.insert({"l_i", "l_jHere"});
  EXPECT_THAT(test::val3_faults(code, known), IsEmpty());
  EXPECT_THAT(
      code, AllOf(HasSubstr("  waitEndMove()\n  dOutput[0]=true\n"), HasSubstr("dOutput[1]=true\n"),
                  HasSubstr("dOutput[0]=false\n"), HasSubstr("  aioSet(aOutput[0],2.500000)\n"),
                  HasSubstr("  // NOT SET: lamp to true\n")));
  std::vector<std::string> links;
  for (const char* name : {"dOutput", "aOutput"}) {
    EXPECT_EQ(application.data(name).attribute("size").as_uint(), application.values(name).size());
    for (const pugi::xml_node value : application.values(name)) {
      links.emplace_back(value.attribute("link").value());
    }
  }
  EXPECT_THAT(links, ElementsAre("BasicIO-1\\%Q3", "Fieldbus\\lamp", "Fieldbus\\heat"));
  EXPECT_STREQ(application.data("dOutput").attribute("type").value(), "dio");
  EXPECT_STREQ(application.data("aOutput").attribute("type").value(), "aio");
  EXPECT_EQ(application.values("nPause").back().attribute("value").as_double(), 2.5)
      << "the wait is a point with a pause";
  EXPECT_THAT(Val3Exporter().warnings(staged),
              ElementsAre(HasSubstr("lamp"), HasSubstr("do16"), HasSubstr("ao1")));
}

TEST(Val3Grammar, FindsWhatIsWrong) {
  const auto faults = [](const char* code) { return test::val3_faults(code, {"a"}); };
  EXPECT_THAT(faults("begin\n  a=1\nend"), IsEmpty());
  EXPECT_THAT(faults("begin\n  b=1\nend"), ElementsAre("line 2: unknown word b"));
  EXPECT_THAT(faults("begin\n  if a==1\nend"),
              ElementsAre("line 3: end closes nothing", HasSubstr("begin"), HasSubstr("if")));
  EXPECT_THAT(faults("begin\n  wait(a\nend"), ElementsAre(HasSubstr("brackets")));
}

// Duration of a joint's motion with a trapezium of speed, or a triangle of a short one, s.
double trapezium(double distance, double velocity, double acceleration) {
  return distance * acceleration < velocity * velocity
             ? 2.0 * std::sqrt(distance / acceleration)
             : distance / velocity + velocity / acceleration;
}

// The controller knows the files alone: its slowest joint of each move, and the pauses.
TEST(Val3Application, TakesByItsTextAsLongAsTheMotion) {
  const Application application(motion());
  const std::vector<pugi::xml_node> points = application.values("jPath");
  const std::vector<pugi::xml_node> moves = application.values("mMove");
  const std::vector<pugi::xml_node> pauses = application.values("nPause");
  ASSERT_EQ(moves.size(), points.size());
  ASSERT_EQ(pauses.size(), points.size());
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double pause = pauses[i].attribute("value").as_double();
    double slowest = 0.0;
    for (int j = 0; j < 6; ++j) {
      const std::string name = "j" + std::to_string(j + 1);
      const int v = motion().arm[static_cast<std::size_t>(j)];
      const double distance =
          geometric::radians(std::abs(points[i].attribute(name.c_str()).as_double() -
                                      points[i - 1].attribute(name.c_str()).as_double()));
      slowest = std::max(
          slowest,
          trapezium(
              distance, 0.01 * moves[i].attribute("vel").as_double() * motion().limits.velocity[v],
              0.01 * moves[i].attribute("accel").as_double() * motion().limits.acceleration[v]));
    }
    EXPECT_NEAR(pause > 0.0 ? pause : slowest,
                motion().waypoint_times[i] - motion().waypoint_times[i - 1], 1e-5)
        << i;
  }
}

// 1 / w + w / acceleration is the time of a trapezium of speed over the share 0 to 1.
TEST(ArmMoves, TakeAsLongAsTheirPartOfTheMotion) {
  const std::vector<ArmMove> moves = arm_moves(motion());
  ASSERT_EQ(moves.size(), 4U);
  for (const std::size_t w : {1U, 3U}) {
    double velocity = 1e9;
    double acceleration = 1e9;
    for (const int v : motion().arm) {
      const double way =
          std::abs(motion().path.waypoints[w][v] - motion().path.waypoints[w - 1][v]);
      if (way > 0.0) {
        velocity = std::min(velocity, motion().limits.velocity[v] / way);
        acceleration = std::min(acceleration, motion().limits.acceleration[v] / way);
      }
    }
    const double top = 0.01 * moves[w].velocity * velocity;
    const double expected = motion().waypoint_times[w] - motion().waypoint_times[w - 1];
    EXPECT_NEAR(1.0 / top + top / (0.01 * moves[w].acceleration * acceleration), expected, 1e-6);
    EXPECT_EQ(moves[w].pause, 0.0);
  }
}

TEST(ArmMoves, WaitWhileTheHandMovesAlone) {
  const std::vector<ArmMove> moves = arm_moves(motion());
  ASSERT_EQ(moves.size(), 4U);
  EXPECT_EQ(moves[2].point, moves[1].point);
  EXPECT_DOUBLE_EQ(moves[2].pause, motion().waypoint_times[2] - motion().waypoint_times[1]);
}

TEST(ArmMoves, NeedSixJoints) {
  planning::Motion odd = motion();
  odd.arm.pop_back();
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(Val3Exporter().files(odd)); }),
              HasSubstr("5 joints"));
}

TEST(Val3Exporter, AsksForStopsAtWaypoints) { EXPECT_TRUE(Val3Exporter().stops_at_waypoints()); }

}  // namespace
}  // namespace handway::export_val3
