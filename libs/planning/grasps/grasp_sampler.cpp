#include "grasps/grasp_sampler.h"

#include "handway/geometric/math/units.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

namespace handway::planning {
namespace {

using Eigen::Vector3d;
using geometric::Pose;

constexpr double kContactDistance = 0.015;  // m, of a finger at the object
constexpr double kEnclosure = 0.5;          // at least: thumb and a finger at right angles
constexpr double kClearanceCap = 0.05;      // m: more is not distinguished
constexpr double kMaxGraspWidth = 0.16;     // m, of the object's second longest side, or …
constexpr double kMaxRimWidth = 0.5;  // m, … of the longest side of what is held at its rim: …
constexpr double kCoreShare = 0.65;   // of a chord, and …
constexpr double kCoreRoom = 0.02;    // … m: radius of the part that the fingers close around
constexpr int kOpeningSteps = 12;
constexpr double kOpeningStep = 0.06;   // normalised
constexpr int kFineOpeningSteps = 100;  // of a given hand that is in the object
constexpr double kFineOpeningStep = 0.005;
constexpr double kFreeGap = 5e-5;          // m that it then keeps: less than in contact
constexpr double kHoldingImbalance = 0.3;  // imbalance of the fingers: friction holds up to here, …
constexpr double kSlippingImbalance = 0.6;  // … and not from here on
constexpr double kHoldWeight = 0.6;         // share of the score that is lost then
constexpr double kSurfaceSpacing = 0.004;   // m
constexpr double kEpsilonWeight = 0.7;      // share of the score

// Points of a link's surface, in its frame, `spacing` (m) apart or a little more.
std::vector<Vector3d> surface_points(const geometric::Link& link, double spacing) {
  constexpr int kMostSegments = 40;
  const geometric::TriangleMesh mesh = geometric::collision_mesh(link);
  std::vector<Vector3d> points;
  for (const auto& triangle : mesh.triangles) {
    const Vector3d a = mesh.vertices[static_cast<std::size_t>(triangle[0])];
    const Vector3d u = mesh.vertices[static_cast<std::size_t>(triangle[1])] - a;
    const Vector3d v = mesh.vertices[static_cast<std::size_t>(triangle[2])] - a;
    const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
    const int steps = std::clamp(static_cast<int>(longest / spacing), 1, kMostSegments);
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        points.emplace_back(a + (u * i + v * j) / steps);
      }
    }
  }
  return points;
}

// Distance of the origin from the convex hull of unit vectors: 0 if pushes against them balance
// each other, sin(a) if two miss opposing each other by an angle of a each.
double imbalance(const std::vector<Vector3d>& directions) {
  constexpr int kSteps = 200;
  if (directions.empty()) {
    return 1.0;
  }
  Vector3d nearest = directions.front();
  for (int step = 0; step < kSteps; ++step) {
    const Vector3d& support = *std::ranges::min_element(
        directions, {}, [&](const Vector3d& d) { return d.dot(nearest); });
    const Vector3d change = support - nearest;
    if (change.squaredNorm() < 1e-12) {
      break;
    }
    const double share = -nearest.dot(change) / change.squaredNorm();
    if (share < 1e-6) {
      break;
    }
    nearest += std::min(share, 1.0) * change;
  }
  return nearest.norm();
}

// Epsilon (N) that `other` needs for a higher score than that of `candidate`.
double needed_epsilon(const Candidate& candidate, const Candidate& other) {
  return candidate.is_good() ? kFullEpsilon / kEpsilonWeight *
                                   (candidate.grasp.score - (1.0 - kEpsilonWeight) * other.promise)
                             : candidate.grasp.quality.epsilon;
}

// From the core of the object to the point of a link's surface that is nearest to it.
Vector3d side_of(const Pose& X_OL, const std::vector<Vector3d>& surface,
                 const geometric::Aabb& core) {
  Vector3d side = Vector3d::Zero();
  double least = HUGE_VAL;
  for (const Vector3d& p_L : surface) {
    const Vector3d p_O = X_OL * p_L;
    const Vector3d offset = p_O - nearest_in(core, p_O);
    if (offset.squaredNorm() < least) {
      least = offset.squaredNorm();
      side = offset;
    }
  }
  return side.normalized();
}

}  // namespace

GraspSampler::GraspSampler(const PlanningProblem& problem, const geometric::SceneObject& object,
                           const PregraspOptions& options, const std::stop_token& stop)
    : problem_(problem),
      options_(options),
      stop_(stop),
      checker_(problem.checker->clone()),
      ik_(problem.scene->robots.front().model, problem.hand.palm, problem.joints.arm),
      hand_(problem),
      box_(geometric::bounding_box(*geometric::tessellate(object.shape))),
      chords_(*geometric::tessellate(object.shape)),
      X_BO_(problem.scene->robots.front().X_WB.inverse() * object.X_PO),
      with_object_(checker_->world().pairs_with(object.name)),
      object_(object.name) {
  for (int link = 0; link < problem.model().link_count(); ++link) {
    const bool is_of_hand = std::ranges::any_of(hand_.fingers(), [&](const auto& finger) {
      return std::ranges::count(finger.links, link) > 0;
    });
    surfaces_.push_back(is_of_hand ? surface_points(problem.model().link(link), kSurfaceSpacing)
                                   : std::vector<Vector3d>());
  }
  Vector3d sides = box_.size();
  std::ranges::sort(sides);
  is_too_large_ =
      sides[1] >= kMaxGraspWidth && (sides[0] >= kMaxGraspWidth || sides[2] >= kMaxRimWidth);
  const geometric::CollisionWorld& world = checker_->world();
  for (int pair = 0; pair < static_cast<int>(world.pairs().size()); ++pair) {
    const bool is_self = world.is_self_pair(world.pairs()[static_cast<std::size_t>(pair)]);
    if (is_self && is_of_hand(pair)) {
      of_hand_.push_back(pair);
    } else if (!is_self && std::ranges::count(with_object_, pair) == 0) {
      with_others_.push_back(pair);
    }
  }
  std::vector<int> with_hand;
  std::ranges::copy_if(with_object_, std::back_inserter(with_hand),
                       [this](int pair) { return is_of_hand(pair); });
  closing_ = std::make_unique<FingerClosing>(problem, hand_, *checker_, with_object_, of_hand_);
  measurement_ = std::make_unique<GraspMeasurement>(
      GraspMeasurement::Hand{problem, ik_, hand_, *checker_, *closing_}, object,
      std::move(with_hand), options, stop);
}

std::string GraspSampler::invalid_problem_reason() const {
  if (is_too_large_) {
    return fmt::format(
        "{} is too large to be grasped: two of its sides are longer than {:.0f} mm. Choose "
        "something smaller.",
        object_, geometric::millimetres(kMaxGraspWidth));
  }
  if (!hand_.opens()) {
    return fmt::format(
        "The hand has no thumb and fingers, nor two jaws, that open to {:.0f} mm or more. See in "
        "the robot's setup whether its joints are the hand's.",
        geometric::millimetres(HandClosing::kLeastOpening));
  }
  return {};
}

SampleResult GraspSampler::sample(sampling::RandomStream random, bool judges) {
  SampleResult result;
  const Chord chord = chords_.draw(random);
  if (chord.length <= 0.0) {
    result.end = SampleEnd::kTooWide;
    return result;
  }
  result.width = chord.length;
  const std::span<const HandClosing::Preshape> fitting = hand_.opened_to(result.width);
  if (fitting.empty()) {  // it does not fit, or the hand would close on from too far
    result.end = result.width > hand_.widest() ? SampleEnd::kTooWide : SampleEnd::kTooThin;
    return result;
  }
  const HandClosing::Preshape& preshape = fitting[random.below(fitting.size())];
  const GraspPlace place{preshape, palm_at(preshape, chord, random),
                         chords_.core(chord.centre, kCoreShare * chord.length + kCoreRoom)};
  const Configuration opened = hand_.with_hand(problem_.start, preshape.open);
  const Pose X_BP = X_BO_ * place.X_OP;
  try_place(
      place, ik_.all(opened, X_BP, 1), [&] { return ik_.all(opened, X_BP); }, judges, result);
  return result;
}

SampleResult GraspSampler::neighbour(const Candidate& candidate, sampling::RandomStream random) {
  SampleResult result;
  const GraspPlace place = beside(candidate.place, random);
  PalmMove moved =
      ik_.moved(hand_.with_hand(candidate.grasp.q, place.preshape.open), X_BO_ * place.X_OP);
  std::vector<Configuration> reached;
  if (moved.reached) {
    reached.push_back(std::move(moved.q));
  }
  try_place(
      place, reached, [] { return std::vector<Configuration>(); }, false, result);
  if (result.candidate &&
      !measure(*result.candidate, needed_epsilon(candidate, *result.candidate))) {
    result.candidate.reset();
  }
  return result;
}

SampleResult GraspSampler::given(const GivenGrasp& grasp) {
  SampleResult result;
  const Configuration open = grasp.open.value_or(grasp.q);
  HandClosing::Preshape shape;
  shape.open = hand_.hand_of(open);
  const GraspPlace place{std::move(shape), grasp.X_OP, held_core(grasp.X_OP, grasp.q)};
  std::vector<Configuration> reached = ik_.all(grasp.q, X_BO_ * grasp.X_OP);
  for (Configuration& posture : reached) {
    posture = hand_in(std::move(posture), open);
  }
  try_place(
      place, reached, [&] { return reached; }, true, result);
  if (result.candidate) {
    const Configuration in_hand = hand_in(result.candidate->grasp.q, grasp.q);
    const Opening off{kFreeGap, kFineOpeningStep, kFineOpeningSteps};
    measurement_->measure_held(result.candidate->grasp, opened(in_hand, place.core, off),
                               place.core);
    rate(*result.candidate);
  }
  return result;
}

geometric::Aabb GraspSampler::held_core(const Pose& X_OP, const Configuration& q) const {
  Eigen::Matrix3Xd tips(3, std::ssize(hand_.fingers()));
  for (Eigen::Index i = 0; i < tips.cols(); ++i) {
    tips.col(i) = X_OP * hand_.tip_in_palm(hand_.fingers()[static_cast<std::size_t>(i)], q);
  }
  const Vector3d centre = nearest_in(box_, tips.rowwise().mean());
  const double reach = (tips.colwise() - centre).colwise().norm().mean();
  return chords_.core(centre, 2.0 * kCoreShare * reach + kCoreRoom);
}

std::string GraspSampler::why_not(const SampleResult& result) const {
  switch (result.end) {
    case SampleEnd::kOutOfReach:
      return "the arm does not get there";
    case SampleEnd::kInObject:
      return fmt::format("the palm, or a finger that opens, is in {} or in the hand", object_);
    case SampleEnd::kBlocked:
      return fmt::format("{} is in the way", *result.in_the_way.begin());
    default:
      return fmt::format("no two fingers close to different sides of {}", object_);
  }
}

bool GraspSampler::measure(Candidate& candidate, double needed) {
  if (needed > kFullEpsilon ||
      !measurement_->measure(candidate.grasp, candidate.place.core, needed)) {
    return false;
  }
  rate(candidate);
  return true;
}

void GraspSampler::rate(Candidate& candidate) {
  Pregrasp& grasp = candidate.grasp;
  grasp.score = kEpsilonWeight * std::clamp(grasp.quality.epsilon / kFullEpsilon, 0.0, 1.0) +
                (1.0 - kEpsilonWeight) * candidate.promise;
}

std::string GraspSampler::why_none(const SampleResults& results) const {
  return why_no_grasp(results.rejections(), object_, results.narrowest(), hand_.widest(),
                      (X_BO_ * box_.centre()).norm());
}

void GraspSampler::try_place(const GraspPlace& place, const std::vector<Configuration>& reached,
                             const ArmPostures& others, bool judges, SampleResult& result) {
  last_pair_ = 0;  // of this place alone: which pair is looked at first counts as work
  if (reached.empty()) {
    result.end = SampleEnd::kOutOfReach;
    return;
  }
  const Configuration wider =
      opened(reached.front(), place.core, {options_.gap, kOpeningStep, kOpeningSteps});
  Configuration q = wider;
  std::optional<int> pair = colliding(q);
  if (pair && !is_of_hand(*pair)) {  // the hand is at the same place for all postures of the arm
    for (Configuration other : others()) {
      q = hand_in(std::move(other), wider);
      pair = colliding(q);
      if (!pair) {
        break;
      }
    }
  }
  if (!pair && keeps_gaps()) {
    const Pose X_PO = object_in_palm(q);
    q = closing_->all_closed(std::move(q), place.core, X_PO,
                             {.object_gap = options_.gap, .own_gap = options_.own_gap}, stop_);
    result.candidate = candidate_of(q, place);
    result.end = result.candidate ? SampleEnd::kFound : SampleEnd::kOneSided;
  } else if (judges) {
    judge(wider, result);
  }
}

Configuration GraspSampler::hand_in(Configuration q, const Configuration& other) const {
  q(problem_.joints.hand) = other(problem_.joints.hand);
  return q;
}

void GraspSampler::judge(const Configuration& q, SampleResult& result) {
  checker_->place(q);
  if (!keeps_gaps()) {
    result.end = SampleEnd::kInObject;
    return;
  }
  const geometric::CollisionWorld& world = checker_->world();
  for (int check = 0; check < world.check_count(); ++check) {
    if (!checker_->pair_collides(check)) {
      continue;
    }
    const geometric::NamedPair pair = geometric::named_pair(world, check, 0.0);
    result.in_the_way.insert(world.constraint(check) ? "Constraint " + pair.a
                             : world.is_self_pair(world.pairs()[static_cast<std::size_t>(check)])
                                 ? "The robot itself"
                                 : pair.b);
  }
  if (!result.in_the_way.empty()) {
    result.end = SampleEnd::kBlocked;
  }
}

std::optional<int> GraspSampler::colliding(const Configuration& q) {
  const std::optional<int> pair = checker_->first_collision(q, last_pair_);
  last_pair_ = pair.value_or(last_pair_);
  return pair;
}

bool GraspSampler::keeps_gaps() {
  const auto keep = [this](const std::vector<int>& pairs, double gap) {
    return std::ranges::all_of(pairs,
                               [&](int pair) { return !checker_->pair_is_nearer_than(pair, gap); });
  };
  return keep(with_object_, options_.gap) && keep(of_hand_, options_.own_gap);
}

bool GraspSampler::is_of_hand(int pair) const {
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

bool GraspSampler::touches(const Configuration& q, const std::vector<int>& links, double gap) {
  checker_->place(q);
  const geometric::CollisionWorld& world = checker_->world();
  return std::ranges::any_of(with_object_, [&](int pair) {
    const int link = world.body(world.pairs()[static_cast<std::size_t>(pair)].a).link;
    return std::ranges::count(links, link) > 0 && checker_->pair_is_nearer_than(pair, gap);
  });
}

Configuration GraspSampler::opened(Configuration q, const geometric::Aabb& core,
                                   const Opening& opening) {
  for (const HandClosing::Finger& finger : hand_.fingers()) {
    if (!touches(q, finger.links, opening.gap)) {
      continue;
    }
    Eigen::VectorXd posture = hand_.hand_of(q);
    const Eigen::VectorXd rates = hand_.towards(finger, posture, core, object_in_palm(q));
    for (int step = 0; step < opening.most && touches(q, finger.links, opening.gap); ++step) {
      posture(finger.joints) -= opening.step * rates;
      posture = posture.cwiseMax(0.0).cwiseMin(1.0);
      q = hand_.with_hand(q, posture);
    }
  }
  return q;
}

Pose GraspSampler::object_in_palm(const Configuration& q) const {
  return ik_.pose(q).inverse() * X_BO_;
}

std::optional<Candidate> GraspSampler::candidate_of(const Configuration& q,
                                                    const GraspPlace& place) {
  Pregrasp grasp{q};
  checker_->place(q);
  const Pose X_OB = X_BO_.inverse();
  std::vector<Vector3d> sides;  // of the object, on which the fingers are
  for (const HandClosing::Finger& finger : hand_.fingers()) {
    if (const auto nearest = nearest_link(finger)) {
      const Pose X_OL = X_OB * checker_->link_poses()[static_cast<std::size_t>(*nearest)];
      sides.push_back(side_of(X_OL, surfaces_[static_cast<std::size_t>(*nearest)], place.core));
    }
  }
  grasp.fingers = static_cast<int>(sides.size());
  for (const Vector3d& one : sides) {
    for (const Vector3d& other : sides) {
      grasp.enclosure = std::max(grasp.enclosure, 0.5 * (1.0 - one.dot(other)));
    }
  }
  if (grasp.fingers < 2 || grasp.enclosure < kEnclosure) {
    return std::nullopt;
  }
  grasp.clearance = kClearanceCap;
  for (const int pair : with_others_) {
    grasp.clearance = std::min(grasp.clearance, checker_->pair_distance(pair, grasp.clearance));
  }
  grasp.subspace_distance = has_directions(problem_)
                                ? sampling::distance_to_subspace(*problem_.basis, hand_.hand_of(q))
                                : 0.0;
  Configuration arm_only = problem_.start;
  arm_only(problem_.joints.arm) = q(problem_.joints.arm);
  grasp.arm_travel = normalised_distance(problem_.model(), problem_.start, arm_only);
  const double promise = this->promise(grasp, imbalance(sides));
  return Candidate{std::move(grasp), place, promise, ik_.pose(q)};
}

double GraspSampler::promise(const Pregrasp& grasp, double unopposed) const {
  const double hold = std::clamp(
      (kSlippingImbalance - unopposed) / (kSlippingImbalance - kHoldingImbalance), 0.0, 1.0);
  return (kHoldWeight * hold + 1.0 - kHoldWeight) * plain_promise(grasp);
}

double GraspSampler::plain_promise(const Pregrasp& grasp) const {
  const auto full = [](double value, double most) { return std::min(value / most, 1.0); };
  return 0.35 * grasp.fingers / static_cast<double>(hand_.fingers().size()) +
         0.25 * grasp.enclosure + 0.15 * full(grasp.clearance, 0.03) +
         0.15 * (1.0 - full(grasp.subspace_distance, 1.0)) +
         0.1 * (1.0 - full(grasp.arm_travel, 1.0));
}

std::optional<int> GraspSampler::nearest_link(const HandClosing::Finger& finger) {
  std::optional<int> nearest;
  double least = kContactDistance;
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

}  // namespace handway::planning
