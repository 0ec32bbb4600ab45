#include "window_test.h"

#include "patience.h"
#include "watched_application.h"

#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTextDocument>

namespace handway::test {

void WindowTest::SetUp() {
  HANDWAY_NEED_DISPLAY();
  window_ = std::make_unique<gui::MainWindow>(plugins());
  window_->resize(1024, 700);
  window_->show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
  WatchedApplication::forget();
}

std::shared_ptr<planning::PluginManager> WindowTest::plugins() const {
  return std::make_shared<planning::PluginManager>();
}

void WindowTest::TearDown() {
  if (window_) {
    expect_no_stall();
  }
}

void WindowTest::open(const std::filesystem::path& file) {
  QSignalSpy ready(window_.get(), &gui::MainWindow::ready);
  QSignalSpy failed(window_.get(), &gui::MainWindow::failed);
  window_->open(QString::fromStdString(file.string()));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !ready.isEmpty() || !failed.isEmpty(); }, kPatienceMs));
}

void WindowTest::plan() {
  QSignalSpy ended(&window_->session(), &gui::PlanningSession::ended);
  click("plan");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !ended.isEmpty(); }, kPatienceMs));
}

void WindowTest::click(const char* button) const {
  QTest::mouseClick(&part<QAbstractButton>(button), Qt::LeftButton);
}

void WindowTest::show_dock(const char* name) const {
  auto& dock = part<QDockWidget>(name);
  dock.show();
  dock.raise();
  QTest::qWait(50);
}

void WindowTest::keep_picture(const char* name) const {
  const QString folder = qEnvironmentVariable("HANDWAY_PICTURES");
  if (!folder.isEmpty()) {
    window_->resize(1440, 900);
    QTest::qWait(200);
    EXPECT_TRUE(window_->grab().save(QStringLiteral("%1/%2.png").arg(folder, QLatin1String(name))));
  }
}

std::string WindowTest::result() const {
  QTextDocument text;
  text.setHtml(part<QLabel>("result").text());
  return text.toPlainText().toStdString();
}

}  // namespace handway::test
