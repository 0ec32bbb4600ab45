/// window_memory FILE…: opens scenes in the window, one after the other, plans each, and prints
/// what memory the program then has for itself (not mapped from files), in MB.
#include "app/main_window.h"
#include "patience.h"
#include "widgets/style/theme.h"

#include <QApplication>
#include <QSignalSpy>
#include <QTest>

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <string>

namespace handway::test {
namespace {

double anonymous_memory() {
  std::ifstream rollup("/proc/self/smaps_rollup");
  for (std::string word; rollup >> word;) {
    if (word == "Anonymous:") {
      double kilobytes = 0.0;
      rollup >> kilobytes;
      return kilobytes / 1024.0;
    }
  }
  throw std::runtime_error("no /proc/self/smaps_rollup");
}

// Unused memory is given back in the background, a second after the last work.
double memory_at_rest() {
  double memory = 0.0;
  double before = 0.0;
  do {
    before = memory;
    QTest::qWait(2500);
    memory = anonymous_memory();
  } while (std::abs(memory - before) > 0.01 * memory);
  return memory;
}

void open_and_plan(gui::MainWindow& window, const QString& file) {
  QSignalSpy ready(&window, &gui::MainWindow::ready);
  QSignalSpy failed(&window, &gui::MainWindow::failed);
  window.open(file);
  if (!QTest::qWaitFor([&] { return !ready.isEmpty() || !failed.isEmpty(); }, kPatienceMs) ||
      !failed.isEmpty()) {
    throw std::runtime_error("can't open " + file.toStdString());
  }
  QSignalSpy ended(&window.session(), &gui::PlanningSession::ended);
  window.session().start();
  (void)QTest::qWaitFor([&] { return !ended.isEmpty(); }, kPatienceMs);
  window.player().seek(0.5);
  (void)QTest::qWaitFor([&] { return !window.workbench().is_busy(); }, kPatienceMs);
}

void run(const QStringList& files) {
  auto plugins = std::make_shared<planning::PluginManager>();
  plugins->load_plugins(planning::plugin_directory());
  gui::MainWindow window(plugins);
  window.resize(1440, 900);
  window.show();
  (void)QTest::qWaitForWindowExposed(&window);
  for (const QString& file : files) {
    open_and_plan(window, file);
  }
  fmt::print("{:.1f}\n", memory_at_rest());
}

}  // namespace
}  // namespace handway::test

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  handway::gui::apply_theme(application, handway::gui::Theme::kLight, 1.0);
  try {
    handway::test::run(QApplication::arguments().mid(1));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
