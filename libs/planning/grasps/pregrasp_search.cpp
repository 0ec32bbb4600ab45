#include "handway/planning/grasps/pregrasp_search.h"

#include "grasps/pregrasp_rejections.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/jacobian.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "handway/planning/queries/palm_ik.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

namespace handway::planning {
namespace {

using Eigen::Vector3d;
using geometric::Pose;
using geometric::RobotModel;

/// The point of the segment from `a` to `b` that is closest to `p`.
Vector3d nearest_on_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const double length = (b - a).squaredNorm();
  const double t = length > 0.0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
  return a + t * (b - a);
}

// The tip that is farthest from the middle of all.
Eigen::Index thumb_of(const Eigen::Matrix3Xd& tips) {
  const Vector3d middle = tips.rowwise().mean();
  Eigen::Index thumb = 0;
  (tips.colwise() - middle).colwise().norm().maxCoeff(&thumb);
  return thumb;
}

// Of the others those that reach as far from the palm as the thumb, more or less: not those that
// are bent away, nor the inner bars of a parallel gripper.
std::vector<Eigen::Index> opposite(Eigen::Index thumb, const Eigen::Matrix3Xd& tips) {
  constexpr double kReach = 0.7;
  std::vector<Eigen::Index> others;
  for (Eigen::Index i = 0; i < tips.cols(); ++i) {
    if (i != thumb && tips.col(i).norm() > kReach * tips.col(thumb).norm()) {
      others.push_back(i);
    }
  }
  return others;
}

bool has_directions(const PlanningProblem& problem) {
  return problem.basis && !problem.basis->directions.empty();
}

constexpr double kLeastOpening = 0.04;  // m, of a preshape

/// Opened preshapes of a problem's hand, drawn from its PMD box or else from its joints' ranges,
/// and how its fingers close.
class HandClosing {
 public:
  /// An opened hand, seen from its palm: a thumb against fingers side by side. Lengths in m.
  struct Preshape {
    Eigen::VectorXd open;  ///< Normalised joints in the basis' order.
    Vector3d grip;         ///< Between the ends of the thumb and of the others.
    Vector3d opposition;   ///< From the thumb to the others; of length 1.
    Vector3d row = {};     ///< Along the others' tips, square to it; of length 1.
    double opening = 0.0;  ///< From the thumb's tip to the others.
  };
  /// The part of the hand that one branch of the palm carries.
  struct Finger {
    std::vector<int> joints;  ///< Indices in the basis' order, the nearest to the palm first.
    std::vector<int> links;
    Vector3d p_LTip = Vector3d::Zero();  ///< Middle of the last one, in its frame.
    Vector3d p_LEnd = Vector3d::Zero();  ///< Its end, as far from the joint as it goes.
  };

  /// @param palm the link of the hand.
  HandClosing(const PlanningProblem& problem, int palm) : problem_(problem), palm_(palm) {
    find_fingers();
    make_preshapes();
  }

  [[nodiscard]] bool opens() const { return !preshapes_.empty(); }
  /// m; of a hand that opens.
  [[nodiscard]] double widest() const { return preshapes_.back().opening; }
  /// Those that are opened to a width (m) or a little wider.
  [[nodiscard]] std::span<const Preshape> opened_to(double width) const {
    constexpr double kRoom = 0.06;  // m
    const auto first = std::ranges::lower_bound(preshapes_, width, {}, &Preshape::opening);
    const auto last = std::ranges::upper_bound(preshapes_, width + kRoom, {}, &Preshape::opening);
    return {first, last};
  }
  [[nodiscard]] const std::vector<Finger>& fingers() const { return fingers_; }

  /// `q` with the hand in `posture`, brought within limits.
  [[nodiscard]] Configuration with_hand(Configuration q, const Eigen::VectorXd& posture) const {
    const RobotModel& model = problem_.model();
    const Eigen::VectorXd lower = model.lower()(problem_.hand);
    const Eigen::VectorXd upper = model.upper()(problem_.hand);
    const Eigen::VectorXd share = posture.cwiseMax(0.0).cwiseMin(1.0);
    q(problem_.hand) = (lower + share.cwiseProduct(upper - lower)).cwiseMin(upper);
    return q;
  }

  /// The hand of `q`, normalised.
  [[nodiscard]] Eigen::VectorXd hand_of(const Configuration& q) const {
    return geometric::normalised(problem_.model(), q)(problem_.hand);
  }

  /// How a finger's joints bring its tip closer to a segment: shape [joints of the finger], of
  /// length 1, or zero where none does. @param a, b ends of the segment in the palm's frame, m.
  [[nodiscard]] Eigen::VectorXd towards(const Finger& finger, const Eigen::VectorXd& posture,
                                        const Vector3d& a, const Vector3d& b) const {
    const RobotModel& model = problem_.model();
    const std::vector<Pose> X_BL = link_poses(posture);
    const Pose& X_BP = X_BL[static_cast<std::size_t>(palm_)];
    const Vector3d p_P = last_link(finger, X_BL) * finger.p_LTip;
    const Vector3d way_B = X_BP.linear() * (nearest_on_segment(p_P, a, b) - p_P).normalized();
    const geometric::Jacobian J =
        geometric::point_jacobian(model, X_BL, finger.links.back(), finger.p_LTip);
    const Eigen::VectorXd of_hand = (J.topRows<3>().transpose() * way_B)
                                        .cwiseProduct(model.upper() - model.lower())(problem_.hand);
    const Eigen::VectorXd rates = of_hand(finger.joints);
    return rates.norm() > 1e-9 ? rates.normalized() : Eigen::VectorXd::Zero(rates.size());
  }

 private:
  void find_fingers() {
    const RobotModel& model = problem_.model();
    std::map<int, Finger> by_root;  // the palm's child that everything of a finger hangs from
    const auto root_of = [&](int link) {
      while (link >= 0 && model.parent(link) != palm_) {
        link = model.parent(link);
      }
      return link;
    };
    for (int link = 1; link < model.link_count(); ++link) {  // those of coupled joints too
      const auto joint = std::ranges::find(problem_.hand, model.drive(link).variable);
      const int root = root_of(link);
      if (joint != problem_.hand.end() && root >= 0) {
        std::vector<int>& joints = by_root[root].joints;
        const auto j = static_cast<int>(joint - problem_.hand.begin());
        if (std::ranges::count(joints, j) == 0) {
          joints.push_back(j);
        }
      }
    }
    for (int link = 0; link < model.link_count(); ++link) {
      if (const auto found = by_root.find(root_of(link)); found != by_root.end()) {
        found->second.links.push_back(link);
      }
    }
    for (auto& [root, finger] : by_root) {
      finger.p_LTip = middle_of(model.link(finger.links.back()));
      double length = finger.p_LTip.norm();
      for (const Vector3d& p_L :
           geometric::collision_mesh(model.link(finger.links.back())).vertices) {
        length = std::max(length, p_L.norm());
      }
      finger.p_LEnd = length * finger.p_LTip.normalized();
      fingers_.push_back(std::move(finger));
    }
  }

  [[nodiscard]] std::vector<Pose> link_poses(const Eigen::VectorXd& posture) const {
    std::vector<Pose> X_BL(static_cast<std::size_t>(problem_.model().link_count()));
    problem_.model().forward_kinematics(with_hand(problem_.start, posture), X_BL);
    return X_BL;
  }

  // In the palm's frame.
  [[nodiscard]] Pose last_link(const Finger& finger, const std::vector<Pose>& X_BL) const {
    return X_BL[static_cast<std::size_t>(palm_)].inverse() *
           X_BL[static_cast<std::size_t>(finger.links.back())];
  }

  [[nodiscard]] std::optional<Preshape> preshape(Eigen::VectorXd open) const {
    if (fingers_.size() < 2) {
      return std::nullopt;
    }
    const std::vector<Pose> X_BL = link_poses(open);
    Eigen::Matrix3Xd tips(3, std::ssize(fingers_));
    Eigen::Matrix3Xd ends(3, tips.cols());
    for (Eigen::Index i = 0; i < tips.cols(); ++i) {
      const Finger& finger = fingers_[static_cast<std::size_t>(i)];
      const Pose X_PL = last_link(finger, X_BL);
      tips.col(i) = X_PL * finger.p_LTip;
      ends.col(i) = X_PL * finger.p_LEnd;
    }
    const Eigen::Index thumb = thumb_of(tips);
    const std::vector<Eigen::Index> others = opposite(thumb, tips);
    if (others.empty()) {
      return std::nullopt;
    }
    Preshape shape{.open = std::move(open),
                   .grip = 0.5 * (ends.col(thumb) + ends(Eigen::all, others).rowwise().mean()),
                   .opposition = tips(Eigen::all, others).rowwise().mean() - tips.col(thumb)};
    shape.opening = shape.opposition.norm();
    if (shape.opening < kLeastOpening) {
      return std::nullopt;
    }
    shape.opposition /= shape.opening;
    shape.row = tips.col(others.back()) - tips.col(others.front());
    shape.row -= shape.row.dot(shape.opposition) * shape.opposition;
    if (shape.row.norm() < 1e-3) {  // one finger against the thumb
      shape.row = shape.opposition.unitOrthogonal();
    }
    shape.row.normalize();
    return shape;
  }

  // Without principal motion directions: somewhere between the neutral posture, in which fingers
  // are as their maker drew them, and any other.
  [[nodiscard]] Eigen::VectorXd drawn_posture(sampling::RandomStream& random) const {
    if (has_directions(problem_)) {
      return sampling::map_to_posture(*problem_.basis, random.uniform(problem_.basis->dimension()));
    }
    const Eigen::VectorXd rest = hand_of(problem_.model().neutral());
    const double share = random.uniform();
    return rest + share * (random.uniform(static_cast<int>(rest.size())) - rest);
  }

  void make_preshapes() {
    constexpr int kDrawn = 400;
    sampling::RandomStream random(1);
    for (int i = 0; i < kDrawn; ++i) {
      if (auto shape = preshape(drawn_posture(random))) {
        preshapes_.push_back(std::move(*shape));
      }
    }
    std::ranges::stable_sort(preshapes_, {}, &Preshape::opening);
  }

  const PlanningProblem& problem_;
  int palm_;
  std::vector<Finger> fingers_;
  std::vector<Preshape> preshapes_;
};

constexpr double kNear = 0.015;     // m, of a finger at the object
constexpr double kEnclosure = 0.5;  // at least: thumb and a finger at right angles
constexpr double kClear = 0.05;     // m: more is not distinguished
constexpr double kMost = 0.16;      // m, of the object's second longest side
constexpr double kAside = 0.015;    // m
constexpr double kDeepest = 0.45;   // of the distance from the fingers' ends to the palm
constexpr double kBreadth = 0.03;   // m, of fingers
constexpr double kAlong = 0.45;     // cosine: more than that is along the object's longest side
constexpr int kDirections = 200;    // in which the object's outermost points are looked for
constexpr double kTilt = geometric::radians(25.0);
constexpr int kClosingSteps = 40;
constexpr int kOpeningSteps = 12;
constexpr double kOpeningStep = 0.06;  // normalised
constexpr double kClosingStep = 0.03;  // normalised
constexpr double kSameTurn = geometric::radians(30.0);
constexpr double kSamePlace = 0.03;  // m
constexpr int kMostJudged = 400;     // rejected places of the hand, to say what was in the way

const geometric::SceneObject& needed_object(const PlanningProblem& problem, std::string_view name) {
  const std::string file = problem.scene->file.string();
  const geometric::SceneObject* object = geometric::find_object(*problem.scene, name);
  if (!object || object->attachment) {
    throw geometric::InputError({file, "object", std::string(name), "an object that stands still",
                                 "Choose another one to grasp"});
  }
  if (problem.hand.empty()) {
    throw geometric::InputError({file, "robot " + problem.scene->robots.front().name,
                                 "no joints of a hand", "a robot with a hand",
                                 "Mount a hand, or name its group \"hand\" in the SRDF"});
  }
  return *object;
}

class PregraspSearch {
 public:
  PregraspSearch(const PlanningProblem& problem, const geometric::SceneObject& object,
                 const PregraspOptions& options)
      : problem_(problem),
        options_(options),
        checker_(problem.checker->clone()),
        ik_(problem.scene->robots.front().model,
            palm_link(problem.model(), problem.arm, problem.hand), problem.arm),
        hand_(problem, ik_.palm()),
        box_(geometric::bounding_box(*geometric::tessellate(object.shape))),
        X_WO_(object.X_PO),
        X_BW_(problem.scene->robots.front().X_WB.inverse()),
        with_object_(checker_->world().pairs_with(object.name)),
        object_(object.name) {
    for (int link = 0; link < problem.model().link_count(); ++link) {
      middles_.push_back(middle_of(problem.model().link(link)));
    }
    box_.size().maxCoeff(&longest_);
    make_profile(geometric::tessellate(object.shape)->vertices);
    Vector3d sides = box_.size();
    std::ranges::sort(sides);
    middle_side_ = sides[1];
    const geometric::CollisionWorld& world = checker_->world();
    for (int pair = 0; pair < static_cast<int>(world.pairs().size()); ++pair) {
      const bool is_self = world.is_self_pair(world.pairs()[static_cast<std::size_t>(pair)]);
      if (is_self && is_of_hand(pair)) {
        of_hand_.push_back(pair);
      } else if (!is_self && std::ranges::count(with_object_, pair) == 0) {
        with_others_.push_back(pair);
      }
    }
  }

  /// Why there is nothing to try; empty if there is.
  [[nodiscard]] std::string objection() const {
    if (middle_side_ >= kMost) {
      return fmt::format(
          "{} is too large to be grasped: two of its sides are longer than {:.0f} mm. Choose "
          "something smaller.",
          object_, geometric::millimetres(kMost));
    }
    if (!hand_.opens()) {
      return fmt::format(
          "The hand has no thumb and fingers, nor two jaws, that open to {:.0f} mm or more. See in "
          "the robot's setup whether its joints are the hand's.",
          geometric::millimetres(kLeastOpening));
    }
    return {};
  }

  void try_sample(sampling::RandomStream random) {
    const Eigen::Matrix3d R_OG = orientation(random);
    const double width = width_along(R_OG.col(1));
    const std::span<const HandClosing::Preshape> fitting = hand_.opened_to(width);
    ++rejections_.tried;
    narrowest_ = std::min(narrowest_, width);
    if (fitting.empty()) {  // it does not fit, or the hand would close on from too far
      ++(width > hand_.widest() ? rejections_.too_wide : rejections_.too_thin);
      return;
    }
    const HandClosing::Preshape& preshape = fitting[random.below(fitting.size())];
    const Pose X_OP = palm_at(preshape, R_OG, random);
    const Configuration opened = hand_.with_hand(problem_.start, preshape.open);
    const std::vector<Configuration> solutions = ik_.all(opened, X_BW_ * X_WO_ * X_OP);
    if (solutions.empty()) {
      ++rejections_.out_of_reach;
      return;
    }
    const Configuration wider = opened_wider(solutions.front());
    for (Configuration q : solutions) {  // the hand is at the same place in all of them
      q = hand_in(std::move(q), wider);
      const std::optional<int> pair = colliding(q);
      if (!pair && keeps_gaps()) {
        for (const HandClosing::Finger& finger : hand_.fingers()) {
          q = closed_finger(std::move(q), finger);
        }
        take(q);
        return;
      }
      if (!pair || is_of_hand(*pair)) {
        break;
      }
    }
    if (found_.empty() && rejections_.judged() < kMostJudged) {
      judge(hand_in(solutions.front(), wider));
    }
  }

  [[nodiscard]] std::string why_none() const {
    return why_no_grasp(rejections_, object_, narrowest_, hand_.widest(),
                        (X_BW_ * X_WO_ * box_.centre()).norm());
  }

  [[nodiscard]] std::vector<Pregrasp> best() {
    std::ranges::stable_sort(found_, std::greater(), &Pregrasp::score);
    std::vector<Pregrasp> chosen;
    std::vector<Pose> palms;
    for (Pregrasp& grasp : found_) {
      const Pose X_BP = ik_.pose(grasp.q);
      const bool known = std::ranges::any_of(palms, [&](const Pose& other) {
        return Eigen::AngleAxisd(X_BP.linear().transpose() * other.linear()).angle() < kSameTurn &&
               (X_BP.translation() - other.translation()).norm() < kSamePlace;
      });
      if (!known) {
        palms.push_back(X_BP);
        chosen.push_back(std::move(grasp));
      }
      if (static_cast<int>(chosen.size()) >= options_.most) {
        break;
      }
    }
    return chosen;
  }

 private:
  /// `q` with the hand of another one.
  [[nodiscard]] Configuration hand_in(Configuration q, const Configuration& other) const {
    q(problem_.hand) = other(problem_.hand);
    return q;
  }

  /// Counts what is in the way of a configuration that is no grasp.
  void judge(const Configuration& q) {
    checker_->place(q);
    if (!keeps_gaps()) {
      ++rejections_.in_object;
      return;
    }
    const geometric::CollisionWorld& world = checker_->world();
    std::set<std::string> touched;
    for (int check = 0; check < world.check_count(); ++check) {
      if (checker_->pair_closeness(check, 0.0) == geometric::Closeness::kFarther) {
        continue;
      }
      const geometric::NamedPair pair = geometric::named_pair(world, check, 0.0);
      touched.insert(world.constraint(check) ? "Constraint " + pair.a
                     : world.is_self_pair(world.pairs()[static_cast<std::size_t>(check)])
                         ? "The robot itself"
                         : pair.b);
    }
    if (!touched.empty()) {
      rejections_.block(touched);
    }
  }

  void make_profile(std::vector<Vector3d> points) {
    const double centre = box_.centre()[longest_];
    for (Vector3d& p_O : points) {
      p_O[longest_] = std::clamp(p_O[longest_], centre - 0.5 * kBreadth, centre + 0.5 * kBreadth);
    }
    profile_.resize(3, kDirections);
    for (int i = 0; i < kDirections; ++i) {  // on a spiral around the sphere
      const double z = 1.0 - (2.0 * i + 1.0) / kDirections;
      const double turn = 2.0 * std::numbers::pi * std::numbers::phi * i;
      const double r = std::sqrt(1.0 - z * z);
      const Vector3d direction(r * std::cos(turn), r * std::sin(turn), z);
      profile_.col(i) = *std::ranges::max_element(
          points, {}, [&](const Vector3d& p_O) { return direction.dot(p_O); });
    }
  }

  /// Of the grip (the fingers' row, opposition, and what is square to both) in the object's frame:
  /// the row along one of its edges, more or less.
  [[nodiscard]] static Eigen::Matrix3d orientation(sampling::RandomStream& random) {
    const auto signed_uniform = [&] { return 2.0 * random.uniform() - 1.0; };
    const auto edge = static_cast<int>(random.below(3));
    const Vector3d row = (random.below(2) == 0 ? 1.0 : -1.0) * Vector3d::Unit(edge);
    const Vector3d across = Eigen::AngleAxisd(std::numbers::pi * signed_uniform(), row) *
                            Vector3d::Unit((edge + 1) % 3);
    Eigen::Matrix3d R_OG;
    R_OG << row, across, row.cross(across);
    const double share = random.uniform();  // some nearly straight: a narrow gripper needs them
    const Vector3d tilt =
        share * kTilt * Vector3d(signed_uniform(), signed_uniform(), signed_uniform());
    return tilt.norm() > 0.0
               ? R_OG * Eigen::AngleAxisd(tilt.norm(), tilt.normalized()).toRotationMatrix()
               : R_OG;
  }

  /// With the object between the thumb and the fingers, anywhere from their tips to the palm.
  [[nodiscard]] Pose palm_at(const HandClosing::Preshape& preshape, const Eigen::Matrix3d& R_OG,
                             sampling::RandomStream& random) const {
    const auto signed_uniform = [&] { return 2.0 * random.uniform() - 1.0; };
    Eigen::Matrix3d R_PG;
    R_PG << preshape.row, preshape.opposition, preshape.row.cross(preshape.opposition);
    Pose X_OP = Pose::Identity();
    X_OP.linear() = R_OG * R_PG.transpose();
    Vector3d p_O = box_.centre();  // its longest side has room to choose
    p_O[longest_] += 0.35 * signed_uniform() * box_.size()[longest_];
    const double share = random.uniform();
    const Vector3d aside =
        share * kAside * Vector3d(signed_uniform(), signed_uniform(), signed_uniform());
    const double depth = 1.0 - kDeepest * random.uniform();
    X_OP.translation() = p_O - X_OP.linear() * (depth * preshape.grip + aside);
    return X_OP;
  }

  /// What is between fingers along a direction of the object's frame, m.
  [[nodiscard]] double width_along(const Vector3d& direction) const {
    if (std::abs(direction[longest_]) > kAlong) {
      return direction.cwiseAbs().dot(box_.size());
    }
    const Eigen::RowVectorXd along = direction.transpose() * profile_;
    return along.maxCoeff() - along.minCoeff();
  }

  std::optional<int> colliding(const Configuration& q) {
    const std::optional<int> pair = checker_->first_collision(q, last_pair_);
    last_pair_ = pair.value_or(last_pair_);
    return pair;
  }

  /// As it was placed last.
  bool keeps_gaps() {
    const auto keep = [this](const std::vector<int>& pairs, double gap) {
      return std::ranges::all_of(pairs, [&](int pair) {
        return checker_->pair_closeness(pair, gap) == geometric::Closeness::kFarther;
      });
    };
    return keep(with_object_, options_.gap) && keep(of_hand_, options_.own_gap);
  }

  bool keeps_gap(const Configuration& q) { return !colliding(q) && keeps_gaps(); }

  /// Does it only depend on where the hand is?
  [[nodiscard]] bool is_of_hand(int pair) const {
    const geometric::CollisionWorld& world = checker_->world();
    const auto is_hand_link = [&](int link) {
      return link == ik_.palm() ||
             std::ranges::any_of(hand_.fingers(), [&](const HandClosing::Finger& finger) {
               return std::ranges::count(finger.links, link) > 0;
             });
    };
    if (const geometric::LinkConstraint* constraint = world.constraint(pair)) {
      return is_hand_link(constraint->link());
    }
    const auto is_hand = [&](int body) {
      return !world.body(body).moves() || is_hand_link(world.body(body).link);
    };
    const auto& bodies = world.pairs()[static_cast<std::size_t>(pair)];
    return is_hand(bodies.a) && is_hand(bodies.b);
  }

  /// Closes one finger around the object's longest axis. Where something is in the way, its joints
  /// stop one after the other, the one at the palm first, so that the outer links go on.
  Configuration closed_finger(Configuration q, const HandClosing::Finger& finger) {
    const auto [a, b] = axis_in_palm(q);
    Eigen::VectorXd posture = hand_.hand_of(q);
    Eigen::VectorXd rates;
    for (int step = 0, first = 0; step < kClosingSteps;) {
      if (step % 4 == 0 || rates.size() == 0) {
        rates = hand_.towards(finger, posture, a, b);
      }
      Eigen::VectorXd next = posture;
      for (auto k = static_cast<Eigen::Index>(first); k < rates.size(); ++k) {
        next[finger.joints[static_cast<std::size_t>(k)]] += kClosingStep * rates[k];
      }
      next = next.cwiseMax(0.0).cwiseMin(1.0);
      const Configuration q_next = hand_.with_hand(q, next);
      if (next != posture && keeps_gap(q_next)) {
        posture = next;
        q = q_next;
        ++step;
      } else if (++first == static_cast<int>(finger.joints.size())) {
        break;
      }
    }
    return q;
  }

  /// Is one of these links at the object?
  bool touches(const Configuration& q, const std::vector<int>& links) {
    checker_->place(q);
    const geometric::CollisionWorld& world = checker_->world();
    return std::ranges::any_of(with_object_, [&](int pair) {
      const int link = world.body(world.pairs()[static_cast<std::size_t>(pair)].a).link;
      return std::ranges::count(links, link) > 0 &&
             checker_->pair_closeness(pair, options_.gap) != geometric::Closeness::kFarther;
    });
  }

  /// Opens the fingers that are in the object.
  Configuration opened_wider(Configuration q) {
    for (const HandClosing::Finger& finger : hand_.fingers()) {
      if (!touches(q, finger.links)) {
        continue;
      }
      const auto [a, b] = axis_in_palm(q);
      Eigen::VectorXd posture = hand_.hand_of(q);
      const Eigen::VectorXd rates = hand_.towards(finger, posture, a, b);
      for (int step = 0; step < kOpeningSteps && touches(q, finger.links); ++step) {
        posture(finger.joints) -= kOpeningStep * rates;
        posture = posture.cwiseMax(0.0).cwiseMin(1.0);
        q = hand_.with_hand(q, posture);
      }
    }
    return q;
  }

  /// The object's longest axis, as far as fingers go to it.
  [[nodiscard]] std::pair<Vector3d, Vector3d> axis_in_palm(const Configuration& q) const {
    const Pose X_PO = (X_WO_.inverse() * X_BW_.inverse() * ik_.pose(q)).inverse();
    Vector3d along = Vector3d::Zero();
    along[longest_] = 0.5 * std::max(0.0, box_.size()[longest_] - middle_side_);
    return {X_PO * (box_.centre() - along), X_PO * (box_.centre() + along)};
  }

  void take(const Configuration& q) {
    Pregrasp grasp{q};
    checker_->place(q);
    const auto [a, b] = axis_in_palm(q);
    const Pose X_PB = ik_.pose(q).inverse();
    std::vector<Vector3d> sides;  // of the object, on which the fingers are
    for (const HandClosing::Finger& finger : hand_.fingers()) {
      if (const auto nearest = nearest_link(finger)) {
        const Vector3d p_P = X_PB * checker_->link_poses()[static_cast<std::size_t>(*nearest)] *
                             middles_[static_cast<std::size_t>(*nearest)];
        sides.push_back((p_P - nearest_on_segment(p_P, a, b)).normalized());
      }
    }
    grasp.fingers = static_cast<int>(sides.size());
    for (const Vector3d& one : sides) {
      for (const Vector3d& other : sides) {
        grasp.enclosure = std::max(grasp.enclosure, 0.5 * (1.0 - one.dot(other)));
      }
    }
    if (grasp.fingers < 2 || grasp.enclosure < kEnclosure) {
      ++rejections_.one_sided;
      return;
    }
    grasp.clearance = kClear;
    for (const int pair : with_others_) {
      grasp.clearance = std::min(grasp.clearance, checker_->pair_distance(pair, grasp.clearance));
    }
    grasp.subspace_distance =
        has_directions(problem_) ? sampling::distance_to_subspace(*problem_.basis, hand_.hand_of(q))
                                 : 0.0;
    Configuration arm_only = problem_.start;
    arm_only(problem_.arm) = q(problem_.arm);
    grasp.arm_travel = normalised_distance(problem_.model(), problem_.start, arm_only);
    grasp.score = score(grasp);
    found_.push_back(std::move(grasp));
  }

  [[nodiscard]] double score(const Pregrasp& grasp) const {
    const auto full = [](double value, double most) { return std::min(value / most, 1.0); };
    return 0.35 * grasp.fingers / static_cast<double>(hand_.fingers().size()) +
           0.25 * grasp.enclosure + 0.15 * full(grasp.clearance, 0.03) +
           0.15 * (1.0 - full(grasp.subspace_distance, 1.0)) +
           0.1 * (1.0 - full(grasp.arm_travel, 1.0));
  }

  /// The finger's link that is nearest to the object, if it is near.
  std::optional<int> nearest_link(const HandClosing::Finger& finger) {
    std::optional<int> nearest;
    double least = kNear;
    const geometric::CollisionWorld& world = checker_->world();
    for (const int pair : with_object_) {
      const int link = world.body(world.pairs()[static_cast<std::size_t>(pair)].a).link;
      if (std::ranges::count(finger.links, link) == 0) {
        continue;
      }
      if (const double distance = checker_->pair_distance(pair, least); distance < least) {
        least = distance;
        nearest = link;
      }
    }
    return nearest;
  }

  const PlanningProblem& problem_;
  PregraspOptions options_;
  std::unique_ptr<geometric::CollisionChecker> checker_;
  PalmIk ik_;
  HandClosing hand_;
  geometric::Aabb box_;
  Eigen::Index longest_ = 0;
  Eigen::Matrix3Xd profile_;  ///< The object, as long as fingers are broad; in its frame.
  double middle_side_ = 0.0;
  Pose X_WO_;
  Pose X_BW_;
  std::vector<int> with_object_;
  std::vector<int> with_others_;
  std::vector<int> of_hand_;       ///< Pairs of its links.
  std::vector<Vector3d> middles_;  ///< Of every link, in its frame.
  std::string object_;
  std::vector<Pregrasp> found_;
  PregraspRejections rejections_;
  double narrowest_ = HUGE_VAL;  ///< Of the object between fingers, as far as it was tried, m.
  int last_pair_ = 0;
};

}  // namespace

Pregrasps find_pregrasps(const PlanningProblem& problem, std::string_view object,
                         const PregraspOptions& options, const std::stop_token& stop) {
  PregraspSearch search(problem, needed_object(problem, object), options);
  if (std::string objection = search.objection(); !objection.empty()) {
    return {{}, std::move(objection)};
  }
  const sampling::RandomStream random(options.seed);
  for (int i = 0; i < options.samples; ++i) {
    if (stop.stop_requested()) {
      return {};
    }
    search.try_sample(random.fork(static_cast<std::uint64_t>(i)));
  }
  Pregrasps grasps{search.best(), {}};
  if (grasps.found.empty()) {
    grasps.why_none = search.why_none();
  }
  return grasps;
}

}  // namespace handway::planning
