#include "handway/geometric/setup/collision_sampling.h"

#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/robot/base_joint.h"

#include <algorithm>
#include <memory>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

namespace handway::geometric {
namespace {

bool is_of_base(const RobotModel& model, int link) {
  return std::ranges::any_of(model.description().base_joints, [&](const BaseJoint& base) {
    return std::ranges::count(joints_of(base), model.joint(link).name) > 0;
  });
}

// The closest ancestor with collision geometry; -1 if it does not exist, or a planar or floating
// joint is between: a free body may collide with its parent.
int solid_ancestor(const RobotModel& model, int link) {
  while (link > 0 && !is_of_base(model, link)) {
    link = model.parent(link);
    if (!model.link(link).collision.empty()) {
      return link;
    }
  }
  return -1;
}

std::shared_ptr<const CollisionWorld> world_of_all_pairs(const RobotModel& model) {
  RobotDescription description = model.description();
  description.allowed_collisions = {};
  RobotInstance robot;
  robot.name = model.name();
  robot.model = std::make_shared<const RobotModel>(std::move(description));
  robot.configuration = model.neutral();
  Scene scene;
  scene.robots.push_back(std::move(robot));
  return std::make_shared<const CollisionWorld>(scene);
}

// Uniform in [0, 1) from the generator's upper 53 bits: the standard library's
// distributions may differ between its implementations.
double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1.0p-53;
}

Configuration random_configuration(const RobotModel& model, std::mt19937_64& generator) {
  Configuration q(model.variable_count());
  for (int v = 0; v < model.variable_count(); ++v) {
    q[v] = model.lower()[v] + uniform(generator) * (model.upper()[v] - model.lower()[v]);
  }
  return q;
}

// Variables that move a link against a link above it.
std::set<int> variables_between(const RobotModel& model, int link, int above) {
  std::set<int> variables;
  for (; link != above; link = model.parent(link)) {
    if (model.mimic_mapping(link).variable >= 0) {
      variables.insert(model.mimic_mapping(link).variable);
    }
  }
  return variables;
}

int common_ancestor(const RobotModel& model, int a, int b) {
  while (a != b) {
    (a > b ? a : b) = model.parent(std::max(a, b));
  }
  return a;
}

// Returns whether a single joint moves both links and is at a limit at neutral.
bool are_jaws(const RobotModel& model, const std::string& name_a, const std::string& name_b) {
  const int a = model.find_link(name_a).value();
  const int b = model.find_link(name_b).value();
  const int palm = common_ancestor(model, a, b);
  const std::set<int> variables = variables_between(model, a, palm);
  if (variables.size() != 1 || variables_between(model, b, palm) != variables) {
    return false;
  }
  const int v = *variables.begin();
  const double q = model.neutral()[v];
  return q == model.lower()[v] || q == model.upper()[v];
}

void check_samples(int samples) {
  if (samples < 1) {
    throw std::invalid_argument("self-collision samples must be at least 1, got " +
                                std::to_string(samples));
  }
}

std::vector<bool> touching_at(FclChecker& checker, const Configuration& q) {
  std::vector<bool> touching(checker.world().pairs().size());
  checker.place(q);
  for (std::size_t pair = 0; pair < touching.size(); ++pair) {
    touching[pair] = checker.pair_collides(static_cast<int>(pair));
  }
  return touching;
}

}  // namespace

AllowedCollisions adjacent_links(const RobotModel& model) {
  AllowedCollisions allowed;
  for (int link = 1; link < model.link_count(); ++link) {
    const int above = solid_ancestor(model, link);
    if (above >= 0 && !model.link(link).collision.empty()) {
      allowed.allow(model.link(above).name, model.link(link).name, AllowedReason::kAdjacent);
    }
  }
  return allowed;
}

bool SampledPair::overlaps(int samples) const { return at_neutral && 2 * collisions >= samples; }

bool SampledPair::closes(int samples) const {
  return jaws && at_neutral && !at_middle && 100 * collisions <= samples;
}

bool SampledPair::is_checked(int samples) const {
  return collisions < samples && !overlaps(samples) && !closes(samples) && !by_user;
}

SelfCollisionSamples sample_self_collisions(const RobotModel& model, int samples,
                                            std::uint64_t seed, const std::stop_token& stop,
                                            const std::function<void(double)>& progress) {
  check_samples(samples);
  FclChecker checker(world_of_all_pairs(model));
  const CollisionWorld& world = checker.world();
  const AllowedCollisions adjacent = adjacent_links(model);
  SelfCollisionSamples found;
  const std::vector<bool> at_neutral = touching_at(checker, model.neutral());
  const std::vector<bool> at_middle =
      touching_at(checker, Configuration(0.5 * (model.lower() + model.upper())));
  std::vector<int> indices;
  for (std::size_t pair = 0; pair < world.pairs().size(); ++pair) {
    SampledPair sampled{world.body(world.pairs()[pair].a).name,
                        world.body(world.pairs()[pair].b).name};
    if (!adjacent.reason(sampled.a, sampled.b)) {
      sampled.jaws = at_neutral[pair] && are_jaws(model, sampled.a, sampled.b);
      sampled.at_neutral = at_neutral[pair];
      sampled.at_middle = at_middle[pair];
      sampled.by_user = model.description().allowed_collisions.reason(sampled.a, sampled.b) ==
                        AllowedReason::kUser;
      indices.push_back(static_cast<int>(pair));
      found.pairs.push_back(std::move(sampled));
    }
  }
  std::vector<std::vector<std::size_t>> touching;
  std::mt19937_64 generator(seed);
  while (found.samples == 0 || (found.samples < samples && !stop.stop_requested())) {
    std::vector<std::size_t> sample;
    checker.place(random_configuration(model, generator));
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (checker.pair_collides(indices[i])) {
        sample.push_back(i);
        ++found.pairs[i].collisions;
      }
    }
    touching.push_back(std::move(sample));
    ++found.samples;
    if (progress) {
      progress(static_cast<double>(found.samples) / samples);
    }
  }
  found.colliding = static_cast<int>(std::ranges::count_if(touching, [&](const auto& sample) {
    return std::ranges::any_of(
        sample, [&](std::size_t i) { return found.pairs[i].is_checked(found.samples); });
  }));
  return found;
}

AllowedCollisions allowed_collisions(const RobotModel& model, const SelfCollisionSamples& sampled) {
  AllowedCollisions allowed = adjacent_links(model);
  for (const SampledPair& pair : sampled.pairs) {
    if (pair.collisions == 0 && !pair.at_neutral && !pair.at_middle) {
      allowed.allow(pair.a, pair.b, AllowedReason::kNever);
    } else if (pair.collisions == sampled.samples) {
      allowed.allow(pair.a, pair.b, AllowedReason::kAlways);
    } else if (pair.overlaps(sampled.samples) || pair.closes(sampled.samples)) {
      allowed.allow(pair.a, pair.b, AllowedReason::kDefault);
    }
  }
  return allowed;
}

AllowedCollisions sample_overlapping_links(const RobotModel& model, int samples,
                                           std::uint64_t seed) {
  check_samples(samples);
  FclChecker checker(world_of_all_pairs(model));
  const CollisionWorld& world = checker.world();
  AllowedCollisions allowed = adjacent_links(model);
  std::vector<std::pair<int, SampledPair>> candidates;
  checker.place(model.neutral());
  for (std::size_t pair = 0; pair < world.pairs().size(); ++pair) {
    SampledPair sampled{world.body(world.pairs()[pair].a).name,
                        world.body(world.pairs()[pair].b).name, 0, true};
    if (!allowed.reason(sampled.a, sampled.b) && checker.pair_collides(static_cast<int>(pair))) {
      sampled.jaws = are_jaws(model, sampled.a, sampled.b);
      candidates.emplace_back(static_cast<int>(pair), std::move(sampled));
    }
  }
  std::mt19937_64 generator(seed);
  for (int sample = 0; sample < samples && !candidates.empty(); ++sample) {
    checker.place(random_configuration(model, generator));
    for (auto& [index, pair] : candidates) {
      pair.collisions += checker.pair_collides(index) ? 1 : 0;
    }
  }
  for (const auto& [index, pair] : candidates) {
    if (pair.overlaps(samples) || pair.closes(samples)) {
      allowed.allow(pair.a, pair.b,
                    pair.collisions == samples ? AllowedReason::kAlways : AllowedReason::kDefault);
    }
  }
  return allowed;
}

}  // namespace handway::geometric
