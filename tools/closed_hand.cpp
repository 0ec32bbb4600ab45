#include "closed_hand.h"

#include <algorithm>
#include <map>
#include <utility>

namespace handway::tools {
namespace {

using geometric::CollisionChecker;
using geometric::CollisionWorld;
using geometric::Configuration;
using geometric::RobotModel;

constexpr double kFar = 0.3;             // m, a finger that is farther away does not close
constexpr double kFirstStep = 0.02;      // rad, or m of a sliding finger
constexpr double kLeastStep = 1e-6;      // the same
constexpr double kDifference = 1e-4;     // the same, of the gradient
constexpr double kLeastGradient = 1e-4;  // m by rad
constexpr int kMostSteps = 300;

/// What one branch of the palm moves.
struct Finger {
  std::vector<int> variables;
  std::vector<int> pairs;         ///< All that it takes part in.
  std::vector<int> object_pairs;  ///< Of these, with the objects.
};

// The palm's child that `link` hangs from; -1: it does not hang from the palm.
int branch_of(const RobotModel& model, int palm, int link) {
  while (link >= 0 && model.parent(link) != palm) {
    link = model.parent(link);
  }
  return link;
}

std::vector<Finger> fingers_of(const CollisionWorld& world, const std::vector<int>& hand, int palm,
                               const std::vector<std::string>& objects) {
  const RobotModel& model = world.model();
  std::map<int, Finger> by_branch;
  for (const int variable : hand) {
    if (const int branch = branch_of(model, palm, model.variable_link(variable)); branch >= 0) {
      by_branch[branch].variables.push_back(variable);
    }
  }
  for (int pair = 0; pair < static_cast<int>(world.pairs().size()); ++pair) {
    const geometric::BodyPair& bodies = world.pairs()[static_cast<std::size_t>(pair)];
    for (auto& [branch, finger] : by_branch) {
      const auto is_of_finger = [&, b = branch](int body) {
        return world.body(body).moves() && branch_of(model, palm, world.body(body).link) == b;
      };
      if (is_of_finger(bodies.a) || is_of_finger(bodies.b)) {
        finger.pairs.push_back(pair);
        if (std::ranges::count(objects, world.body(bodies.b).name) > 0) {
          finger.object_pairs.push_back(pair);
        }
      }
    }
  }
  std::vector<Finger> fingers;
  fingers.reserve(by_branch.size());
  for (auto& [branch, finger] : by_branch) {
    fingers.push_back(std::move(finger));
  }
  return fingers;
}

class FingerClosing {
 public:
  FingerClosing(CollisionChecker& checker, const Finger& finger, double gap)
      : checker_(checker), model_(checker.world().model()), finger_(finger), gap_(gap) {}

  [[nodiscard]] Configuration closed(Configuration q) {
    double distance = distance_to_objects(q);
    double size = kFirstStep;
    for (int step = 0; step < kMostSteps && size > kLeastStep && distance < kFar; ++step) {
      const Configuration direction = closing_direction(q, distance);
      if (direction.norm() < kLeastGradient) {
        break;
      }
      for (; size > kLeastStep; size *= 0.5) {
        const Configuration next =
            (q + size * direction.normalized()).cwiseMax(model_.lower()).cwiseMin(model_.upper());
        const double closer = distance_to_objects(next);
        if (closer < distance && keeps_gap(next)) {
          q = next;
          distance = closer;
          break;
        }
      }
    }
    return q;
  }

 private:
  [[nodiscard]] double distance_to_objects(const Configuration& q) {
    checker_.place(q);
    double least = kFar;
    for (const int pair : finger_.object_pairs) {
      least = std::min(least, checker_.pair_distance(pair, least));
    }
    return least;
  }

  [[nodiscard]] bool keeps_gap(const Configuration& q) {
    checker_.place(q);
    return std::ranges::all_of(finger_.pairs, [&](int pair) {
      return checker_.pair_closeness(pair, gap_) == geometric::Closeness::kFarther;
    });
  }

  // Against the gradient of the distance, of joints that are not at a limit.
  [[nodiscard]] Configuration closing_direction(const Configuration& q, double distance) {
    Configuration direction = Configuration::Zero(q.size());
    for (const int v : finger_.variables) {
      Configuration moved = q;
      const double step = q[v] + kDifference <= model_.upper()[v] ? kDifference : -kDifference;
      moved[v] += step;
      const double rate = (distance - distance_to_objects(moved)) / step;
      const bool stuck = rate > 0.0 ? q[v] >= model_.upper()[v] : q[v] <= model_.lower()[v];
      direction[v] = stuck ? 0.0 : rate;
    }
    return direction;
  }

  CollisionChecker& checker_;
  const RobotModel& model_;
  const Finger& finger_;
  double gap_;
};

}  // namespace

std::vector<int> hand_links(const RobotModel& model, int palm) {
  std::vector<int> links{palm};
  for (int link = 0; link < model.link_count(); ++link) {
    if (branch_of(model, palm, link) >= 0) {
      links.push_back(link);
    }
  }
  return links;
}

Configuration close_hand(CollisionChecker& checker, const std::vector<int>& hand, int palm,
                         const std::vector<std::string>& objects, Configuration q, double gap) {
  for (const Finger& finger : fingers_of(checker.world(), hand, palm, objects)) {
    q = FingerClosing(checker, finger, gap).closed(std::move(q));
  }
  return q;
}

}  // namespace handway::tools
