#include "handway/geometric/collision/contact.h"

#include "collision/fcl_tree.h"
#include "collision/inside_mesh.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

namespace handway::geometric {
namespace {

constexpr double kPrecision = 1e-4;       // m
constexpr std::size_t kMostPoints = 400;  // triangle contacts that the middle is taken of

// Two bodies in their places, one of which can be shifted.
class PlacedPair {
 public:
  PlacedPair(const CollisionBody& a, const Pose& X_WA, const CollisionBody& b, const Pose& X_WB)
      : a_(a),
        b_(b),
        X_WA_(X_WA),
        X_WB_(X_WB),
        tree_a_(make_fcl_tree(*a.mesh)),
        tree_b_(make_fcl_tree(*b.mesh)) {}

  // Middle and mean normal (from a to b) of where the surfaces cross, if they do.
  struct Crossing {
    Eigen::Vector3d middle;
    Eigen::Vector3d normal;
  };
  [[nodiscard]] std::optional<Crossing> crossing() const {
    fcl::CollisionRequestd request(kMostPoints, true);
    fcl::CollisionResultd result;
    fcl::collide(tree_a_.get(), X_WA_, tree_b_.get(), X_WB_, request, result);
    if (!result.isCollision()) {
      return std::nullopt;
    }
    Crossing crossing{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    for (std::size_t i = 0; i < result.numContacts(); ++i) {
      crossing.middle += result.getContact(i).pos;
      crossing.normal += result.getContact(i).normal;
    }
    crossing.middle /= static_cast<double>(result.numContacts());
    return crossing;
  }

  // Is body a, shifted, neither crossing body b nor wholly inside it, or around it?
  [[nodiscard]] bool is_clear(const Eigen::Vector3d& shift) const {
    const Pose X_WA = Eigen::Translation3d(shift) * X_WA_;
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    if (fcl::collide(tree_a_.get(), X_WA, tree_b_.get(), X_WB_, request, result) > 0) {
      return false;
    }
    const Pose X_BA = X_WB_.inverse() * X_WA;
    return !is_inside(*b_.mesh, X_BA * a_.mesh->vertices.front()) &&
           !is_inside(*a_.mesh, X_BA.inverse() * b_.mesh->vertices.front());
  }

  [[nodiscard]] const Pose& X_WB() const { return X_WB_; }

 private:
  const CollisionBody& a_;
  const CollisionBody& b_;
  Pose X_WA_;
  Pose X_WB_;
  std::shared_ptr<const FclTree> tree_a_;
  std::shared_ptr<const FclTree> tree_b_;
};

// The mean normal and the 26 ways to a cube's faces, edges and corners, the cube turned
// as body b: boxes and walls are left straight.
std::vector<Eigen::Vector3d> ways_out(const Eigen::Vector3d& normal, const Pose& X_WB) {
  std::vector<Eigen::Vector3d> ways;
  if (normal.norm() > 1e-6) {
    ways.emplace_back(-normal.normalized());
    ways.emplace_back(normal.normalized());
  }
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) {
          ways.emplace_back(X_WB.linear() * Eigen::Vector3d(x, y, z).normalized());
        }
      }
    }
  }
  return ways;
}

void find_depth(const PlacedPair& pair, const Eigen::Vector3d& normal, Contact& contact) {
  for (const Eigen::Vector3d& way : ways_out(normal, pair.X_WB())) {
    if (contact.depth <= kPrecision || !pair.is_clear((contact.depth - kPrecision) * way)) {
      continue;
    }
    double blocked = 0.0;
    double clear = contact.depth - kPrecision;
    while (clear - blocked > kPrecision) {
      const double middle = 0.5 * (blocked + clear);
      (pair.is_clear(middle * way) ? clear : blocked) = middle;
    }
    contact.depth = clear;
    contact.direction = way;
  }
}

}  // namespace

std::vector<Contact> find_contacts(const CollisionWorld& world, const Configuration& q,
                                   std::span<const int> pairs) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(world.model().link_count()));
  std::vector<Pose> X_WBody(world.bodies().size());
  world.place(q, X_BL, X_WBody);
  std::vector<Contact> contacts;
  for (const int index : pairs) {
    const BodyPair& bodies = world.pairs()[static_cast<std::size_t>(index)];
    const CollisionBody& a = world.body(bodies.a);
    const CollisionBody& b = world.body(bodies.b);
    const PlacedPair pair(a, X_WBody[static_cast<std::size_t>(bodies.a)], b,
                          X_WBody[static_cast<std::size_t>(bodies.b)]);
    if (const auto crossing = pair.crossing()) {
      Contact contact{a.name, b.name, crossing->middle};
      find_depth(pair, crossing->normal, contact);
      contacts.push_back(std::move(contact));
    }
  }
  return contacts;
}

std::vector<Contact> find_contacts(const CollisionWorld& world, const Configuration& q) {
  std::vector<int> all(world.pairs().size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<Contact> contacts = find_contacts(world, q, all);
  std::ranges::stable_sort(contacts, std::greater(), &Contact::depth);
  return contacts;
}

}  // namespace handway::geometric
