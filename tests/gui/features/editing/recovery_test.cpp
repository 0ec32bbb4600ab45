#include "features/editing/editing_test.h"
#include "features/editing/scene_editing.h"
#include "full_disk.h"
#include "handway/geometric/formats/scene_file.h"
#include "patience.h"

#include <QProcess>
#include <QPushButton>
#include <QSignalSpy>

#include <csignal>

namespace handway::test {
namespace {

using ::testing::HasSubstr;

class RecoveringWork : public EditingTest {
 protected:
  [[nodiscard]] static std::filesystem::path folder() { return gui::Autosave::default_folder(); }
  /// The copy of the scene that this window keeps.
  [[nodiscard]] static std::filesystem::path kept() {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder())) {
      if (entry.path().extension() == ".yaml") {
        return entry.path();
      }
    }
    throw std::runtime_error("no copy of the scene");
  }
  [[nodiscard]] static bool comes(QSignalSpy& spy) {
    return QTest::qWaitFor([&] { return !spy.isEmpty(); }, kPatienceMs);
  }
};

/// This is not a test of its own: the test below runs it in another process, and kills it.
TEST_F(RecoveringWork, DISABLED_WorkThatIsKilled) {
  open(QString::fromLocal8Bit(qgetenv("HANDWAY_TEST_SCENE")).toStdString());
  QSignalSpy stored(&tool<gui::Recovery>().autosave(), &gui::Autosave::stored);
  select("post");
  editor().place(geometric::Pose(Eigen::Translation3d(0.6, 0.4, 0.0)));
  editor().add("box", geometric::Box{}, {}, {0.6, 0.0, 0.0});
  editor().add("box", geometric::Box{}, {}, {0.9, 0.0, 0.0});
  editor().select_objects({"box", "box 2"});
  tool<gui::ArrangeActions>().make_group();
  editor().set_hidden({"box"}, true);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !stored.isEmpty(); }));
  QTest::qWait(500);
  editor().add("lost", geometric::Sphere{}, {}, {0.0, 0.0, 0.0});
  (void)std::raise(SIGKILL);
}

TEST_F(RecoveringWork, LosesAtMostOneEditWhenItIsKilled) {
  QProcess killed;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert("HANDWAY_TEST_DATA", QString::fromLocal8Bit(qgetenv("XDG_DATA_HOME")));
  environment.insert("HANDWAY_TEST_SCENE", QString::fromStdString(cell().post().string()));
  killed.setProcessEnvironment(environment);
  killed.start(QCoreApplication::applicationFilePath(),
               {"--gtest_filter=RecoveringWork.DISABLED_WorkThatIsKilled",
                "--gtest_also_run_disabled_tests"});
  ASSERT_TRUE(killed.waitForFinished(kPatienceMs));
  ASSERT_EQ(killed.exitStatus(), QProcess::CrashExit) << killed.readAll().toStdString();

  window().begin({});
  ASSERT_TRUE(part<QPushButton>("banner_accept").isVisible());
  EXPECT_THAT(window().message().toStdString(), HasSubstr("Small cell"));
  QSignalSpy ready(&window(), &gui::MainWindow::ready);
  QSignalSpy stored(&tool<gui::Recovery>().autosave(), &gui::Autosave::stored);
  click("banner_accept");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !ready.isEmpty(); }));
  EXPECT_DOUBLE_EQ(object("post").X_PO.translation().x(), 0.6);
  EXPECT_EQ(display("box 2").group, "group");
  EXPECT_TRUE(display("box").hidden);
  EXPECT_TRUE(window().isWindowModified()) << "still to be saved";
  EXPECT_EQ(window().document().file(), cell().post());
  EXPECT_TRUE(QTest::qWaitFor([&] {
    return !stored.isEmpty() && tool<gui::Recovery>().autosave().find_lost().empty();
  })) << "offered once";

  ready.clear();
  window().workbench().document.open(cell().post_aside());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !ready.isEmpty(); }));
  EXPECT_FALSE(window().isWindowModified()) << "nothing of the scene that was opened next";
}

TEST_F(RecoveringWork, KeepsTheLastCopyWhileTheDiskIsFullAndSaysSoOnce) {
  QSignalSpy stored(&tool<gui::Recovery>().autosave(), &gui::Autosave::stored);
  QSignalSpy not_stored(&tool<gui::Recovery>().autosave(), &gui::Autosave::failed);
  QSignalSpy told(&tool<gui::Recovery>(), &gui::Recovery::failed);
  editor().add("first", geometric::Box{}, {}, {0.6, 0.0, 0.0});
  ASSERT_TRUE(comes(stored));
  {
    const FullDisk full;
    for (const char* name : {"second", "third"}) {
      not_stored.clear();
      editor().add(name, geometric::Box{}, {}, {0.9, 0.0, 0.0});
      ASSERT_TRUE(comes(not_stored));
    }
  }
  ASSERT_EQ(told.size(), 1);
  EXPECT_THAT(told.front().front().toString().toStdString(), HasSubstr("File too large"));
  EXPECT_EQ(geometric::read_scene(kept()).objects.back().name, "first");

  stored.clear();
  editor().add("fourth", geometric::Box{}, {}, {0.9, 0.3, 0.0});
  ASSERT_TRUE(comes(stored));
  EXPECT_EQ(geometric::read_scene(kept()).objects.size(), 5U) << "all, with the post";
}

TEST_F(RecoveringWork, LeavesTheFileAloneWhenItCannotBeSaved) {
  editor().add("box", geometric::Box{}, {}, {0.6, 0.0, 0.0});
  {
    const FullDisk full;
    for (QAction* action : window().findChildren<QAction*>()) {
      if (action->shortcut() == QKeySequence::Save) {
        action->trigger();
      }
    }
  }
  EXPECT_THAT(window().message().toStdString(), HasSubstr("File too large"));
  EXPECT_TRUE(window().isWindowModified());
  EXPECT_EQ(geometric::read_scene(cell().folder() / "scene.yaml").objects.size(), 1U);
  EXPECT_TRUE(std::filesystem::is_regular_file(cell().folder() / "scene.yaml"));
}

TEST_F(RecoveringWork, OffersNothingWhenAllIsSaved) {
  QSignalSpy stored(&tool<gui::Recovery>().autosave(), &gui::Autosave::stored);
  select("post");
  editor().remove();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !stored.isEmpty(); }));
  stored.clear();
  editor().undo_stack().undo();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !stored.isEmpty(); }));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder())) {
    EXPECT_NE(entry.path().extension(), ".yaml") << entry.path();
  }
}

// A window that is open is not lost.
TEST_F(RecoveringWork, LeavesOtherWindowsAlone) {
  QSignalSpy stored(&tool<gui::Recovery>().autosave(), &gui::Autosave::stored);
  select("post");
  editor().remove();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !stored.isEmpty(); }));
  const gui::Autosave other(folder());
  EXPECT_TRUE(other.find_lost().empty());
}

}  // namespace
}  // namespace handway::test
