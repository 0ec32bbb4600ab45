#include "handway/device/arm/tx90_joints.h"

#include "handway/geometric/math/units.h"

#include <array>

namespace handway::device {
namespace {

struct Row {
  const char* name;
  double lower;     ///< degrees
  double upper;     ///< degrees
  double velocity;  ///< degrees a second
};

constexpr std::array<Row, 6> kRows{{{"joint_1", -180.0, 180.0, 400.0},
                                    {"joint_2", -130.0, 147.5, 400.0},
                                    {"joint_3", -145.0, 145.0, 430.0},
                                    {"joint_4", -270.0, 270.0, 540.0},
                                    {"joint_5", -115.0, 140.0, 475.0},
                                    {"joint_6", -270.0, 270.0, 760.0}}};

}  // namespace

JointRanges tx90_joints() {
  JointRanges joints{{}, Eigen::VectorXd(6), Eigen::VectorXd(6), Eigen::VectorXd(6)};
  for (Eigen::Index j = 0; j < 6; ++j) {
    const Row& row = kRows[static_cast<std::size_t>(j)];
    joints.names.emplace_back(row.name);
    joints.lower[j] = geometric::radians(row.lower);
    joints.upper[j] = geometric::radians(row.upper);
    joints.velocity[j] = geometric::radians(row.velocity);
  }
  return joints;
}

}  // namespace handway::device
