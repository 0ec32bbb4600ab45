/// The run database: nothing lost, nothing twice.
#include "handway/planning/campaigns/run_database.h"

#include "handway/geometric/io/input_error.h"
#include "handway_test/paths.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace handway::planning {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using testing::ThrowsMessage;
using Opening = RunDatabase::Opening;

class RunDatabaseTest : public testing::Test {
 protected:
  RunDatabaseTest() {
    std::ofstream(problem_) << "a problem";
    campaign_.name = "study";
    campaign_.problems = {{"first", problem_}, {"second", problem_}};
    campaign_.planners = {{"a", "pmd-prm", {{"k", "10"}}}, {"b", "pmd-prm", {{"k", "20"}}}};
    campaign_.seeds = {1, 2};
  }

  test::ScratchFolder folder_;
  fs::path problem_ = folder_.path() / "problem.yaml";
  fs::path file_ = folder_.path() / "runs.sqlite";
  Campaign campaign_;
};

RunRecord record_of(const RunSpec& spec) {
  RunRecord record;
  record.spec = spec;
  record.solved = true;
  record.status = "solved";
  record.reason = "it's \"solved\"";
  record.time_s = 0.1 + static_cast<double>(spec.seed);
  record.samples = std::uint64_t{1} << 40;
  record.nodes_per_pmds = {0, 3, 5};
  record.path_nodes = 2;
  record.path = "time,a\n0,1\n";
  record.l2_length = 2.5;
  record.fault = "a fault";
  record.measures.hand_sparc = -1.5;
  return record;
}

TEST_F(RunDatabaseTest, GivesBackWhatWasAdded) {
  RunDatabase database(file_, campaign_, "1.0", Opening::kNew);
  EXPECT_THAT(database.pending(), SizeIs(8));
  const RunRecord added = record_of({1, 0, 2});
  database.add(std::vector{added, record_of({0, 1, 1})});
  const std::vector<RunRecord> records = database.records();
  ASSERT_THAT(records, SizeIs(2));
  EXPECT_EQ(records[0].spec, (RunSpec{0, 1, 1}));
  EXPECT_EQ(records[1].spec, added.spec);
  EXPECT_EQ(records[1].reason, added.reason);
  EXPECT_EQ(records[1].time_s, added.time_s);
  EXPECT_EQ(records[1].samples, added.samples);
  EXPECT_EQ(records[1].l2_length, added.l2_length);
  EXPECT_EQ(records[1].fault, added.fault);
  EXPECT_EQ(records[1].measures.hand_sparc, added.measures.hand_sparc);
  EXPECT_TRUE(std::isnan(records[1].cpu_s)) << "was not measured";
  EXPECT_EQ(records[1].nodes_per_pmds, added.nodes_per_pmds);
  EXPECT_THAT(database.pending(), SizeIs(6));
  EXPECT_THAT(database.versions(), ElementsAre("1.0"));
}

TEST_F(RunDatabaseTest, KeepsTheFirstOfARunThatComesTwice) {
  RunDatabase database(file_, campaign_, "1.0", Opening::kNew);
  RunRecord again = record_of({0, 0, 1});
  database.add(std::vector{again});
  again.time_s = 99.0;
  database.add(std::vector{again, again});
  ASSERT_THAT(database.records(), SizeIs(1));
  EXPECT_EQ(database.records().front().time_s, 1.1);
}

TEST_F(RunDatabaseTest, GoesOnWhereItEnded) {
  { RunDatabase(file_, campaign_, "1.0", Opening::kNew).add(std::vector{record_of({0, 0, 1})}); }
  campaign_.seeds = {1, 2, 3};
  std::swap(campaign_.planners[0], campaign_.planners[1]);
  const RunDatabase database(file_, campaign_, "1.1", Opening::kResume);
  EXPECT_THAT(database.pending(), SizeIs(11));
  ASSERT_THAT(database.records(), SizeIs(1));
  EXPECT_EQ(database.records().front().spec, (RunSpec{0, 1, 1})) << "the planner's new place";
}

TEST_F(RunDatabaseTest, HasAViewWithNamesAndPaths) {
  { RunDatabase(file_, campaign_, "1.0", Opening::kNew).add(std::vector{record_of({1, 1, 2})}); }
  SQLite::Database sqlite(file_.string());
  SQLite::Statement query(sqlite, "SELECT problem, planner, seed, path FROM runs");
  ASSERT_TRUE(query.executeStep());
  EXPECT_EQ(query.getColumn(0).getString(), "second");
  EXPECT_EQ(query.getColumn(1).getString(), "b");
  EXPECT_EQ(query.getColumn(2).getInt(), 2);
  EXPECT_EQ(query.getColumn(3).getString(), "time,a\n0,1\n");
}

TEST_F(RunDatabaseTest, RefusesWhatIsNotItsOwn) {
  const auto open = [&](Opening opening) { RunDatabase(file_, campaign_, "1.0", opening); };
  std::ofstream(file_) << "no database, but a text long enough to be taken for one by mistake";
  EXPECT_THAT([&] { open(Opening::kResume); },
              ThrowsMessage<InputError>(HasSubstr("another format")));
  fs::remove(file_);
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
      .exec("CREATE TABLE run (a)");
  EXPECT_THAT([&] { open(Opening::kResume); },
              ThrowsMessage<InputError>(HasSubstr("another program")));
}

TEST_F(RunDatabaseTest, RefusesRunsThatDoNotBelongTogether) {
  const auto open = [&](Opening opening) { RunDatabase(file_, campaign_, "1.0", opening); };
  RunDatabase(file_, campaign_, "1.0", Opening::kNew).add(std::vector{record_of({0, 0, 1})});
  EXPECT_THAT([&] { open(Opening::kNew); }, ThrowsMessage<InputError>(HasSubstr("--resume")));
  campaign_.time_limit_s = 5.0;
  EXPECT_THAT([&] { open(Opening::kResume); },
              ThrowsMessage<InputError>(HasSubstr("time_limit_s")));
  campaign_.time_limit_s = 60.0;
  std::ofstream(problem_) << "another problem";
  EXPECT_THAT([&] { open(Opening::kResume); },
              ThrowsMessage<InputError>(HasSubstr("problem \"first\"")));
}

TEST_F(RunDatabaseTest, NoticesAChangeOfAnyFileThatAProblemRefersTo) {
  const fs::path mesh = folder_.path() / "mesh.obj";
  const fs::path robot = folder_.path() / "robot.urdf";
  std::ofstream(mesh) << "a mesh";
  std::ofstream(robot) << "a robot";
  campaign_.problems[0].files = {problem_, robot, mesh};
  const auto open = [&] { RunDatabase(file_, campaign_, "1.0", Opening::kResume); };
  RunDatabase(file_, campaign_, "1.0", Opening::kNew).add(std::vector{record_of({0, 0, 1})});
  EXPECT_NO_THROW(open());
  for (const fs::path& file : {robot, mesh}) {
    const std::string before = file == mesh ? "a mesh" : "a robot";
    std::ofstream(file) << before << ", edited";
    EXPECT_THAT(open, ThrowsMessage<InputError>(HasSubstr(file.string() + " as it is now")));
    std::ofstream(file) << before;
    EXPECT_NO_THROW(open());
  }
  fs::remove(mesh);
  EXPECT_THAT(open, ThrowsMessage<InputError>(HasSubstr("mesh.obj")));
}

TEST_F(RunDatabaseTest, KeepsASecondProgramOut) {
  const RunDatabase database(file_, campaign_, "1.0", Opening::kNew);
  EXPECT_THAT([&] { RunDatabase(file_, campaign_, "1.0", Opening::kResume); },
              ThrowsMessage<InputError>(HasSubstr("is running there")));
}

TEST_F(RunDatabaseTest, SaysWhenThereIsNoRoomAndKeepsWhatThereIs) {
  RunDatabase(file_, campaign_, "1.0", Opening::kNew).add(std::vector{record_of({0, 0, 1})});
  fs::create_symlink("/dev/full", folder_.path() / "full.sqlite");
  EXPECT_THAT([&] { RunDatabase(folder_.path() / "full.sqlite", campaign_, "1.0", Opening::kNew); },
              ThrowsMessage<InputError>(HasSubstr("full.sqlite")));
  EXPECT_THAT(RunDatabase(file_, campaign_, "1.0", Opening::kResume).records(), SizeIs(1));
}

}  // namespace
}  // namespace handway::planning
