#include "handway/device/retargeting/fingertip_retargeter.h"

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/jacobian.h"

#include <fmt/format.h>
#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

namespace handway::device {
namespace {

using Eigen::Vector3d;
using geometric::Configuration;
using geometric::Pose;
using geometric::YamlElement;

constexpr int kMostEvaluations = 200;
constexpr double kLeastChange = 1e-5;  // relative change of the minimised value
constexpr double kPinchReach = 0.04;  // m: tips of a person's fingers that are nearer come together
constexpr double kPadDepth = 0.015;   // m: between their tips when the pads touch
constexpr int kRounds = 2;            // rounds over all fingers, out of self-collision
constexpr double kMuchNearer = 0.7;   // to the fingertips, as a share of the miss
constexpr double kLeastShare = 0.02;  // smallest share of a finger's move tried

const RobotFinger* thumb_of(const RobotFingers& hand) {
  const auto found = std::ranges::find(hand.fingers, Finger::kThumb, &RobotFinger::finger);
  return found == hand.fingers.end() ? nullptr : &*found;
}

/// Scales from a person's fingers to the robot's, in their order; the thumb's is the mean of the
/// others.
std::vector<double> scales_of(const RobotFingers& hand, double scale, const HandBones& bones) {
  GloveAngles flat;
  flat.angles.fill(0.0);
  const HandLandmarks landmarks = hand_landmarks(flat, bones);
  std::vector<double> scales;
  double sum = 0.0;
  int count = 0;
  for (const RobotFinger& finger : hand.fingers) {
    const double human_reach =
        (landmarks.col(tip_landmark(finger.finger)) - landmarks.col(base_landmark(finger.finger)))
            .norm();
    scales.push_back(scale * finger.reach / human_reach);
    if (finger.finger != Finger::kThumb) {
      sum += scales.back();
      ++count;
    }
  }
  for (std::size_t f = 0; f < scales.size(); ++f) {
    scales[f] = hand.fingers[f].finger == Finger::kThumb ? sum / count : scales[f];
  }
  return scales;
}

double positive(const YamlElement& element, double least) {
  const double value = element.number();
  if (!(value >= least)) {
    element.refuse(element.found(), least > 0.0 ? "a number above 0" : "0 or more");
  }
  return value;
}

}  // namespace

bool is_retargeting(const std::filesystem::path& file) {
  return YamlElement::read(file, "a mapping").find("retargeting").has_value();
}

RetargetingSettings read_retargeting(const std::filesystem::path& file) {
  const YamlElement top = YamlElement::read(file, "a retargeting of a hand");
  top.allow_keys({"hand", "retargeting"});
  RetargetingSettings settings;
  settings.hand = top.need("hand").text();
  const YamlElement map = top.need("retargeting");
  if (!map.is_map()) {
    return settings;
  }
  map.allow_keys({"scale", "pinch", "smoothness", "self_collision", "fingertips"});
  if (const auto scale = map.find("scale")) {
    settings.scale = positive(*scale, 1e-3);
  }
  if (const auto pinch = map.find("pinch")) {
    settings.pinch = positive(*pinch, 0.0);
  }
  if (const auto smoothness = map.find("smoothness")) {
    settings.smoothness = positive(*smoothness, 0.0);
  }
  settings.self_collision = map.flag_or("self_collision", settings.self_collision);
  if (const auto tips = map.find("fingertips")) {
    tips->allow_keys({"thumb", "index", "middle", "ring", "little"});
    for (int f = 0; f < kFingers; ++f) {
      const auto finger = static_cast<Finger>(f);
      if (const auto link = tips->find(name_of(finger))) {
        settings.fingertips[finger] = link->text();
      }
    }
  }
  return settings;
}

/// Problem that NLopt minimises for one posture.
struct FingertipRetargeter::Problem {
  const FingertipRetargeter& self;
  const HandLandmarks& landmarks;
  Eigen::Matrix3Xd wanted;
  Configuration q;     ///< Configuration of the whole robot.
  Configuration last;  ///< Last one of the whole robot.
  std::vector<Pose> X_BL;
  std::vector<geometric::Jacobian> jacobians;

  /// The tip of a finger in the palm's frame, and its motion with the robot's variables.
  Vector3d tip(const RobotFinger& finger, std::size_t place) {
    const geometric::RobotModel& model = *self.hand_;
    const Pose& X_BP = X_BL[static_cast<std::size_t>(self.fingers_.palm)];
    jacobians[place] = geometric::point_jacobian(model, X_BL, finger.tip_link, finger.p_LT);
    jacobians[place].topRows<3>() =
        (X_BP.linear().transpose() * jacobians[place].topRows<3>()).eval();
    return X_BP.inverse() * (X_BL[static_cast<std::size_t>(finger.tip_link)] * finger.p_LT);
  }

  double evaluate(Eigen::VectorXd& gradient) {
    const RobotFingers& hand = self.fingers_;
    self.hand_->forward_kinematics(q, X_BL);
    gradient.setZero(q.size());
    double value = 0.0;
    Eigen::Matrix3Xd tips(3, wanted.cols());
    const auto add = [&](double weight, const Vector3d& miss, const auto& jacobian) {
      value += weight * miss.squaredNorm();
      gradient += 2.0 * weight * jacobian.transpose() * miss;
    };
    for (std::size_t f = 0; f < hand.fingers.size(); ++f) {
      const auto column = static_cast<Eigen::Index>(f);
      const RobotFinger& finger = hand.fingers[f];
      tips.col(column) = tip(finger, f);
      add(1.0 / (finger.reach * finger.reach), tips.col(column) - wanted.col(column),
          jacobians[f].topRows<3>());
    }
    add_pinches(tips, add);
    add_moves(value, gradient);
    return value;
  }

  template <typename Add>
  void add_pinches(const Eigen::Matrix3Xd& tips, const Add& add) const {
    const RobotFingers& hand = self.fingers_;
    const RobotFinger* thumb = thumb_of(hand);
    if (thumb == nullptr || self.settings_.pinch <= 0.0) {
      return;
    }
    const auto t = static_cast<std::size_t>(thumb - hand.fingers.data());
    for (std::size_t f = 0; f < hand.fingers.size(); ++f) {
      if (f == t) {
        continue;
      }
      const Vector3d gap = landmarks.col(tip_landmark(Finger::kThumb)) -
                           landmarks.col(tip_landmark(hand.fingers[f].finger));
      const double near = gap.norm() / kPinchReach;
      const double weight = self.settings_.pinch * std::exp(-near * near);
      if (weight < 1e-3) {
        continue;
      }
      const double open = std::max(0.0, gap.norm() - kPadDepth) / std::max(gap.norm(), 1e-9);
      const double scale = self.scales_[t];
      const Vector3d miss = tips.col(static_cast<Eigen::Index>(t)) -
                            tips.col(static_cast<Eigen::Index>(f)) -
                            scale * open * self.turned(gap);
      const double reach = hand.fingers[f].reach;
      add(weight / (reach * reach), miss,
          (jacobians[t].topRows<3>() - jacobians[f].topRows<3>()).eval());
    }
  }

  void add_moves(double& value, Eigen::VectorXd& gradient) const {
    for (const int v : self.variables_) {
      const double range = std::max(self.upper_[v] - self.lower_[v], 1e-6);
      const double weight = self.settings_.smoothness / (range * range);
      const double move = q[v] - last[v];
      value += weight * move * move;
      gradient[v] += 2.0 * weight * move;
    }
  }

  static double minimised(unsigned count, const double* x, double* gradient, void* data) {
    auto& problem = *static_cast<Problem*>(data);
    const std::vector<int>& variables = problem.self.variables_;
    for (unsigned i = 0; i < count; ++i) {
      problem.q[variables[i]] = x[i];
    }
    Eigen::VectorXd all;
    const double value = problem.evaluate(all);
    for (unsigned i = 0; gradient != nullptr && i < count; ++i) {
      gradient[i] = all[variables[i]];
    }
    return value;
  }
};

FingertipRetargeter::FingertipRetargeter(std::shared_ptr<const geometric::RobotModel> hand,
                                         const RetargetingSettings& settings)
    : hand_(std::move(hand)),
      settings_(settings),
      fingers_(find_fingers(*hand_, settings.fingertips)) {
  lower_ = hand_->lower();
  upper_ = hand_->upper();
  for (int v = 0; v < hand_->variable_count(); ++v) {
    joints_.push_back(hand_->variable(v).name);
  }
  for (const RobotFinger& finger : fingers_.fingers) {
    variables_.insert(variables_.end(), finger.variables.begin(), finger.variables.end());
  }
  scales_ = scales_of(fingers_, settings_.scale, settings_.bones);
  std::ranges::sort(variables_);
  variables_.erase(std::unique(variables_.begin(), variables_.end()), variables_.end());
  if (settings_.self_collision) {
    geometric::Scene scene;
    scene.robots.push_back({hand_->name(), {}, hand_, Pose::Identity(), hand_->neutral()});
    checker_ =
        geometric::make_collision_checker(std::make_shared<const geometric::CollisionWorld>(scene));
  }
}

FingertipRetargeter::~FingertipRetargeter() = default;

const RobotFinger& FingertipRetargeter::seen_from(const RobotFinger& finger) const {
  const bool is_thumb = finger.finger == Finger::kThumb;
  return is_thumb ? fingers_.fingers[1] : finger;  // in their order, the thumb first
}

Vector3d FingertipRetargeter::turned(const Vector3d& v_H) const {
  return fingers_.R_PH * Vector3d(v_H.x(), v_H.y(), fingers_.left ? -v_H.z() : v_H.z());
}

Eigen::Matrix3Xd FingertipRetargeter::wanted(const HandLandmarks& landmarks) const {
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(fingers_.fingers.size()));
  for (Eigen::Index f = 0; f < result.cols(); ++f) {
    const RobotFinger& finger = fingers_.fingers[static_cast<std::size_t>(f)];
    const RobotFinger& from = seen_from(finger);
    const Vector3d v_H =
        landmarks.col(tip_landmark(finger.finger)) - landmarks.col(base_landmark(from.finger));
    result.col(f) = from.p_PB + scales_[static_cast<std::size_t>(f)] * turned(v_H);
  }
  return result;
}

Eigen::Matrix3Xd FingertipRetargeter::fingertips(const Eigen::VectorXd& posture) const {
  std::vector<Pose> X_BL(static_cast<std::size_t>(hand_->link_count()));
  hand_->forward_kinematics(posture, X_BL);
  const Pose X_PB = X_BL[static_cast<std::size_t>(fingers_.palm)].inverse();
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(fingers_.fingers.size()));
  for (Eigen::Index f = 0; f < result.cols(); ++f) {
    const RobotFinger& finger = fingers_.fingers[static_cast<std::size_t>(f)];
    result.col(f) = X_PB * (X_BL[static_cast<std::size_t>(finger.tip_link)] * finger.p_LT);
  }
  return result;
}

Eigen::VectorXd FingertipRetargeter::middle() const { return 0.5 * (lower_ + upper_); }

Eigen::VectorXd FingertipRetargeter::posture(const HandLandmarks& landmarks,
                                             const Eigen::VectorXd& last) const {
  Problem problem{*this,
                  landmarks,
                  wanted(landmarks),
                  last,
                  last,
                  std::vector<Pose>(static_cast<std::size_t>(hand_->link_count())),
                  std::vector<geometric::Jacobian>(fingers_.fingers.size())};
  const auto count = static_cast<unsigned>(variables_.size());
  const std::unique_ptr<std::remove_pointer_t<nlopt_opt>, decltype(&nlopt_destroy)> optimizer(
      nlopt_create(NLOPT_LD_SLSQP, count), &nlopt_destroy);
  std::vector<double> x;
  std::vector<double> lower;
  std::vector<double> upper;
  for (const int v : variables_) {
    x.push_back(std::clamp(last[v], lower_[v], upper_[v]));
    lower.push_back(lower_[v]);
    upper.push_back(upper_[v]);
  }
  nlopt_set_lower_bounds(optimizer.get(), lower.data());
  nlopt_set_upper_bounds(optimizer.get(), upper.data());
  nlopt_set_min_objective(optimizer.get(), &Problem::minimised, &problem);
  nlopt_set_ftol_rel(optimizer.get(), kLeastChange);
  nlopt_set_maxeval(optimizer.get(), kMostEvaluations);
  double value = 0.0;
  nlopt_optimize(optimizer.get(), x.data(), &value);  // on failure x is the best so far
  Eigen::VectorXd posture = last;
  for (std::size_t i = 0; i < x.size(); ++i) {
    posture[variables_[i]] = std::clamp(x[i], lower[i], upper[i]);
  }
  return out_of_collision(posture, last);
}

// Starts from the last posture, or from the open hand if that comes much nearer: so fingers in
// contact come free again.
Eigen::VectorXd FingertipRetargeter::out_of_collision(const Eigen::VectorXd& posture,
                                                      const Eigen::VectorXd& last) const {
  const std::lock_guard lock(checking_);
  if (!checker_ || !checker_->first_collision(posture)) {
    return posture;
  }
  const Eigen::Matrix3Xd wanted_there = fingertips(posture);
  const auto miss = [&](const Eigen::VectorXd& q) {
    return (fingertips(q) - wanted_there).colwise().norm().sum();
  };
  const std::optional<Eigen::VectorXd> from_last = advanced(last, posture);
  const std::optional<Eigen::VectorXd> from_open = advanced(hand_->neutral(), posture);
  if (!from_last || (from_open && miss(*from_open) < kMuchNearer * miss(*from_last))) {
    return from_open.value_or(posture);
  }
  return *from_last;
}

// Moves finger by finger, each as far as it can: a blocked one does not hold the others.
std::optional<Eigen::VectorXd> FingertipRetargeter::advanced(const Eigen::VectorXd& from,
                                                             const Eigen::VectorXd& to) const {
  if (checker_->first_collision(from)) {
    return std::nullopt;
  }
  Configuration reached = from;
  const auto advance = [&](const RobotFinger& finger, double share) {
    Configuration q = reached;
    for (const int v : finger.variables) {
      q[v] += share * (to[v] - q[v]);
    }
    const bool free = !checker_->first_collision(q);
    reached = free ? q : reached;
    return free;
  };
  for (int round = 0; round < kRounds; ++round) {
    for (const RobotFinger& finger : fingers_.fingers) {
      for (double share = 1.0; share > kLeastShare && !advance(finger, share); share *= 0.5) {
      }
    }
  }
  return reached;
}

std::vector<bool> FingertipRetargeter::driven() const {
  std::vector<bool> result(joints_.size(), false);
  for (const int v : variables_) {
    result[static_cast<std::size_t>(v)] = true;
  }
  return result;
}

MappedPostures FingertipRetargeter::map_recording(const Recording& recording,
                                                  const std::stop_token& stop) const {
  MappedPostures result;
  result.joints = joints_;
  result.clamped.assign(joints_.size(), 0);
  result.postures.resize(recording.values.rows(), lower_.size());
  Eigen::VectorXd last = middle();
  for (Eigen::Index row = 0; row < recording.values.rows(); ++row) {
    if (stop.stop_requested()) {
      result.postures.conservativeResize(row, result.postures.cols());
      break;
    }
    last = posture(landmarks(angles_of_row(recording, row)), last);
    result.postures.row(row) = last;
  }
  result.unclamped = result.postures;
  return result;
}

}  // namespace handway::device
