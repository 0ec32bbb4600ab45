#include "handway/geometric/robot/group_proposal.h"

#include "handway/geometric/robot/base_joint.h"
#include "handway/geometric/robot/hand_structure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

constexpr double kLongestFinger = 0.4;           // m
constexpr std::size_t kMostJointsOfWrist = 2;    // joints of any length
constexpr std::size_t kMostJointsOfCompact = 3;  // joints of a compact wrist
constexpr double kCompactWrist = 0.15;           // m
constexpr int kMostJointsOfNeck = 3;
constexpr double kWithObject = 0.8;  // share of fingers' distance: the rest is the object

class GroupFinder {
 public:
  explicit GroupFinder(const RobotModel& model)
      : model_(model),
        children_(static_cast<std::size_t>(model.link_count())),
        moves_(children_.size()),
        reach_(children_.size()),
        is_palm_(children_.size()),
        joints_to_palm_(children_.size()) {
    for (int link = model.link_count() - 1; link > 0; --link) {
      const auto i = static_cast<std::size_t>(link);
      const auto above = static_cast<std::size_t>(model.parent(link));
      const Joint& joint = model.joint(link);
      children_[above].insert(children_[above].begin(), link);
      moves_[i] = moves_[i] || joint.type != JointType::kFixed;
      moves_[above] = moves_[above] || moves_[i];
      const double slide = joint.type == JointType::kPrismatic ? joint.limits.range() : 0.0;
      reach_[above] = std::max(reach_[above], reach_[i] + joint.X_PJ.translation().norm() + slide);
    }
    for (int link = model.link_count() - 1; link >= 0; --link) {
      find_palm(link);
    }
  }

  [[nodiscard]] GroupProposal find() {
    follow(0);
    if (!proposal_.hand.empty() && leads_by_a_wrist()) {
      std::swap(proposal_.wrist, proposal_.arm);
    }
    std::ranges::transform(fingertips(model_, hand_joints_),
                           std::back_inserter(proposal_.fingertips),
                           [&](int tip) { return model_.link(tip).name; });
    ask();
    return std::move(proposal_);
  }

 private:
  [[nodiscard]] LinkIndices moving_branches(int link) const {
    LinkIndices branches;
    std::ranges::copy_if(children_[static_cast<std::size_t>(link)], std::back_inserter(branches),
                         [&](int child) { return moves_[static_cast<std::size_t>(child)]; });
    return branches;
  }

  [[nodiscard]] bool leads_by_a_wrist() const {
    const std::size_t joints = proposal_.arm.size();
    if (joints <= kMostJointsOfWrist || joints > kMostJointsOfCompact) {
      return joints <= kMostJointsOfWrist;
    }
    int first = model_.find_link(proposal_.palm).value();
    const double beyond_palm = reach_[static_cast<std::size_t>(first)];
    while (model_.joint(first).name != proposal_.arm.front()) {
      first = model_.parent(first);
    }
    return reach_[static_cast<std::size_t>(first)] - beyond_palm <= kCompactWrist;
  }

  // The links from `link` to where the tree branches, or ends.
  void follow(int link) {
    if (link > 0 && !is_of_base(link)) {
      add(proposal_.arm, link);
    }
    LinkIndices branches = moving_branches(link);
    if (branches.empty()) {
      proposal_.tip = model_.link(last_fixed_link(model_, link)).name;
    } else if (is_palm(link)) {
      add_hand(link, branches);
    } else {
      keep_if_any(branches, [&](int branch) { return joints_to_palm(branch) > kMostJointsOfNeck; });
      if (std::ranges::any_of(branches, [&](int b) { return joints_to_palm(b).has_value(); })) {
        keep_if_any(branches, [&](int branch) {
          return joints_to_palm(branch).value_or(joints_to_end(branch)) > kMostJointsOfNeck;
        });
        keep_if_any(branches, [&](int branch) { return joints_to_palm(branch).has_value(); });
      }
      keep_if_any(branches, [&](int branch) { return !is_wheel(branch); });
      std::ranges::for_each(branches, [&](int branch) { follow(branch); });
    }
  }

  // A robot is fixed, unless its description has a moving base.
  [[nodiscard]] bool is_of_base(int link) const {
    return std::ranges::any_of(model_.description().base_joints, [&](const BaseJoint& base) {
      return std::ranges::count(joints_of(base), model_.joint(link).name) > 0;
    });
  }

  static void keep_if_any(LinkIndices& branches, const auto& wanted) {
    if (std::ranges::any_of(branches, wanted)) {
      std::erase_if(branches, [&](int branch) { return !wanted(branch); });
    }
  }

  [[nodiscard]] bool is_palm(int link) const { return is_palm_[static_cast<std::size_t>(link)]; }

  // Number of joints from `link`, its own counted, to the palm farthest from it; none if it leads
  // to no palm.
  [[nodiscard]] std::optional<int> joints_to_palm(int link) const {
    return joints_to_palm_[static_cast<std::size_t>(link)];
  }

  // The largest number of joints from `link`, its own counted, to an end.
  [[nodiscard]] int joints_to_end(int link) const {
    int most = 0;
    for (const int branch : moving_branches(link)) {
      most = std::max(most, joints_to_end(branch));
    }
    return most + (model_.joint(link).type != JointType::kFixed ? 1 : 0);
  }

  // Decides whether `link` is a palm, and how far the next one is, from the results of its
  // children.
  void find_palm(int link) {
    const auto i = static_cast<std::size_t>(link);
    const LinkIndices branches = moving_branches(link);
    LinkIndices fingers = branches;
    std::erase_if(fingers, [&](int branch) { return is_wheel(branch); });
    is_palm_[i] = reach_[i] <= kLongestFinger && can_meet(fingers);
    if (is_palm_[i]) {
      joints_to_palm_[i] = 0;
    } else {
      for (const int branch : branches) {
        joints_to_palm_[i] = std::max(joints_to_palm_[i], joints_to_palm(branch));
      }
    }
    if (joints_to_palm_[i] && link > 0 && model_.joint(link).type != JointType::kFixed) {
      ++*joints_to_palm_[i];
    }
  }

  // Returns whether two of the branches are long enough to touch an object between them: eyes are
  // not. True for branches without shapes.
  [[nodiscard]] bool can_meet(const LinkIndices& branches) const {
    const auto base = [&](int link) { return model_.joint(link).X_PJ.translation(); };
    for (auto one = branches.begin(); one != branches.end(); ++one) {
      for (auto other = std::next(one); other != branches.end(); ++other) {
        if ((!has_shape(*one) && !has_shape(*other)) ||
            kWithObject * (base(*one) - base(*other)).norm() <= sweep(*one) + sweep(*other)) {
          return true;
        }
      }
    }
    return false;
  }

  // Largest distance that `link` and the links on it reach from its joint, m.
  [[nodiscard]] double sweep(int link) const {
    const Joint& joint = model_.joint(link);
    double farthest = 0.0;
    for (const auto* shapes : {&model_.link(link).visual, &model_.link(link).collision}) {
      for (const LinkGeometry& shape : *shapes) {
        const auto mesh = tessellate(shape.shape);
        for (const Eigen::Vector3d& p_G : mesh->vertices) {
          farthest = std::max(farthest, (shape.X_LG * p_G).norm());
        }
      }
    }
    for (const int child : children_[static_cast<std::size_t>(link)]) {
      farthest = std::max(farthest, model_.joint(child).X_PJ.translation().norm() + sweep(child));
    }
    return farthest + (joint.type == JointType::kPrismatic ? joint.limits.range() : 0.0);
  }

  // Returns whether a branch that moves is a single joint that turns without end.
  [[nodiscard]] bool is_wheel(int link) const {
    const LinkIndices branches = moving_branches(link);
    const Joint& joint = model_.joint(link);
    return joint.type == JointType::kFixed
               ? branches.size() == 1 && is_wheel(branches.front())
               : branches.empty() && joint.is_continuous() && !joint.mimic;
  }

  void add_hand(int palm, const LinkIndices& fingers) {
    if (proposal_.palm.empty()) {
      proposal_.palm = model_.link(palm).name;
    }
    std::ranges::for_each(fingers, [&](int finger) { add_finger(finger); });
  }

  void add_finger(int link) {
    add(proposal_.hand, link);
    if (model_.joint(link).type != JointType::kFixed) {
      hand_joints_.push_back(model_.mimic_mapping(link).variable);
    }
    const LinkIndices branches = moving_branches(link);
    std::ranges::for_each(branches, [&](int branch) { add_finger(branch); });
  }

  // Returns whether a link has a shape; motors and synergies that move fingers are links without.
  [[nodiscard]] bool has_shape(int link) const {
    return !model_.link(link).visual.empty() || !model_.link(link).collision.empty() ||
           std::ranges::any_of(children_[static_cast<std::size_t>(link)],
                               [&](int child) { return has_shape(child); });
  }

  void add(std::vector<std::string>& joints, int link) const {
    if (model_.joint(link).type != JointType::kFixed) {
      joints.push_back(model_.joint(link).name);
    }
  }

  void ask() {
    if (!proposal_.wrist.empty()) {
      const bool one = proposal_.wrist.size() == 1;
      proposal_.questions.push_back(
          {fmt::format("{} lead{} to the palm ({}), and may be of the hand or of the arm",
                       fmt::join(proposal_.wrist, ", "), one ? "s" : "", proposal_.palm),
           "Counted to the hand; `handway setup --wrist arm`, or Robot setup… in the window, makes "
           "an "
           "SRDF that counts them to the arm"});
    }
    if (proposal_.hand.empty() && !proposal_.arm.empty() && reach_.front() <= kLongestFinger) {
      proposal_.questions.push_back(
          {fmt::format("{} may be an arm or a finger", fmt::join(proposal_.arm, ", ")),
           "Counted to the arm; name them in a group \"hand\" of the SRDF if they grasp"});
    }
  }

  const RobotModel& model_;
  std::vector<LinkIndices> children_;  // by link
  std::vector<bool> moves_;            // the link or one that it carries
  std::vector<double> reach_;          // m, from the link to the farthest end of what it carries
  std::vector<bool> is_palm_;
  std::vector<std::optional<int>> joints_to_palm_;
  JointIndices hand_joints_;  // of proposal_.hand
  GroupProposal proposal_;
};

}  // namespace

bool has_group(const RobotDescription& robot, const std::string& name) {
  return std::ranges::count(robot.groups, name, &JointGroup::name) > 0;
}

std::vector<std::string> GroupProposal::hand_with_wrist() const {
  std::vector<std::string> joints = wrist;
  joints.insert(joints.end(), hand.begin(), hand.end());
  return joints;
}

GroupProposal propose_groups(const RobotModel& model) { return GroupFinder(model).find(); }

void add_groups(const GroupProposal& proposal, RobotDescription& robot) {
  const std::vector<std::string> hand = proposal.hand_with_wrist();
  if (!proposal.arm.empty() && !has_group(robot, "arm")) {
    robot.groups.push_back({"arm", proposal.arm});
  }
  if (!hand.empty() && !has_group(robot, "hand")) {
    robot.groups.push_back({"hand", hand});
    const bool has_arm = has_group(robot, "arm");
    if (robot.end_effectors.empty()) {
      robot.end_effectors.push_back({"hand", "hand", proposal.palm, has_arm ? "arm" : ""});
    }
  }
}

namespace {

JointIndices hand_joints(const RobotModel& robot) {
  if (auto hand = robot.find_group("hand"); hand && !hand->empty()) {
    return *std::move(hand);
  }
  JointIndices variables;
  for (const std::string& joint : propose_groups(robot).hand_with_wrist()) {
    if (const auto variable = robot.find_variable(joint)) {
      variables.push_back(*variable);
    }
  }
  return variables;
}

/// Parents come before their children, so the later one of two is never above the other.
int common_ancestor(const RobotModel& robot, int a, int b) {
  while (a != b) {
    int& later = a > b ? a : b;
    later = robot.parent(later);
  }
  return a;
}

}  // namespace

std::shared_ptr<const RobotModel> hand_alone(const std::shared_ptr<const RobotModel>& robot) {
  const JointIndices hand = hand_joints(*robot);
  if (hand.empty()) {
    return robot;
  }
  int root = robot->parent(robot->variable_link(hand.front()));
  for (const int variable : hand) {
    root = common_ancestor(*robot, root, robot->parent(robot->variable_link(variable)));
  }
  if (root == 0) {
    return robot;
  }
  const RobotDescription& whole = robot->description();
  RobotDescription alone;
  alone.name = whole.name + "_hand";
  alone.file = whole.file;
  std::vector<bool> kept(static_cast<std::size_t>(robot->link_count()), false);
  kept[static_cast<std::size_t>(root)] = true;
  alone.links.push_back(robot->link(root));
  for (int link = root + 1; link < robot->link_count(); ++link) {
    if (kept[static_cast<std::size_t>(robot->parent(link))]) {
      kept[static_cast<std::size_t>(link)] = true;
      alone.links.push_back(robot->link(link));
      alone.joints.push_back(robot->joint(link));
    }
  }
  const auto has_link = [&](const std::string& name) {
    const auto link = robot->find_link(name);
    return link && kept[static_cast<std::size_t>(*link)];
  };
  for (const auto& [pair, reason] : whole.allowed_collisions.entries()) {
    if (has_link(pair.first) && has_link(pair.second)) {
      alone.allowed_collisions.allow(pair.first, pair.second, reason);
    }
  }
  const auto has_joint = [&](const std::string& name) {
    return std::ranges::count(alone.joints, name, &Joint::name) > 0;
  };
  std::ranges::copy_if(whole.couplings, std::back_inserter(alone.couplings),
                       [&](const JointCoupling& coupling) { return has_joint(coupling.joint); });
  return std::make_shared<const RobotModel>(std::move(alone));
}

}  // namespace handway::geometric
