#include "handway/device/retargeting/robot_fingers.h"

#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/group_proposal.h"
#include "retargeting/finger_bend.h"

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

/// Chains from the palm (excluded) to the fingertips; the palm is where they branch. A moving part
/// of the palm may carry several fingers.
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
    return std::ranges::none_of(chain, [&](int link) { return joint_moves(model, link); });
  });
  return {palm, chains.size() > kAllFingers.size() ? longest_of_branches(chains) : chains};
}

/// The fingertip in the frame of the last link of a chain.
Vector3d tip_point(const RobotModel& model, int link) {
  if (!joint_moves(model, link)) {
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

/// A finger with its links from the palm on and how it bends.
struct FoundFinger {
  RobotFinger finger;
  std::vector<int> chain;
  FingerBend bend;
};

/// Deviation of the fingers but one from a row, m: the distance of their knuckles from the best
/// line, plus the difference of their axes.
double disorder(const std::vector<FoundFinger>& fingers, std::size_t left_out, Vector3d& along) {
  constexpr double kOfAxes = 0.02;  // m, of axes at right angles
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(fingers.size()) - 1);
  double difference = 0.0;
  const FoundFinger* before = nullptr;
  for (std::size_t f = 0, column = 0; f < fingers.size(); ++f) {
    if (f != left_out) {
      points.col(static_cast<Eigen::Index>(column++)) = fingers[f].bend.knuckle;
      if (before != nullptr && before->bend.bends() && fingers[f].bend.bends()) {
        difference += 1.0 - std::abs(before->bend.axis.dot(fingers[f].bend.axis));
      }
      before = &fingers[f];
    }
  }
  points.colwise() -= Vector3d(points.rowwise().mean());
  // A matrix type with fixed rows would get a workspace of that size, which two fingers don't
  // fill.
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(points, Eigen::ComputeThinU);
  along = svd.matrixU().col(0);
  return (svd.singularValues().size() > 1 ? svd.singularValues()[1] : 0.0) +
         kOfAxes * difference / static_cast<double>(fingers.size());
}

// The thumb begins beside the line of the others, which follow from its side on.
void number_by_place(std::vector<FoundFinger>& fingers) {
  std::size_t thumb = 0;
  Vector3d along = Vector3d::UnitX();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < fingers.size(); ++f) {
    Vector3d direction;
    if (const double value = disorder(fingers, f, direction); value < least - 1e-9) {
      least = value;
      thumb = f;
      along = direction;
    }
  }
  std::swap(fingers[0], fingers[thumb]);
  const auto place = [&](const FoundFinger& found) {
    return (&found == fingers.data() ? found.finger.p_PB : found.bend.knuckle).dot(along);
  };
  const double of_thumb = place(fingers[0]);
  std::sort(fingers.begin() + 1, fingers.end(), [&](const FoundFinger& a, const FoundFinger& b) {
    return a.bend.knuckle.dot(along) < b.bend.knuckle.dot(along);
  });
  if (std::abs(of_thumb - place(fingers[1])) > std::abs(of_thumb - place(fingers.back()))) {
    std::reverse(fingers.begin() + 1, fingers.end());
  }
  for (std::size_t f = 0; f < fingers.size(); ++f) {
    fingers[f].finger.finger = kAllFingers[f];
  }
}

/// The joints of a finger with its tip farthest from its base (`sign` 1) or nearest (-1). A joint
/// with little effect on that, as the first one, stays neutral.
Configuration extreme(PalmKinematics& palm, const RobotFinger& finger, double sign) {
  constexpr int kSweeps = 3;
  constexpr int kSteps = 16;
  constexpr double kNoChange = 5e-4;  // m
  const RobotModel& model = palm.model();
  Configuration q = model.neutral();
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const int v : finger.variables) {
      double best = sign * (palm.tip(finger, q) - finger.p_PB).norm();
      double kept = q[v];
      for (int step = 0; step <= kSteps; ++step) {
        q[v] = std::lerp(model.lower()[v], model.upper()[v], static_cast<double>(step) / kSteps);
        const double value = sign * (palm.tip(finger, q) - finger.p_PB).norm();
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

/// Common directions of a person's hand and the robot's, a column each.
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

/// Direction of a straight finger, and the direction to which it closes.
std::pair<Vector3d, Vector3d> directions_of(PalmKinematics& palm, const FoundFinger& found) {
  const RobotFinger& finger = found.finger;
  if (found.bend.bends()) {
    Configuration q = palm.model().neutral();
    for (std::size_t k = 0; k < finger.variables.size(); ++k) {
      q[finger.variables[k]] = found.bend.straight[k];
    }
    const Vector3d along = palm.tip(finger, q) - found.bend.knuckle;
    return {along, found.bend.axis.cross(along)};
  }
  const Configuration straight = extreme(palm, finger, 1.0);
  const Configuration closed = extreme(palm, finger, -1.0);
  Configuration bent = palm.model().neutral();
  for (const int v : finger.variables) {
    bent[v] = 0.5 * (straight[v] + closed[v]);
  }
  const Vector3d tip = palm.tip(finger, straight);
  return {tip - finger.p_PB, palm.tip(finger, bent) - tip};
}

Directions common_directions(const std::vector<FoundFinger>& fingers, PalmKinematics& palm) {
  GloveAngles open;
  open.angles.fill(0.0);
  const HandLandmarks flat = hand_landmarks(open);
  Directions directions;
  const RobotFinger* before = nullptr;
  for (const FoundFinger& found : fingers) {
    const RobotFinger& finger = found.finger;
    if (finger.finger == Finger::kThumb) {
      continue;
    }
    const auto [along, closing] = directions_of(palm, found);
    const int human_base = base_landmark(finger.finger);
    directions.add(flat.col(tip_landmark(finger.finger)) - flat.col(human_base), along);
    directions.add(-Vector3d::UnitZ(), closing);
    if (before != nullptr) {
      directions.add(flat.col(human_base) - flat.col(base_landmark(before->finger)),
                     finger.p_PB - before->p_PB);
    }
    before = &finger;
  }
  return directions;
}

// Finds the rotation of the person's directions that fits the robot's best (Kabsch); mirrored first
// if that fits better, as for a left hand.
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

/// The moving joints of a chain.
std::vector<int> variables_of(const RobotModel& model, const std::vector<int>& chain) {
  std::vector<int> variables;
  for (const int link : chain) {
    if (joint_moves(model, link) &&
        std::ranges::count(variables, model.mimic_mapping(link).variable) == 0) {
      variables.push_back(model.mimic_mapping(link).variable);
    }
  }
  return variables;
}

// Returns the variables of a finger without those of other fingers that it follows, unless it has
// no others.
std::vector<int> own_variables(const RobotModel& model, const std::vector<std::vector<int>>& chains,
                               const std::vector<int>& chain) {
  const auto has_joint = [&](const std::vector<int>& links, int variable) {
    return std::ranges::count(links, model.variable_link(variable)) > 0;
  };
  const std::vector<int> all = variables_of(model, chain);
  std::vector<int> own = all;
  std::erase_if(own, [&](int variable) {
    return !has_joint(chain, variable) && std::ranges::any_of(chains, [&](const auto& other) {
      return has_joint(other, variable);
    });
  });
  return own.empty() ? all : own;
}

/// The first link that only this finger has and one of its own joints moves; else the first that
/// moves.
int first_link(const RobotModel& model, const std::vector<std::vector<int>>& chains,
               const std::vector<int>& chain, const std::vector<int>& variables) {
  const auto moves = [&](int link) { return joint_moves(model, link); };
  const auto is_own = [&](int link) {
    return moves(link) && std::ranges::count(variables, model.mimic_mapping(link).variable) > 0 &&
           std::ranges::count_if(chains, [&](const std::vector<int>& other) {
             return std::ranges::count(other, link) > 0;
           }) == 1;
  };
  const auto own = std::ranges::find_if(chain, is_own);
  return own != chain.end() ? *own : *std::ranges::find_if(chain, moves);
}

FoundFinger make_finger(PalmKinematics& palm, const std::vector<std::vector<int>>& chains,
                        const std::vector<int>& chain) {
  const RobotModel& model = palm.model();
  FoundFinger found;
  RobotFinger& finger = found.finger;
  found.chain = chain;
  finger.tip_link = chain.back();
  finger.p_LT = tip_point(model, chain.back());
  finger.variables = own_variables(model, chains, chain);
  finger.p_PB = palm.point(first_link(model, chains, chain, finger.variables), Vector3d::Zero(),
                           model.neutral());
  finger.reach = (palm.tip(finger, extreme(palm, finger, 1.0)) - finger.p_PB).norm();
  found.bend = bend_of(palm, chain, finger);
  return found;
}

/// Decides to which sides the fingers close.
void find_sides(PalmKinematics& palm, std::vector<FoundFinger>& fingers, RobotFingers& hand) {
  std::vector<RobotFinger> plain;
  std::vector<FingerBend> bends;
  for (const FoundFinger& found : fingers) {
    plain.push_back(found.finger);
    bends.push_back(found.bend);
  }
  hand.doubts = find_closing_sides(palm, plain, bends);
  for (std::size_t f = 0; f < fingers.size(); ++f) {
    fingers[f].bend = std::move(bends[f]);
    fingers[f].finger.straight = fingers[f].bend.straight;
    fingers[f].finger.flexion = fingers[f].bend.rates;
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
  PalmKinematics palm(model, palm_link);
  std::vector<FoundFinger> fingers;
  std::set<Finger> named;
  for (const std::vector<int>& chain : chains) {
    RobotFinger& finger = fingers.emplace_back(make_finger(palm, chains, chain)).finger;
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
  if (named.size() < fingers.size()) {
    number_by_place(fingers);
  }
  std::ranges::sort(fingers, {}, [](const FoundFinger& found) { return found.finger.finger; });
  find_sides(palm, fingers, hand);
  orient(common_directions(fingers, palm), hand);
  for (FoundFinger& found : fingers) {
    hand.fingers.push_back(std::move(found.finger));
  }
  return hand;
}

}  // namespace handway::device
