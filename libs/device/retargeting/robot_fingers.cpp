#include "handway/device/retargeting/robot_fingers.h"

#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/group_proposal.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <regex>
#include <set>
#include <utility>

namespace handway::device {
namespace {

using Eigen::Vector3d;
using geometric::Configuration;
using geometric::InputError;
using geometric::Pose;
using geometric::RobotModel;

constexpr std::array<Finger, kFingers> kAllFingers{Finger::kThumb, Finger::kIndex, Finger::kMiddle,
                                                   Finger::kRing, Finger::kLittle};

bool moves(const RobotModel& model, int link) {
  return link > 0 && model.drive(link).variable >= 0;
}

/// Links from the root to `link`.
std::vector<int> chain_to(const RobotModel& model, int link) {
  std::vector<int> chain;
  for (; link >= 0; link = model.parent(link)) {
    chain.insert(chain.begin(), link);
  }
  return chain;
}

// The longest chain of those that begin with the same link.
std::vector<std::vector<int>> longest_of_branches(const std::vector<std::vector<int>>& chains) {
  std::map<int, std::vector<int>> longest;
  for (const std::vector<int>& chain : chains) {
    std::vector<int>& taken = longest[chain.front()];
    taken = chain.size() > taken.size() ? chain : taken;
  }
  std::vector<std::vector<int>> fingers;
  std::ranges::transform(longest, std::back_inserter(fingers),
                         [](const auto& entry) { return entry.second; });
  return fingers;
}

/// Chains from the palm (not in them) to the fingertips; the palm is where they part. A part of the
/// palm that moves may carry several fingers.
std::pair<int, std::vector<std::vector<int>>> finger_chains(const RobotModel& model,
                                                            const std::vector<int>& leaves) {
  std::vector<std::vector<int>> chains;
  std::ranges::transform(leaves, std::back_inserter(chains),
                         [&](int leaf) { return chain_to(model, leaf); });
  std::size_t common = 0;
  const auto all_have = [&](std::size_t place) {
    return std::ranges::all_of(chains, [&](const std::vector<int>& chain) {
      return place < chain.size() && chain[place] == chains.front()[place];
    });
  };
  while (!chains.empty() && all_have(common)) {
    ++common;
  }
  if (chains.size() < 2 || common == 0) {
    return {-1, {}};
  }
  const int palm = chains.front()[common - 1];
  for (std::vector<int>& chain : chains) {
    chain.erase(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(common));
  }
  std::erase_if(chains, [&](const std::vector<int>& chain) {
    return std::ranges::none_of(chain, [&](int link) { return moves(model, link); });
  });
  return {palm, chains.size() > kAllFingers.size() ? longest_of_branches(chains) : chains};
}

/// The fingertip in the frame of the last link of a chain.
Vector3d tip_point(const RobotModel& model, int link) {
  if (!moves(model, link)) {
    return Vector3d::Zero();
  }
  Vector3d farthest = Vector3d::Zero();
  for (const auto& vertex : geometric::collision_mesh(model.link(link)).vertices) {
    farthest = vertex.norm() > farthest.norm() ? Vector3d(vertex) : farthest;
  }
  return farthest;
}

std::optional<Finger> finger_by_name(const RobotModel& model, const std::vector<int>& chain) {
  static const std::array<std::regex, kFingers> kNames{
      std::regex("thumb|(^|[_/-])(rh_|lh_)?th"), std::regex("index|fore|(^|[_/-])(rh_|lh_)?ff"),
      std::regex("middle|(^|[_/-])(rh_|lh_)?mf"), std::regex("ring|(^|[_/-])(rh_|lh_)?rf"),
      std::regex("little|pinkie|pinky|small|(^|[_/-])(rh_|lh_)?lf")};
  for (const int link : chain) {
    std::string name = model.link(link).name + ' ' + model.joint(link).name;
    std::ranges::transform(name, name.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (std::size_t f = 0; f < kNames.size(); ++f) {
      if (std::regex_search(name, kNames[f])) {
        return kAllFingers[f];
      }
    }
  }
  return std::nullopt;
}

// How far the points but one are from the line that fits them best.
double off_line(const std::vector<RobotFinger>& fingers, std::size_t left_out, Vector3d& along) {
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(fingers.size()) - 1);
  for (std::size_t f = 0, column = 0; f < fingers.size(); ++f) {
    if (f != left_out) {
      points.col(static_cast<Eigen::Index>(column++)) = fingers[f].p_PB;
    }
  }
  points.colwise() -= Vector3d(points.rowwise().mean());
  // Of a type with as many rows, its workspace has their size, which two fingers don't fill.
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(points, Eigen::ComputeThinU);
  along = svd.matrixU().col(0);
  return svd.singularValues().size() > 1 ? svd.singularValues()[1] : 0.0;
}

// The thumb begins beside the line of the others, which follow from its side on.
void number_by_place(std::vector<RobotFinger>& fingers) {
  std::size_t thumb = 0;
  Vector3d along = Vector3d::UnitX();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < fingers.size(); ++f) {
    Vector3d direction;
    if (const double residual = off_line(fingers, f, direction); residual < least - 1e-9) {
      least = residual;
      thumb = f;
      along = direction;
    }
  }
  std::swap(fingers[0], fingers[thumb]);
  const auto place = [&](const RobotFinger& finger) { return finger.p_PB.dot(along); };
  std::sort(fingers.begin() + 1, fingers.end(),
            [&](const RobotFinger& a, const RobotFinger& b) { return place(a) < place(b); });
  if (std::abs(place(fingers[0]) - place(fingers[1])) >
      std::abs(place(fingers[0]) - place(fingers.back()))) {
    std::reverse(fingers.begin() + 1, fingers.end());
  }
  for (std::size_t f = 0; f < fingers.size(); ++f) {
    fingers[f].finger = kAllFingers[f];
  }
}

/// Where fingertips are in the palm's frame.
class Palm {
 public:
  Palm(const RobotModel& model, int palm)
      : model_(model), palm_(palm), X_BL_(static_cast<std::size_t>(model.link_count())) {}

  Vector3d tip(const RobotFinger& finger, const Configuration& q) {
    return point(finger.tip_link, finger.p_LT, q);
  }
  Vector3d point(int link, const Vector3d& p_LT, const Configuration& q) {
    model_.forward_kinematics(q, X_BL_);
    return X_BL_[static_cast<std::size_t>(palm_)].inverse() *
           (X_BL_[static_cast<std::size_t>(link)] * p_LT);
  }

  /// The joints of a finger where its tip is farthest from its base (`sign` 1) or nearest (-1). A
  /// joint that hardly changes that, as the first one, stays neutral.
  Configuration extreme(const RobotFinger& finger, double sign) {
    constexpr int kSweeps = 3;
    constexpr int kSteps = 16;
    constexpr double kNoChange = 5e-4;  // m
    Configuration q = model_.neutral();
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (const int v : finger.variables) {
        double best = sign * (tip(finger, q) - finger.p_PB).norm();
        double kept = q[v];
        for (int step = 0; step <= kSteps; ++step) {
          q[v] = model_.lower()[v] + (model_.upper()[v] - model_.lower()[v]) * step / kSteps;
          const double value = sign * (tip(finger, q) - finger.p_PB).norm();
          if (value > best + kNoChange) {
            best = value;
            kept = q[v];
          }
        }
        q[v] = kept;
      }
    }
    return q;
  }

 private:
  const RobotModel& model_;
  int palm_;
  std::vector<Pose> X_BL_;
};

/// Directions that a person's hand and the robot's have in common, a column each.
struct Directions {
  std::vector<Vector3d> human;
  std::vector<Vector3d> robot;

  void add(const Vector3d& h, const Vector3d& r) {
    if (h.norm() > 1e-6 && r.norm() > 1e-6) {
      human.push_back(h.normalized());
      robot.push_back(r.normalized());
    }
  }
};

GloveAngles flexed(double angle) {
  GloveAngles angles;
  angles.angles.fill(0.0);
  for (const char* finger : {"Index", "Middle", "Ring", "Pinkie"}) {
    for (const char* joint : {"MPJ", "PIJ", "DIJ"}) {
      angles.angles.at(static_cast<std::size_t>(*find_sensor(std::string(finger) + joint))) = angle;
    }
  }
  return angles;
}

Directions common_directions(const RobotFingers& hand, Palm& palm, const Configuration& neutral) {
  const HandLandmarks flat = hand_landmarks(flexed(0.0));
  const HandLandmarks half = hand_landmarks(flexed(0.25 * std::numbers::pi));
  Directions directions;
  const RobotFinger* before = nullptr;
  for (const RobotFinger& finger : hand.fingers) {
    if (finger.finger == Finger::kThumb) {
      continue;
    }
    Configuration bent = neutral;
    const Configuration straight = palm.extreme(finger, 1.0);
    const Configuration closed = palm.extreme(finger, -1.0);
    for (const int v : finger.variables) {
      bent[v] = 0.5 * (straight[v] + closed[v]);
    }
    const Vector3d tip = palm.tip(finger, straight);
    const int human_tip = tip_landmark(finger.finger);
    const int human_base = base_landmark(finger.finger);
    directions.add(flat.col(human_tip) - flat.col(human_base), tip - finger.p_PB);
    directions.add(half.col(human_tip) - flat.col(human_tip), palm.tip(finger, bent) - tip);
    if (before != nullptr) {
      directions.add(flat.col(human_base) - flat.col(base_landmark(before->finger)),
                     finger.p_PB - before->p_PB);
    }
    before = &finger;
  }
  return directions;
}

// The rotation that takes the person's directions best to the robot's (Kabsch); mirrored first if
// that fits better, as for a left hand.
void orient(const Directions& directions, RobotFingers& hand) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < directions.human.size(); ++i) {
    moments += directions.robot[i] * directions.human[i].transpose();
  }
  const auto fit = [&](bool left) {
    const Eigen::Matrix3d mirrored =
        moments * Eigen::DiagonalMatrix<double, 3>(1.0, 1.0, left ? -1.0 : 1.0);
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(mirrored,
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant();
    const Eigen::Matrix3d R = svd.matrixU() * Eigen::DiagonalMatrix<double, 3>(1.0, 1.0, sign) *
                              svd.matrixV().transpose();
    return std::pair(R, (R.transpose() * mirrored).trace());
  };
  const auto [right, right_score] = fit(false);
  const auto [left, left_score] = fit(true);
  hand.left = left_score > right_score + 1e-9;
  hand.R_PH = hand.left ? left : right;
}

RobotFinger make_finger(const RobotModel& model, const std::vector<int>& chain, Palm& palm) {
  RobotFinger finger;
  finger.tip_link = chain.back();
  finger.p_LT = tip_point(model, chain.back());
  int first = -1;
  for (const int link : chain) {
    if (moves(model, link)) {
      first = first < 0 ? link : first;
      const int variable = model.drive(link).variable;
      if (std::ranges::count(finger.variables, variable) == 0) {
        finger.variables.push_back(variable);
      }
    }
  }
  finger.p_PB = palm.point(first, Vector3d::Zero(), model.neutral());
  finger.reach = (palm.tip(finger, palm.extreme(finger, 1.0)) - finger.p_PB).norm();
  return finger;
}

// What a finger merely follows is left to the finger that has the joint, unless it has no other.
void leave_to_owners(const RobotModel& model, const std::vector<std::vector<int>>& chains,
                     std::vector<RobotFinger>& fingers) {
  for (std::size_t f = 0; f < fingers.size(); ++f) {
    const auto is_followed = [&](int variable) {
      const auto has_joint = [&](const std::vector<int>& chain) {
        return std::ranges::count(chain, model.variable_link(variable)) > 0;
      };
      return !has_joint(chains[f]) && std::ranges::any_of(chains, has_joint);
    };
    std::vector<int> own = fingers[f].variables;
    std::erase_if(own, is_followed);
    fingers[f].variables = own.empty() ? fingers[f].variables : own;
  }
}

std::vector<int> leaves_of(const RobotModel& model, const std::map<Finger, std::string>& tips) {
  std::vector<int> leaves;
  if (tips.empty()) {
    for (const std::string& link : geometric::propose_groups(model).fingertips) {
      leaves.push_back(model.find_link(link).value());
    }
  }
  for (const auto& [finger, name] : tips) {
    const std::optional<int> link = model.find_link(name);
    if (!link) {
      throw InputError({"fingertips", name_of(finger), fmt::format("link \"{}\"", name),
                        "a link of robot " + model.name(), ""});
    }
    leaves.push_back(*link);
  }
  return leaves;
}

}  // namespace

RobotFingers find_fingers(const RobotModel& model, const std::map<Finger, std::string>& tips) {
  RobotFingers hand;
  const auto [palm_link, chains] = finger_chains(model, leaves_of(model, tips));
  if (chains.size() < 2 || chains.size() > kAllFingers.size()) {
    throw InputError({"robot " + model.name(), "", fmt::format("{} fingers", chains.size()),
                      "a hand with two to five, each a chain of joints from the palm",
                      "Name its fingertips by \"fingertips\" of a retargeting file."});
  }
  hand.palm = palm_link;
  Palm palm(model, palm_link);
  std::set<Finger> named;
  for (const std::vector<int>& chain : chains) {
    RobotFinger& finger = hand.fingers.emplace_back(make_finger(model, chain, palm));
    for (const auto& [wanted, name] : tips) {
      if (model.link(finger.tip_link).name == name) {
        finger.finger = wanted;
        named.insert(wanted);
      }
    }
    if (const std::optional<Finger> known = finger_by_name(model, chain); known && tips.empty()) {
      finger.finger = *known;
      named.insert(*known);
    }
  }
  leave_to_owners(model, chains, hand.fingers);
  if (named.size() < hand.fingers.size()) {
    number_by_place(hand.fingers);
  }
  std::ranges::sort(hand.fingers, {}, &RobotFinger::finger);
  orient(common_directions(hand, palm, model.neutral()), hand);
  return hand;
}

}  // namespace handway::device
