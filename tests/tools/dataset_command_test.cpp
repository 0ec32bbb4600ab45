/// `handway dataset`: what it writes, and how it is continued.
#include "command_line.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace handway::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class DatasetCommand : public testing::Test {
 protected:
  [[nodiscard]] Outcome make(const std::string& options) const {
    return line_.run("dataset " + (source_dir() / "scenes" / "can_on_table.yaml").string() +
                     " --pick can --place-on table --spread-mm 60 --out set " + options);
  }
  [[nodiscard]] std::vector<nlohmann::json> episodes() const {
    std::vector<nlohmann::json> entries;
    for (const std::string& line : lines_of(line_.read("set/episodes.jsonl"))) {
      entries.push_back(nlohmann::json::parse(line));
    }
    return entries;
  }

  CommandLine line_;
};

TEST_F(DatasetCommand, MakesMotionsFromRandomPlaces) {
  const Outcome made = make("--episodes 2");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("2 episodes, 2 with a motion"));
  for (const nlohmann::json& episode : episodes()) {
    EXPECT_EQ(episode["stages"].size(), 8U);
    EXPECT_EQ(episode["stages"][3]["carried"], "can");
    const Outcome info = line_.run("recording info set/" + episode["file"].get<std::string>());
    EXPECT_EQ(info.exit_code, 0) << info.err;
    EXPECT_THAT(info.out, AllOf(HasSubstr("joint_1"), HasSubstr("palm.qw"), HasSubstr("can.x"),
                                HasSubstr("stage")));
  }
  EXPECT_NE(line_.read("set/episode_000000.npz"), line_.read("set/episode_000001.npz"));
  EXPECT_THAT(line_.read("set/README.md"),
              AllOf(HasSubstr("with a motion | 2 (100.0 %)"), HasSubstr("certified")));
  EXPECT_FALSE(nlohmann::json::parse(line_.read("set/dataset.json")).contains("objects"))
      << "older data sets lack it, and are continued";
}

TEST_F(DatasetCommand, ContinuesWithWhatIsThere) {
  ASSERT_EQ(make("--episodes 1 --jobs 1").exit_code, 0);
  const std::string first = line_.read("set/episode_000000.npz");
  line_.write("set/episodes.jsonl", line_.read("set/episodes.jsonl") + "{\"episode\": 1, \"sol");
  const Outcome refused = make("--episodes 2");
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_THAT(refused.err, HasSubstr("--resume"));
  ASSERT_EQ(make("--episodes 2 --resume").exit_code, 0);
  EXPECT_EQ(episodes().size(), 2U);
  EXPECT_EQ(line_.read("set/episode_000000.npz"), first);
  const Outcome other = make("--episodes 2 --resume --friction 0.5");
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_THAT(other.err, HasSubstr("of other settings"));
}

TEST_F(DatasetCommand, DrawsObjectsAndTheirSizes) {
  line_.write("objects.yaml",
              "objects:\n"
              "  - object: can\n"
              "  - name: post\n"
              "    cylinder: {radius: [0.028, 0.034], length: [0.12, 0.14]}\n");
  const Outcome made = make("--objects objects.yaml --episodes 4 --jobs 2");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::vector<nlohmann::json> first = episodes();
  ASSERT_EQ(first.size(), 4U);
  for (const nlohmann::json& episode : first) {
    const nlohmann::json& object = episode["object"];
    EXPECT_EQ(object["bounds_m"].size(), 3U);
    if (object["name"] == "post") {
      EXPECT_GE(object["radius_m"], 0.028);
      EXPECT_LE(object["radius_m"], 0.034);
      EXPECT_NEAR(object["bounds_m"][2].get<double>(), object["length_m"].get<double>(), 1e-3);
    } else {
      EXPECT_EQ(object["object"], "can");
    }
    if (episode["solved"] == true) {
      const Outcome info = line_.run("recording info set/" + episode["file"].get<std::string>());
      EXPECT_THAT(info.out, AllOf(HasSubstr("object.x"), HasSubstr("object.choice"),
                                  HasSubstr("object.size_z")));
    }
  }
  EXPECT_THAT(line_.read("set/README.md"),
              AllOf(HasSubstr("| can | object of the scene |"),
                    HasSubstr("| post | cylinder, radius 28–34 mm, length 120–140 mm |")));

  const std::string again = "--objects objects.yaml --episodes 4 --jobs 1 --resume";
  line_.write("set/episodes.jsonl", "");
  ASSERT_EQ(make(again).exit_code, 0);
  const std::vector<nlohmann::json> second = episodes();
  ASSERT_EQ(second.size(), 4U);
  for (std::size_t i = 0; i < second.size(); ++i) {
    EXPECT_EQ(first[i]["object"], second[i]["object"]);
  }
  EXPECT_EQ(make("--episodes 4 --resume").exit_code, 3) << "without the objects";
}

TEST_F(DatasetCommand, WritesDataSetsOfLeRobot) {
  line_.write("objects.yaml",
              "objects:\n  - name: post\n    cylinder: {radius: 0.03, length: [0.12, 0.14]}\n");
  const std::string options = "--objects objects.yaml --format lerobot --episodes ";
  ASSERT_EQ(make(options + "1").exit_code, 0);
  const Outcome more = make(options + "2 --resume");
  ASSERT_EQ(more.exit_code, 0) << more.err;
  std::size_t frames = 0;
  std::size_t solved = 0;
  for (const nlohmann::json& episode : episodes()) {
    if (episode["solved"] == true) {
      frames += episode["frames"].get<std::size_t>();
      ++solved;
    }
    EXPECT_EQ(episode["steps"][0], "pick post");
  }
  const nlohmann::json info = nlohmann::json::parse(line_.read("set/meta/info.json"));
  EXPECT_EQ(info["fps"], 50);
  EXPECT_EQ(info["total_episodes"], solved);
  EXPECT_EQ(info["total_frames"], frames);
  EXPECT_EQ(info["total_tasks"], 1);
  EXPECT_EQ(info["features"]["observation.state"]["names"][0], "joint_1");
  EXPECT_EQ(info["features"]["observation.environment_state"]["names"][7], "object.x");
  const Outcome read = line_.run("recording info set#episode_0/observation.state");
  EXPECT_EQ(read.exit_code, 0) << read.err;
  EXPECT_THAT(read.out, HasSubstr("joint_1"));
  EXPECT_THAT(line_.read("set/README.md"), HasSubstr("LeRobot, version 3"));
  const Outcome period = line_.run(
      "dataset " + (source_dir() / "scenes" / "can_on_table.yaml").string() +
      " --pick can --place-on table --format lerobot --period-ms 30 --episodes 1 --out other");
  EXPECT_EQ(period.exit_code, 3);
  EXPECT_THAT(period.err, HasSubstr("a whole number of frames per second"));
}

TEST_F(DatasetCommand, RefusesBadObjects) {
  line_.write("objects.yaml", "objects:\n  - sphere: {radius: [0.04, 0]}\n");
  const Outcome range = make("--objects objects.yaml --episodes 1");
  EXPECT_EQ(range.exit_code, 3);
  EXPECT_THAT(range.err, AllOf(HasSubstr("objects.yaml:2"), HasSubstr("objects[0].sphere.radius")));
  line_.write("objects.yaml", "objects:\n  - object: cna\n");
  EXPECT_THAT(make("--objects objects.yaml --episodes 1").err,
              HasSubstr("There are: pedestal, table, can."));
  EXPECT_EQ(make("--objects missing.yaml --episodes 1").exit_code, 3);
}

TEST_F(DatasetCommand, QuotesNamesOfTheScene) {
  const std::string shipped = (source_dir() / "scenes" / "can_on_table.yaml").string();
  std::string text = line_.read(shipped);
  const std::string name = "Can on a table";
  line_.write("scene.yaml", text.replace(text.find(name), name.size(), "<script>a</script>"));
  EXPECT_EQ(line_.run("dataset scene.yaml --pick can --place-at 9,9,9,0,0,0 --episodes 1 --out set")
                .exit_code,
            1);
  EXPECT_THAT(line_.read("set/README.md"), testing::Not(HasSubstr("<script>")));
}

TEST_F(DatasetCommand, SaysWhyEpisodesHaveNoMotion) {
  const Outcome made = make("--episodes 1 --place-at 9,9,9,0,0,0");
  EXPECT_NE(made.exit_code, 0) << "excluded by --place-on";
  const Outcome far =
      line_.run("dataset " + (source_dir() / "scenes" / "can_on_table.yaml").string() +
                " --pick can --place-at 9,9,9,0,0,0 --episodes 1 --out far");
  EXPECT_EQ(far.exit_code, 1);
  EXPECT_THAT(line_.read("far/README.md"), HasSubstr("Episodes without a motion"));
}

}  // namespace
}  // namespace handway::test
