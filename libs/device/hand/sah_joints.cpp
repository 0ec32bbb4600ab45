#include "handway/device/hand/sah_joints.h"

#include "handway/geometric/math/units.h"

namespace handway::device {
namespace {

constexpr double kVelocity = 120.0;  // degrees a second

}  // namespace

JointRanges sah_joints() {
  JointRanges joints;
  joints.lower.resize(13);
  joints.upper.resize(13);
  joints.velocity = Eigen::VectorXd::Constant(13, geometric::radians(kVelocity));
  const auto add = [&joints](std::string name, double lower, double upper) {
    const auto j = static_cast<Eigen::Index>(joints.names.size());
    joints.names.push_back(std::move(name));
    joints.lower[j] = geometric::radians(lower);
    joints.upper[j] = geometric::radians(upper);
  };
  add("thumb_base", -90.0, 0.0);
  for (const std::string finger : {"thumb", "index", "middle", "ring"}) {
    add(finger + "_abduction", -15.0, 15.0);
    add(finger + "_proximal", -75.0, 4.0);
    add(finger + "_medial", -75.0, -4.0);
  }
  return joints;
}

}  // namespace handway::device
