#include "widgets/forms/file_dialogs.h"

#include <QAbstractButton>
#include <QApplication>
#include <QFile>
#include <QFileDialog>
#include <QLineEdit>
#include <QMessageBox>
#include <QTemporaryDir>
#include <QTimer>

#include <gtest/gtest.h>

namespace handway::test {
namespace {

class WhereToSave : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!QCoreApplication::instance()) {
      GTEST_SKIP() << "no display";
    }
  }

  /// Types the name, accepts, and takes back what is asked about a file that is there.
  QString answer(const QString& name, const char* filter = nullptr) {
    QTimer::singleShot(0, &folder_, [this, name, filter] { type(name, filter); });
    return gui::ask_where_to_save(nullptr, QStringLiteral("Save"),
                                  folder_.filePath("proposed.yaml"),
                                  QStringLiteral("Scenes (*.yaml);;Tables (*.csv *.txt)"));
  }
  void make(const char* name) const {
    QFile file(folder_.filePath(QLatin1String(name)));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  }
  [[nodiscard]] QString path(const char* name) const {
    return folder_.filePath(QLatin1String(name));
  }
  int asked_ = 0;

 private:
  struct Folder : public QObject, public QTemporaryDir {};

  void type(const QString& name, const char* filter) {
    auto& dialog = *qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    if (filter) {
      dialog.selectNameFilter(QLatin1String(filter));
      emit dialog.filterSelected(QLatin1String(filter));
    }
    dialog.findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))->setText(name);
    QTimer::singleShot(0, &folder_, [this, &dialog] {
      if (auto* question = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
        ++asked_;
        question->button(QMessageBox::No)->click();
        dialog.reject();
      }
    });
    QMetaObject::invokeMethod(&dialog, "accept");
  }

  Folder folder_;
};

TEST_F(WhereToSave, GivesNamesTheEndingOfTheChosenType) {
  EXPECT_EQ(answer("scene"), path("scene.yaml"));
  EXPECT_EQ(answer("scene", "Tables (*.csv *.txt)"), path("scene.csv"));
  EXPECT_EQ(answer("scene.yml"), path("scene.yml"));
}

// The ending came after the question, and the file that is there was lost.
TEST_F(WhereToSave, AsksBeforeAFileIsReplacedWhoseEndingWasLeftOut) {
  make("scene.yaml");
  EXPECT_EQ(answer("scene"), QString());
  EXPECT_EQ(asked_, 1);
}

}  // namespace
}  // namespace handway::test
