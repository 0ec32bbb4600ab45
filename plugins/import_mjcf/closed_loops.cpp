#include "closed_loops.h"

#include "handway/geometric/robot/jacobian.h"
#include "handway/geometric/robot/robot_model.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace handway::import_mjcf {
namespace {

using geometric::Configuration;
using geometric::RobotModel;

constexpr double kStep = 1.0 / 16.0;  // share from home to an end of the first joint's range
constexpr double kLeastStep = 1.0 / 4096.0;
constexpr int kMostIterations = 50;
constexpr double kClosed = 1e-7;     // m
constexpr double kMostApart = 1e-3;  // m, of what counts as closed in the end
constexpr double kRounding = 1e-6;   // rad or m, of limits
constexpr double kNoMotion = 1e-9;   // m per rad or m

class Linkage {
 public:
  Linkage(const RobotModel& model, const ClosedLoop& loop, Configuration home)
      : model_(model),
        a_(model.find_link(loop.link_a).value()),
        b_(model.find_link(loop.link_b).value()),
        p_AQ_(loop.p_AQ),
        home_(std::move(home)) {
    const std::vector<geometric::Pose> X_BL = poses(home_);
    p_BQ_ = at(X_BL, b_).inverse() * (at(X_BL, a_) * p_AQ_);
    const Eigen::MatrixXd J = jacobian(X_BL);
    for (int link = 1; link < model.link_count(); ++link) {  // what moves the first one leads
      const int v = model.mimic_mapping(link).variable;
      if (v >= 0 && J.col(v).norm() > kNoMotion && std::ranges::count(followers_, v) == 0) {
        followers_.push_back(v);
      }
    }
    if (!followers_.empty()) {
      leader_ = followers_.front();
      followers_.erase(followers_.begin());
    }
    if (!has_one_freedom() && !followers_.empty()) {
      held_ = followers_.front();
      followers_.erase(followers_.begin());
    }
  }

  [[nodiscard]] bool has_one_freedom() const {
    const Eigen::MatrixXd J = jacobian(poses(home_))(Eigen::all, followers_);
    return !followers_.empty() &&
           J.colPivHouseholderQr().rank() == static_cast<Eigen::Index>(followers_.size());
  }

  // Postures in which the loop is closed, from one end of the first joint's range to the other.
  [[nodiscard]] std::vector<Configuration> closed_postures() const {
    std::vector<Configuration> found{home_};
    for (const double end : {model_.lower()[leader_], model_.upper()[leader_]}) {
      const double range = std::clamp(end - home_[leader_], -std::numbers::pi, std::numbers::pi);
      Configuration q = home_;
      double share = 0.0;
      for (double step = kStep; share < 1.0 && step > kLeastStep;) {
        Configuration next = q;
        next[leader_] = home_[leader_] + range * std::min(share + step, 1.0);
        if (!close(next)) {
          step /= 2.0;
          continue;
        }
        share += step;
        q = next;
        found.push_back(q);
      }
    }
    return found;
  }

  // Returns the distance between the ends of the loop.
  [[nodiscard]] double gap(const Configuration& q) const { return gap_at(poses(q)).norm(); }

  [[nodiscard]] int leader() const { return leader_; }
  [[nodiscard]] const std::vector<int>& followers() const { return followers_; }
  /// Joint that stays at home, as springs hold it; -1: none.
  [[nodiscard]] int held() const { return held_; }

 private:
  [[nodiscard]] std::vector<geometric::Pose> poses(const Configuration& q) const {
    std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(model_.link_count()));
    model_.forward_kinematics(q, X_BL);
    return X_BL;
  }

  static const geometric::Pose& at(const std::vector<geometric::Pose>& X_BL, int link) {
    return X_BL[static_cast<std::size_t>(link)];
  }

  [[nodiscard]] Eigen::Vector3d gap_at(const std::vector<geometric::Pose>& X_BL) const {
    return at(X_BL, a_) * p_AQ_ - at(X_BL, b_) * p_BQ_;
  }

  [[nodiscard]] Eigen::MatrixXd jacobian(const std::vector<geometric::Pose>& X_BL) const {
    return geometric::point_jacobian(model_, X_BL, a_, p_AQ_).topRows(3) -
           geometric::point_jacobian(model_, X_BL, b_, p_BQ_).topRows(3);
  }

  // Closes the loop by Newton's steps of the followers, within their limits.
  bool close(Configuration& q) const {
    for (int i = 0; i < kMostIterations; ++i) {
      const std::vector<geometric::Pose> X_BL = poses(q);
      const Eigen::Vector3d gap = gap_at(X_BL);
      if (gap.norm() < kClosed) {
        return ((q - model_.lower()).array() >= -kRounding).all() &&
               ((model_.upper() - q).array() >= -kRounding).all();
      }
      const Eigen::MatrixXd J = jacobian(X_BL)(Eigen::all, followers_);
      q(followers_) -= J.completeOrthogonalDecomposition().solve(gap);
    }
    return false;
  }

  const RobotModel& model_;
  int a_;
  int b_;
  Eigen::Vector3d p_AQ_;
  Eigen::Vector3d p_BQ_;
  Configuration home_;
  int leader_ = -1;
  int held_ = -1;
  std::vector<int> followers_;
};

/// Fit of a linkage's followers to its leader: slope · leader + offset.
struct Fit {
  Eigen::VectorXd slope;
  Eigen::VectorXd offset;
  double lower = 0.0;  ///< Leader's range in which the loop closes.
  double upper = 0.0;
  double gap = 0.0;  ///< m, the largest remaining gap.
};

Fit fitted(const Linkage& linkage) {
  std::vector<Configuration> postures = linkage.closed_postures();
  const auto count = static_cast<Eigen::Index>(postures.size());
  Eigen::MatrixX2d line = Eigen::MatrixX2d::Ones(count, 2);
  Eigen::MatrixXd follow(count, std::ssize(linkage.followers()));
  for (Eigen::Index row = 0; row < count; ++row) {
    const Configuration& posture = postures[static_cast<std::size_t>(row)];
    line(row, 0) = posture[linkage.leader()];
    follow.row(row) = posture(linkage.followers()).transpose();
  }
  const Eigen::MatrixXd factors = line.colPivHouseholderQr().solve(follow);
  Fit fit{factors.row(0), factors.row(1), line.col(0).minCoeff(), line.col(0).maxCoeff()};
  for (Configuration& posture : postures) {
    posture(linkage.followers()) = fit.slope * posture[linkage.leader()] + fit.offset;
    fit.gap = std::max(fit.gap, linkage.gap(posture));
  }
  return fit;
}

}  // namespace

bool close_loop(geometric::RobotDescription& robot, const ClosedLoop& loop,
                const std::map<std::string, double>& home) {
  const RobotModel model(robot);
  Configuration q = Configuration::Zero(model.variable_count());
  for (int v = 0; v < model.variable_count(); ++v) {
    const auto value = home.find(model.variable(v).name);
    q[v] = value == home.end() ? 0.0 : value->second;
  }
  const Linkage linkage(model, loop, q);
  const auto leads_others = [&](int variable) {
    return std::ranges::any_of(robot.joints, [&](const geometric::Joint& joint) {
      return joint.mimic && joint.mimic->joint == model.variable(variable).name;
    });
  };
  if (!linkage.has_one_freedom() || std::ranges::any_of(linkage.followers(), leads_others) ||
      (linkage.held() >= 0 && leads_others(linkage.held()))) {
    return false;
  }
  const Fit fit = fitted(linkage);
  if (fit.upper - fit.lower < kRounding || fit.gap > kMostApart) {
    return false;
  }
  const auto joint_of = [&](int variable) {
    return std::ranges::find(robot.joints, model.variable(variable).name, &geometric::Joint::name);
  };
  const auto leader = joint_of(linkage.leader());
  leader->limits.lower = std::max(leader->limits.lower, fit.lower);
  leader->limits.upper = std::min(leader->limits.upper, fit.upper);
  if (linkage.held() >= 0) {
    joint_of(linkage.held())->mimic = geometric::Mimic{leader->name, 0.0, q[linkage.held()]};
  }
  for (Eigen::Index i = 0; i < fit.slope.size(); ++i) {
    joint_of(linkage.followers()[static_cast<std::size_t>(i)])->mimic =
        geometric::Mimic{leader->name, fit.slope[i], fit.offset[i]};
  }
  return true;
}

}  // namespace handway::import_mjcf
