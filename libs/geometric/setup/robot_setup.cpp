#include "handway/geometric/setup/robot_setup.h"

#include "handway/geometric/collision/collision_world.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

constexpr double kLargestLink = 5.0;    // m
constexpr double kSmallestLink = 5e-4;  // m
constexpr double kSizeRatio = 50.0;     // ratio of visual and collision sizes
constexpr std::size_t kMostPairs = 5;   // pairs named as reasons of collisions

std::optional<double> size_of(const Link& link) {
  const TriangleMesh mesh = collision_mesh(link);
  return mesh.vertices.empty() ? std::nullopt : std::optional(bounding_box(mesh).size().maxCoeff());
}

// m³, negative if most faces point inwards.
double signed_volume(const TriangleMesh& mesh) {
  const Eigen::Vector3d middle = bounding_box(mesh).centre();
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += (mesh.vertices[a] - middle)
                  .dot((mesh.vertices[b] - middle).cross(mesh.vertices[c] - middle)) /
              6.0;
  }
  return volume;
}

class Examination {
 public:
  Examination(const RobotModel& model, const SelfCollisionSamples& sampled)
      : model_(model), sampled_(sampled) {}

  void look_at_shapes() {
    std::vector<std::string> inverted;
    std::vector<std::string> open;
    for (const Link& link : model_.description().links) {
      look_at_size(link);
      for (const LinkGeometry& part : link.collision) {
        if (!is_closed(part.shape)) {
          open.push_back(link.name);
        } else if (signed_volume(*tessellate(part.shape)) < 0.0) {
          inverted.push_back(link.name);
        }
      }
    }
    add_list("faces of collision meshes point inwards", inverted,
             "Collisions are found all the same; turn the faces over in the mesh file for other "
             "programs");
    add_list("collision meshes are open, so that only their surface collides", open,
             "Close the holes, or take the convex hull as collision mesh");
  }

  void look_at_joints() {
    std::vector<std::string> fast;
    for (int v = 0; v < model_.variable_count(); ++v) {
      const JointLimits& limits = model_.variable(v).limits;
      if (std::isinf(limits.velocity) && limits.range() > 0.0) {
        fast.push_back(model_.variable(v).name);
      }
    }
    add_list(
        "joints have no velocity limit", fast,
        "Write <limit velocity=…>, or a joint_limits.yaml: motions are timed by 1 rad/s or m/s");
  }

  void look_at_pairs() {
    for (const SampledPair& pair : sampled_.pairs) {
      if (pair.by_user) {
        continue;
      }
      if (pair.collisions == sampled_.samples) {
        add(fmt::format("{} and {} touch in every posture", pair.a, pair.b),
            "Their shapes overlap; the pair is allowed to touch (Always)", {pair.a, pair.b});
      } else if (pair.overlaps(sampled_.samples)) {
        add(fmt::format("{} and {} touch at the zero posture and in {} of random ones", pair.a,
                        pair.b, share(pair.collisions)),
            "Their shapes overlap; the pair is allowed to touch (Default). Give one of them a "
            "smaller collision mesh to have it checked",
            {pair.a, pair.b});
      } else if ((pair.at_neutral || pair.at_middle) && pair.is_checked(sampled_.samples)) {
        add(fmt::format("{} and {} touch at the {} posture, and in {} of random ones", pair.a,
                        pair.b, pair.at_neutral ? "zero" : "middle", share(pair.collisions)),
            "The pair is checked: start from another posture, or disable it in the SRDF if the "
            "shapes are too large",
            {pair.a, pair.b}, !pair.at_neutral);
      }
    }
  }

  void look_at_share() {
    if (2 * sampled_.colliding < sampled_.samples) {
      return;
    }
    std::vector<const SampledPair*> pairs;
    for (const SampledPair& pair : sampled_.pairs) {
      if (pair.collisions > 0 && pair.is_checked(sampled_.samples)) {
        pairs.push_back(&pair);
      }
    }
    std::ranges::stable_sort(pairs, std::ranges::greater(), &SampledPair::collisions);
    pairs.resize(std::min(pairs.size(), kMostPairs));
    std::vector<std::string> named;
    std::ranges::transform(pairs, std::back_inserter(named), [&](const SampledPair* pair) {
      return fmt::format("{} with {} ({})", pair->a, pair->b, share(pair->collisions));
    });
    add(fmt::format("{} of random postures collide, most by {}", share(sampled_.colliding),
                    fmt::join(named, ", ")),
        "Look whether these collision meshes are larger than the links are, and whether the joint "
        "limits are right");
  }

  void ask(const GroupProposal& groups) {
    for (const GroupQuestion& question : groups.questions) {
      add(question.open, question.mend);
    }
  }

  [[nodiscard]] std::vector<RobotFinding> findings() && { return std::move(findings_); }

 private:
  void add(std::string found, std::string mend, std::vector<std::string> links = {},
           bool at_middle = false) {
    findings_.push_back({std::move(found), std::move(mend), std::move(links), at_middle});
  }

  void add_list(const char* what, std::vector<std::string>& names, const char* mend) {
    names.erase(std::unique(names.begin(), names.end()), names.end());
    if (!names.empty()) {
      add(fmt::format("{}: {}", what, fmt::join(names, ", ")), mend, names);
    }
  }

  void look_at_size(const Link& link) {
    const std::optional<double> collides = size_of(link);
    const std::optional<double> seen = size_of({link.name, {}, link.visual});
    if (collides && *collides > kLargestLink) {
      add(fmt::format("link {} is {:.3g} m long", link.name, *collides),
          "If the mesh is in millimetres, write scale=\"0.001 0.001 0.001\"", {link.name});
    } else if (collides && *collides < kSmallestLink) {
      add(fmt::format("link {} is {:.3g} mm long", link.name, 1000.0 * *collides),
          "If the mesh is in metres already, leave its scale away", {link.name});
    } else if (collides && seen && std::abs(std::log(*collides / *seen)) > std::log(kSizeRatio)) {
      add(fmt::format("link {} looks {:.3g} m long and collides as one of {:.3g} m", link.name,
                      *seen, *collides),
          "Give the visual and the collision mesh the same scale", {link.name});
    }
  }

  [[nodiscard]] std::string share(int count) const {
    return fmt::format("{:.3g} %", 100.0 * count / sampled_.samples);
  }

  const RobotModel& model_;
  const SelfCollisionSamples& sampled_;
  std::vector<RobotFinding> findings_;
};

}  // namespace

std::vector<RobotFinding> examine_robot(const RobotModel& model,
                                        const SelfCollisionSamples& sampled,
                                        const GroupProposal& groups) {
  Examination examination(model, sampled);
  examination.look_at_shapes();
  examination.look_at_joints();
  examination.look_at_pairs();
  examination.look_at_share();
  examination.ask(groups);
  return std::move(examination).findings();
}

GroupProposal decided_groups(const RobotModel& model, WristOwner wrist) {
  GroupProposal groups = propose_groups(model);
  if (wrist != WristOwner::kUndecided) {
    std::vector<std::string>& owner = wrist == WristOwner::kArm ? groups.arm : groups.hand;
    owner.insert(owner.begin(), groups.wrist.begin(), groups.wrist.end());
    groups.wrist.clear();
    groups.questions.clear();
  }
  return groups;
}

RobotDescription with_setup(const RobotModel& model, const SelfCollisionSamples& sampled,
                            const GroupProposal& groups, const SetupDecisions& decisions) {
  RobotDescription robot = model.description();
  const AllowedCollisions before = robot.allowed_collisions;
  robot.allowed_collisions = allowed_collisions(model, sampled);
  for (const auto& [pair, reason] : before.entries()) {
    if (reason == AllowedReason::kUser) {
      robot.allowed_collisions.allow(pair.first, pair.second, reason);
    }
  }
  for (const auto& [pair, allowed_collisions] : decisions.allowed_collisions) {
    if (allowed_collisions) {
      robot.allowed_collisions.allow(pair.first, pair.second, AllowedReason::kUser);
    } else {
      robot.allowed_collisions.forbid(pair.first, pair.second);
    }
  }
  if (decisions.wrist != WristOwner::kUndecided) {
    std::erase_if(robot.groups, [](const JointGroup& group) {
      return group.name == "arm" || group.name == "hand";
    });
  }
  add_groups(groups, robot);
  return robot;
}

}  // namespace handway::geometric
