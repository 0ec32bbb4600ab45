/// File > Export the path: nothing is written that was not cleared and seen before.
#include "features/export/export_dialog.h"

#include "features/editing/scene_editing.h"
#include "handway/planning/edits/scene_edits.h"
#include "handway/planning/extensions/plugin.h"
#include "patience.h"
#include "window_test.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPlainTextEdit>
#include <QPushButton>

#include <fstream>

namespace handway::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class ExportDialogTest : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) {
      return;
    }
    open(cell().post());
    plan();
    auto plugins = std::make_shared<planning::PluginManager>();
    plugins->load_plugins(planning::plugin_directory());
    dialog_ = new gui::ExportDialog(plugins, window().document(),
                                    window().player().timeline().path(), "Small cell", &window());
    dialog_->set_folder(QString::fromStdString((folder_.path() / "out").string()));
    dialog_->choose_format("csv");
    dialog_->open();
  }

  template <typename Widget>
  [[nodiscard]] Widget& field(const char* name) const {
    return *dialog_->findChild<Widget*>(QLatin1String(name));
  }
  /// Waits until the path may be exported. At full speed it passes the post at less than the
  /// assumed following error, which is confirmed.
  [[nodiscard]] bool is_ready() const {
    auto& too_close = field<QCheckBox>("export_too_close");
    return QTest::qWaitFor(
        [&] {
          if (too_close.isVisible() && !too_close.isChecked()) {
            too_close.click();
          }
          return field<QPushButton>("export_now").isEnabled();
        },
        kPatienceMs);
  }

  ScratchFolder folder_;
  gui::ExportDialog* dialog_ = nullptr;  ///< The window's; gone when it is closed.
};

TEST_F(ExportDialogTest, ShowsTheFilesBeforeItWritesThem) {
  ASSERT_TRUE(is_ready());
  EXPECT_THAT(field<QLabel>("export_report").text().toStdString(),
              AllOf(HasSubstr("Cleared"), HasSubstr("The motion takes"),
                    HasSubstr("No acceleration limits given")));
  ASSERT_EQ(field<QListWidget>("export_files").count(), 1);
  // Only the beginning of a long file is shown.
  const std::string shown = field<QPlainTextEdit>("export_content").toPlainText().toStdString();
  EXPECT_THAT(shown, HasSubstr("shoulder"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out"));
  QStringList written;
  QObject::connect(dialog_, &gui::ExportDialog::exported, &window(),
                   [&](const QStringList& files) { written = files; });
  field<QPushButton>("export_now").click();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !written.isEmpty(); }, kPatienceMs));
  std::ifstream file(folder_.path() / "out" / "Small_cell.csv");
  const std::string content(std::istreambuf_iterator<char>(file), {});
  EXPECT_EQ(content.substr(0, 1000), shown.substr(0, 1000));
}

TEST_F(ExportDialogTest, StaysOpenForOtherFormatsAndListsWhatItWrote) {
  ASSERT_TRUE(is_ready());
  const auto& written = field<QListWidget>("export_written");
  EXPECT_FALSE(written.isVisible());
  for (int exports = 1; exports <= 2; ++exports) {
    field<QPushButton>("export_now").click();
    ASSERT_TRUE(QTest::qWaitFor([&] { return written.count() == exports; }, kPatienceMs));
    EXPECT_TRUE(dialog_->isEnabled());
  }
  EXPECT_TRUE(written.isVisible());
  EXPECT_TRUE(field<QPushButton>("export_open_folder").isVisible());
  EXPECT_THAT(written.item(0)->text().toStdString(),
              AllOf(HasSubstr("csv: 1 file in "), HasSubstr("out")));
}

TEST_F(ExportDialogTest, AsksForAConfirmationWhereThePathIsTooClose) {
  auto& too_close = field<QCheckBox>("export_too_close");
  auto& now = field<QPushButton>("export_now");
  const auto& files = field<QListWidget>("export_files");
  ASSERT_TRUE(QTest::qWaitFor([&] { return files.count() == 1; }, kPatienceMs));
  EXPECT_THAT(field<QLabel>("export_report").text().toStdString(), HasSubstr("too close"));
  ASSERT_TRUE(too_close.isVisible());
  EXPECT_FALSE(too_close.isChecked());
  EXPECT_FALSE(now.isEnabled());
  too_close.click();
  EXPECT_TRUE(now.isEnabled());
  too_close.click();
  EXPECT_FALSE(now.isEnabled());
  too_close.click();
  field<QDoubleSpinBox>("speed").setValue(0.5);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !too_close.isChecked(); }, kPatienceMs))
      << "it holds for one motion";
  EXPECT_FALSE(now.isEnabled());
  field<QDoubleSpinBox>("speed").setValue(0.05);
  ASSERT_TRUE(QTest::qWaitFor([&] { return now.isEnabled(); }, kPatienceMs)) << "slow enough";
  EXPECT_FALSE(too_close.isVisible());
}

TEST_F(ExportDialogTest, TimesAgainAtAnotherSpeed) {
  ASSERT_TRUE(is_ready());
  const QString fast = field<QPlainTextEdit>("export_content").toPlainText();
  field<QDoubleSpinBox>("speed").setValue(0.5);
  EXPECT_FALSE(field<QPushButton>("export_now").isEnabled());
  ASSERT_TRUE(is_ready());
  EXPECT_NE(field<QPlainTextEdit>("export_content").toPlainText(), fast);
}

TEST_F(ExportDialogTest, ExportsNothingThatWasTimedBeforeAnEdit) {
  ASSERT_TRUE(is_ready());
  gui::SceneEditor& editor = window().editor();
  const auto add = [&](double x) {
    geometric::SceneObject wall;
    wall.name = "wall";
    wall.shape = geometric::Box{{0.02, 0.02, 3.0}};
    wall.X_PO.translation().x() = x;
    editor.apply("Add a wall", planning::with_object(editor.state(), wall), {"wall"});
  };
  add(-2.0);
  EXPECT_FALSE(field<QPushButton>("export_now").isEnabled()) << "at once";
  ASSERT_TRUE(is_ready()) << "it is out of the way";
  editor.undo_stack().undo();
  add(0.2);  // where the arm starts
  EXPECT_FALSE(field<QPushButton>("export_now").isEnabled());
  auto& report = field<QLabel>("export_report");
  ASSERT_TRUE(QTest::qWaitFor([&] { return report.text().contains(QStringLiteral("Not cleared")); },
                              kPatienceMs))
      << report.text().toStdString();
  EXPECT_FALSE(field<QPushButton>("export_now").isEnabled());
}

TEST_F(ExportDialogTest, StaysOpenAndSaysWhyAFolderCannotBeWritten) {
  std::ofstream(folder_.path() / "file") << "in the way";
  dialog_->set_folder(QString::fromStdString((folder_.path() / "file" / "out").string()));
  ASSERT_TRUE(is_ready());
  field<QPushButton>("export_now").click();
  auto& problem = field<QLabel>("export_problem");
  ASSERT_TRUE(QTest::qWaitFor([&] { return problem.isVisible(); }, kPatienceMs));
  EXPECT_THAT(problem.text().toStdString(), HasSubstr("file"));
  EXPECT_TRUE(dialog_->isVisible());
}

}  // namespace
}  // namespace handway::test
