#include "handway/geometric/formats/robot_loader.h"

#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/formats/urdf_reader.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/base_joint.h"

#include <algorithm>
#include <random>
#include <stdexcept>
#include <vector>

namespace handway::geometric {
namespace {

bool is_of_base(const RobotModel& model, int link) {
  return std::ranges::any_of(model.description().base_joints, [&](const BaseJoint& base) {
    return std::ranges::count(joints_of(base), model.joint(link).name) > 0;
  });
}

// The closest ancestor with collision geometry; -1 if there is none, or a planar or floating joint
// between: what moves freely may hit what it moves against.
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

AllowedCollisions sample_allowed_collisions(const RobotModel& model, int samples,
                                            std::uint64_t seed) {
  if (samples < 1) {
    throw std::invalid_argument("sample_allowed_collisions: samples must be at least 1, got " +
                                std::to_string(samples));
  }
  FclChecker checker(world_of_all_pairs(model));
  const CollisionWorld& world = checker.world();
  std::vector<int> hits(world.pairs().size());
  std::mt19937_64 generator(seed);
  Configuration q(model.variable_count());
  for (int sample = 0; sample < samples; ++sample) {
    for (int v = 0; v < model.variable_count(); ++v) {
      q[v] = model.lower()[v] + uniform(generator) * (model.upper()[v] - model.lower()[v]);
    }
    checker.place(q);
    for (std::size_t pair = 0; pair < hits.size(); ++pair) {
      // A pair that was hit and missed once is neither Always nor Never.
      if (hits[pair] == 0 || hits[pair] == sample) {
        hits[pair] += checker.pair_collides(static_cast<int>(pair)) ? 1 : 0;
      }
    }
  }
  AllowedCollisions allowed = adjacent_links(model);
  for (std::size_t pair = 0; pair < hits.size(); ++pair) {
    const std::string& a = world.body(world.pairs()[pair].a).name;
    const std::string& b = world.body(world.pairs()[pair].b).name;
    if (!allowed.reason(a, b) && (hits[pair] == 0 || hits[pair] == samples)) {
      allowed.allow(a, b, hits[pair] == 0 ? AllowedReason::kNever : AllowedReason::kAlways);
    }
  }
  return allowed;
}

std::shared_ptr<const RobotModel> load_robot(const std::filesystem::path& file) {
  if (!has_extension(file, ".urdf")) {
    throw InputError({file.string(), "", "a file called *" + file.extension().string(),
                      "a robot file (*.urdf)", "Convert xacro files with the xacro tool first"});
  }
  RobotDescription description = read_urdf(file);
  if (description.allowed_collisions.entries().empty()) {
    description.allowed_collisions = adjacent_links(RobotModel(description));
    if (!description.allowed_collisions.entries().empty()) {
      description.warnings.push_back(
          "no SRDF disables collisions between links: only links that a joint connects are "
          "allowed to touch");
    }
  }
  return std::make_shared<const RobotModel>(std::move(description));
}

}  // namespace handway::geometric
