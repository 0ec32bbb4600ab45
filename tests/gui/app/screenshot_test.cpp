#include "handway_test/resource_use.h"
#include "small_cell.h"
#include "window_test.h"

#include <QImage>
#include <QProcess>
#include <QProcessEnvironment>

#include <fstream>

namespace handway::test {
namespace {

using ::testing::HasSubstr;

class Screenshot : public ::testing::Test {
 protected:
  void SetUp() override {
    HANDWAY_NEED_DISPLAY();
    ignore_leaks_of_children();
  }

  int run(const QStringList& arguments) {
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QStringLiteral("XDG_CONFIG_HOME"), path("config"));
    QProcess program;
    program.setProcessEnvironment(environment);
    program.start(QStringLiteral(HANDWAY_WORKBENCH), arguments);
    EXPECT_TRUE(program.waitForFinished(30000));
    said_ = program.readAllStandardError().toStdString();
    return program.exitCode();
  }
  [[nodiscard]] QString path(const char* name) const {
    return QString::fromStdString((cell_.folder() / name).string());
  }

  SmallCell cell_;
  std::string said_;
};

TEST_F(Screenshot, HasTheSizeAskedFor) {
  ASSERT_EQ(run({QString::fromStdString(cell_.post().string()), "--screenshot", path("out.png"),
                 "--size", "900x600", "--play"}),
            0)
      << said_;
  const QImage picture(path("out.png"));
  EXPECT_EQ(picture.size(), QSize(900, 600));
}

TEST_F(Screenshot, IsRefusedForABrokenFile) {
  EXPECT_EQ(run({QString::fromStdString(cell_.broken().string()), "--screenshot", path("out.png")}),
            3);
  EXPECT_THAT(said_, HasSubstr("broken.yaml:5"));
  EXPECT_FALSE(std::filesystem::exists(cell_.folder() / "out.png"));
}

TEST_F(Screenshot, ShowsAPathOfAFile) {
  std::ofstream(cell_.folder() / "arm.csv") << "time,shoulder,elbow\n0,0,0\n1,0,1.5\n";
  const QString scene = QString::fromStdString(cell_.post_aside().string());
  ASSERT_EQ(run({scene, "--screenshot", path("still.png"), "--view-only"}), 0) << said_;
  ASSERT_EQ(
      run({scene, "--path", path("arm.csv"), "--screenshot", path("moved.png"), "--view-only"}), 0)
      << said_;
  EXPECT_NE(QImage(path("still.png")), QImage(path("moved.png")));
}

TEST_F(Screenshot, IsRefusedForAPathThatCannotBeRead) {
  EXPECT_EQ(run({QString::fromStdString(cell_.post().string()), "--path", path("none.csv"),
                 "--screenshot", path("out.png")}),
            3);
  EXPECT_THAT(said_, HasSubstr("none.csv"));
}

TEST_F(Screenshot, NeedsASizeThatMakesSense) {
  EXPECT_EQ(run({"--screenshot", path("out.png"), "--size", "big"}), 2);
  EXPECT_THAT(said_, HasSubstr("WIDTHxHEIGHT"));
}

TEST_F(Screenshot, NamesThePlannersThatThereAre) {
  EXPECT_EQ(run({QString::fromStdString(cell_.post().string()), "--screenshot", path("out.png"),
                 "--planner", "guess"}),
            3);
  EXPECT_THAT(said_, ::testing::AllOf(HasSubstr("guess"), HasSubstr("rrt-connect")));
}

}  // namespace
}  // namespace handway::test
