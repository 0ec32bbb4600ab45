#include "handway/geometric/collision/narrow_phase/contact.h"

#include "collision/narrow_phase/fcl_bodies.h"
#include "collision/volumes/solid.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace handway::geometric {
namespace {

constexpr double kPrecision = 1e-4;       // m
constexpr std::size_t kMostPoints = 400;  // triangle contacts that the middle is taken of

struct PlacedBody {
  const BodySolids& solids;
  const FclTree& tree;
  Pose X_WB;
};

// Two placed bodies, one of which can be shifted.
class PlacedPair {
 public:
  // @param padding m: bodies nearer to each other than that are in contact.
  PlacedPair(const PlacedBody& a, const PlacedBody& b, double padding)
      : a_(a), b_(b), padding_(padding) {}

  // Middle and mean normal (from a to b) of the surfaces' intersection, if any.
  struct Crossing {
    Eigen::Vector3d middle;
    Eigen::Vector3d normal;
  };
  [[nodiscard]] std::optional<Crossing> crossing() const {
    fcl::CollisionRequestd request(kMostPoints, true);
    fcl::CollisionResultd result;
    fcl::collide(&a_.tree, a_.X_WB, &b_.tree, b_.X_WB, request, result);
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

  // Returns whether the shifted body a neither crosses body b nor contains it or is in it.
  [[nodiscard]] bool is_clear(const Eigen::Vector3d& shift) const {
    const Pose X_WA = Eigen::Translation3d(shift) * a_.X_WB;
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    if (fcl::collide(&a_.tree, X_WA, &b_.tree, b_.X_WB, request, result) > 0 ||
        (padding_ > 0.0 && nearest_points(X_WA).min_distance < padding_)) {
      return false;
    }
    return !contain_each_other(a_.solids, X_WA, b_.solids, b_.X_WB);
  }

  // Returns a point of the inner body if one body contains the other without a crossing; no normal.
  [[nodiscard]] std::optional<Crossing> containment() const {
    for (const auto& [inner, outer] : {std::pair(&a_, &b_), std::pair(&b_, &a_)}) {
      const Pose X_OI = outer->X_WB.inverse(Eigen::Isometry) * inner->X_WB;
      for (const Eigen::Vector3d& point : inner->solids.points) {
        if (outer->solids.contains(X_OI * point)) {
          return Crossing{inner->X_WB * point, Eigen::Vector3d::Zero()};
        }
      }
    }
    return std::nullopt;
  }

  // The middle between surfaces that do not cross, if they are nearer than the padding.
  [[nodiscard]] std::optional<Crossing> approach() const {
    if (padding_ <= 0.0) {
      return std::nullopt;
    }
    const fcl::DistanceResultd result = nearest_points(a_.X_WB);
    if (result.min_distance >= padding_) {
      return std::nullopt;
    }
    const auto& [p, q] = result.nearest_points;
    return Crossing{0.5 * (p + q), q - p};
  }

  [[nodiscard]] const Pose& X_WB() const { return b_.X_WB; }

 private:
  [[nodiscard]] fcl::DistanceResultd nearest_points(const Pose& X_WA) const {
    const fcl::DistanceRequestd request(true);
    fcl::DistanceResultd result;
    fcl::distance(&a_.tree, X_WA, &b_.tree, b_.X_WB, request, result);
    return result;
  }

  const PlacedBody& a_;
  const PlacedBody& b_;
  double padding_;
};

// The mean normal and the 26 directions to a cube's faces, edges and corners, the cube rotated as
// body b: contacts of boxes and walls separate along their normals.
std::vector<Eigen::Vector3d> separation_directions(const Eigen::Vector3d& normal,
                                                   const Pose& X_WB) {
  std::vector<Eigen::Vector3d> directions;
  if (normal.norm() > 1e-6) {
    directions.emplace_back(-normal.normalized());
    directions.emplace_back(normal.normalized());
  }
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) {
          directions.emplace_back(X_WB.linear() * Eigen::Vector3d(x, y, z).normalized());
        }
      }
    }
  }
  return directions;
}

void find_depth(const PlacedPair& pair, const Eigen::Vector3d& normal, Contact& contact) {
  for (const Eigen::Vector3d& direction : separation_directions(normal, pair.X_WB())) {
    if (contact.depth <= kPrecision || !pair.is_clear((contact.depth - kPrecision) * direction)) {
      continue;
    }
    double blocked = 0.0;
    double clear = contact.depth - kPrecision;
    while (clear - blocked > kPrecision) {
      const double middle = 0.5 * (blocked + clear);
      (pair.is_clear(middle * direction) ? clear : blocked) = middle;
    }
    contact.depth = clear;
    contact.direction = direction;
  }
}

}  // namespace

std::vector<Contact> find_contacts(const CollisionWorld& world, const Configuration& q,
                                   std::span<const int> pairs) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(world.model().link_count()));
  std::vector<Pose> X_WBody(world.bodies().size());
  world.place(q, X_BL, X_WBody);
  FclTrees trees;
  const auto placed = [&](int index) {
    const CollisionBody& body = world.body(index);
    return PlacedBody{*body.solids, *trees.of(*body.mesh),
                      X_WBody[static_cast<std::size_t>(index)]};
  };
  std::vector<Contact> contacts;
  for (const int index : pairs) {
    const BodyPair& bodies = world.pairs()[static_cast<std::size_t>(index)];
    const PlacedBody a = placed(bodies.a);
    const PlacedBody b = placed(bodies.b);
    const PlacedPair pair(a, b, world.padding(index));
    std::optional<PlacedPair::Crossing> crossing = pair.crossing();
    if (!crossing) {
      crossing = pair.containment();
    }
    if (!crossing) {
      crossing = pair.approach();
    }
    if (crossing) {
      Contact contact{world.body(bodies.a).name, world.body(bodies.b).name, crossing->middle};
      find_depth(pair, crossing->normal, contact);
      contacts.push_back(std::move(contact));
    }
  }
  return contacts;
}

std::vector<Contact> find_contacts(CollisionChecker& checker, const Configuration& q) {
  std::vector<Contact> contacts = find_contacts(checker.world(), q, touching_pairs(checker, q));
  std::ranges::stable_sort(contacts, std::greater(), &Contact::depth);
  return contacts;
}

}  // namespace handway::geometric
