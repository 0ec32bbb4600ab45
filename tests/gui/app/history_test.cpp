/// One history for everything that a person does, and leaving a scene.
#include "features/editing/editing_test.h"
#include "features/glove/glove_panel.h"
#include "features/glove/mapping_editor.h"
#include "features/glove/mapping_wires.h"

#include <QComboBox>
#include <QFileDialog>
#include <QFileIconProvider>
#include <QMessageBox>
#include <QPushButton>
#include <QSpinBox>
#include <QTabWidget>
#include <QTimer>
#include <QUndoView>
#include <QUrl>

#include <handway_test/paths.h>

namespace handway::test {
namespace {

class History : public EditingTest {
 protected:
  [[nodiscard]] gui::PlanSettings& settings() const { return window().workbench().plan_settings; }
  [[nodiscard]] QStringList entries() const {
    QStringList texts;
    for (int i = 0; i < editor().undo_stack().count(); ++i) {
      texts << editor().undo_stack().text(i);
    }
    return texts;
  }
  void undo() const {
    actions().undo->trigger();
    QTest::qWait(20);
  }
  void settle() const { QTest::qWait(20); }
  /// Presses a button of the question that comes up. @returns whether there was one.
  template <typename Step>
  bool answer(QMessageBox::StandardButton button, const Step& step) const {
    bool was_asked = false;
    QTimer::singleShot(100, [&] {
      if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
        was_asked = true;
        box->button(button)->click();
      }
    });
    step();
    QTest::qWait(150);
    return was_asked;
  }
};

TEST_F(History, HoldsScenePlannerAndMapping) {
  select("post");
  editor().place(geometric::Pose(Eigen::Translation3d(0.5, 0.5, 0.0)));
  const std::string planner = settings().choice().name;
  part<QComboBox>("planners").setCurrentText(QStringLiteral("pmd-prm"));
  settle();
  const int k = part<QSpinBox>("k").value();
  part<QSpinBox>("k").setValue(k + 3);
  settle();
  part<QSpinBox>("seed").setValue(17);
  settle();
  editor().set_goal(geometric::Configuration::Constant(4, 0.1));
  auto& mapping = tool<gui::GlovePanel>().mapping_editor();
  auto& wires = *mapping.findChild<gui::MappingWires*>();
  const auto& mapped = [&]() -> const device::JointMapping& {
    return tool<gui::GlovePanel>().session().mapping().joints[2];
  };
  const int sensor = mapped().sensor;
  emit wires.connected(2, sensor + 1);
  EXPECT_EQ(entries(),
            (QStringList{"Move post", "Plan with pmd-prm", "Set k of pmd-prm", "Set seed",
                         "Set goal", "Wire " + QString::fromStdString(mapped().joint)}));
  undo();
  EXPECT_EQ(mapped().sensor, sensor);
  undo();
  EXPECT_DOUBLE_EQ((*scene().goal)[0], 1.5);
  undo();
  EXPECT_EQ(part<QSpinBox>("seed").value(), 1);
  undo();
  EXPECT_EQ(part<QSpinBox>("k").value(), k);
  undo();
  EXPECT_EQ(settings().choice().name, planner);
  EXPECT_EQ(part<QComboBox>("planners").currentText().toStdString(), planner);
  undo();
  EXPECT_FALSE(editor().undo_stack().canUndo());
  EXPECT_EQ(editor().undo_stack().count(), 6) << "undoing is no edit";
}

TEST_F(History, AClickOnAnEntryGoesThere) {
  editor().add("box", geometric::Box{}, {}, {0.0, -0.5, 0.0});
  settings().set_seed(5);
  settle();
  editor().add("ball", geometric::Sphere{}, {}, {0.3, -0.5, 0.0});
  show_dock("history");
  auto& list = *part<QWidget>("history").findChild<QUndoView*>();
  EXPECT_EQ(list.model()->index(0, 0).data().toString(), QStringLiteral("As opened"));
  QTest::mouseClick(list.viewport(), Qt::LeftButton, {},
                    list.visualRect(list.model()->index(1, 0)).center());
  settle();
  EXPECT_EQ(scene().objects.size(), 2U);
  EXPECT_EQ(settings().request().seed, 1U);
  EXPECT_EQ(editor().undo_stack().count(), 3);
  QTest::mouseClick(list.viewport(), Qt::LeftButton, {},
                    list.visualRect(list.model()->index(3, 0)).center());
  settle();
  EXPECT_EQ(scene().objects.size(), 3U);
  EXPECT_EQ(settings().request().seed, 5U);
}

TEST_F(History, SettingsAloneAreNoUnsavedWork) {
  settings().set_seed(5);
  settle();
  EXPECT_TRUE(editor().undo_stack().canUndo());
  EXPECT_FALSE(window().isWindowModified());
  editor().add("box", geometric::Box{}, {}, {0.0, -0.5, 0.0});
  EXPECT_TRUE(window().isWindowModified());
  settings().choose_planner("pmd-prm");
  settle();
  undo();
  EXPECT_TRUE(window().isWindowModified());
  undo();
  EXPECT_FALSE(window().isWindowModified());
}

TEST_F(History, BeginsAnewWithEachScene) {
  open(cell().wall());
  settle();
  EXPECT_EQ(entries(), QStringList());
}

TEST_F(History, ClosingASceneGoesBackToTheStartPage) {
  plan();
  editor().select({gui::SceneItem::Kind::kObject, "", "post"});
  auto& close = part<QAction>("close_scene");
  close.trigger();
  QTest::qWait(50);
  EXPECT_TRUE(part<QWidget>("start_page").isVisible());
  EXPECT_EQ(window().windowTitle(), QStringLiteral("Handway"));
  EXPECT_EQ(window().document().scene(), nullptr);
  EXPECT_FALSE(close.isEnabled());
  for (const QAction* action : {actions().paste, actions().duplicate, actions().palm}) {
    EXPECT_FALSE(action->isEnabled()) << action->text().toStdString();
  }
  // All parts of the window work without a scene.
  auto& tabs = part<QTabWidget>("control_tabs");
  for (int i = 0; i < tabs.count(); ++i) {
    tabs.setCurrentIndex(i);
    QTest::qWait(20);
  }
  open(cell().wall());
  EXPECT_TRUE(window().view().isVisible());
  plan();
}

TEST_F(History, TheOpenDialogHasTheScenesThatShipWithPictures) {
  QList<QUrl> places;
  QIcon picture, plain;
  QTimer::singleShot(300, [&] {
    if (auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget())) {
      places = dialog->sidebarUrls();
      const QString scenes = QString::fromStdString((source_dir() / "scenes").string());
      picture = dialog->iconProvider()->icon(QFileInfo(scenes + "/can_on_table.yaml"));
      plain =
          dialog->iconProvider()->icon(QFileInfo(QString::fromStdString(cell().post().string())));
      dialog->reject();
    }
  });
  part<QAction>("open").trigger();
  const auto folder = [](const std::filesystem::path& path) {
    return QUrl::fromLocalFile(QString::fromStdString(path.string()));
  };
  EXPECT_TRUE(places.contains(folder(source_dir() / "scenes")));
  EXPECT_TRUE(places.contains(folder(cell().folder()))) << "of the scene that was opened last";
  EXPECT_GT(picture.availableSizes().value(0).width(), 90);
  EXPECT_NE(picture.cacheKey(), plain.cacheKey());
}

TEST_F(History, ClosingASceneAsksAboutUnsavedWork) {
  auto& close = part<QAction>("close_scene");
  EXPECT_EQ(close.shortcut(), QKeySequence(QStringLiteral("Ctrl+W")));
  editor().add("box", geometric::Box{}, {}, {0.0, -0.5, 0.0});
  EXPECT_TRUE(answer(QMessageBox::Cancel, [&] { close.trigger(); }));
  EXPECT_TRUE(window().document().scene());
  EXPECT_TRUE(answer(QMessageBox::Discard, [&] { close.trigger(); }));
  EXPECT_FALSE(window().document().scene());
  EXPECT_FALSE(window().isWindowModified());
}

}  // namespace
}  // namespace handway::test
