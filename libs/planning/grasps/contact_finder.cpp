#include "grasps/contact_finder.h"

#include "handway/geometric/math/units.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace handway::planning {
namespace {

using Eigen::Vector3d;
using geometric::Pose;

constexpr double kPatchTilt = geometric::radians(0.5);  // of a link, to find its patch's corners
constexpr double kPatchLift = 0.0015;   // m, off the object, so that tilts do not touch
constexpr double kSameContact = 0.002;  // m: contacts that count as one

}  // namespace

ContactFinder::ContactFinder(std::shared_ptr<const geometric::CollisionWorld> world,
                             std::vector<int> pairs, const Pose& X_WO)
    : world_(std::move(world)), closest_(world_), pairs_(std::move(pairs)), X_WO_(X_WO) {}

std::vector<LinkContact> ContactFinder::contacts(geometric::CollisionChecker& checker,
                                                 double tolerance) {
  std::vector<LinkContact> found;
  for (const int pair : pairs_) {
    if (checker.pair_is_nearer_than(pair, tolerance)) {
      add_contacts(pair, X_WA(pair, checker.link_poses()), tolerance, found);
    }
  }
  return found;
}

std::optional<geometric::ClosestPoints> ContactFinder::closest(geometric::CollisionChecker& checker,
                                                               const std::vector<int>& links,
                                                               double enough) {
  std::optional<int> nearest;
  for (const int pair : pairs_) {
    const auto [a, b] = world_->pairs()[static_cast<std::size_t>(pair)];
    if (std::ranges::count(links, world_->body(a).link) == 0) {
      continue;
    }
    if (const double distance = checker.pair_distance(pair, enough); distance < enough) {
      enough = distance;
      nearest = pair;
    }
  }
  if (!nearest) {
    return std::nullopt;
  }
  const auto [a, b] = world_->pairs()[static_cast<std::size_t>(*nearest)];
  return closest_.between(a, b, X_WA(*nearest, checker.link_poses()), world_->body(b).X_FB);
}

Pose ContactFinder::X_WA(int pair, const std::vector<Pose>& X_BL) const {
  const geometric::CollisionBody& body =
      world_->body(world_->pairs()[static_cast<std::size_t>(pair)].a);
  return world_->X_WB() * X_BL[static_cast<std::size_t>(body.link)] * body.X_FB;
}

void ContactFinder::add_contacts(int pair, const Pose& X_WA, double tolerance,
                                 std::vector<LinkContact>& contacts) {
  constexpr double kSpare = 1e-6;  // m, of rounding
  const auto [a, b] = world_->pairs()[static_cast<std::size_t>(pair)];
  const int link = world_->body(a).link;
  const Pose& X_WB = world_->body(b).X_FB;
  const std::optional<geometric::ClosestPoints> nearest =
      closest_.between(a, b, X_WA, X_WB, tolerance + world_->padding(pair) + kSpare);
  if (!nearest) {
    return;  // they are in each other
  }
  const Vector3d offset = nearest->p_WB - nearest->p_WA;
  const double distance = offset.norm();
  const Vector3d normal = offset / distance;
  const Pose X_OW = X_WO_.inverse();
  const auto contact_at = [&](const Vector3d& p_W, const Vector3d& normal_W) {
    return LinkContact{link, {X_OW * p_W, X_OW.linear() * normal_W}, distance};
  };
  const Vector3d u = normal.unitOrthogonal();
  const Vector3d v = normal.cross(u);
  const std::size_t first = contacts.size();
  for (const Vector3d& axis : {u, v, Vector3d(-u), Vector3d(-v)}) {
    const Pose tilted = Eigen::Translation3d(nearest->p_WA - kPatchLift * normal) *
                        Eigen::AngleAxisd(kPatchTilt, axis) * Eigen::Translation3d(-nearest->p_WA) *
                        X_WA;
    const std::optional<geometric::ClosestPoints> corner = closest_.between(
        a, b, tilted, X_WB, distance + kPatchLift + kSpare);  // as far as the first point gets
    if (!corner) {
      continue;
    }
    const LinkContact contact =
        contact_at(corner->p_WB, (corner->p_WB - corner->p_WA).normalized());
    const bool is_known =
        std::any_of(contacts.begin() + static_cast<std::ptrdiff_t>(first), contacts.end(),
                    [&](const LinkContact& other) {
                      return (other.contact.p_O - contact.contact.p_O).norm() < kSameContact;
                    });
    if (!is_known) {
      contacts.push_back(contact);
    }
  }
  if (contacts.size() == first) {
    contacts.push_back(contact_at(nearest->p_WB, normal));
  }
}

}  // namespace handway::planning
