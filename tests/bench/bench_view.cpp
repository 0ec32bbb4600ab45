/// Measures the frames per second of the 3-D view for the scenes that ship, at 1280 x 800: while
/// the view turns, and while the robot moves, and the processor time of a frame, which depends less
/// on other load; as the baseline, the view turns with smooth edges and all triangles, as frames
/// are drawn at rest; and the share of a processor that an open scene needs while nothing moves.
///
///     bench_view [SECONDS] [SCENE...]
///
/// The ratio is that of processor time, baseline to turning. It needs a display, for example
/// xvfb-run. The exit code is 1 if any motion has less than 30 frames per second.
#include "handway/geometric/formats/scene_file.h"
#include "handway_test/paths.h"
#include "handway_test/resource_use.h"
#include "view3d/scene_view.h"
#include "widgets/style/theme.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QTimer>

#include <GL/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <vector>

namespace {

namespace geometric = handway::geometric;
namespace gui = handway::gui;
namespace fs = std::filesystem;

constexpr double kEnough = 30.0;  // pictures a second
constexpr double kTurn = 1.0;     // rad/s
constexpr double kSwing = 2.0;    // s from start to goal and back

double cpu_seconds() { return handway::test::cpu_seconds(CLOCK_PROCESS_CPUTIME_ID); }

void wait(double seconds) {
  QEventLoop loop;
  QTimer::singleShot(static_cast<int>(1e3 * seconds), &loop, &QEventLoop::quit);
  loop.exec();
}

struct Rate {
  double per_second = 0.0;
  double cpu_ms = 0.0;  ///< A picture, of all processors.
};

/// Draws as fast as it goes. @param step moves something.
Rate rate(gui::SceneView& view, double seconds, const std::function<void(double)>& step) {
  int pictures = 0;
  QElapsedTimer timer;
  timer.start();
  const auto time = [&] { return 1e-9 * static_cast<double>(timer.nsecsElapsed()); };
  const auto connection = QObject::connect(&view, &QOpenGLWidget::frameSwapped, [&] {
    ++pictures;
    step(time());
  });
  const double cpu = cpu_seconds();
  step(0.0);
  wait(seconds);
  QObject::disconnect(connection);
  return {pictures / time(), 1e3 * (cpu_seconds() - cpu) / std::max(pictures, 1)};
}

struct Figures {
  Rate turning;
  Rate moving;
  Rate fine;  ///< Turning.
  double idle = 0.0;
};

Figures measure(gui::SceneView& view, const fs::path& file, double seconds) {
  const auto scene = std::make_shared<const geometric::Scene>(geometric::read_scene(file));
  view.set_scene(scene);
  wait(0.5);
  Figures figures;
  const gui::OrbitCamera::Placement from = view.camera().placement();
  const auto turn = [&](double time) {
    gui::OrbitCamera::Placement turned = from;
    turned.azimuth += kTurn * time;
    view.set_camera(turned);
  };
  figures.turning = rate(view, seconds, turn);
  view.set_always_fine(true);
  figures.fine = rate(view, seconds, turn);
  view.set_always_fine(false);
  view.set_camera(from);
  const geometric::Configuration start = scene->start.value();
  const geometric::Configuration goal = scene->goal.value();
  figures.moving = rate(view, seconds, [&](double time) {
    const double share = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * time / kSwing);
    view.set_configuration(start + share * (goal - start));
  });
  wait(1.0);
  const double before = cpu_seconds();
  wait(seconds);
  figures.idle = (cpu_seconds() - before) / seconds;
  return figures;
}

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  gui::apply_theme(application, gui::Theme::kLight);
  const double seconds = argc > 1 ? std::atof(argv[1]) : 3.0;
  std::vector<fs::path> files(argv + std::min(argc, 2), argv + argc);
  if (files.empty()) {
    for (const fs::directory_entry& entry :
         fs::directory_iterator(handway::test::source_dir() / "scenes")) {
      if (entry.path().extension() == ".yaml") {
        files.push_back(entry.path());
      }
    }
    std::ranges::sort(files);
  }
  gui::SceneView view;
  view.set_colors(gui::colors_of(gui::Theme::kLight).view);
  view.resize(1280, 800);
  view.show();
  wait(0.5);
  view.makeCurrent();
  std::printf("%s\n", reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
  view.doneCurrent();
  std::printf("%-15s %12s %7s %12s %7s %10s %7s %7s %7s\n", "scene", "turning, 1/s", "CPU ms",
              "moving, 1/s", "CPU ms", "fine, 1/s", "CPU ms", "ratio", "idle");
  bool enough = true;
  for (const fs::path& file : files) {
    const Figures figures = measure(view, file, seconds);
    std::printf("%-15s %12.1f %7.1f %12.1f %7.1f %10.1f %7.1f %7.2f %6.2f%%\n", file.stem().c_str(),
                figures.turning.per_second, figures.turning.cpu_ms, figures.moving.per_second,
                figures.moving.cpu_ms, figures.fine.per_second, figures.fine.cpu_ms,
                figures.fine.cpu_ms / figures.turning.cpu_ms, 100.0 * figures.idle);
    std::fflush(stdout);
    enough &= figures.turning.per_second >= kEnough && figures.moving.per_second >= kEnough;
  }
  return enough ? 0 : 1;
}
