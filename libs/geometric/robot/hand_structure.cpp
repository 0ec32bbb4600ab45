#include "handway/geometric/robot/hand_structure.h"

#include "handway/geometric/robot/inverse_kinematics.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

namespace handway::geometric {
namespace {

constexpr double kBesideFinger = 0.03;  // m: bars of a linkage begin that near to their finger

bool contains(const std::vector<int>& list, int one) { return std::ranges::count(list, one) > 0; }

// Returns the elements of a list that are in `others`, too.
std::vector<int> shared_by(std::vector<int> list, const std::vector<int>& others) {
  std::erase_if(list, [&](int one) { return !contains(others, one); });
  return list;
}

// The links that carry `link`, the nearest first.
LinkIndices ancestors(const RobotModel& model, int link) {
  LinkIndices chain;
  for (link = model.parent(link); link >= 0; link = model.parent(link)) {
    chain.push_back(link);
  }
  return chain;
}

// The closest link that carries all of the hand's joints, those on other arms left out.
std::optional<int> carrier_of(const RobotModel& model, const JointIndices& arm,
                              const JointIndices& hand) {
  const auto arm_below = [&](const LinkIndices& chain) {
    return chain.empty() ? 0 : std::ssize(shared_by(chain_variables(model, chain.front()), arm));
  };
  LinkIndices common = ancestors(model, model.variable_link(hand.front()));
  for (const int joint : hand) {
    LinkIndices shared = shared_by(common, ancestors(model, model.variable_link(joint)));
    if (arm_below(shared) == arm_below(common)) {  // else: of another hand
      common = std::move(shared);
    }
  }
  return common.empty() ? std::nullopt : std::optional(common.front());
}

// The deepest link below `carrier` that carries all links moved by the hand's joints: a wrist that
// counts to the hand is no finger. `carrier` itself if they move a single chain.
int past_the_wrist(const RobotModel& model, const JointIndices& hand, int carrier) {
  std::vector<bool> carries_moved(static_cast<std::size_t>(model.link_count()));
  std::optional<LinkIndices> shared;
  int ends = 0;
  for (int link = model.link_count() - 1; link > carrier; --link) {  // parents come first
    const LinkIndices chain = ancestors(model, link);
    if (!contains(hand, model.mimic_mapping(link).variable) ||
        carries_moved[static_cast<std::size_t>(link)] || !contains(chain, carrier)) {
      continue;
    }
    for (const int above : chain) {
      carries_moved[static_cast<std::size_t>(above)] = true;
    }
    ++ends;
    shared = shared_by(shared.value_or(chain), chain);
  }
  return ends > 1 ? shared->front() : carrier;
}

int find_palm(const RobotModel& model, const JointIndices& arm, const JointIndices& hand) {
  if (!hand.empty()) {
    if (const std::optional<int> carrier = carrier_of(model, arm, hand)) {
      return past_the_wrist(model, hand, *carrier);
    }
  }
  return arm.empty() ? model.link_count() - 1 : model.variable_link(arm.back());
}

bool is_fixed(const RobotModel& model, int link) {
  return model.joint(link).type == JointType::kFixed;
}

void keep_if_any(LinkIndices& links, const auto& wanted) {
  if (std::ranges::any_of(links, wanted)) {
    std::erase_if(links, [&](int link) { return !wanted(link); });
  }
}

/// The fingers of all hands of a robot.
class FingerTree {
 public:
  FingerTree(const RobotModel& model, const JointIndices& hand) : model_(model), hand_(hand) {
    find_shapes();
    find_ends([this](int link) { return is_drawn_[static_cast<std::size_t>(link)]; });
    if (ends_.empty()) {
      find_ends([](int) { return true; });
    }
    count_ends();
    keep_if_any(ends_, [this](int end) { return !is_bar(end); });
    count_ends();
  }

  /// The last link of each finger that the hand moves, ascending.
  [[nodiscard]] const LinkIndices& ends() const { return ends_; }

  // The highest link beyond `palm` that carries no other finger than the one with that end.
  [[nodiscard]] int root(int end, int palm) const {
    int first = end;
    while (model_.parent(first) > 0 && model_.parent(first) != palm &&
           ends_on(model_.parent(first)) < 2) {
      first = model_.parent(first);
    }
    return first;
  }

  [[nodiscard]] HandFinger finger(int palm, int end) const {
    HandFinger finger;
    finger.links = subtree(root(end, palm));
    for (const int link : finger.links) {
      const int joint = model_.mimic_mapping(link).variable;
      if (contains(hand_, joint) && !contains(finger.joints, joint)) {
        finger.joints.push_back(joint);
      }
    }
    finger.tip = last_fixed_link(model_, end);
    return finger;
  }

 private:
  [[nodiscard]] int ends_on(int link) const { return ends_on_[static_cast<std::size_t>(link)]; }

  void find_shapes() {
    is_drawn_.resize(static_cast<std::size_t>(model_.link_count()));
    for (int link = model_.link_count() - 1; link > 0; --link) {  // parents come first
      const auto i = static_cast<std::size_t>(link);
      const Link& one = model_.link(link);
      is_drawn_[i] = is_drawn_[i] || !one.visual.empty() || !one.collision.empty();
      const auto above = static_cast<std::size_t>(model_.parent(link));
      is_drawn_[above] = is_drawn_[above] || is_drawn_[i];
    }
  }

  // Finds those that the hand moves, that are wanted, and that carry no other such link.
  void find_ends(const auto& wanted) {
    std::vector<bool> carries_end(is_drawn_.size());
    for (int link = model_.link_count() - 1; link > 0; --link) {
      if (!carries_end[static_cast<std::size_t>(link)] &&
          contains(hand_, model_.mimic_mapping(link).variable) && wanted(link)) {
        ends_.push_back(link);
        for (const int above : ancestors(model_, link)) {
          carries_end[static_cast<std::size_t>(above)] = true;
        }
      }
    }
    std::ranges::reverse(ends_);
  }

  void count_ends() {
    ends_on_.assign(is_drawn_.size(), 0);
    for (const int end : ends_) {
      ++ends_on_[static_cast<std::size_t>(end)];
      for (const int above : ancestors(model_, end)) {
        ++ends_on_[static_cast<std::size_t>(above)];
      }
    }
  }

  [[nodiscard]] LinkIndices subtree(int first) const {
    LinkIndices links{first};
    for (int link = first + 1; link < model_.link_count(); ++link) {
      if (contains(links, model_.parent(link))) {
        links.push_back(link);
      }
    }
    return links;
  }

  [[nodiscard]] bool is_bar(int end) const {
    const int bar = root(end, 0);
    return std::ranges::any_of(ends_, [&](int other) {
      const int finger = root(other, 0);
      return other != end && model_.parent(finger) == model_.parent(bar) &&
             is_bar_beside(bar, finger);
    });
  }

  [[nodiscard]] bool is_bar_beside(int bar, int finger) const {
    const JointIndices of_bar = joints_on(bar);
    const JointIndices of_finger = joints_on(finger);
    const auto base = [&](int link) { return model_.joint(link).X_PJ.translation(); };
    const auto axis = [&](int link) -> Eigen::Vector3d {
      return model_.joint(link).X_PJ.linear() * model_.joint(link).axis *
             model_.mimic_mapping(link).multiplier;
    };
    return of_bar.size() < of_finger.size() && (base(bar) - base(finger)).norm() < kBesideFinger &&
           axis(bar).dot(axis(finger)) >= 0.0 &&
           std::ranges::all_of(of_bar, [&](int joint) { return joint == of_finger.front(); });
  }

  // The joint that each moving link of a branch follows.
  [[nodiscard]] JointIndices joints_on(int branch) const {
    JointIndices joints;
    for (const int link : subtree(branch)) {
      if (!is_fixed(model_, link)) {
        joints.push_back(model_.mimic_mapping(link).variable);
      }
    }
    return joints;
  }

  const RobotModel& model_;
  const JointIndices& hand_;
  std::vector<bool> is_drawn_;  // the link or one that it carries has a shape
  LinkIndices ends_;
  std::vector<int> ends_on_;  // by link: of the fingers that it is part of or carries
};

}  // namespace

HandStructure HandStructure::of(const RobotModel& model, const JointIndices& arm,
                                const JointIndices& hand) {
  HandStructure found;
  found.palm = find_palm(model, arm, hand);
  const FingerTree tree(model, hand);
  for (const int end : tree.ends()) {
    if (contains(ancestors(model, end), found.palm)) {
      found.fingers.push_back(tree.finger(found.palm, end));
    }
  }
  std::ranges::sort(found.fingers, {}, [](const HandFinger& f) { return f.links.front(); });
  return found;
}

LinkIndices fingertips(const RobotModel& model, const JointIndices& hand) {
  LinkIndices tips;
  std::ranges::transform(FingerTree(model, hand).ends(), std::back_inserter(tips),
                         [&](int end) { return last_fixed_link(model, end); });
  return tips;
}

int last_fixed_link(const RobotModel& model, int link) {
  std::vector<bool> is_free_of_joints(static_cast<std::size_t>(model.link_count()), true);
  std::vector<double> length(is_free_of_joints.size(), 0.0);  // of the longest chain from a link
  std::vector<int> end(is_free_of_joints.size(), -1);         // of that chain
  for (int below = model.link_count() - 1; below >= link; --below) {  // parents come first
    const auto i = static_cast<std::size_t>(below);
    end[i] = end[i] < 0 ? below : end[i];
    if (below == link) {
      break;
    }
    const auto above = static_cast<std::size_t>(model.parent(below));
    if (!is_fixed(model, below) || !is_free_of_joints[i]) {
      is_free_of_joints[above] = false;
      continue;
    }
    const double to_end = length[i] + model.joint(below).X_PJ.translation().norm();
    if (end[above] < 0 || to_end >= length[above]) {
      length[above] = to_end;
      end[above] = end[i];
    }
  }
  return end[static_cast<std::size_t>(link)];
}

}  // namespace handway::geometric
