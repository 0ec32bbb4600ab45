#include "handway/sampling/postures/posture_table.h"

#include "handway/geometric/io/input_error.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace handway::sampling {
namespace {

using ::testing::HasSubstr;

const char* const kHead = "# handway postures 1\n# hand: claw\n# source: made up\n";

class PostureTableFile : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "postures.csv"; }

  [[nodiscard]] PostureTable read(const std::string& text) const {
    std::ofstream(file()) << text;
    return read_postures(file());
  }

  [[nodiscard]] std::string complaint(const std::string& text) const {
    try {
      static_cast<void>(read(text));
    } catch (const geometric::InputError& e) {
      return e.what();
    }
    return "accepted";
  }

 private:
  test::ScratchFolder folder_;
};

TEST_F(PostureTableFile, ReadsBackAnyNamesOfJoints) {
  PostureTable table;
  table.hand = "claw";
  table.joints = {"\"thumb\", left", "=index", "5\" ring"};
  table.postures = Eigen::MatrixXd{{0.25, 0.5, 0.75}};
  write_postures(table, file());
  EXPECT_EQ(read_postures(file()).joints, table.joints);
}

TEST_F(PostureTableFile, ReadsEveryPart) {
  const PostureTable table = read(kHead + std::string("left, right\r\n0,1\r\n\r\n0.25,0.5\r\n"));
  EXPECT_EQ(table.hand, "claw");
  EXPECT_EQ(table.source, "made up");
  EXPECT_EQ(table.joints, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(table.postures, (Eigen::Matrix2d() << 0.0, 1.0, 0.25, 0.5).finished());
}

TEST_F(PostureTableFile, ReadsBackWhatItWrote) {
  const PostureTable table{
      "claw", "two\nlines", {"left", "right"}, (Eigen::MatrixXd(1, 2) << 0.12344, 1.0).finished()};
  write_postures(table, file());
  const PostureTable again = read_postures(file());
  EXPECT_EQ(again.hand, table.hand);
  EXPECT_EQ(again.source, "two lines");
  EXPECT_EQ(again.joints, table.joints);
  EXPECT_LT((again.postures - table.postures).cwiseAbs().maxCoeff(), 5e-5);
}

TEST_F(PostureTableFile, KeepsTheTimes) {
  const PostureTable table{"claw",
                           "",
                           {"left"},
                           (Eigen::MatrixXd(3, 1) << 0.1, 0.2, 0.3).finished(),
                           Eigen::Vector3d(0.0, 0.01, 0.0)};
  write_postures(table, file());
  const PostureTable again = read_postures(file());
  EXPECT_EQ(again.joints, table.joints);
  EXPECT_TRUE(again.times.isApprox(table.times)) << again.times;
  EXPECT_EQ(read(kHead + std::string("left\n0.5\n")).times.size(), 0);
}

TEST_F(PostureTableFile, RefusesWrongTimes) {
  EXPECT_THAT(complaint(kHead + std::string("time,left\nsoon,0.5\n")),
              HasSubstr(":5: time: found \"soon\", expected a number of seconds"));
  EXPECT_THAT(complaint(kHead + std::string("time\n0\n")), HasSubstr("no joints"));
  EXPECT_THROW(
      write_postures({"claw", "", {"left"}, Eigen::MatrixXd::Zero(2, 1), Eigen::VectorXd::Zero(1)},
                     file()),
      std::invalid_argument);
}

TEST_F(PostureTableFile, NamesTheLineOfAWrongValue) {
  const std::string complained = complaint(kHead + std::string("left,right\n0,0.5\n0,1.5\n"));
  EXPECT_THAT(complained, HasSubstr("postures.csv:6: right: found \"1.5\""));
  EXPECT_THAT(complained, HasSubstr("a number from 0 to 1"));
  EXPECT_THAT(complaint(kHead + std::string("left,right\n0,nan\n")), HasSubstr(":5: right"));
  EXPECT_THAT(complaint(kHead + std::string("left,right\n0,much\n")), HasSubstr("\"much\""));
}

TEST_F(PostureTableFile, RefusesWhatIsNoTable) {
  EXPECT_THAT(complaint("left,right\n0,1\n"), HasSubstr("another first line"));
  EXPECT_THAT(complaint("# handway postures 1\nleft\n0\n"), HasSubstr("hand: found nothing"));
  EXPECT_THAT(complaint(kHead + std::string("left,left\n0,1\n")), HasSubstr("\"left\" twice"));
  EXPECT_THAT(complaint(kHead + std::string("left,\n0,1\n")), HasSubstr("without a name"));
  EXPECT_THAT(complaint(kHead + std::string("left,right\n0,1,1\n")), HasSubstr("3 values"));
  EXPECT_THAT(complaint(kHead + std::string("left,right\n")), HasSubstr("no rows"));
  EXPECT_THAT(complaint(""), HasSubstr("postures of a hand"));
}

TEST_F(PostureTableFile, WantsANameForEveryColumn) {
  EXPECT_THROW(write_postures({"claw", "", {"left"}, Eigen::MatrixXd::Zero(1, 2)}, file()),
               std::invalid_argument);
}

}  // namespace
}  // namespace handway::sampling
