#include "handway/device/retargeting/mapping_proposal.h"

#include "handway/device/glove/angle_ranges.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/retargeting/mapping_check.h"
#include "handway/device/retargeting/robot_fingers.h"
#include "handway/geometric/robot/group_proposal.h"
#include "retargeting/finger_bend.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace handway::device {
namespace {

using Eigen::Vector3d;
using geometric::Configuration;
using geometric::Pose;
using geometric::RobotModel;

constexpr std::array<const char*, kFingers> kSensorPrefixes{"Thumb", "Index", "Middle", "Ring",
                                                            "Pinkie"};
constexpr std::array<const char*, 3> kFlexions{"MPJ", "PIJ", "DIJ"};
constexpr double kClearlyMore = 1.2;      // ratio of the ranges on both sides of 0
constexpr double kParallel = 0.7;         // cosine of the angle between axes
constexpr double kDifferenceStep = 1e-3;  // rad

int sensor_called(const std::string& name) { return find_sensor(name).value(); }

/// The joints of a hand in the frame of a person's palm (see hand_landmarks()): fingers straight,
/// other joints neutral.
class HandAtRest {
 public:
  explicit HandAtRest(const RobotModel& model)
      : model_(model),
        hand_(find_fingers(model)),
        q_(model.neutral()),
        X_BL_(static_cast<std::size_t>(model.link_count())) {
    for (const RobotFinger& finger : hand_.fingers) {
      for (std::size_t k = 0; k < finger.variables.size(); ++k) {
        q_[finger.variables[k]] = finger.straight[k];
      }
    }
    model_.forward_kinematics(q_, X_BL_);
  }

  [[nodiscard]] const RobotFingers& hand() const { return hand_; }
  [[nodiscard]] double at_rest(int variable) const { return q_[variable]; }
  [[nodiscard]] double lower(int variable) const { return model_.lower()[variable]; }
  [[nodiscard]] double upper(int variable) const { return model_.upper()[variable]; }
  [[nodiscard]] double middle(int variable) const {
    return 0.5 * (lower(variable) + upper(variable));
  }
  [[nodiscard]] bool turns(int variable) const {
    return model_.joint(model_.variable_link(variable)).type != geometric::JointType::kPrismatic;
  }

  /// Axis of a joint, as seen in a right hand.
  [[nodiscard]] Vector3d axis(int variable) const {
    const int link = model_.variable_link(variable);
    const Vector3d a_P = palm().linear().transpose() *
                         (X_BL_[static_cast<std::size_t>(link)].linear() * model_.joint(link).axis);
    const Vector3d a_H = hand_.R_PH.transpose() * a_P;
    // Rotations of a mirrored hand have the reverse direction.
    return hand_.left ? Vector3d(-a_H.x(), -a_H.y(), a_H.z()) : a_H;
  }
  [[nodiscard]] Vector3d place(int variable) const {
    const int link = model_.variable_link(variable);
    return seen(palm().inverse() * X_BL_[static_cast<std::size_t>(link)].translation());
  }
  [[nodiscard]] Vector3d tip(const RobotFinger& finger) const { return tip_at(finger, X_BL_); }
  /// Flexion of the finger by a variable, rad per unit; 0: none.
  [[nodiscard]] static double flexion(const RobotFinger& finger, int variable) {
    const auto found = std::ranges::find(finger.variables, variable);
    return found == finger.variables.end()
               ? 0.0
               : finger.flexion[static_cast<std::size_t>(found - finger.variables.begin())];
  }

  /// Motion of the fingertip by a joint, per rad: the mean over its range and those of the finger's
  /// other joints.
  /// @param held a variable that stays at a value meanwhile.
  [[nodiscard]] Vector3d tip_motion(const RobotFinger& finger, int variable,
                                    std::optional<std::pair<int, double>> held = {}) const {
    constexpr std::array<double, 3> kShares{0.2, 0.5, 0.8};
    std::size_t samples = 1;
    for (std::size_t k = 1; k < finger.variables.size(); ++k) {
      samples *= kShares.size();
    }
    Configuration q = q_;
    std::vector<Pose> X_BL(X_BL_.size());
    const auto tip_with = [&](double share) {
      q[variable] = std::lerp(lower(variable), upper(variable), share);
      model_.forward_kinematics(q, X_BL);
      return tip_at(finger, X_BL);
    };
    Vector3d motion = Vector3d::Zero();
    for (std::size_t sample = 0; sample < samples; ++sample) {
      std::size_t rest = sample;
      for (const int v : finger.variables) {
        if (v != variable) {
          q[v] = std::lerp(lower(v), upper(v), kShares.at(rest % kShares.size()));
          rest /= kShares.size();
        }
      }
      if (held) {
        q[held->first] = held->second;
      }
      motion += tip_with(kShares.back()) - tip_with(kShares.front());
    }
    const double range = upper(variable) - lower(variable);
    return motion / (static_cast<double>(samples) * (kShares.back() - kShares.front()) * range);
  }
  /// The fingertip with the finger in the middle of its ranges. @param held a variable with another
  /// value.
  [[nodiscard]] Vector3d middle_tip(const RobotFinger& finger,
                                    const std::pair<int, double>& held) const {
    Configuration q = q_;
    for (const int v : finger.variables) {
      q[v] = middle(v);
    }
    q[held.first] = held.second;
    std::vector<Pose> X_BL(X_BL_.size());
    model_.forward_kinematics(q, X_BL);
    return tip_at(finger, X_BL);
  }
  /// Distance of a fingertip from the workspace of the other fingertips, at a share of the range of
  /// the finger's only joint, m.
  [[nodiscard]] double distance_to_others(const RobotFinger& finger, double share) const {
    constexpr int kSteps = 8;
    Configuration q = q_;
    const int variable = finger.variables.front();
    std::vector<Pose> X_BL(X_BL_.size());
    q[variable] = std::lerp(lower(variable), upper(variable), share);
    model_.forward_kinematics(q, X_BL);
    const Vector3d own = tip_at(finger, X_BL);
    double least = std::numeric_limits<double>::infinity();
    for (int step = 0; step <= kSteps; ++step) {
      for (const RobotFinger& other : hand_.fingers) {
        for (const int v : other.variables) {
          q[v] = std::lerp(lower(v), upper(v), static_cast<double>(step) / kSteps);
        }
      }
      q[variable] = std::lerp(lower(variable), upper(variable), share);
      model_.forward_kinematics(q, X_BL);
      for (const RobotFinger& other : hand_.fingers) {
        if (&other != &finger) {
          least = std::min(least, (tip_at(other, X_BL) - own).norm());
        }
      }
    }
    return least;
  }

 private:
  [[nodiscard]] const Pose& palm() const { return X_BL_[static_cast<std::size_t>(hand_.palm)]; }
  [[nodiscard]] Vector3d seen(const Vector3d& p_P) const {
    const Vector3d p_H = hand_.R_PH.transpose() * p_P;
    return hand_.left ? Vector3d(p_H.x(), p_H.y(), -p_H.z()) : p_H;
  }
  [[nodiscard]] Vector3d tip_at(const RobotFinger& finger, const std::vector<Pose>& X_BL) const {
    return seen(X_BL[static_cast<std::size_t>(hand_.palm)].inverse() *
                (X_BL[static_cast<std::size_t>(finger.tip_link)] * finger.p_LT));
  }

  const RobotModel& model_;
  RobotFingers hand_;
  Configuration q_;
  std::vector<Pose> X_BL_;
};

/// Makes the joint mappings of one hand.
class MappingProposer {
 public:
  explicit MappingProposer(const RobotModel& model) : model_(model), rest_(model) {}

  [[nodiscard]] HandMapping propose() {
    const geometric::GroupProposal groups = geometric::propose_groups(model_);
    for (const std::string& joint : groups.wrist) {
      const std::optional<int> variable = model_.find_variable(joint);
      if (variable && joint_moves(model_, model_.variable_link(*variable))) {
        add_wrist(*variable);
      }
    }
    for (const RobotFinger& finger : rest_.hand().fingers) {
      if (finger.variables.size() == 1) {
        add_gripping(finger);
      } else if (finger.finger == Finger::kThumb) {
        add_thumb(finger);
      } else {
        add_finger(finger);
      }
    }
    HandMapping mapping;
    int moving = 0;
    for (int v = 0; v < model_.variable_count(); ++v) {
      moving += joint_moves(model_, model_.variable_link(v)) ? 1 : 0;
    }
    const bool is_whole = std::ssize(mappings_) == moving;
    mapping.hand = is_whole ? model_.name() : model_.name() + "_hand";
    mapping.source = "proposed from the joints' order and axes";
    for (auto& [variable, mapped] : mappings_) {
      mapping.joints.push_back(std::move(mapped));
    }
    return mapping;
  }

 private:
  void add(int variable, JointMapping mapped) {
    mapped.joint = model_.variable(variable).name;
    mappings_.insert_or_assign(variable, std::move(mapped));
  }

  void add_fixed(int variable) {
    JointMapping mapped;
    mapped.fixed = rest_.at_rest(variable);
    add(variable, mapped);
  }

  /// Maps one for one, from `zero` of the joint.
  void add_turning(int variable, const std::string& sensor, double sign, double zero) {
    JointMapping mapped;
    mapped.sensor = sensor_called(sensor);
    mapped.gain = sign;
    mapped.offset = zero;
    add(variable, mapped);
  }

  /// Maps the sensor's typical range to the joint's whole range.
  void add_spanning(int variable, const std::string& sensor, double sign) {
    JointMapping mapped;
    mapped.sensor = sensor_called(sensor);
    const auto& [least, most] = typical_angle_ranges().at(static_cast<std::size_t>(mapped.sensor));
    mapped.gain = sign * (rest_.upper(variable) - rest_.lower(variable)) / (most - least);
    mapped.offset = rest_.middle(variable) - mapped.gain * 0.5 * (least + most);
    add(variable, mapped);
  }

  void add_wrist(int variable) {
    const Vector3d axis = rest_.axis(variable);
    if (std::abs(axis.y()) >= std::abs(axis.z())) {
      add_turning(variable, "WristPitch", sign_of(axis.y()), rest_.at_rest(variable));
    } else {
      add_turning(variable, "WristYaw", -sign_of(axis.z()), rest_.at_rest(variable));
    }
  }

  /// Maps a person's open hand to the joint's value `open`, a closed one to its limit in that
  /// direction.
  void add_closing(int variable, const std::string& sensor, double sign, double open) {
    JointMapping mapped;
    mapped.sensor = sensor_called(sensor);
    const double most = typical_angle_ranges().at(static_cast<std::size_t>(mapped.sensor)).second;
    mapped.gain = ((sign > 0.0 ? rest_.upper(variable) : rest_.lower(variable)) - open) / most;
    mapped.offset = open;
    add(variable, mapped);
  }

  /// The only joint of a finger closes the hand.
  void add_gripping(const RobotFinger& finger) {
    const int variable = finger.variables.front();
    if (is_jointed(finger)) {
      add_closing(variable, prefix(finger) + "MPJ", finger.flexion.front(),
                  finger.straight.front());
      return;
    }
    const double change =
        rest_.distance_to_others(finger, 1.0) - rest_.distance_to_others(finger, 0.0);
    const double sign =
        std::abs(finger.flexion.front()) > 0.0 ? sign_of(finger.flexion.front()) : -sign_of(change);
    add_closing(variable, prefix(finger) + "MPJ", sign,
                sign > 0.0 ? rest_.lower(variable) : rest_.upper(variable));
  }

  /// Returns whether the only joint of a finger also bends further links: then it is a finger that
  /// can be straight, and no jaw.
  [[nodiscard]] bool is_jointed(const RobotFinger& finger) const {
    int moved = 0;
    for (int link = finger.tip_link; link > 0 && link != rest_.hand().palm;
         link = model_.parent(link)) {
      moved += joint_moves(model_, link) &&
                       model_.mimic_mapping(link).variable == finger.variables.front()
                   ? 1
                   : 0;
    }
    return moved > 1 && finger.flexion.front() != 0.0;
  }

  void add_finger(const RobotFinger& finger) {
    std::vector<int> flexing;
    std::vector<int> spreading;
    std::vector<int> twisting;
    for (const int v : finger.variables) {
      const Vector3d a = rest_.axis(v).cwiseAbs();
      const bool bends = HandAtRest::flexion(finger, v) != 0.0;
      (!rest_.turns(v) || bends || (a.y() >= a.x() && a.y() >= a.z()) ? flexing
       : a.z() >= a.x()                                               ? spreading
                                                                      : twisting)
          .push_back(v);
    }
    // Turning a finger about its own axis takes its tip sideways as soon as it is bent.
    if (spreading.empty() && !twisting.empty()) {
      spreading.push_back(twisting.front());
      twisting.erase(twisting.begin());
    }
    add_spread(finger, spreading);
    for (const int v : twisting) {
      add_arch(finger, v);
    }
    while (flexing.size() > kFlexions.size()) {
      add_arch(finger, flexing.front());
      flexing.erase(flexing.begin());
    }
    add_flexions(finger, flexing);
  }

  void add_spread(const RobotFinger& finger, const std::vector<int>& variables) {
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const Vector3d axis = rest_.axis(variables[i]);
      const double to_thumb =
          sign_of(std::abs(axis.z()) >= std::abs(axis.x()) ? axis.z() : axis.x());
      const double zero = rest_.at_rest(variables[i]);
      if (i > 0 || finger.finger == Finger::kMiddle) {
        add_fixed(variables[i]);
      } else if (finger.finger == Finger::kIndex) {
        add_turning(variables[i], "MiddleIndexAbduct", to_thumb, zero);
      } else {
        add_turning(variables[i],
                    finger.finger == Finger::kRing ? "RingMiddleAbduct" : "PinkieRingAbduct",
                    -to_thumb, zero);
      }
    }
  }

  void add_arch(const RobotFinger& finger, int variable) {
    if (finger.finger != Finger::kLittle && finger.finger != Finger::kRing) {
      add_fixed(variable);
      return;
    }
    const Vector3d motion = rest_.axis(variable).cross(rest_.tip(finger) - rest_.place(variable));
    add_turning(variable, "PalmArch", -sign_of(motion.z()), rest_.at_rest(variable));
  }

  void add_flexions(const RobotFinger& finger, const std::vector<int>& variables) {
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const int v = variables[i];
      const std::string sensor = prefix(finger) + kFlexions.at(i);
      if (!rest_.turns(v)) {
        add_spanning(v, sensor, -sign_of(rest_.tip_motion(finger, v).z()));
        continue;
      }
      const double flexion = HandAtRest::flexion(finger, v);
      add_turning(v, sensor, sign_of(flexion != 0.0 ? flexion : rest_.axis(v).y()),
                  rest_.at_rest(v));
    }
  }

  void add_thumb(const RobotFinger& thumb) {
    std::vector<int> base = thumb.variables;
    const int outer = base.back();
    base.pop_back();
    const int inner = base.back();
    base.pop_back();
    const double outer_sign = closing_sign(thumb, outer);
    const double along = rest_.axis(inner).dot(rest_.axis(outer));
    const bool bends_alike = std::abs(along) > kParallel;
    constexpr std::array<const char*, 2> kBaseSensors{"ThumbRotate", "ThumbAbduct"};
    add_turning(outer, "ThumbIJ", outer_sign, rest_.at_rest(outer));
    if (!bends_alike && base.size() < kBaseSensors.size()) {
      base.push_back(inner);  // of a thumb of few joints: it turns the thumb as a whole
    } else {
      add_turning(inner, "ThumbMPJ",
                  bends_alike ? outer_sign * sign_of(along) : closing_sign(thumb, inner),
                  rest_.at_rest(inner));
    }
    double roll_sign = 1.0;
    for (std::size_t i = 0; i < base.size(); ++i) {
      if (i == 0) {
        roll_sign =
            sign_of(rest_.tip_motion(thumb, base[i]).dot(human_thumb_motion("ThumbRotate")));
        add_spanning(base[i], kBaseSensors[0], roll_sign);
      } else if (i == 1) {
        add_spanning(base[i], kBaseSensors[1], abduction_sign(thumb, base[0], roll_sign, base[1]));
      } else {
        add_fixed(base[i]);
      }
    }
  }

  /// Returns the sign with which abduction moves the thumb away from the index finger, and in the
  /// direction of a person's for the same share of the roll, which turns the direction of
  /// abduction.
  [[nodiscard]] double abduction_sign(const RobotFinger& thumb, int roll, double roll_sign,
                                      int abduction) const {
    double alike = 0.0;
    for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      const std::pair rolled(roll, std::lerp(rest_.lower(roll), rest_.upper(roll),
                                             roll_sign > 0.0 ? share : 1.0 - share));
      const Vector3d motion = rest_.tip_motion(thumb, abduction, rolled).normalized();
      alike += motion.dot(human_thumb_motion("ThumbAbduct", share).normalized()) +
               motion.dot(from_index_finger(rest_.middle_tip(thumb, rolled)));
    }
    return sign_of(alike);
  }

  /// The direction away from the line of the straight index finger; zero without one.
  [[nodiscard]] Vector3d from_index_finger(const Vector3d& point) const {
    const auto index =
        std::ranges::find(rest_.hand().fingers, Finger::kIndex, &RobotFinger::finger);
    if (index == rest_.hand().fingers.end()) {
      return Vector3d::Zero();
    }
    const Vector3d base = rest_.place(index->variables.front());
    const Vector3d along = (rest_.tip(*index) - base).normalized();
    const Vector3d offset = point - base;
    return (offset - along.dot(offset) * along).normalized();
  }

  /// Returns the sign by which a finger closes: to the side of its larger range if that is clear,
  /// else towards the palm.
  [[nodiscard]] double closing_sign(const RobotFinger& finger, int variable) const {
    const double up = rest_.upper(variable) - rest_.at_rest(variable);
    const double down = rest_.at_rest(variable) - rest_.lower(variable);
    if (up > kClearlyMore * down || down > kClearlyMore * up) {
      return sign_of(up - down);
    }
    return -sign_of(rest_.tip_motion(finger, variable).z());
  }

  /// Motion of a human thumb by a sensor, from the middle of its typical posture.
  /// @param roll share of its roll.
  [[nodiscard]] static Vector3d human_thumb_motion(const std::string& sensor, double roll = 0.5) {
    GloveAngles angles;
    angles.angles.fill(0.0);
    for (const char* joint : {"ThumbRotate", "ThumbAbduct", "ThumbMPJ", "ThumbIJ"}) {
      const auto s = static_cast<std::size_t>(sensor_called(joint));
      angles.angles.at(s) =
          std::lerp(typical_angle_ranges().at(s).first, typical_angle_ranges().at(s).second,
                    std::string_view(joint) == "ThumbRotate" ? roll : 0.5);
    }
    const int tip = tip_landmark(Finger::kThumb);
    const Vector3d before = hand_landmarks(angles).col(tip);
    angles.angles.at(static_cast<std::size_t>(sensor_called(sensor))) += kDifferenceStep;
    return (hand_landmarks(angles).col(tip) - before) / kDifferenceStep;
  }

  [[nodiscard]] static std::string prefix(const RobotFinger& finger) {
    return kSensorPrefixes.at(static_cast<std::size_t>(finger.finger));
  }

  const RobotModel& model_;
  HandAtRest rest_;
  std::map<int, JointMapping> mappings_;  ///< By variable.
};

}  // namespace

HandMapping propose_mapping(const RobotModel& model) {
  HandMapping mapping = MappingProposer(model).propose();
  const std::vector<std::string> doubts = mapping_doubts(mapping, model);
  if (!doubts.empty()) {
    mapping.source += ". Not certain. " + fmt::format("{}", fmt::join(doubts, " "));
  }
  return mapping;
}

}  // namespace handway::device
