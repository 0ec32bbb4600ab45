/// From the sensors of a glove to the pixels of the workbench: an emulated glove numbers its
/// frames in a sensor that no joint follows and keeps when each was measured; the window tells when
/// a picture with it is done.
///
///     bench_live_hand [SCENE] [SECONDS] [PAGE] [BUSY]
///
/// BUSY other processes keep a core each busy at the same priority. Needs a display, for example
/// xvfb-run.
#include "app/main_window.h"
#include "features/glove/glove_panel.h"
#include "handway/device/emulators/glove_emulator.h"
#include "handway/device/emulators/glove_signals.h"
#include "handway/device/glove/glove_layout.h"
#include "handway_test/paths.h"
#include "handway_test/resource_use.h"
#include "view3d/scene_view.h"
#include "widgets/style/theme.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QTimer>

#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <vector>

namespace {

namespace device = handway::device;
namespace gui = handway::gui;

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr std::size_t kNumbers = 255;  // that a sensor can tell apart
constexpr double kRate = 100.0;        // Hz
constexpr double kWarmUp = 2.0;        // s

// The wrist, which the paper's Table 1 leaves out.
const auto kNumberSensor = static_cast<std::size_t>(device::find_sensor("WristYaw").value());

/// When each of the last frames was measured.
struct Stamps {
  std::array<std::atomic<Clock::rep>, kNumbers> times{};
  std::size_t frames = 0;
};

device::GloveSignal numbered(const std::shared_ptr<Stamps>& stamps) {
  return [stamps, hand = device::exploring_hand_signal(1)](double time) mutable {
    auto counts = hand(time);
    const std::size_t number = stamps->frames++ % kNumbers;
    counts[kNumberSensor] = static_cast<std::uint16_t>(number + 1);
    stamps->times[number] = Clock::now().time_since_epoch().count();
    return counts;
  };
}

/// Delays of all pictures that show a new frame.
class Measurement {
 public:
  Measurement(gui::MainWindow& window, std::shared_ptr<Stamps> stamps)
      : stamps_(std::move(stamps)), view_(window.view()) {
    gui::GlovePanel& panel = *window.findChild<gui::GlovePanel*>();
    QObject::connect(&panel.session(), &gui::GloveSession::sampled, &view_,
                     [this](const std::vector<gui::GloveSample>& samples) {
                       latest_ = samples.back().frame.counts[kNumberSensor];
                     });
    QObject::connect(&panel, &gui::GlovePanel::posture_changed, &view_,
                     [this] { shown_ = latest_; });
    QObject::connect(&view_, &gui::SceneView::frameSwapped, &view_, [this] { note_picture(); });
  }

  void begin() {
    delays_.clear();
    drawing_.clear();
    pictures_ = 0;
    begin_ = Clock::now();
    gui_cpu_ = handway::test::cpu_seconds();
    all_cpu_ = handway::test::cpu_seconds(CLOCK_PROCESS_CPUTIME_ID);
  }

  void print() {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    const auto count = static_cast<double>(std::max<std::size_t>(delays_.size(), 1));
    const double gui_ms = 1e3 * (handway::test::cpu_seconds() - gui_cpu_) / count;
    const double all_ms =
        1e3 * (handway::test::cpu_seconds(CLOCK_PROCESS_CPUTIME_ID) - all_cpu_) / count;
    std::printf("new pictures   %6.1f a second (of %.1f; the glove has %.0f)\n", count / seconds,
                pictures_ / seconds, kRate);
    print_row("sensor to pixel", delays_);
    print_row("drawing", drawing_);
    std::printf("CPU a picture  %6.1f ms of the window's thread, %.1f ms of all\n", gui_ms, all_ms);
  }

 private:
  void note_picture() {
    ++pictures_;
    if (shown_ == 0) {
      return;
    }
    const Clock::time_point measured{Clock::duration(stamps_->times.at(shown_ - 1U))};
    delays_.push_back(Milliseconds(Clock::now() - measured).count());
    drawing_.push_back(view_.frame_time_ms());
    shown_ = 0;
  }

  static void print_row(const char* name, std::vector<double> values) {
    if (values.empty()) {
      return;
    }
    std::ranges::sort(values);
    std::printf("%-15s%6.1f ms median, %.1f ms 95 %%, %.1f ms worst\n", name,
                values[values.size() / 2], values[values.size() * 19 / 20], values.back());
  }

  std::shared_ptr<Stamps> stamps_;
  gui::SceneView& view_;
  std::uint16_t latest_ = 0;
  std::uint16_t shown_ = 0;  ///< Number of the frame that the next picture shows; 0: none.
  std::vector<double> delays_;
  std::vector<double> drawing_;
  int pictures_ = 0;
  Clock::time_point begin_;
  double gui_cpu_ = 0.0;
  double all_cpu_ = 0.0;
};

/// Processes that do nothing but keep a core busy, as long as this lives.
class Load {
 public:
  explicit Load(int processes) {
    for (int i = 0; i < processes; ++i) {
      const pid_t child = ::fork();
      if (child == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        for (std::atomic<unsigned> turns = 0;; ++turns) {
        }
      }
      children_.push_back(child);
    }
  }
  ~Load() {
    for (const pid_t child : children_) {
      ::kill(child, SIGKILL);
    }
  }
  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;

 private:
  std::vector<pid_t> children_;
};

}  // namespace

int main(int argc, char** argv) {
  const Load load(argc > 4 ? std::atoi(argv[4]) : 0);
  QCoreApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QApplication application(argc, argv);
  QApplication::setOrganizationName(QStringLiteral("handway-bench"));
  gui::apply_theme(application, gui::Theme::kLight);
  const auto scene = argc > 1 ? std::filesystem::path(argv[1])
                              : handway::test::source_dir() / "scenes" / "can_on_table.yaml";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 10.0;
  const QString page = argc > 3 ? QString::fromLocal8Bit(argv[3]) : QStringLiteral("Sensors");
  device::GloveEmulatorSettings settings;
  settings.unit.rate = kRate;
  auto stamps = std::make_shared<Stamps>();
  const device::GloveEmulator glove(settings, numbered(stamps));
  gui::MainWindow window(std::make_shared<handway::planning::PluginManager>());
  window.resize(1280, 800);
  window.show();
  Measurement measurement(window, stamps);
  int exit_code = EXIT_FAILURE;
  QObject::connect(&window, &gui::MainWindow::failed, [](const QString& message) {
    std::fprintf(stderr, "%s\n", qPrintable(message));
    QCoreApplication::exit(EXIT_FAILURE);
  });
  QObject::connect(&window, &gui::MainWindow::ready, [&] {
    window.document().set_configuration(*window.document().scene()->start);
    window.findChild<gui::GlovePanel*>()->come_to_front(page);
    window.findChild<gui::GlovePanel*>()->connect_to(QString::fromStdString(glove.address()));
    QTimer::singleShot(static_cast<int>(1e3 * kWarmUp), &window, [&] { measurement.begin(); });
    QTimer::singleShot(static_cast<int>(1e3 * (kWarmUp + seconds)), &window, [&] {
      measurement.print();
      exit_code = EXIT_SUCCESS;
      QCoreApplication::quit();
    });
  });
  window.open(QString::fromStdString(scene.string()));
  const int ended = QApplication::exec();
  return ended == 0 ? exit_code : ended;
}
