#include "handway/device/emulators/tracker_signals.h"

#include "core/random_moves.h"
#include "handway/geometric/math/units.h"

#include <map>
#include <memory>

namespace handway::device {
namespace {

const Eigen::Vector3d kCentre(0.45, 0.0, 0.1);
const Eigen::Vector3d kHalfBox(0.25, 0.25, 0.2);
constexpr double kLargestTurn = 40.0 * geometric::kDegree;
constexpr MovePace kPace{.reaction = 0.5, .per_unit = 0.6, .longest_rest = 0.4};
// Position and rotation vector.
constexpr Eigen::Index kCoordinates = 6;

class WristMotion {
 public:
  WristMotion(std::uint64_t seed, const TrackerNoise& noise)
      : moves_(kCoordinates, kPace, seed), random_(seed + 1), noise_(noise) {}

  geometric::Pose at(double time) {
    const Eigen::VectorXd x = moves_.at(time);
    geometric::Pose X_ST = geometric::Pose::Identity();
    X_ST.translation() = kCentre + kHalfBox.cwiseProduct(x.head<3>()) + normal(noise_.position);
    const Eigen::Vector3d turn = kLargestTurn * x.tail<3>();
    X_ST.linear() = (geometric::turn_from_rotation_vector(turn) *
                     geometric::turn_from_rotation_vector(normal(noise_.angle)))
                        .toRotationMatrix();
    return X_ST;
  }

 private:
  Eigen::Vector3d normal(double deviation) {
    Eigen::Vector3d v;
    for (double& x : v) {
      x = deviation * random_.normal();
    }
    return v;
  }

  MinimumJerkMoves moves_;
  SeededRandom random_;
  TrackerNoise noise_;
};

}  // namespace

TrackerSignal wrist_motion_signal(std::uint64_t seed, const TrackerNoise& noise) {
  auto motions = std::make_shared<std::map<int, WristMotion>>();
  return [motions, seed, noise](double time, int sensor) {
    const auto own = seed + 1000003 * static_cast<std::uint64_t>(sensor);
    return motions->try_emplace(sensor, own, noise).first->second.at(time);
  };
}

}  // namespace handway::device
