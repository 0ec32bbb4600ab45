#include "retargeting/finger_bend.h"

#include "handway/geometric/collision/collision_world.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace handway::device {
namespace {

using Eigen::Vector3d;
using geometric::Configuration;
using geometric::Pose;
using geometric::RobotModel;

constexpr double kLeastRange = 1e-4;  // rad or m: less is a fixed joint
constexpr double kAlike = 0.85;       // cosine of the angle between axes that bend alike
constexpr double kTwist = 0.9;        // cosine between axis and phalanx: it turns about itself
constexpr double kSamePlace = 0.004;  // m: joints that near bend a finger at one place
constexpr double kDrawnBend = 0.15;   // rad between two phalanges: less is how they are drawn, …
constexpr double kDrawnTip = 0.3;     // … and of the outermost, whose end is its shape's
constexpr double kDrawnKnuckle = 0.35;   // … and between palm and finger
constexpr double kSideBySide = 0.7;      // cosine of the angle between axes of such fingers
constexpr double kSameDirection = 0.3;   // cosine of the angle between straight fingers
constexpr double kUncertain = 0.25;      // limit of evidence between -2 and 2
constexpr double kContradiction = 0.35;  // evidence on each side
constexpr int kCurlSteps = 8;
constexpr int kCloudPoints = 256;

/// The middle of the end of a finger, in the palm's frame: that of its outermost shape, or its
/// fingertip if that is a frame.
Vector3d end_of(PalmKinematics& palm, const RobotFinger& finger, const Configuration& q) {
  constexpr double kEnd = 0.9;  // of the distance of its farthest point
  if (finger.p_LT.isZero()) {
    return palm.tip(finger, q);
  }
  Vector3d sum = Vector3d::Zero();
  double count = 0.0;
  for (const auto& vertex :
       geometric::collision_mesh(palm.model().link(finger.tip_link)).vertices) {
    if (vertex.norm() > kEnd * finger.p_LT.norm()) {
      sum += vertex;
      count += 1.0;
    }
  }
  return count > 0.0 ? palm.point(finger.tip_link, sum / count, q) : palm.tip(finger, q);
}

/// A joint that turns a finger, at rest.
struct Turn {
  int variable = 0;
  double rate = 0.0;  ///< Rate of the joint per unit of the variable.
  Vector3d origin;    ///< In the palm's frame, m.
  Vector3d axis;
};

std::vector<Turn> turns_of(PalmKinematics& palm, const std::vector<int>& chain,
                           const RobotFinger& finger, const Configuration& q) {
  const RobotModel& model = palm.model();
  std::vector<Turn> turns;
  for (const int link : chain) {
    if (!joint_moves(model, link) || model.joint(link).type == geometric::JointType::kPrismatic ||
        std::ranges::count(finger.variables, model.mimic_mapping(link).variable) == 0) {
      continue;
    }
    const Pose X_PL = palm.pose(link, q);
    turns.push_back({model.mimic_mapping(link).variable, model.mimic_mapping(link).multiplier,
                     X_PL.translation(), X_PL.linear() * model.joint(link).axis.normalized()});
  }
  return turns;
}

/// The vector from a joint to the next one in another place, or to the fingertip.
Vector3d phalanx(const std::vector<Turn>& turns, std::size_t i, const Vector3d& tip) {
  for (std::size_t next = i + 1; next < turns.size(); ++next) {
    if ((turns[next].origin - turns[i].origin).norm() > kSamePlace) {
      return turns[next].origin - turns[i].origin;
    }
  }
  return tip - turns[i].origin;
}

/// The joints that bend a finger about the axis that most have in common; the outermost decides if
/// two axes have equally many.
std::vector<Turn> bending_turns(const std::vector<Turn>& turns, const Vector3d& tip) {
  std::vector<Turn> best;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const auto is_twist = [&](std::size_t j) {
      const Vector3d bone = phalanx(turns, j, tip);
      return std::abs(turns[j].axis.dot(bone)) > kTwist * bone.norm();
    };
    if (is_twist(i)) {
      continue;
    }
    std::vector<Turn> alike;
    for (std::size_t j = 0; j < turns.size(); ++j) {
      if (!is_twist(j) && std::abs(turns[i].axis.dot(turns[j].axis)) > kAlike) {
        alike.push_back(turns[j]);
        alike.back().rate *= sign_of(turns[i].axis.dot(turns[j].axis));
        alike.back().axis = turns[i].axis;
      }
    }
    if (alike.size() >= best.size()) {
      best = std::move(alike);
    }
  }
  return best;
}

/// One place where a finger bends.
struct Bend {
  Vector3d place;
  std::vector<Turn> turns;
  double angle = 0.0;  ///< From the phalanx before to the one after, about the axis, rad.
};

double angle_about(const Vector3d& axis, const Vector3d& from, const Vector3d& to) {
  return std::atan2(axis.dot(from.cross(to)), from.dot(to));
}

std::vector<Bend> bends_along(const std::vector<Turn>& turns, const Vector3d& tip) {
  const Vector3d axis = turns.front().axis;
  const auto in_plane = [&](const Vector3d& v) -> Vector3d { return v - axis.dot(v) * axis; };
  std::vector<Bend> bends;
  for (const Turn& turn : turns) {
    if (bends.empty() || in_plane(turn.origin - bends.back().place).norm() > kSamePlace) {
      bends.push_back({turn.origin, {}, 0.0});
    }
    bends.back().turns.push_back(turn);
  }
  for (std::size_t i = 1; i < bends.size(); ++i) {
    const Vector3d next = i + 1 < bends.size() ? bends[i + 1].place : tip;
    const Vector3d after = in_plane(next - bends[i].place);
    bends[i].angle = after.norm() > kSamePlace
                         ? angle_about(axis, in_plane(bends[i].place - bends[i - 1].place), after)
                         : 0.0;
  }
  return bends;
}

std::size_t index_of(const RobotFinger& finger, int variable) {
  return static_cast<std::size_t>(std::ranges::find(finger.variables, variable) -
                                  finger.variables.begin());
}

/// Finds the variables' values that align the phalanges: the best for all that one variable moves.
void straighten(const RobotModel& model, const RobotFinger& finger, const std::vector<Bend>& places,
                FingerBend& bend) {
  const std::size_t count = finger.variables.size();
  std::vector<double> moments(count, 0.0);
  std::vector<double> squares(count, 0.0);
  std::vector<double> drawn(count, kDrawnTip);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (const Turn& turn : places[i].turns) {
      const std::size_t k = index_of(finger, turn.variable);
      bend.rates[k] += turn.rate;
      if (i == 0) {
        continue;
      }
      bend.is_at_knuckle[k] = false;
      moments[k] -= turn.rate * places[i].angle / static_cast<double>(places[i].turns.size());
      squares[k] += turn.rate * turn.rate;
      drawn[k] = i + 1 < places.size() ? kDrawnBend : drawn[k];
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    const double change = squares[k] > 0.0 ? moments[k] / squares[k] : 0.0;
    if (std::abs(change) * std::sqrt(squares[k]) > drawn[k]) {
      const int v = finger.variables[k];
      bend.straight[k] = std::clamp(bend.straight[k] + change, model.lower()[v], model.upper()[v]);
    }
  }
}

/// Range over which a variable bends the finger from straight, about the axis: at its lower and
/// upper limit.
std::pair<double, double> reach_of(const RobotModel& model, const RobotFinger& finger,
                                   const FingerBend& bend, std::size_t k) {
  const int v = finger.variables[k];
  const double a = bend.rates[k] * (model.lower()[v] - bend.straight[k]);
  const double b = bend.rates[k] * (model.upper()[v] - bend.straight[k]);
  return {std::min(a, b), std::max(a, b)};
}

void find_asymmetry(const RobotModel& model, const RobotFinger& finger, FingerBend& bend) {
  constexpr double kOfKnuckle =
      0.5;  // weight: where a finger is in line with the palm is less sure
  double difference = 0.0;
  double whole = 0.0;
  for (std::size_t k = 0; k < finger.variables.size(); ++k) {
    const auto [least, most] = reach_of(model, finger, bend, k);
    const double weight = bend.is_at_knuckle[k] ? kOfKnuckle : 1.0;
    difference += weight * (most + least);
    whole += weight * (most - least);
  }
  bend.asymmetry = whole > 0.0 ? std::clamp(difference / whole, -1.0, 1.0) : 0.0;
}

/// Sets `q` to a curled finger: its bending joints at `share` of their range from straight to the
/// farther limit. @returns the side to which they turn about the axis.
double curl(const RobotModel& model, const RobotFinger& finger, const FingerBend& bend,
            double share, Configuration& q) {
  double side = 0.0;
  for (std::size_t k = 0; k < finger.variables.size(); ++k) {
    const auto [least, most] = reach_of(model, finger, bend, k);
    side += most + least;
  }
  side = side < -1e-6 ? -1.0 : 1.0;
  for (std::size_t k = 0; k < finger.variables.size(); ++k) {
    const auto [least, most] = reach_of(model, finger, bend, k);
    const double by = share * (side > 0.0 ? std::max(most, 0.0) : std::min(least, 0.0));
    q[finger.variables[k]] = bend.straight[k] + (bend.rates[k] != 0.0 ? by / bend.rates[k] : 0.0);
  }
  return side;
}

/// The i-th number in [0, 1) of the van der Corput sequence in a base.
double radical_inverse(int i, int base) {
  double result = 0.0;
  double share = 1.0;
  for (; i > 0; i /= base) {
    share /= base;
    result += share * (i % base);
  }
  return result;
}

/// Sampled positions of a fingertip over the whole ranges of its joints.
std::vector<Vector3d> workspace(PalmKinematics& palm, const RobotFinger& finger) {
  constexpr std::array<int, 6> kBases{2, 3, 5, 7, 11, 13};
  const RobotModel& model = palm.model();
  Configuration q = model.neutral();
  std::vector<Vector3d> points;
  for (int i = 0; i < kCloudPoints; ++i) {
    for (std::size_t k = 0; k < finger.variables.size(); ++k) {
      const int v = finger.variables[k];
      q[v] = std::lerp(model.lower()[v], model.upper()[v],
                       radical_inverse(i + 1, kBases.at(k % kBases.size())));
    }
    points.push_back(palm.tip(finger, q));
  }
  return points;
}

double distance_between(const std::vector<Vector3d>& some, const std::vector<Vector3d>& others) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& a : some) {
    for (const Vector3d& b : others) {
      least = std::min(least, (a - b).norm());
    }
  }
  return least;
}

/// Scores, in [-1, 1], whether a finger that bends about its axis approaches these points: by their
/// side, and by its nearest distance compared with that of the mirrored finger.
double opposition(PalmKinematics& palm, const RobotFinger& finger, const FingerBend& bend,
                  const std::vector<Vector3d>& points) {
  constexpr double kClear = 2.0;  // half a finger's length is certain
  if (points.empty() || !bend.bends()) {
    return 0.0;
  }
  Configuration q = palm.model().neutral();
  static_cast<void>(curl(palm.model(), finger, bend, 0.0, q));
  const Vector3d straight = palm.tip(finger, q);
  const double length = (straight - bend.knuckle).norm();
  const Vector3d aside = bend.axis.cross(straight - bend.knuckle).normalized();
  std::vector<Vector3d> curled;
  std::vector<Vector3d> mirrored;
  double side = 1.0;
  for (int step = 0; step <= kCurlSteps; ++step) {
    side = curl(palm.model(), finger, bend, static_cast<double>(step) / kCurlSteps, q);
    curled.push_back(palm.tip(finger, q));
    mirrored.emplace_back(curled.back() - 2.0 * aside.dot(curled.back() - bend.knuckle) * aside);
  }
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : points) {
    mean += p / static_cast<double>(points.size());
  }
  const auto clear = [&](double distance) {
    return std::clamp(kClear * distance / length, -1.0, 1.0);
  };
  return 0.5 * clear(aside.dot(mean - bend.knuckle)) +
         0.5 * side * clear(distance_between(mirrored, points) - distance_between(curled, points));
}

bool is_thumb(const RobotFinger& finger) { return finger.finger == Finger::kThumb; }

/// Returns whether the fingers but for the thumb are two or more that lie side by side: then axes
/// of `bends` are turned to point in the same direction.
bool align_side_by_side(PalmKinematics& palm, const std::vector<RobotFinger>& fingers,
                        std::vector<FingerBend>& bends) {
  const FingerBend* first = nullptr;
  Vector3d direction = Vector3d::Zero();
  int count = 0;
  for (std::size_t f = 0; f < fingers.size(); ++f) {
    if (is_thumb(fingers[f])) {
      continue;
    }
    Configuration q = palm.model().neutral();
    static_cast<void>(curl(palm.model(), fingers[f], bends[f], 0.0, q));
    const Vector3d along = (palm.tip(fingers[f], q) - bends[f].knuckle).normalized();
    if (first == nullptr) {
      first = &bends[f];
      direction = along;
    }
    if (!bends[f].bends() || std::abs(bends[f].axis.dot(first->axis)) < kSideBySide ||
        along.dot(direction) < kSameDirection) {
      return false;
    }
    if (bends[f].axis.dot(first->axis) < 0.0) {
      bends[f].reverse();
    }
    ++count;
  }
  return count > 1;
}

/// The middle of the palm's shape, in its frame.
std::optional<Vector3d> middle_of_palm(const PalmKinematics& palm) {
  const auto& vertices = geometric::collision_mesh(palm.model().link(palm.palm())).vertices;
  if (vertices.empty()) {
    return std::nullopt;
  }
  Vector3d lower = vertices.front();
  Vector3d upper = vertices.front();
  for (const Vector3d& vertex : vertices) {
    lower = lower.cwiseMin(vertex);
    upper = upper.cwiseMax(vertex);
  }
  return 0.5 * (lower + upper);
}

/// Aligns fingers side by side with the palm by their first joints, if they are far from aligned
/// with these joints at rest.
void line_up_with_palm(PalmKinematics& palm, const std::vector<RobotFinger>& fingers,
                       std::vector<FingerBend>& bends) {
  const std::optional<Vector3d> middle = middle_of_palm(palm);
  if (!middle) {
    return;
  }
  Vector3d knuckles = Vector3d::Zero();
  double count = 0.0;
  for (std::size_t f = 0; f < fingers.size(); ++f) {
    if (!is_thumb(fingers[f])) {
      knuckles += 0.5 * (bends[f].knuckle + fingers[f].p_PB);
      count += 1.0;
    }
  }
  const Vector3d along = knuckles / count - *middle;
  for (std::size_t f = 0; f < fingers.size(); ++f) {
    if (is_thumb(fingers[f])) {
      continue;
    }
    const Vector3d& axis = bends[f].axis;
    Configuration q = palm.model().neutral();
    static_cast<void>(curl(palm.model(), fingers[f], bends[f], 0.0, q));
    const Vector3d finger = end_of(palm, fingers[f], q) - bends[f].knuckle;
    const double angle =
        angle_about(axis, along - axis.dot(along) * axis, finger - axis.dot(finger) * axis);
    if (std::abs(angle) < kDrawnKnuckle) {
      continue;
    }
    for (std::size_t k = 0; k < fingers[f].variables.size(); ++k) {
      const int v = fingers[f].variables[k];
      if (bends[f].is_at_knuckle[k] && bends[f].rates[k] != 0.0) {
        bends[f].straight[k] = std::clamp(bends[f].straight[k] - angle / bends[f].rates[k],
                                          palm.model().lower()[v], palm.model().upper()[v]);
      }
    }
    find_asymmetry(palm.model(), fingers[f], bends[f]);
  }
}

/// Evidence for a finger's closing about its axis (positive), or against it.
struct Evidence {
  double ranges = 0.0;      ///< By its joints, in [-1, 1].
  double opposition = 0.0;  ///< See opposition().

  [[nodiscard]] double sum() const { return ranges + opposition; }
  [[nodiscard]] bool is_contradictory() const {
    return ranges * opposition < 0.0 && std::abs(ranges) > kContradiction &&
           std::abs(opposition) > kContradiction;
  }
};

std::vector<std::string> doubts_of(const std::string& what, const Evidence& evidence) {
  if (evidence.is_contradictory()) {
    return {
        fmt::format("{}: the ranges of the joints go to one side, the thumb or the other "
                    "fingers are on the other one.",
                    what)};
  }
  if (std::abs(evidence.sum()) < kUncertain) {
    return {
        fmt::format("{}: neither the ranges of the joints nor the place of the thumb say to "
                    "which side it closes.",
                    what)};
  }
  return {};
}

}  // namespace

bool joint_moves(const RobotModel& model, int link) {
  if (link <= 0 || model.mimic_mapping(link).variable < 0) {
    return false;
  }
  const int v = model.mimic_mapping(link).variable;
  return (model.upper()[v] - model.lower()[v]) * std::abs(model.mimic_mapping(link).multiplier) >
         kLeastRange;
}

Pose PalmKinematics::pose(int link, const Configuration& q) {
  model_.forward_kinematics(q, X_BL_);
  return X_BL_[static_cast<std::size_t>(palm_)].inverse() * X_BL_[static_cast<std::size_t>(link)];
}

void FingerBend::reverse() {
  axis = -axis;
  asymmetry = -asymmetry;
  for (double& rate : rates) {
    rate = -rate;
  }
}

FingerBend bend_of(PalmKinematics& palm, const std::vector<int>& chain, const RobotFinger& finger) {
  const RobotModel& model = palm.model();
  Configuration q = model.neutral();
  FingerBend bend;
  bend.knuckle = finger.p_PB;
  bend.rates.assign(finger.variables.size(), 0.0);
  bend.is_at_knuckle.assign(finger.variables.size(), true);
  // Joints that bend the finger are drawn straight at 0, or as near to it as possible.
  for (const Turn& turn :
       bending_turns(turns_of(palm, chain, finger, q), end_of(palm, finger, q))) {
    q[turn.variable] = std::clamp(0.0, model.lower()[turn.variable], model.upper()[turn.variable]);
  }
  for (const int v : finger.variables) {
    bend.straight.push_back(q[v]);
  }
  const Vector3d tip = end_of(palm, finger, q);
  const std::vector<Turn> turns = bending_turns(turns_of(palm, chain, finger, q), tip);
  if (turns.empty()) {
    return bend;
  }
  bend.axis = turns.front().axis;
  bend.knuckle = turns.front().origin;
  straighten(model, finger, bends_along(turns, tip), bend);
  find_asymmetry(model, finger, bend);
  return bend;
}

std::vector<std::string> find_closing_sides(PalmKinematics& palm,
                                            const std::vector<RobotFinger>& fingers,
                                            std::vector<FingerBend>& bends) {
  std::vector<std::vector<Vector3d>> workspaces;
  for (const RobotFinger& finger : fingers) {
    workspaces.push_back(workspace(palm, finger));
  }
  const bool side_by_side = align_side_by_side(palm, fingers, bends);
  if (side_by_side) {
    line_up_with_palm(palm, fingers, bends);
  }
  std::vector<Evidence> evidence(fingers.size());
  Evidence all;
  double count = 0.0;
  for (std::size_t f = 0; f < fingers.size(); ++f) {
    std::vector<Vector3d> others;
    for (std::size_t other = 0; other < fingers.size(); ++other) {
      if (other != f && (!side_by_side || is_thumb(fingers[f]) || is_thumb(fingers[other]))) {
        others.insert(others.end(), workspaces[other].begin(), workspaces[other].end());
      }
    }
    // One joint without phalanges behind it may open as well as close.
    const bool has_phalanges = std::ranges::count(bends[f].is_at_knuckle, false) > 0;
    evidence[f] = {side_by_side || has_phalanges ? bends[f].asymmetry : 0.0,
                   opposition(palm, fingers[f], bends[f], others)};
    if (!is_thumb(fingers[f])) {
      all.ranges += evidence[f].ranges;
      all.opposition += evidence[f].opposition;
      count += 1.0;
    }
  }
  all.ranges /= std::max(count, 1.0);
  all.opposition /= std::max(count, 1.0);
  std::vector<std::string> doubts;
  if (side_by_side) {
    doubts = doubts_of("The fingers", all);
  }
  for (std::size_t f = 0; f < fingers.size(); ++f) {
    const std::string& name = name_of(fingers[f].finger);
    const bool goes_with_others = side_by_side && !is_thumb(fingers[f]);
    if (bends[f].bends() && (goes_with_others ? all : evidence[f]).sum() < 0.0) {
      bends[f].reverse();
    }
    if (goes_with_others) {
      if (bends[f].asymmetry < -kContradiction) {
        doubts.push_back(fmt::format(
            "The {} finger: the ranges of its joints go to another side than the others'.", name));
      }
    } else if (!is_thumb(fingers[f]) && bends[f].bends()) {
      std::ranges::move(doubts_of("The finger taken for the " + name, evidence[f]),
                        std::back_inserter(doubts));
    }
  }
  return doubts;
}

}  // namespace handway::device
