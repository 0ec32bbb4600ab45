/// How many postures a second a robot's hand follows a person's fingertips with, on one core: hands
/// given as files (`bench_retargeting ROBOT.urdf… [RECORDING]`), else those that ship, over a hand
/// that moves freely, or over the recording.
#include "handway/device/glove/hand_exploration.h"
#include "handway/device/glove/recording.h"
#include "handway/device/retargeting/fingertip_retargeter.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/resources.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace handway::device {
namespace {

namespace fs = std::filesystem;

constexpr int kRows = 1000;
constexpr double kRate = 30.0;  // Hz, of a camera

std::vector<HandLandmarks> free_motion() {
  HandExploration hand(1);
  std::vector<HandLandmarks> rows;
  for (int row = 0; row < kRows; ++row) {
    rows.push_back(hand_landmarks(hand.at(row / kRate)));
  }
  return rows;
}

std::vector<HandLandmarks> recorded(const fs::path& file) {
  const Recording recording = read_recording(file);
  std::vector<HandLandmarks> rows;
  for (Eigen::Index row = 0; row < recording.values.rows(); ++row) {
    rows.push_back(hand_landmarks(angles_of_row(recording, row)));
  }
  return rows;
}

void bm_retargeting(benchmark::State& state, const fs::path& robot,
                    const std::vector<HandLandmarks>& rows, bool self_collision) {
  using Clock = std::chrono::steady_clock;
  RetargetingSettings settings;
  settings.self_collision = self_collision;
  const FingertipRetargeter hand(geometric::load_robot(robot), settings);
  std::vector<double> times;
  for (auto _ : state) {
    Eigen::VectorXd posture = hand.middle();
    for (const HandLandmarks& row : rows) {
      const Clock::time_point begin = Clock::now();
      posture = hand.posture(row, posture);
      times.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
    }
    benchmark::DoNotOptimize(posture);
  }
  std::ranges::sort(times);
  state.counters["joints"] = static_cast<double>(hand.joints().size());
  state.counters["postures_per_second"] =
      benchmark::Counter(static_cast<double>(times.size()), benchmark::Counter::kIsRate);
  state.counters["p99_ms"] = 1e3 * times[times.size() * 99 / 100];
}

}  // namespace
}  // namespace handway::device

int main(int argc, char** argv) {
  using namespace handway;
  benchmark::Initialize(&argc, argv);
  std::vector<std::filesystem::path> robots;
  std::vector<device::HandLandmarks> rows;
  for (int i = 1; i < argc; ++i) {
    const std::filesystem::path file(argv[i]);
    if (file.extension() == ".urdf") {
      robots.push_back(file);
    } else {
      rows = device::recorded(file);
    }
  }
  if (robots.empty()) {
    for (const char* hand :
         {"sah_right", "allegro_class_right", "leap_class_right", "shadow_class_right"}) {
      robots.push_back(geometric::find_resource(geometric::ResourceKind::kRobot, hand,
                                                std::filesystem::current_path()));
    }
  }
  if (rows.empty()) {
    rows = device::free_motion();
  }
  for (const std::filesystem::path& robot : robots) {
    for (const bool self_collision : {true, false}) {
      benchmark::RegisterBenchmark(
          (robot.stem().string() + (self_collision ? "" : "/without_self_collision")).c_str(),
          [=](benchmark::State& state) {
            device::bm_retargeting(state, robot, rows, self_collision);
          })
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
