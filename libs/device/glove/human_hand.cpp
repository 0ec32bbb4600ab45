#include "handway/device/glove/human_hand.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>

namespace handway::device {
namespace {

using Eigen::Vector3d;

/// Lengths relative to the length of the hand.
struct FingerShape {
  Vector3d base;                  ///< In the palm's frame.
  std::array<double, 3> lengths;  ///< Lengths of the bones from there on.
};

// Metacarpals end at Buchholz's places of the knuckles along the hand; across it they are spread
// over its breadth, 0.44 of its length.
const std::array<FingerShape, kFingers> kFingerShapes{{
    {Vector3d(0.12, 0.11, -0.04), {0.251, 0.196, 0.158}},
    {Vector3d(0.446, 0.125, 0.0), {0.245, 0.143, 0.097}},
    {Vector3d(0.446, 0.0, 0.0), {0.266, 0.170, 0.108}},
    {Vector3d(0.409, -0.105, 0.0), {0.244, 0.165, 0.107}},
    {Vector3d(0.368, -0.200, 0.0), {0.204, 0.117, 0.093}},
}};

constexpr std::array<const char*, 4> kFingerNames{"Index", "Middle", "Ring", "Pinkie"};
constexpr std::array<const char*, 3> kJointNames{"MPJ", "PIJ", "DIJ"};

/// A glove's angles by the sensors' names.
class Angles {
 public:
  explicit Angles(const GloveAngles& angles) : angles_(angles) {}

  [[nodiscard]] double operator()(std::string_view sensor) const {
    const double angle = angles_.angles.at(static_cast<std::size_t>(*find_sensor(sensor)));
    return std::isfinite(angle) ? angle : 0.0;
  }

 private:
  const GloveAngles& angles_;
};

Eigen::Matrix3d about(const Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

void place_finger(const std::array<double, 4>& bones, const Vector3d& knuckle, double spread,
                  const std::array<double, 3>& flexions, Finger finger, HandLandmarks& landmarks) {
  const Eigen::Matrix3d side = about(Vector3d::UnitZ(), spread);
  Vector3d point = knuckle;
  double flexion = 0.0;
  landmarks.col(base_landmark(finger)) = point;
  for (int i = 0; i < 3; ++i) {
    const auto bone = static_cast<std::size_t>(i);
    flexion += flexions[bone];
    point += side * about(Vector3d::UnitY(), flexion) * Vector3d(bones.at(bone + 1), 0.0, 0.0);
    landmarks.col(base_landmark(finger) + 1 + i) = point;
  }
}

// The roll turns the plane in which the thumb moves from the palm's own towards opposition; in this
// plane it is abducted from the index finger, and its outer joints bend back towards it.
void place_thumb(const std::array<double, 4>& bones, const Vector3d& base, const Angles& angle,
                 HandLandmarks& landmarks) {
  const Eigen::Matrix3d plane = about(Vector3d::UnitX(), -angle("ThumbRotate"));
  double direction = angle("ThumbAbduct");
  Vector3d point = base;
  landmarks.col(base_landmark(Finger::kThumb)) = point;
  const auto grow = [&](double length, int joint) {
    point += plane * Vector3d(length * std::cos(direction), length * std::sin(direction), 0.0);
    landmarks.col(base_landmark(Finger::kThumb) + joint) = point;
  };
  grow(bones[1], 1);
  direction -= angle("ThumbMPJ");
  grow(bones[2], 2);
  direction -= angle("ThumbIJ");
  grow(bones[3], 3);
}

}  // namespace

const std::string& name_of(Finger finger) {
  static const std::array<std::string, kFingers> kNames{"thumb", "index", "middle", "ring",
                                                        "little"};
  return kNames.at(static_cast<std::size_t>(finger));
}

HandBones typical_bones(double hand_length) {
  HandBones bones{};
  for (std::size_t f = 0; f < bones.size(); ++f) {
    const FingerShape& shape = kFingerShapes.at(f);
    bones.at(f) = {hand_length * shape.base.norm(), hand_length * shape.lengths[0],
                   hand_length * shape.lengths[1], hand_length * shape.lengths[2]};
  }
  return bones;
}

HandBones bones_of(const HandLandmarks& landmarks) {
  HandBones bones{};
  for (int f = 0; f < kFingers; ++f) {
    const int base = base_landmark(static_cast<Finger>(f));
    int before = kWristLandmark;
    for (int i = 0; i < 4; ++i) {
      bones.at(static_cast<std::size_t>(f)).at(static_cast<std::size_t>(i)) =
          (landmarks.col(base + i) - landmarks.col(before)).norm();
      before = base + i;
    }
  }
  return bones;
}

HandBones median_bones(std::span<const HandBones> frames) {
  HandBones bones{};
  std::vector<double> lengths(frames.size());
  for (std::size_t f = 0; f < bones.size(); ++f) {
    for (std::size_t i = 0; i < bones[f].size(); ++i) {
      std::ranges::transform(frames, lengths.begin(),
                             [&](const HandBones& frame) { return frame.at(f).at(i); });
      const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
      std::ranges::nth_element(lengths, middle);
      bones[f].at(i) = *middle;
    }
  }
  return bones;
}

HandLandmarks hand_landmarks(const GloveAngles& angles, const HandBones& bones) {
  const Angles angle(angles);
  HandLandmarks landmarks = HandLandmarks::Zero();
  const auto base = [&](std::size_t finger) -> Vector3d {
    return bones.at(finger)[0] * kFingerShapes.at(finger).base.normalized();
  };
  place_thumb(bones[0], base(0), angle, landmarks);
  const double ring = -angle("RingMiddleAbduct");
  const std::array<double, 4> spreads{angle("MiddleIndexAbduct"), 0.0, ring,
                                      ring - angle("PinkieRingAbduct")};
  // The arch of the palm brings the little finger's knuckle forward, the ring finger's half as far.
  const std::array<double, 4> arches{0.0, 0.0, 0.5 * angle("PalmArch"), angle("PalmArch")};
  for (std::size_t f = 0; f < kFingerNames.size(); ++f) {
    const Vector3d knuckle = about(Vector3d::UnitX(), arches.at(f)) * base(f + 1);
    std::array<double, 3> flexions{};
    for (std::size_t joint = 0; joint < flexions.size(); ++joint) {
      flexions.at(joint) = angle(std::string(kFingerNames.at(f)) + kJointNames.at(joint));
    }
    place_finger(bones.at(f + 1), knuckle, spreads.at(f), flexions, static_cast<Finger>(f + 1),
                 landmarks);
  }
  return landmarks;
}

namespace {

constexpr double kLeastReach = 0.17;  // share of a phalanx along the palm: bent by 80°

double& angle_of(GloveAngles& angles, const std::string& sensor) {
  return angles.angles.at(static_cast<std::size_t>(*find_sensor(sensor)));
}

/// Angle from one bone to the next in the plane in which both bend, rad, -π to π.
double turn(double from, double to) { return std::remainder(to - from, 2.0 * std::numbers::pi); }

/// Angle of a finger towards the thumb's side, rad.
double spread_of(const Vector3d& phalanx) {
  return phalanx.x() > kLeastReach * phalanx.norm() ? std::atan2(phalanx.y(), phalanx.x()) : 0.0;
}

void measure_thumb(const HandLandmarks& landmarks, GloveAngles& angles) {
  constexpr double kAlong = 1e-3;  // a thumb along the palm's axis has no roll, as a share
  const auto bone = [&](int i) -> Vector3d {
    return (landmarks.col(i + 1) - landmarks.col(i)).normalized();
  };
  const int base = base_landmark(Finger::kThumb);
  const Vector3d metacarpal = bone(base);
  const bool rolls = std::hypot(metacarpal.y(), metacarpal.z()) > kAlong;
  const double roll = rolls ? std::atan2(-metacarpal.z(), metacarpal.y()) : 0.0;
  const Eigen::Matrix3d back = about(Vector3d::UnitX(), roll);
  std::array<double, 3> directions{};
  for (int i = 0; i < 3; ++i) {
    const Vector3d in_plane = back * bone(base + i);
    directions.at(static_cast<std::size_t>(i)) = std::atan2(in_plane.y(), in_plane.x());
  }
  angle_of(angles, "ThumbRotate") = roll;
  angle_of(angles, "ThumbAbduct") = directions[0];
  angle_of(angles, "ThumbMPJ") = turn(directions[1], directions[0]);
  angle_of(angles, "ThumbIJ") = turn(directions[2], directions[1]);
}

}  // namespace

GloveAngles glove_angles(const HandLandmarks& landmarks) {
  GloveAngles angles;
  angles.angles.fill(std::numeric_limits<double>::quiet_NaN());
  measure_thumb(landmarks, angles);
  std::array<double, 4> spreads{};
  for (std::size_t f = 0; f < 4; ++f) {
    const int base = base_landmark(static_cast<Finger>(f + 1));
    spreads.at(f) = spread_of(landmarks.col(base + 1) - landmarks.col(base));
    const Eigen::Matrix3d back = about(Vector3d::UnitZ(), -spreads.at(f));
    double before = 0.0;
    for (int joint = 0; joint < 3; ++joint) {
      const Vector3d bone = back * (landmarks.col(base + joint + 1) - landmarks.col(base + joint));
      const double direction = std::atan2(-bone.z(), bone.x());
      angle_of(angles,
               std::string(kFingerNames.at(f)) + kJointNames.at(static_cast<std::size_t>(joint))) =
          turn(before, direction);
      before = direction;
    }
  }
  angle_of(angles, "MiddleIndexAbduct") = spreads[0] - spreads[1];
  angle_of(angles, "RingMiddleAbduct") = spreads[1] - spreads[2];
  angle_of(angles, "PinkieRingAbduct") = spreads[2] - spreads[3];
  return angles;
}

SensorIndices landmark_sensors() {
  SensorIndices sensors;
  for (int sensor = 0; sensor < kGloveSensors; ++sensor) {
    const std::string_view name = cyberglove_sensors()[static_cast<std::size_t>(sensor)].name;
    if (name != "PalmArch" && !name.starts_with("Wrist")) {
      sensors.push_back(sensor);
    }
  }
  return sensors;
}

geometric::Pose palm_frame(const HandLandmarks& landmarks) {
  constexpr double kLeast = 1e-6;  // m²
  const Vector3d wrist = landmarks.col(kWristLandmark);
  const auto knuckle = [&](Finger finger) -> Vector3d {
    return landmarks.col(base_landmark(finger));
  };
  const Vector3d along = knuckle(Finger::kMiddle) - wrist;
  const Vector3d across = knuckle(Finger::kIndex) - knuckle(Finger::kLittle);
  const Vector3d back = along.cross(across);
  if (!(back.norm() > kLeast)) {
    throw std::invalid_argument("wrist and knuckles give no palm: they lie in a line");
  }
  geometric::Pose frame = geometric::Pose::Identity();
  const Vector3d x = along.normalized();
  const Vector3d z = back.normalized();
  frame.linear() << x, z.cross(x), z;
  frame.translation() = wrist;
  return frame;
}

HandLandmarks in_palm_frame(const HandLandmarks& landmarks, bool left) {
  const geometric::Pose frame = palm_frame(landmarks);
  HandLandmarks result =
      frame.linear().transpose() * (landmarks.colwise() - Vector3d(frame.translation()));
  if (left) {
    result.row(2) *= -1.0;  // in the frame of a left hand z points into the palm
  }
  return result;
}

}  // namespace handway::device
