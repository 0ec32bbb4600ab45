/// `handway pca`, and plans with the bases that it makes.
#include "command_line.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/posture_table.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

namespace handway::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

// Records three slow motions of all sensors that Table 1 uses, in counts at 50 Hz.
std::string recording(double phase) {
  std::string text = "time,c,e,f,j,g,h,k,l,n,o,p\n";
  for (int row = 0; row < 500; ++row) {
    const double t = 0.02 * row;
    const double fist = 50 + 40 * std::sin(2.0 * t + phase);
    const double hook = 30 + 20 * std::sin(3.1 * t);
    const double thumb = 40 + 30 * std::sin(1.3 * t);
    text += std::to_string(t);
    for (const double value : {90 + thumb, 110 + 0.5 * thumb, 105 + 0.4 * thumb, 148 - 0.2 * fist,
                               75 + 0.6 * fist, 40 + fist - hook, 78 + 0.6 * fist, 55 + fist - hook,
                               133 - 0.1 * fist, 105 + 0.5 * fist, 75 + 0.8 * fist - hook}) {
      text += ',';
      text += std::to_string(std::lround(value));
    }
    text += "\n";
  }
  return text;
}

class Pca : public testing::Test {
 protected:
  Pca() {
    line_.write("one.csv", recording(0.0));
    line_.write("two.csv", recording(1.0));
  }

  CommandLine line_;
};

TEST_F(Pca, WritesABasisThatPlansAreMadeWith) {
  const Outcome pca = line_.run("pca one.csv --components 3 --sigmas 2 --out basis.yaml");
  EXPECT_EQ(pca.exit_code, 0) << pca.err;
  EXPECT_THAT(pca.err, IsEmpty());
  EXPECT_THAT(pca.out, AllOf(HasSubstr("500 rows of counts"), HasSubstr("at 50.0 Hz"),
                             HasSubstr("joints by limits"), HasSubstr("joints by own range"),
                             HasSubstr("thumb_base\n"), HasSubstr("no --calibration given")));
  const sampling::PmdBasis basis = sampling::read_pmd_basis(line_.folder() / "basis.yaml");
  EXPECT_EQ(basis.hand, "sah_right");
  EXPECT_EQ(basis.joints.size(), 13U);
  ASSERT_EQ(basis.directions.size(), 3U);
  EXPECT_NEAR(basis.directions[0].half_side, 2.0 * std::sqrt(basis.directions[0].variance), 1e-12);
  ASSERT_EQ(basis.free_joints.size(), 1U);
  EXPECT_EQ(basis.free_joints[0].joint, 0);
  const std::string scene = (source_dir() / "scenes" / "can_on_table.yaml").string();
  const Outcome plan = line_.run("plan " + scene + " --set basis=basis.yaml --out path.csv");
  EXPECT_EQ(plan.exit_code, 0) << plan.err;
  EXPECT_EQ(line_.run("check " + scene + " path.csv").exit_code, 0);
}

TEST_F(Pca, KeepsThePosturesThatHandsAreComparedWith) {
  ASSERT_EQ(line_.run("pca one.csv --postures seen.csv --out basis.yaml").exit_code, 0);
  const sampling::PmdBasis basis = sampling::read_pmd_basis(line_.folder() / "basis.yaml");
  const auto postures = sampling::load_recorded_postures(basis);
  ASSERT_NE(postures, nullptr);
  EXPECT_EQ(postures->count(), 500);
  const std::string scene = (source_dir() / "scenes" / "can_on_table.yaml").string();
  ASSERT_EQ(
      line_.run("plan " + scene + " --set basis=basis.yaml --out path.csv --report report.json")
          .exit_code,
      0);
  const auto report = nlohmann::json::parse(line_.read("report.json"));
  for (const char* to : {"to_subspace", "to_recorded"}) {
    const auto& distance = report["human_likeness"][to];
    EXPECT_GT(distance["mean"], 0.0) << to;
    EXPECT_GE(distance["largest"], distance["mean"]) << to;
  }
  const Outcome alone = line_.run("check " + scene + " path.csv");
  EXPECT_THAT(alone.out, HasSubstr("from its principal motion directions\n"));
  const Outcome compared = line_.run("check " + scene + " path.csv --postures seen.csv");
  EXPECT_THAT(compared.out, HasSubstr("from the nearest recorded posture\n"));
  const Outcome wrong = line_.run("check " + scene + " path.csv --postures one.csv");
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_THAT(wrong.err, HasSubstr("handway pca --postures"));
}

// The recording is from the hand itself, on a robot that is an arm with that hand.
TEST_F(Pca, TakesTheJointsOfARobotsOwnHand) {
  std::string joints = "time,index_proximal,index_medial,axis_1\n";
  for (int row = 0; row < 100; ++row) {
    joints += fmt::format("{},{},{},0\n", 0.02 * row, -0.5 + 0.4 * std::sin(0.2 * row),
                          -0.6 + 0.2 * std::sin(0.2 * row));
  }
  line_.write("joints.csv", joints);
  const Outcome pca =
      line_.run("pca joints.csv --joints-of sah_right --components 1 --out basis.yaml");
  ASSERT_EQ(pca.exit_code, 0) << pca.err;
  EXPECT_THAT(pca.out, AllOf(HasSubstr("none of the hand's joints: axis_1"),
                             HasSubstr("no values of thumb_base"), HasSubstr("50.0 Hz")));
  const sampling::PmdBasis basis = sampling::read_pmd_basis(line_.folder() / "basis.yaml");
  EXPECT_EQ(basis.hand, "sah_right");
  ASSERT_EQ(basis.directions.size(), 1U);
  const Eigen::VectorXd& moves = basis.directions[0].vector;
  EXPECT_EQ((moves.array().abs() > 1e-6).count(), 2);
  const std::string scene = (source_dir() / "scenes" / "can_on_table.yaml").string();
  EXPECT_EQ(line_.run("plan " + scene + " --set basis=basis.yaml").exit_code, 0);
}

TEST_F(Pca, JoinsAndComparesRecordings) {
  const Outcome pca = line_.run("pca one.csv two.csv --compare --robust --normalise range");
  EXPECT_EQ(pca.exit_code, 0) << pca.err;
  EXPECT_THAT(pca.out,
              AllOf(HasSubstr("of 1000 samples excluded"), HasSubstr("all together"),
                    ContainsRegex("one.csv and two.csv: [0-9.]+ [0-9.]+ [0-9.]+ [0-9.]+")));
}

// The paper's choice of sensor c for the joint after the thumb base, against sensor d.
TEST_F(Pca, ComparesTwoMappings) {
  const auto resources = source_dir() / "resources";
  const std::string recording = (resources / "recordings" / "free_hand.csv").string();
  const std::string other = (resources / "mappings" / "table1_d_sah.yaml").string();
  const Outcome pca = line_.run("pca " + recording + " --against " + other);
  EXPECT_EQ(pca.exit_code, 0) << pca.err;
  EXPECT_THAT(pca.out, AllOf(ContainsRegex("this mapping +43\\.7. +79\\.5. +84\\.3."),
                             ContainsRegex("table1_d_sah.yaml +[0-9.]+ +[0-9.]+ +[0-9.]+"),
                             ContainsRegex("angle +[0-9.]+ +[0-9.]+ +[0-9.]+ +[0-9.]+")));
  const Outcome same =
      line_.run("pca one.csv --against " + (resources / "mappings" / "table1_sah.yaml").string());
  EXPECT_THAT(same.out, ContainsRegex("angle +0\\.0 +0\\.0 +0\\.0 +0\\.0"));
}

TEST_F(Pca, FiltersBeforeItMaps) {
  const Outcome pca = line_.run(
      "pca one.csv --from 1 --to 5 --drop-duplicates --resample 100 --low-pass 4 "
      "--free none --calibration cal.yaml --robust");
  EXPECT_EQ(pca.exit_code, 3);
  EXPECT_THAT(pca.err, HasSubstr("cal.yaml"));
  const Outcome filtered = line_.run(
      "pca one.csv --from 1 --to 5 --drop-duplicates --resample 100 --low-pass 4 "
      "--free none --robust");
  EXPECT_EQ(filtered.exit_code, 0) << filtered.err;
  EXPECT_THAT(filtered.out, AllOf(HasSubstr("of 401 samples"), HasSubstr("free joints: none")));
}

TEST_F(Pca, TakesMappingsForItsOwnChoiceOfSensors) {
  line_.write("mapping.yaml", "hand: sah_right\njoints:\n  - {joint: thumb_base, sensor: c}\n");
  const Outcome pca = line_.run("pca one.csv --mapping mapping.yaml");
  EXPECT_EQ(pca.exit_code, 3);
  EXPECT_THAT(pca.err, HasSubstr("nothing for joint thumb_abduction"));
}

// A hand of another name, which the mapping names by a path from its own folder.
TEST_F(Pca, FindsTheHandFromTheFolderOfTheMapping) {
  const auto resources = source_dir() / "resources";
  const std::string sah = (resources / "robots/sah_right/sah_right.urdf").string();
  std::filesystem::create_directories(line_.folder() / "hands/left");
  std::filesystem::create_directories(line_.folder() / "bases");
  const Outcome mirror = line_.run("setup " + sah + " --mirror --samples 10 -o hands/left/l.urdf");
  ASSERT_EQ(mirror.exit_code, 0) << mirror.err;
  std::ifstream table1(resources / "mappings" / "table1_sah.yaml");
  std::string text((std::istreambuf_iterator<char>(table1)), {});
  text.replace(text.find("hand: sah_right"), 15, "hand: left/l.urdf");
  line_.write("hands/mapping.yaml", text);

  const Outcome pca = line_.run("pca one.csv --mapping hands/mapping.yaml --out bases/left.yaml");
  ASSERT_EQ(pca.exit_code, 0) << pca.err;
  EXPECT_THAT(line_.read("bases/left.yaml"), HasSubstr("hand: ../hands/left/l.urdf"));
  // A right hand's recording gives a left hand the same basis, joint by joint.
  ASSERT_EQ(line_.run("pca one.csv --out right.yaml").exit_code, 0);
  const auto from_joints = [](const std::string& basis) {
    return basis.substr(basis.find("joints:"));
  };
  EXPECT_EQ(from_joints(line_.read("bases/left.yaml")), from_joints(line_.read("right.yaml")));

  line_.write("hands/short.yaml",
              "hand: left/l.urdf\njoints:\n  - {joint: thumb_base, sensor: c}\n");
  const Outcome lacking = line_.run("pca one.csv --mapping hands/short.yaml");
  EXPECT_EQ(lacking.exit_code, 3);
  EXPECT_THAT(lacking.err, HasSubstr("nothing for joint thumb_abduction"));
}

// Tests the way from the recording of a right hand to a left hand's plan, by both methods, and
// again from another folder: files name each other by relative paths.
TEST_F(Pca, TakesALeftHandFromARightHandsRecordingToAPlan) {
  const auto robots = source_dir() / "resources/robots";
  const std::string right = (robots / "allegro_class_right/allegro_class_right.urdf").string();
  const std::string pca =
      "pca " + (source_dir() / "resources/recordings/free_hand.csv").string() + " --to 20 ";
  for (const char* folder : {"made/hands", "made/maps", "made/bases", "made/scenes"}) {
    std::filesystem::create_directories(line_.folder() / folder);
  }
  const auto succeeds = [&](const std::string& command) {
    const Outcome done = line_.run(command);
    EXPECT_EQ(done.exit_code, 0) << command << '\n' << done.err;
    return done.out;
  };
  succeeds("setup " + right + " --mirror --samples 10 -o made/hands/left.urdf");
  succeeds("glove map made/hands/left.urdf --out made/maps/left.yaml");
  succeeds(pca + "--mapping made/maps/left.yaml --out made/bases/mapped.yaml");
  const std::string out = succeeds(
      pca + "--retarget made/hands/left.urdf --fingertips --out made/bases/retargeted.yaml");
  std::smatch mean;
  const std::regex row("fingertip retargeting +([0-9.]+)");
  ASSERT_TRUE(std::regex_search(out, mean, row)) << out;
  EXPECT_LT(std::stod(mean[1]), 30.0) << "mm";
  std::filesystem::rename(line_.folder() / "made", line_.folder() / "moved");
  EXPECT_THAT(line_.read("moved/maps/left.yaml"), HasSubstr("hand: ../hands/left.urdf"));
  succeeds(pca + "--mapping moved/maps/left.yaml");
  for (const std::string basis : {"mapped", "retargeted"}) {
    EXPECT_THAT(line_.read("moved/bases/" + basis + ".yaml"),
                StartsWith("hand: ../hands/left.urdf"));
    line_.write(
        "moved/scenes/left.yaml",
        "handway: 1\nrobots:\n  - {name: arm, model: iiwa14_class}\n"
        "  - {name: hand, model: ../hands/left.urdf, mount: {robot: arm, link: flange_link}}\n"
        "objects:\n  - {name: bar, box: {size: [0.05, 0.5, 0.05]}, pose: {xyz: [0.7, 0, "
        "1.0]}}\nhand_basis: ../bases/" +
            basis + ".yaml\nstart: {}\ngoal: {joint_2: 0.7, joint_4: -1.57, joint_6: -0.7}\n");
    succeeds("plan moved/scenes/left.yaml --report report.json");
    const auto human = nlohmann::json::parse(line_.read("report.json"))
                           .at("objective")
                           .at("human_likeness")
                           .at("to_subspace");
    EXPECT_LT(human.at("mean").get<double>() - human.at("forced").get<double>(), 0.05);
    EXPECT_LT(human.at("share_beyond").get<double>(), 0.05);
  }
}

TEST_F(Pca, ReportsHowManyDirectionsAreEnough) {
  const Outcome pca = line_.run("pca one.csv two.csv --report report.json");
  ASSERT_EQ(pca.exit_code, 0) << pca.err;
  EXPECT_THAT(pca.out, AllOf(HasSubstr("not used for the basis, mm (95 % confidence)"),
                             ContainsRegex("for 5 mm: [0-9]+ PMDs"), HasSubstr("Stability"),
                             HasSubstr("a new person (estimate)")));
  const auto report = nlohmann::json::parse(line_.read("report.json"));
  EXPECT_EQ(report.at("hand"), "sah_right");
  ASSERT_EQ(report.at("reconstruction").size(), 13U);
  EXPECT_GT(report.at("reconstruction")[0].at("fingertip_mm").at("mean"), 10.0);
  EXPECT_LT(report.at("reconstruction")[12].at("fingertip_mm").at("mean"), 1e-6);
  EXPECT_EQ(report.at("persons").size(), 2U);
  EXPECT_EQ(report.at("persons")[1].at("recording"), "two.csv");
  EXPECT_EQ(report.at("parameters").at("free_joints")[0], "thumb_base");
  const std::string first = line_.read("report.json");
  ASSERT_EQ(line_.run("pca one.csv two.csv --report report.json").exit_code, 0);
  EXPECT_EQ(line_.read("report.json"), first);
}

TEST_F(Pca, DrawsTheFiguresOfThePaper) {
  const Outcome pca = line_.run("pca one.csv --plots figures");
  ASSERT_EQ(pca.exit_code, 0) << pca.err;
  EXPECT_THAT(line_.read("figures/correlations.svg"),
              AllOf(StartsWith("<svg xmlns"), HasSubstr(">r = "),
                    HasSubstr(">Joint 8, middle proximal [°]</text>")));
  EXPECT_THAT(line_.read("figures/variance.svg"),
              AllOf(StartsWith("<svg xmlns"), HasSubstr(">Variance covered [%]</text>")));
  if (!std::filesystem::exists(std::filesystem::path(HANDWAY_PROGRAM).parent_path() /
                               "handway-figures")) {
    EXPECT_THAT(pca.err, HasSubstr("no pictures of the hand"));
    return;
  }
  for (const char* figure : {"directions", "grid"}) {
    const std::string name = std::string("figures/") + figure;
    EXPECT_THAT(line_.read(name + ".png"), StartsWith("\x89PNG")) << figure;
    EXPECT_THAT(line_.read(name + ".svg"), HasSubstr("<svg")) << figure;
    EXPECT_GT(std::filesystem::file_size(line_.folder() / (name + ".png")), 20000U) << figure;
  }
}

TEST_F(Pca, SaysWhatIsMissingToDraw) {
  const Outcome pca = line_.run("pca one.csv --plots /dev/null/figures");
  EXPECT_EQ(pca.exit_code, 3);
  EXPECT_THAT(pca.err, HasSubstr("/dev/null/figures"));
}

TEST_F(Pca, NamesWhatIsWrong) {
  EXPECT_EQ(line_.run("pca").exit_code, 2);
  EXPECT_EQ(line_.run("pca one.csv --normalise feet").exit_code, 2);
  const Outcome joint = line_.run("pca one.csv --free thumb_bas");
  EXPECT_EQ(joint.exit_code, 3);
  EXPECT_THAT(joint.err, HasSubstr("thumb_base"));
  line_.write("cut.csv", "time,c\n0,1\n0.1\n");
  EXPECT_THAT(line_.run("pca cut.csv").err, HasSubstr("cut.csv:3"));
}

TEST_F(Pca, PlansRefuseTheBasisOfAnotherHand) {
  ASSERT_EQ(line_.run("pca one.csv --out sah.yaml").exit_code, 0);
  const Outcome plan = line_.run("plan post.yaml --set basis=sah.yaml");
  EXPECT_EQ(plan.exit_code, 3);
  EXPECT_THAT(plan.err, HasSubstr("another hand"));
}

TEST_F(Pca, FindsTheSharesOfTheReferenceRecordings) {
  HANDWAY_NEED_REFERENCE(reference);
  const std::string glove = (reference / "glove").string();
  EXPECT_THAT(line_.run("pca " + glove + "/calib-rad-su01.txt").out,
              ContainsRegex("by own range +41\\.6. +64\\.3. +79\\.5. +91\\.7"));
  EXPECT_THAT(line_.run("pca " + glove + "/grasp-rad-su01.txt").out,
              ContainsRegex("by own range +61\\.1. +76\\.7. +85\\.3. +89\\.9"));
}

}  // namespace
}  // namespace handway::test
