#include "style/theme.h"

#include <QApplication>
#include <QSettings>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

// Without a display there is no application: tests that need one skip.
int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  std::unique_ptr<QApplication> application;
  const QTemporaryDir settings;
  if (qEnvironmentVariableIsEmpty("HANDWAY_TEST_DATA")) {
    qputenv("XDG_DATA_HOME", settings.path().toUtf8());
  } else {  // of the test that started this program
    qputenv("XDG_DATA_HOME", qgetenv("HANDWAY_TEST_DATA"));
  }
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, settings.path());
  if (!::testing::GTEST_FLAG(list_tests) && std::getenv("DISPLAY")) {
    application = std::make_unique<QApplication>(argc, argv);
    QApplication::setOrganizationName(QStringLiteral("handway"));
    QApplication::setApplicationName(QStringLiteral("handway-test"));
    handway::gui::apply_theme(*application, handway::gui::Theme::kLight);
  }
  return RUN_ALL_TESTS();
}
