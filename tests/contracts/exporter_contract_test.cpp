/// Contract of every exporter, whatever its format.
#include "handway/planning/extensions/exporter.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/timing/timing_settings.h"
#include "handway_test/input_errors.h"
#include "handway_test/motions.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace handway::planning {
namespace {

namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;

const PluginManager& plugins() {
  static const PluginManager kExtensions = [] {
    PluginManager made;
    made.load_plugins(HANDWAY_PLUGINS);
    return made;
  }();
  return kExtensions;
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& exporter : plugins().exporters()) {
    all.push_back(exporter->name());
  }
  return all;
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

const Motion& motion() {
  static const Motion kMotion = test::tx90_sah_motion();
  return kMotion;
}

/// A motion that the exporter accepts: timed as it needs, and of an arm with as many joints.
Motion suitable_motion(const Exporter& exporter, double speed = 1.0, bool arcs = true) {
  const bool needs_seven = exporter.name() == "franka";
  TimingOptions options;
  const TimingSettings settings = exporter.settings_for({});
  options.period = settings.period;
  options.speed = speed;
  options.blends.deviation = settings.blend && arcs ? settings.deviation : 0.0;
  return needs_seven ? test::panda_motion(options) : test::tx90_sah_motion(options);
}

class EveryExporter : public testing::TestWithParam<std::string> {
 protected:
  /// The message with which the motion is refused; nothing may have been written.
  std::string refusal(const Motion& bad) const {
    const test::ScratchFolder scratch;
    const fs::path out = scratch.path() / "out";
    const std::string message =
        test::refusal_of([&] { static_cast<void>(exporter_.write(bad, out)); });
    EXPECT_FALSE(fs::exists(out));
    return message;
  }

  const Exporter& exporter_ = plugins().exporter(GetParam());
  const ExportOptions any_robot_{.any_robot = true};
};

TEST(Exporters, AreTheOnesThatShipEachOnce) {
  const std::vector<std::string> all = names();
  EXPECT_THAT(all, IsSupersetOf({"csv", "franka", "krl", "moveit", "rapid", "ros", "split",
                                 "urscript", "urscript-servo", "val3"}));
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
}

TEST(Exporters, AreRefusedByNameWithTheOnesThereAre) {
  EXPECT_THAT(test::refusal_of([] { static_cast<void>(plugins().exporter("vla3")); }),
              AllOf(HasSubstr("vla3"), HasSubstr("val3")));
}

TEST_P(EveryExporter, SaysWhatItIs) { EXPECT_THAT(exporter_.description(), Not(IsEmpty())); }

TEST_P(EveryExporter, MakesTheSameFilesEveryTime) {
  const Motion suitable = suitable_motion(exporter_);
  const std::vector<ExportedFile> files = exporter_.files(suitable, any_robot_);
  const std::vector<ExportedFile> again = exporter_.files(suitable, any_robot_);
  ASSERT_FALSE(files.empty());
  ASSERT_EQ(files.size(), again.size());
  std::set<fs::path> all;
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_TRUE(files[i].name.is_relative()) << files[i].name;
    EXPECT_THAT(files[i].name.string(), AllOf(HasSubstr("wave"), Not(HasSubstr(".."))));
    EXPECT_THAT(files[i].content, Not(IsEmpty()));
    EXPECT_EQ(files[i].content, again[i].content) << files[i].name;
    EXPECT_TRUE(all.insert(files[i].name).second) << files[i].name << " twice";
  }
}

TEST_P(EveryExporter, WritesWhatItMakes) {
  const test::ScratchFolder scratch;
  const fs::path out = scratch.path() / "new" / "folder";
  const Motion suitable = suitable_motion(exporter_);
  const std::vector<ExportedFile> files = exporter_.files(suitable, any_robot_);
  fs::create_directories((out / files.front().name).parent_path());
  std::ofstream(out / files.front().name) << "what was there before";
  const std::vector<fs::path> written = exporter_.write(suitable, out, any_robot_);
  ASSERT_EQ(written.size(), files.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_EQ(written[i], out / files[i].name);
    EXPECT_EQ(content(written[i]), files[i].content);
  }
  const auto count = std::ranges::count_if(fs::recursive_directory_iterator(out),
                                           [](const auto& e) { return e.is_regular_file(); });
  EXPECT_EQ(static_cast<std::size_t>(count), files.size()) << "and nothing else";
}

TEST_P(EveryExporter, TakesASlowMotionWithStops) {
  EXPECT_THAT(exporter_.files(suitable_motion(exporter_, 0.5, false), any_robot_), Not(IsEmpty()));
}

TEST_P(EveryExporter, RefusesNumbersThatAreNone) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Motion broken = motion();
    broken.trajectory.points[5].position[2] = bad;
    EXPECT_THAT(refusal(broken), AllOf(HasSubstr("joint_3"), HasSubstr("0.0200 s")));
    broken = motion();
    broken.trajectory.points[5].velocity[1] = bad;
    EXPECT_THAT(refusal(broken), HasSubstr("joint_2"));
    broken = motion();
    broken.path.waypoints[1][0] = bad;
    EXPECT_THAT(refusal(broken), AllOf(HasSubstr("waypoint 2"), HasSubstr("joint_1")));
    broken = motion();
    broken.waypoint_times[1] = bad;
    EXPECT_THAT(refusal(broken), HasSubstr("time"));
  }
}

TEST_P(EveryExporter, RefusesJointsOutOfTheirLimits) {
  Motion broken = motion();
  broken.trajectory.points[7].position[1] = 2.6;
  EXPECT_THAT(refusal(broken),
              AllOf(HasSubstr("joint_2"), HasSubstr("0.0280 s"), HasSubstr("2.6")));
  broken = motion();
  broken.path.waypoints.back()[1] = 2.6;
  EXPECT_THAT(refusal(broken), AllOf(HasSubstr("waypoint 4"), HasSubstr("joint_2")));
}

TEST_P(EveryExporter, RefusesMotionsThatAreTooFast) {
  Motion broken = motion();
  broken.trajectory.points[7].velocity[0] = 20.0;
  EXPECT_THAT(refusal(broken), AllOf(HasSubstr("joint_1"), HasSubstr("velocity 20")));
  broken = motion();
  broken.trajectory.points[7].acceleration[0] = 99.0;
  EXPECT_THAT(refusal(broken), AllOf(HasSubstr("joint_1"), HasSubstr("acceleration 99")));
  broken = motion();
  broken.trajectory.points[7].position[0] += 0.5;
  EXPECT_THAT(refusal(broken), AllOf(HasSubstr("joint_1"), HasSubstr("velocity")))
      << "a jump, whatever velocity is written beside it";
}

TEST_P(EveryExporter, RefusesTimeThatDoesNotIncrease) {
  Motion broken = motion();
  broken.trajectory.points[3].time = broken.trajectory.points[2].time;
  EXPECT_THAT(refusal(broken), HasSubstr("must increase"));
}

TEST_P(EveryExporter, RefusesWhatIsNoMotion) {
  Motion broken = motion();
  broken.trajectory.points.clear();
  EXPECT_THAT(refusal(broken), HasSubstr("no points"));
  broken = motion();
  broken.path.waypoints.clear();
  EXPECT_THAT(refusal(broken), HasSubstr("waypoints"));
  broken = motion();
  broken.trajectory.points[2].position.resize(3);
  EXPECT_THAT(refusal(broken), HasSubstr("3 positions"));
  broken = motion();
  broken.trajectory.points.pop_back();
  EXPECT_THAT(refusal(broken), HasSubstr("not at rest"));
  broken = motion();
  broken.arm.push_back(99);
  EXPECT_THAT(refusal(broken), HasSubstr("99"));
  broken = motion();
  broken.limits.velocity[0] = 0.0;
  EXPECT_THAT(refusal(broken), HasSubstr("limits"));
}

TEST_P(EveryExporter, RefusesStagesOutOfOrder) {
  Motion broken = test::with_stages(motion());
  broken.stages[2].first = 0;
  EXPECT_THAT(refusal(broken), AllOf(HasSubstr("stage lift"), HasSubstr("waypoint 1")));
  broken.stages[2].first = 9;
  EXPECT_THAT(refusal(broken), HasSubstr("waypoint 10"));
}

// The controller takes one point in each of its cycles: with other points it runs at another pace.
TEST_P(EveryExporter, RefusesPointsWithAnotherPeriodThanItNeeds) {
  if (exporter_.point_period() == 0.0) {
    EXPECT_EQ(exporter_.settings_for({.period = 0.003}).period, 0.003);
    return;
  }
  EXPECT_EQ(exporter_.settings_for({}).period, exporter_.point_period());
  EXPECT_THAT(test::refusal_of(
                  [&] { static_cast<void>(exporter_.files(test::tx90_sah_motion(), any_robot_)); }),
              HasSubstr("--period-ms"));
}

TEST_P(EveryExporter, RefusesNamesThatAreNone) {
  for (const char* name : {"", "../up", "two words", "1st", "a-b"}) {
    Motion broken = motion();
    broken.name = name;
    EXPECT_THAT(refusal(broken), HasSubstr("name")) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Exporters, EveryExporter, testing::ValuesIn(names()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace handway::planning
