#include "handway/geometric/collision/continuous/motion_bound.h"

#include "math/vector_units.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace handway::geometric {
namespace {

constexpr double kUnknown = -1.0;  // bends and speeds are not negative

double distance_from_axis(const Eigen::Vector3d& point, const Eigen::Vector3d& axis) {
  return axis.cross(point).norm();
}

// Largest distance of `link`'s origin from its parent's beyond |X_PJ.translation|.
double slide(const RobotModel& model, int link) {
  if (model.joint(link).type != JointType::kPrismatic) {
    return 0.0;
  }
  // A coupled slide follows the limits of its leader, not its own.
  const RobotModel::MimicMapping& drive = model.mimic_mapping(link);
  return std::max(std::abs(drive.multiplier * model.lower()[drive.variable] + drive.offset),
                  std::abs(drive.multiplier * model.upper()[drive.variable] + drive.offset));
}

// Geometry that moves with a link: points in its frame, or a direction.
struct Carried {
  int link;
  std::vector<Eigen::Vector3d> points = {};
  bool is_direction = false;
  double farthest = 0.0;  // m, of the points from the link's origin
};

double farthest_from_origin(const std::vector<Eigen::Vector3d>& points) {
  double farthest = 0.0;
  for (const Eigen::Vector3d& p : points) {
    farthest = std::max(farthest, p.norm());
  }
  return farthest;
}

Carried carried(const CollisionBody& body) {
  Carried points{body.link};
  points.points.reserve(body.mesh->vertices.size());
  for (const Eigen::Vector3d& vertex : body.mesh->vertices) {
    points.points.emplace_back(body.X_FB * vertex);
  }
  points.farthest = farthest_from_origin(points.points);
  return points;
}

Carried carried(const LinkConstraint& constraint) {
  return {constraint.link(),
          {constraint.held()},
          constraint.is_orientation(),
          constraint.held().norm()};
}

// Largest distance of a point from the axis of the joint of `link`, an ancestor of the points' link
// (or that link itself).
double reach(const RobotModel& model, const Carried& carried, int link) {
  if (carried.is_direction) {
    return 1.0;
  }
  const Eigen::Vector3d& axis = model.joint(link).axis;
  double radius = 0.0;
  if (carried.link == link) {
    for (const Eigen::Vector3d& p : carried.points) {
      radius = std::max(radius, distance_from_axis(p, axis));
    }
  } else {
    radius = carried.farthest;
  }
  for (int at = carried.link; at != link; at = model.parent(at)) {
    const Eigen::Vector3d& offset = model.joint(at).X_PJ.translation();
    // Next to the axis only the part of the offset across it counts.
    radius += slide(model, at) +
              (model.parent(at) == link ? distance_from_axis(offset, axis) : offset.norm());
  }
  return radius;
}

// Returns whether `link` is `ancestor` or below it. Fixed bodies have link -1.
bool is_above(const RobotModel& model, int ancestor, int link) {
  while (link > ancestor) {
    link = model.parent(link);
  }
  return link == ancestor;
}

MotionBound::Ball ball_around(const Carried& carried) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : carried.points) {
    box.extend(p);
  }
  MotionBound::Ball ball{std::max(0, carried.link), box.center(), 0.0, carried.is_direction};
  for (const Eigen::Vector3d& p : carried.points) {
    ball.radius = std::max(ball.radius, (p - ball.centre).norm());
  }
  return ball;
}

// Returns the closest common ancestor; fixed bodies count as the root, link 0.
int common_ancestor(const RobotModel& model, int a, int b) {
  a = std::max(a, 0);
  b = std::max(b, 0);
  while (a != b) {
    (a > b ? a : b) = model.parent(std::max(a, b));  // parents come first
  }
  return a;
}

}  // namespace

MotionBound::MotionBound(const CollisionWorld& world)
    : model_(world.shared_model()), X_WB_(world.X_WB()) {
  const RobotModel& model = world.model();
  std::vector<Carried> moving;
  for (const CollisionBody& body : world.bodies()) {
    moving.push_back(carried(body));
  }
  for (const LinkConstraint& constraint : world.constraints()) {
    moving.push_back(carried(constraint));
  }
  std::ranges::transform(moving, std::back_inserter(balls_), ball_around);
  std::vector<BodyPair> motions;  // a pair that shows each
  std::vector<int> against_still(world.bodies().size(), -1);
  for (const auto& [a, b] : world.pairs()) {
    int& shared = against_still[static_cast<std::size_t>(a)];
    const bool is_new = world.body(b).moves() || shared < 0;
    motions_.push_back(is_new ? static_cast<int>(motions.size()) : shared);
    if (is_new) {
      motions.push_back({a, b});
    }
    if (!world.body(b).moves()) {
      shared = motions_.back();
    }
    frames_.push_back({a, b, common_ancestor(model, world.body(a).link, world.body(b).link),
                       world.body(b).moves()});
  }
  pair_motions_ = static_cast<Eigen::Index>(motions.size());
  constexpr int kWorld = -1;
  for (int c = 0; c < static_cast<int>(world.constraints().size()); ++c) {
    const int held = static_cast<int>(world.bodies().size()) + c;
    motions_.push_back(static_cast<int>(motions.size()));
    motions.push_back({held, kWorld});
    frames_.push_back({held, kWorld, 0, false});
  }
  const auto bodies = static_cast<Eigen::Index>(world.bodies().size());
  // Travel of each body's points per unit of each joint above it.
  of_link_ = Eigen::MatrixXd::Zero(model.link_count(), static_cast<Eigen::Index>(moving.size()));
  for (int i = 1; i < model.link_count(); ++i) {
    for (int b = 0; b < static_cast<int>(moving.size()); ++b) {
      const Carried& body = moving[static_cast<std::size_t>(b)];
      if (model.mimic_mapping(i).variable >= 0 && is_above(model, i, body.link)) {
        const bool turns = model.joint(i).type == JointType::kRevolute;
        of_link_(i, b) = turns ? geometric::reach(model, body, i) : body.is_direction ? 0.0 : 1.0;
      }
    }
  }
  reach_ = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(motions.size()), model.variable_count());
  farthest_ = Eigen::VectorXd::Zero(model.variable_count());
  for (int i = 1; i < model.link_count(); ++i) {
    const int variable = model.mimic_mapping(i).variable;
    if (variable < 0) {
      continue;
    }
    const double multiplier = std::abs(model.mimic_mapping(i).multiplier);
    if (bodies > 0) {
      farthest_[variable] += multiplier * of_link_.row(i).head(bodies).maxCoeff();
    }
    for (std::size_t m = 0; m < motions.size(); ++m) {
      const auto [a, b] = motions[m];
      const bool moves_b =
          b != kWorld && is_above(model, i, moving[static_cast<std::size_t>(b)].link);
      if (is_above(model, i, moving[static_cast<std::size_t>(a)].link) != moves_b) {
        reach_(static_cast<Eigen::Index>(m), variable) +=
            multiplier * (of_link_(i, a) + (b == kWorld ? 0.0 : of_link_(i, b)));
      }
    }
  }
}

namespace {

// Adds `factor` times `column` to `sum`, both of `count` values.
HANDWAY_VECTOR_UNITS void add_scaled(const double* column, double factor, std::size_t count,
                                     double* sum) {
  for (std::size_t i = 0; i < count; ++i) {
    sum[i] += factor * column[i];
  }
}

}  // namespace

// Variables that do not move, as those of a hand that rests, cost nothing.
Eigen::VectorXd MotionBound::bounds(const Eigen::VectorXd& travel) const {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(reach_.rows());
  for (Eigen::Index v = 0; v < travel.size(); ++v) {
    if (travel[v] != 0.0) {
      add_scaled(reach_.col(v).data(), travel[v], motion_count(), sums.data());
    }
  }
  return sums;
}

EdgeMotion::EdgeMotion(std::shared_ptr<const MotionBound> motion) : motion_(std::move(motion)) {
  const auto links = static_cast<std::size_t>(motion_->model().link_count());
  rates_.resize(links);
  w_BL_.resize(links, Eigen::Vector3d::Zero());
  v_BL_.resize(links, Eigen::Vector3d::Zero());
  const std::size_t motions = motion_->motion_count();
  bends_.resize(motions, kUnknown);
  speeds_.resize(motions, kUnknown);
}

void EdgeMotion::set_edge(const Configuration& delta) {
  const RobotModel& model = motion_->model();
  travel_ = motion_->bounds(delta.cwiseAbs());
  std::ranges::fill(bends_, kUnknown);
  most_ = motion_->pair_motions() > 0 ? travel_.head(motion_->pair_motions()).maxCoeff() : 0.0;
  for (int i = 1; i < model.link_count(); ++i) {
    const RobotModel::MimicMapping& drive = model.mimic_mapping(i);
    rates_[static_cast<std::size_t>(i)] =
        drive.variable < 0 ? 0.0 : drive.multiplier * delta[drive.variable];
  }
}

void EdgeMotion::set_middle(const std::vector<Pose>& X_BL) {
  const RobotModel& model = motion_->model();
  X_BL_ = &X_BL;
  std::ranges::fill(speeds_, kUnknown);
  for (std::size_t i = 1; i < X_BL.size(); ++i) {
    const int link = static_cast<int>(i);
    const auto parent = static_cast<std::size_t>(model.parent(link));
    w_BL_[i] = w_BL_[parent];
    v_BL_[i] =
        v_BL_[parent] + w_BL_[parent].cross(X_BL[i].translation() - X_BL[parent].translation());
    if (rates_[i] != 0.0) {
      const Eigen::Vector3d motion = rates_[i] * (X_BL[i].linear() * model.joint(link).axis);
      (model.joint(link).type == JointType::kPrismatic ? v_BL_[i] : w_BL_[i]) += motion;
    }
  }
}

double EdgeMotion::within(int pair, double half) {
  const auto motion = static_cast<std::size_t>(motion_->motion(pair));
  double& speed = speeds_[motion];
  if (speed < 0.0) {
    const MotionBound::PairFrame& frame = motion_->pair_frame(pair);
    const auto sum = [&](const auto& of) {
      return of(frame.a) + (frame.b_moves ? of(frame.b) : 0.0);
    };
    speed = sum([&](int body) { return this->speed(body, frame.link); });
    if (bends_[motion] < 0.0) {
      bends_[motion] = sum([&](int body) { return bend(body, frame.link); });
    }
  }
  return std::min(over_edge(pair) * half, half * (speed + 0.5 * half * bends_[motion]));
}

// Second derivatives of a point's displacement by two joints: the outer one's, turned by the inner
// one.
double EdgeMotion::bend(int body, int frame) const {
  const RobotModel& model = motion_->model();
  double bend = 0.0;
  double outer = 0.0;  // the sum of the displacements by the joints from the body inwards
  for (int i = motion_->ball(body).link; i != frame; i = model.parent(i)) {
    const double rate = std::abs(rates_[static_cast<std::size_t>(i)]);
    if (rate == 0.0) {
      continue;
    }
    const double own = rate * motion_->reach(i, body);
    if (model.joint(i).type == JointType::kRevolute) {
      bend += rate * (own + 2.0 * outer);
    }
    outer += own;
  }
  return bend;
}

double EdgeMotion::speed(int body, int frame) const {
  const MotionBound::Ball& ball = motion_->ball(body);
  const auto link = static_cast<std::size_t>(ball.link);
  const auto base = static_cast<std::size_t>(frame);
  const Eigen::Vector3d w = w_BL_[link] - w_BL_[base];  // all in the robot's base
  if (ball.is_direction) {
    return w.cross((*X_BL_)[link].linear() * ball.centre).norm();
  }
  const Eigen::Vector3d p = (*X_BL_)[link] * ball.centre;
  const Eigen::Vector3d v = v_BL_[link] + w_BL_[link].cross(p - (*X_BL_)[link].translation()) -
                            v_BL_[base] - w_BL_[base].cross(p - (*X_BL_)[base].translation());
  return v.norm() + w.norm() * ball.radius;
}

PointMotion EdgeMotion::point_motion(int body, int frame) const {
  const Pose& X_WB = motion_->X_WB();
  const auto link = static_cast<std::size_t>(motion_->ball(body).link);
  const auto base = static_cast<std::size_t>(frame);
  const Eigen::Vector3d w = w_BL_[link] - w_BL_[base];
  const Eigen::Vector3d v = v_BL_[link] - w_BL_[link].cross((*X_BL_)[link].translation()) -
                            v_BL_[base] + w_BL_[base].cross((*X_BL_)[base].translation());
  PointMotion motion;
  motion.w = X_WB.linear() * w;
  motion.v = X_WB.linear() * v - motion.w.cross(X_WB.translation());
  motion.bend = bend(body, frame);
  return motion;
}

PairMotion EdgeMotion::pair_motion(int pair) const {
  const MotionBound::PairFrame& frame = motion_->pair_frame(pair);
  PairMotion motion{point_motion(frame.a, frame.link), {}};
  if (frame.b_moves) {
    motion.b = point_motion(frame.b, frame.link);
  }
  return motion;
}

}  // namespace handway::geometric
