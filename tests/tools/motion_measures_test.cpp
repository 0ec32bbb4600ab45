/// Measures of timed motions: `handway plan --report`, `handway bench`.
#include "command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <string>

namespace handway::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class MotionMeasures : public testing::Test {
 protected:
  [[nodiscard]] nlohmann::json motion_of(const std::string& arguments) const {
    const Outcome plan = line_.run("plan " + arguments + " --report report.json");
    EXPECT_EQ(plan.exit_code, 0) << plan.err;
    return nlohmann::json::parse(line_.read("report.json")).at("motion");
  }
  [[nodiscard]] static std::string scene(const std::string& name) {
    return (source_dir() / "scenes" / name).string();
  }

  CommandLine line_;
};

TEST_F(MotionMeasures, AreInTheReportOfAPlan) {
  const nlohmann::json motion = motion_of("post.yaml");
  EXPECT_GT(motion.at("duration_s"), 0.0);
  for (const char* const part : {"hand", "palm"}) {
    EXPECT_LT(motion.at(part).at("log_dimensionless_jerk"), -5.2) << part;
    EXPECT_LT(motion.at(part).at("spectral_arc_length"), -1.0) << part;
  }
  EXPECT_GE(motion.at("deviation").at("arm"), 0.0);
  EXPECT_GE(motion.at("deviation").at("palm_mm"), 0.0);
  EXPECT_TRUE(motion.at("components").is_null());
  EXPECT_EQ(motion.at("no_components"), "There are no recorded postures of the hand.");
}

TEST_F(MotionMeasures, AreNullWithoutAPath) {
  const Outcome plan = line_.run("plan walled.yaml --time-limit 0.2 --report report.json");
  EXPECT_EQ(plan.exit_code, 1);
  EXPECT_TRUE(nlohmann::json::parse(line_.read("report.json")).at("motion").is_null());
}

TEST_F(MotionMeasures, CompareTheHandWithTheRecordingThatShips) {
  const std::string postures =
      (source_dir() / "resources" / "bases" / "sah_free_hand_postures.csv").string();
  const nlohmann::json components =
      motion_of(scene("can_on_table.yaml") + " --postures " + postures).at("components");
  EXPECT_GT(components.at("motions"), 100);
  EXPECT_GT(components.at("error_rad"), 0.0);
  EXPECT_LT(components.at("recorded_median_rad"), components.at("recorded_95_rad"));
  EXPECT_THAT(std::string(components.at("recordings")), HasSubstr("a synthetic hand"));
  EXPECT_EQ(line_.run("plan post.yaml --postures " + postures).exit_code, 2)
      << "there is no report";
}

TEST_F(MotionMeasures, CompareTheHandWithAPerson) {
  HANDWAY_NEED_REFERENCE(reference);
  const std::string glove = (reference / "glove").string();
  ASSERT_EQ(line_
                .run("pca " + glove + "/calib-rad-su01.txt " + glove +
                     "/grasp-rad-su01.txt --postures person.csv --out person.yaml")
                .exit_code,
            0);
  const nlohmann::json components =
      motion_of(scene("two_cans_on_table.yaml") + " --set basis=person.yaml").at("components");
  EXPECT_EQ(components.at("motions"), 107);
  // Held-out motions of a person are represented within a few degrees; the planned one less well.
  EXPECT_NEAR(components.at("recorded_median_rad"), 0.075, 0.03);
  EXPECT_GT(components.at("error_rad"), components.at("recorded_median_rad"));
  EXPECT_LT(components.at("error_rad"), 0.5);
}

TEST_F(MotionMeasures, SayThatARecordingIsTooShort) {
  std::string postures = "# handway postures 1\n# hand: sah_right\n# source: a moment\ntime";
  std::string row;
  for (const char* const joint :
       {"thumb_base", "thumb_abduction", "thumb_proximal", "thumb_medial", "index_abduction",
        "index_proximal", "index_medial", "middle_abduction", "middle_proximal", "middle_medial",
        "ring_abduction", "ring_proximal", "ring_medial"}) {
    postures += std::string(",") + joint;
    row += ",0.5";
  }
  postures += "\n0" + row + "\n1" + row + "\n";
  line_.write("short.csv", postures);
  const nlohmann::json motion = motion_of(scene("can_on_table.yaml") + " --postures short.csv");
  EXPECT_TRUE(motion.at("components").is_null());
  EXPECT_THAT(std::string(motion.at("no_components")),
              HasSubstr("The recording has 0 motions, which are too few"));
}

TEST_F(MotionMeasures, AreComparedByTheBenchmark) {
  const Outcome bench = line_.run("bench post.yaml --planner full-prm --seeds 3 --out results");
  EXPECT_EQ(bench.exit_code, 0) << bench.err;
  EXPECT_THAT(bench.out, HasSubstr("Motions: medians of the paths found"));
  EXPECT_THAT(bench.out, HasSubstr("DTW"));
  EXPECT_THAT(bench.out, Not(ContainsRegex(" (nan|-?inf)[ \n]")));
  const auto results = nlohmann::json::parse(line_.read("results/bench.json"));
  for (const auto& plan : results.at("scenes").at(0).at("plans")) {
    EXPECT_GT(plan.at("motion").at("warped_distance"), 0.0);
    EXPECT_GE(plan.at("motion").at("largest_warped_distance"),
              plan.at("motion").at("warped_distance"));
    EXPECT_TRUE(plan.at("motion").at("component_error_rad").is_null());
    EXPECT_TRUE(plan.at("runs").at(0).at("motion").is_object());
  }
}

}  // namespace
}  // namespace handway::test
