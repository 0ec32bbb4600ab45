#include "handway_test/real_time.h"
#include "watched_application.h"
#include "widgets/style/theme.h"

#include <QSettings>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#ifdef HANDWAY_SANITIZED
// Modules stay until the process ends: of what one has left behind that is gone, LeakSanitizer
// can't tell whose it was, and whether lsan.supp names it.
extern "C" [[gnu::visibility("default")]] int dlclose(void* /*module*/) { return 0; }
#endif

namespace {

// Without a display there is no application: tests that need one skip.
int run_tests(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  std::unique_ptr<handway::test::WatchedApplication> application;
  const QTemporaryDir settings;
  if (qEnvironmentVariableIsEmpty("HANDWAY_TEST_DATA")) {
    qputenv("XDG_DATA_HOME", settings.path().toUtf8());
  } else {  // of the test that started this program
    qputenv("XDG_DATA_HOME", qgetenv("HANDWAY_TEST_DATA"));
  }
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, settings.path());
  if (!::testing::GTEST_FLAG(list_tests) && std::getenv("DISPLAY")) {
    QCoreApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
    application = std::make_unique<handway::test::WatchedApplication>(argc, argv);
    QApplication::setOrganizationName(QStringLiteral("handway"));
    QApplication::setApplicationName(QStringLiteral("handway-test"));
    handway::gui::apply_theme(*application, handway::gui::Theme::kLight);
  }
  return RUN_ALL_TESTS();
}

}  // namespace

int main(int argc, char** argv) { return handway::test::run_in_real_time(argc, argv, run_tests); }
