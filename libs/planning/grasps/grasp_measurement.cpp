#include "grasps/grasp_measurement.h"

#include "handway/geometric/robot/jacobian.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace handway::planning {
namespace {

using Eigen::Vector3d;
using geometric::Pose;

constexpr double kContactGap = 1e-4;     // m that a closed finger keeps to the object
constexpr double kTouchDistance = 1e-3;  // m: links that near to the object touch it
// m: fingers that are farther away are not brought to the object
constexpr double kMaxClosingDistance = 0.05;
constexpr int kContactHalvings = 4;  // of a closing step
constexpr double kGravity = 9.81;    // m/s²
// Forces of the squeeze, as a multiple of those with which friction just carries the payload.
constexpr double kSqueezeMargin = 3.0;

}  // namespace

std::size_t touching_fingers(const Pregrasp& grasp) {
  std::set<int> fingers;
  for (const HandContact& contact : grasp.contacts) {
    fingers.insert(contact.finger);
  }
  return fingers.size();
}

GraspMeasurement::GraspMeasurement(const Hand& hand, const geometric::SceneObject& object,
                                   std::vector<int> pairs, const PregraspOptions& options,
                                   const std::stop_token& stop)
    : of_(hand),
      options_(options),
      stop_(stop),
      X_WB_(hand.problem.scene->robots.front().X_WB),
      X_BO_(X_WB_.inverse() * object.X_PO),
      contacts_(hand.checker.shared_world(), std::move(pairs), object.X_PO),
      scale_(torque_scale(*geometric::tessellate(object.shape))) {}

bool GraspMeasurement::measure(Pregrasp& grasp, const geometric::Aabb& core, double needed) {
  return set_closed(closed_to_contact(grasp.q, core, 0.0), needed, grasp);
}

void GraspMeasurement::measure_held(Pregrasp& grasp, const Configuration& start,
                                    const geometric::Aabb& core) {
  set_closed(closed_to_contact(start, core, kTouchDistance),
             -std::numeric_limits<double>::infinity(), grasp);
}

bool GraspMeasurement::set_closed(Configuration closed, double needed, Pregrasp& grasp) {
  if (stop_.stop_requested()) {
    return false;  // closed in part
  }
  grasp.closed = std::move(closed);
  of_.checker.place(grasp.closed);
  const std::vector<LinkContact> found = contacts_.contacts(of_.checker, kTouchDistance);
  std::vector<GraspContact> contacts;
  grasp.contacts.clear();
  for (const LinkContact& contact : found) {
    grasp.contacts.push_back({finger_of(contact.link), of_.problem.model().link(contact.link).name,
                              contact.contact, contact.distance});
    contacts.push_back(contact.contact);
  }
  const Wrenches wrenches = contact_wrenches(contacts, options_.contact, scale_);
  if (epsilon_bound(wrenches) < needed) {
    return false;
  }
  grasp.quality = grasp_quality(wrenches);
  if (grasp.quality.epsilon < needed) {
    return false;
  }
  grasp.holding_force = holding_force(contacts);
  grasp.squeezed = squeezed(grasp.closed, found, contacts);
  grasp.doubt = doubt_of(grasp);
  return true;
}

// Index of the finger that a link belongs to; -1 is the palm.
int GraspMeasurement::finger_of(int link) const {
  const auto& fingers = of_.hand.fingers();
  const auto found = std::ranges::find_if(fingers, [link](const HandClosing::Finger& finger) {
    return std::ranges::count(finger.links, link) > 0;
  });
  return found == fingers.end() ? -1 : static_cast<int>(found - fingers.begin());
}

// `q` with the hand closed until everything that moves touches. Where one joint moves several
// fingers and only one of them touches, the palm gives way so that all do.
Configuration GraspMeasurement::closed_to_contact(Configuration q, const geometric::Aabb& core,
                                                  double touch) {
  constexpr int kRounds = 3;
  q = closed_once(std::move(q), core, touch);
  for (int round = 0; round < kRounds; ++round) {
    const std::optional<Vector3d> shift_B = centring(q);
    if (!shift_B) {
      break;
    }
    const PalmMove moved = of_.ik.moved(q, Eigen::Translation3d(*shift_B) * of_.ik.pose(q));
    if (!moved.reached || of_.checker.first_collision(moved.q)) {
      break;
    }
    q = closed_once(moved.q, core, touch);
  }
  return q;
}

Configuration GraspMeasurement::closed_once(Configuration q, const geometric::Aabb& core,
                                            double touch) {
  const Pose X_PO = of_.ik.pose(q).inverse() * X_BO_;
  return of_.closing.all_closed(std::move(q), core, X_PO,
                                {.object_gap = kContactGap,
                                 .own_gap = options_.own_gap,
                                 .halvings = kContactHalvings,
                                 .touch = touch},
                                stop_);
}

// Returns the shift of the palm that centres the object between two fingers of one joint, in the
// base frame, m; nothing if there are no such fingers or the object is centred.
std::optional<Vector3d> GraspMeasurement::centring(const Configuration& q) {
  const auto& fingers = of_.hand.fingers();
  of_.checker.place(q);
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    for (std::size_t j = i + 1; j < fingers.size(); ++j) {
      const bool is_coupled = std::ranges::any_of(fingers[i].joints, [&](int joint) {
        return std::ranges::count(fingers[j].joints, joint) > 0;
      });
      if (!is_coupled) {
        continue;
      }
      const auto a = contacts_.closest(of_.checker, fingers[i].links, kMaxClosingDistance);
      const auto b = contacts_.closest(of_.checker, fingers[j].links, kMaxClosingDistance);
      if (!a || !b) {
        continue;
      }
      const Vector3d from_a = a->p_WB - a->p_WA;
      const Vector3d from_b = b->p_WB - b->p_WA;
      const Vector3d& farther = from_a.norm() > from_b.norm() ? from_a : from_b;
      const double difference = std::abs(from_a.norm() - from_b.norm());
      if (difference > 0.5 * kTouchDistance && from_a.dot(from_b) < 0.0) {
        return X_WB_.linear().transpose() * (0.5 * difference * farther.normalized());
      }
    }
  }
  return std::nullopt;
}

// See Pregrasp::holding_force.
std::optional<double> GraspMeasurement::holding_force(
    const std::vector<GraspContact>& contacts) const {
  Wrench weight = Wrench::Zero();
  weight.head<3>() =
      (X_WB_ * X_BO_).linear().transpose() * Vector3d(0.0, 0.0, -kGravity * options_.payload);
  const auto forces = least_contact_forces(contacts, options_.contact, scale_, weight);
  if (!forces) {
    return std::nullopt;
  }
  double largest = 0.0;
  for (const Vector3d& force : *forces) {
    largest = std::max(largest, force.norm());
  }
  return largest;
}

// See Pregrasp::squeezed. Contacts that no forces balance push with a force of the same size.
Configuration GraspMeasurement::squeezed(const Configuration& closed,
                                         const std::vector<LinkContact>& found,
                                         const std::vector<GraspContact>& contacts) const {
  const geometric::RobotModel& model = of_.problem.model();
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(closed, X_BL);
  const auto forces = internal_contact_forces(contacts, options_.contact, scale_);
  std::vector<geometric::Jacobian> jacobians;
  Eigen::VectorXd torques = Eigen::VectorXd::Zero(model.variable_count());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Pose& X_BLink = X_BL[static_cast<std::size_t>(found[i].link)];
    jacobians.push_back(geometric::point_jacobian(
        model, X_BL, found[i].link, X_BLink.inverse() * (X_BO_ * found[i].contact.p_O)));
    const Vector3d force_B = X_BO_.linear() * (forces ? (*forces)[i] : found[i].contact.normal_O);
    torques += jacobians.back().topRows<3>().transpose() * force_B;
  }
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(model.variable_count());
  for (const int variable : of_.problem.joints.hand) {
    const bool slides =
        model.joint(model.variable_link(variable)).type == geometric::JointType::kPrismatic;
    direction[variable] =
        torques[variable] / (slides ? options_.slide_stiffness : options_.stiffness);
  }
  double depth = 0.0;  // of the farthest contact, along it
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vector3d motion_B = jacobians[i].topRows<3>() * direction;
    depth = std::max(depth, motion_B.dot(X_BO_.linear() * found[i].contact.normal_O));
  }
  if (depth <= 0.0) {
    return closed;
  }
  const double needed =  // N: sum of the normal forces, of which `direction` pushes with 1 N
      forces ? kSqueezeMargin * kGravity * options_.payload / options_.contact.friction : 0.0;
  return (closed + std::max(options_.squeeze / depth, needed) * direction)
      .cwiseMax(model.lower())
      .cwiseMin(model.upper());
}

// See Pregrasp::doubt.
std::string GraspMeasurement::doubt_of(const Pregrasp& grasp) const {
  if (const std::size_t touching = touching_fingers(grasp); touching < 2) {
    return touching == 0 ? "No finger gets to the object." : "Only one finger touches the object.";
  }
  return grasp.quality.epsilon > 0.0
             ? std::string()
             : fmt::format("With friction {}, the contacts do not hold it in every direction.",
                           options_.contact.friction);
}

}  // namespace handway::planning
