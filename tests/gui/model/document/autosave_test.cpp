#include "model/document/autosave.h"

#include "handway/geometric/formats/scene_file.h"
#include "handway/planning/extensions/load_scene.h"
#include "patience.h"
#include "small_cell.h"
#include "window_test.h"

#include <QProcess>
#include <QSignalSpy>
#include <QThread>

#include <iostream>

namespace handway::test {
namespace {

/// This is not a test of its own: it stores a scene with more and more objects, and prints how
/// many.
TEST(Autosave, DISABLED_StoresWithoutEnd) {
  HANDWAY_NEED_DISPLAY();
  const std::filesystem::path file =
      QString::fromLocal8Bit(qgetenv("HANDWAY_TEST_SCENE")).toStdString();
  gui::UnsavedScene unsaved{planning::load_scene(file, {}), {}, {}, file, {}};
  unsaved.shown = unsaved.loaded.scene->robots.front().configuration;
  gui::Autosave autosave(gui::Autosave::default_folder());
  QSignalSpy stored(&autosave, &gui::Autosave::stored);
  for (int count = 2; count < 100000; ++count) {
    geometric::Scene scene = *unsaved.loaded.scene;
    scene.objects.push_back(scene.objects.front());
    scene.objects.back().name = "box " + std::to_string(count);
    unsaved.loaded.scene = std::make_shared<const geometric::Scene>(std::move(scene));
    autosave.store(unsaved);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !stored.isEmpty(); }, kPatienceMs));
    std::cout << "stored " << count << std::endl;
    stored.clear();
  }
}

// The stored scene is there and complete, whenever the program is killed.
TEST(Autosave, KeepsWhatWasStoredWheneverItIsKilled) {
  HANDWAY_NEED_DISPLAY();
  const SmallCell cell;
  const gui::Autosave finder(gui::Autosave::default_folder());
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert("HANDWAY_TEST_DATA", QString::fromLocal8Bit(qgetenv("XDG_DATA_HOME")));
  environment.insert("HANDWAY_TEST_SCENE", QString::fromStdString(cell.post().string()));
  for (const unsigned long later_ms : {0, 1, 3, 7, 12}) {
    QProcess killed;
    killed.setProcessEnvironment(environment);
    killed.setProcessChannelMode(QProcess::MergedChannels);  // what it died of, if not of us
    killed.start(
        QCoreApplication::applicationFilePath(),
        {"--gtest_filter=Autosave.DISABLED_StoresWithoutEnd", "--gtest_also_run_disabled_tests"});
    QByteArray said;
    while (said.count("stored ") < 3 && killed.waitForReadyRead(kPatienceMs)) {
      said += killed.readAll();
    }
    QThread::msleep(later_ms);
    killed.kill();
    ASSERT_TRUE(killed.waitForFinished(kPatienceMs));
    said += killed.readAll();
    const int told = said.count("stored ");
    ASSERT_GE(told, 3) << said.toStdString();
    const std::vector<gui::LostScene> lost = finder.find_lost();
    ASSERT_EQ(lost.size(), 1U);
    EXPECT_GE(static_cast<int>(geometric::read_scene(lost.front().scene).objects.size()), 1 + told);
    EXPECT_EQ(lost.front().file, cell.post());
    gui::Autosave::forget(lost.front());
  }
}

}  // namespace
}  // namespace handway::test
