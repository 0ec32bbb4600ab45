/// Measures the postures per second at which a robot's hand follows a person's fingertips, on one
/// core: hands given as files (`bench_retargeting ROBOT.urdf… [RECORDING]`), else those that ship
/// and one of 24 independent joints, over a hand that moves freely, or over the recording.
#include "handway/device/glove/hand_exploration.h"
#include "handway/device/glove/recording.h"
#include "handway/device/retargeting/fingertip_retargeter.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/resources.h"
#include "handway_test/resource_use.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
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

/// A URDF of so many links and joints, one after the other.
class UrdfText {
 public:
  UrdfText() { text_ << "<robot name='hand_24_right'>\n"; }

  /// @param shape its collision geometry, with its middle at `xyz`; may be empty.
  void link(const std::string& name, const std::string& shape, const std::string& xyz) {
    text_ << "<link name='" << name << "'>";
    if (!shape.empty()) {
      text_ << "<collision><origin xyz='" << xyz << "'/><geometry>" << shape
            << "</geometry></collision>";
    }
    text_ << "</link>\n";
  }
  void joint(const std::string& name, const std::string& parent, const std::string& origin,
             const std::string& axis, double lower, double upper) {
    text_ << "<joint name='" << name << "_joint' type='revolute'><parent link='" << parent
          << "'/><child link='" << name << "'/><origin " << origin << "/><axis xyz='" << axis
          << "'/><limit lower='" << lower << "' upper='" << upper
          << "' effort='1' velocity='4'/></joint>\n";
  }
  /// A bone along z with its joint, which bends about y; nothing of it collides with its
  /// neighbours.
  void bone(const std::string& name, const std::string& parent, double parent_length,
            double length) {
    joint(name, parent, "xyz='0 0 " + std::to_string(parent_length) + "'", "0 1 0", -0.2, 1.57);
    link(name, "<cylinder radius='0.007' length='" + std::to_string(0.7 * length) + "'/>",
         "0 0 " + std::to_string(0.55 * length));
  }
  [[nodiscard]] std::string end() { return text_.str() + "</robot>\n"; }

 private:
  std::ostringstream text_;
};

/// Five joints of the thumb, of the index, ring and little finger, whose metacarpals bend, and four
/// of the middle finger: all move a fingertip, none follows another.
std::string hand_of_24_joints() {
  struct Digit {
    const char* name;
    double y;  // m, of its knuckle
    bool metacarpal;
  };
  UrdfText urdf;
  urdf.link("palm", "<box size='0.02 0.07 0.05'/>", "0 0 0.045");
  urdf.joint("thumb_base", "palm", "xyz='0.01 0.036 0.03' rpy='-0.8 0 0'", "0 0 -1", -1.05, 1.05);
  urdf.link("thumb_base", "", "");
  urdf.bone("thumb_proximal", "thumb_base", 0.0, 0.038);
  urdf.joint("thumb_hub", "thumb_proximal", "xyz='0 0 0.038'", "1 0 0", -0.3, 0.3);
  urdf.link("thumb_hub", "", "");
  urdf.bone("thumb_medial", "thumb_hub", 0.0, 0.032);
  urdf.bone("thumb_distal", "thumb_medial", 0.032, 0.028);
  for (const Digit& digit : {Digit{"index", 0.033, true}, Digit{"middle", 0.011, false},
                             Digit{"ring", -0.011, true}, Digit{"little", -0.033, true}}) {
    const std::string name(digit.name);
    std::string knuckle = "palm";
    std::string place = "xyz='0 " + std::to_string(digit.y) + " 0.095'";
    if (digit.metacarpal) {
      knuckle = name + "_metacarpal";
      urdf.joint(knuckle, "palm", "xyz='0 " + std::to_string(digit.y) + " 0.075'", "0 1 0", 0.0,
                 0.5);
      urdf.link(knuckle, "", "");
      place = "xyz='0 0 0.02'";
    }
    urdf.joint(name + "_abduction", knuckle, place, "1 0 0", -0.35, 0.35);
    urdf.link(name + "_abduction", "", "");
    urdf.bone(name + "_proximal", name + "_abduction", 0.0, 0.045);
    urdf.bone(name + "_medial", name + "_proximal", 0.045, 0.025);
    urdf.bone(name + "_distal", name + "_medial", 0.025, 0.026);
  }
  return urdf.end();
}

void bm_retargeting(benchmark::State& state, const fs::path& robot,
                    const std::vector<HandLandmarks>& rows, bool self_collision) {
  RetargetingSettings settings;
  settings.self_collision = self_collision;
  const FingertipRetargeter hand(geometric::load_robot(robot), settings);
  std::vector<double> times;
  for (auto _ : state) {
    Eigen::VectorXd posture = hand.middle();
    for (const HandLandmarks& row : rows) {
      const double begin = test::cpu_seconds();
      posture = hand.posture(row, posture);
      times.push_back(test::cpu_seconds() - begin);
    }
    benchmark::DoNotOptimize(posture);
  }
  std::ranges::sort(times);
  state.counters["joints"] = static_cast<double>(std::ranges::count(hand.driven(), true));
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
    const std::filesystem::path generated =
        std::filesystem::temp_directory_path() / "hand_24_right.urdf";
    std::ofstream(generated) << device::hand_of_24_joints();
    robots.push_back(generated);
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
