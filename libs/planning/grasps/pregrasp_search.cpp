#include "handway/planning/grasps/pregrasp_search.h"

#include "core/thread_pool.h"
#include "grasps/finger_closing.h"
#include "grasps/grasp_measurement.h"
#include "grasps/hand_closing.h"
#include "grasps/object_chords.h"
#include "grasps/pregrasp_rejections.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/core/carried_objects.h"
#include "handway/planning/edits/scene_edits.h"
#include "handway/planning/queries/palm_ik.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

namespace handway::planning {
namespace {

using Eigen::Vector3d;
using geometric::HandStructure;
using geometric::Pose;

constexpr double kContactDistance = 0.015;  // m, of a finger at the object
constexpr double kEnclosure = 0.5;          // at least: thumb and a finger at right angles
constexpr double kClearanceCap = 0.05;      // m: more is not distinguished
constexpr double kMaxGraspWidth = 0.16;     // m, of the object's second longest side, or …
constexpr double kMaxRimWidth = 0.5;  // m, … of the longest side of what is held at its rim: …
constexpr double kLateralShift = 0.015;  // m
constexpr double kMaxDepthShare = 0.45;  // of the distance from the fingers' ends to the palm
constexpr double kMaxAxisAlignment =
    0.9;                             // cosine: an axis above that is not square to the opposition
constexpr double kCoreShare = 0.65;  // of a chord, and …
constexpr double kCoreRoom = 0.02;   // … m: radius of the part that the fingers close around
constexpr double kTilt = geometric::radians(25.0);
constexpr int kOpeningSteps = 12;
constexpr double kOpeningStep = 0.06;  // normalised
constexpr double kSameTurn = geometric::radians(30.0);
constexpr double kSamePlace = 0.03;  // m
constexpr int kMostJudged = 400;     // rejected places of the hand, to say what was in the way
constexpr double kHoldingImbalance = 0.3;  // imbalance of the fingers: friction holds up to here, …
constexpr double kSlippingImbalance = 0.6;  // … and not from here on
constexpr double kHoldWeight = 0.6;         // share of the score that is lost then
constexpr double kSurfaceSpacing = 0.004;   // m
constexpr int kLeastSamples = 1024;         // before a search ends early …
constexpr int kSamplesWithoutGain = 384;  // … since so many samples made a full list no better, …
constexpr int kGoodPatience = 192;        // … or so many one whose mean score is …
constexpr double kGoodScore = 0.85;       // … at least this, …
constexpr int kMorePatience = 2048;       // … or so many a shorter one
constexpr double kScoreGain = 0.01;       // of a score
constexpr double kEpsilonWeight = 0.7;    // share of the score
constexpr double kFullEpsilon = 0.15;     // N: more is not better
constexpr int kPoolFactor = 2;            // candidates that are measured, times those wanted, …
constexpr int kLeastPool = 16;            // … and at least
constexpr int kMostMeasured = 3;          // times that, with those that turn out bad
constexpr std::size_t kMeasuredEach = 8;   // at a time
constexpr int kBatch = 32;                 // samples between two reports of progress
constexpr double kNeighbourShift = 0.015;  // m, of the palm beside a good place, along each axis
constexpr double kNeighbourTurn = geometric::radians(15.0);  // about each axis
constexpr int kFirstNeighbour = 512;                         // sample, and …
constexpr int kNeighbourEach = 2;                            // … then each of so many, …
constexpr int kNeighbours = 96;                              // … and that for each grasp

const geometric::SceneObject& graspable_object(const PlanningProblem& problem,
                                               std::string_view name) {
  const std::string file = problem.scene->file.string();
  const geometric::SceneObject& object = need_object(*problem.scene, name);
  if (object.attachment) {
    throw geometric::InputError({file, "object", std::string(name), "an object that stands still",
                                 "Choose another one to grasp"});
  }
  if (geometric::tessellate(object.shape)->empty()) {
    throw geometric::InputError(
        {file, "object " + std::string(name), "no triangles", "an object with a surface", ""});
  }
  if (const std::vector<CarriedObject> carried = carried_objects(*problem.scene);
      problem.joints.hand.empty() && !carried.empty()) {
    throw geometric::InputError({file, "object", std::string(name),
                                 "a hand that is free: it carries " + carried.front().name,
                                 "Detach what it carries first"});
  }
  if (problem.joints.hand.empty()) {
    throw geometric::InputError({file, "robot " + problem.scene->robots.front().name,
                                 "no joints of a hand", "a robot with a hand",
                                 "Mount a hand, or name its group \"hand\" in the SRDF"});
  }
  return object;
}

// Candidates that are measured at a time, in places that differ.
int pool_size(const PregraspOptions& options) {
  return std::max(kLeastPool, kPoolFactor * options.most);
}

// In [-1, 1].
double signed_uniform(sampling::RandomStream& random) { return 2.0 * random.uniform() - 1.0; }

Vector3d signed_vector(sampling::RandomStream& random) {
  return Vector3d(signed_uniform(random), signed_uniform(random), signed_uniform(random));
}

// Selects the hand that is nearest to the object where the robot starts; the other hands, and
// their arms, stay.
PlanningProblem with_nearest_hand(const PlanningProblem& problem,
                                  const geometric::SceneObject& object) {
  PlanningProblem of_one = problem;
  if (problem.scene->group.empty() && !problem.basis) {  // a goal is no choice of a hand
    of_one.joints = geometric::JointSelection::of_groups(problem.model());
  }
  std::vector<geometric::Limb> found = limbs(problem.model(), of_one.joints);
  std::erase_if(found, [](const geometric::Limb& limb) { return limb.hand.empty(); });
  if (found.size() < 2) {
    return problem;
  }
  const geometric::RobotInstance& robot = problem.scene->robots.front();
  std::vector<Pose> X_BL(static_cast<std::size_t>(problem.model().link_count()));
  problem.model().forward_kinematics(problem.start, X_BL);
  const auto distance = [&](const geometric::Limb& limb) {
    const int palm = HandStructure::of(problem.model(), limb.arm, limb.hand).palm;
    const Pose X_WP = robot.X_WB * X_BL[static_cast<std::size_t>(palm)];
    return (X_WP.translation() - object.X_PO.translation()).norm();
  };
  const auto nearest = std::ranges::min_element(found, {}, distance);
  for (auto other = found.begin(); other != found.end(); ++other) {
    if (other != nearest) {
      std::erase_if(of_one.joints.arm,
                    [&](int v) { return std::ranges::count(other->arm, v) > 0; });
      std::erase_if(of_one.joints.hand,
                    [&](int v) { return std::ranges::count(other->hand, v) > 0; });
    }
  }
  of_one.hand = HandStructure::of(problem.model(), of_one.joints.arm, of_one.joints.hand);
  if (problem.basis && of_one.joints.hand.size() < problem.joints.hand.size()) {
    of_one.basis = nullptr;  // its directions are of both
  }
  return of_one;
}

/// Points of a link's surface, in its frame, `spacing` (m) apart or a little more.
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

/// Distance of the origin from the convex hull of unit vectors: 0 if pushes against them balance
/// each other, sin(a) if two miss opposing each other by an angle of a each.
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

/// Stage at which a sample ended.
enum class SampleEnd {
  kTooWide,
  kTooThin,
  kOutOfReach,
  kInObject,
  kBlocked,
  kOneSided,
  kFound,
  kUnknown,  ///< Rejected, and not asked why.
};

/// A place of the hand around an object, before its fingers close.
struct Place {
  HandClosing::Preshape preshape;
  Pose X_OP;             ///< Pose of the palm.
  geometric::Aabb core;  ///< Part of the object that the fingers close around, in its frame.
};

/// A pre-grasp that was found, and what is known of it.
struct Candidate {
  Pregrasp grasp;
  Place place;           ///< The place that it was found at.
  double promise = 0.0;  ///< The score of the pre-grasp alone.
  Pose X_BP;             ///< Pose of the palm.

  [[nodiscard]] bool is_measured() const { return grasp.closed.size() > 0; }
  [[nodiscard]] bool is_good() const { return is_measured() && grasp.doubt.empty(); }
};

/// Result of trying one place of the hand.
struct SampleResult {
  SampleEnd end = SampleEnd::kUnknown;
  double width = HUGE_VAL;           ///< Width of the object between the fingers, m.
  std::set<std::string> in_the_way;  ///< If blocked.
  std::optional<Candidate> candidate;
};

/// Collects the results of the samples of a search, added in their order.
class SampleResults {
 public:
  void add(SampleResult result) {
    ++rejections_.tried;
    narrowest_ = std::min(narrowest_, result.width);
    rejections_.too_wide += result.end == SampleEnd::kTooWide ? 1 : 0;
    rejections_.too_thin += result.end == SampleEnd::kTooThin ? 1 : 0;
    rejections_.out_of_reach += result.end == SampleEnd::kOutOfReach ? 1 : 0;
    rejections_.in_object += result.end == SampleEnd::kInObject ? 1 : 0;
    rejections_.one_sided += result.end == SampleEnd::kOneSided ? 1 : 0;
    if (result.end == SampleEnd::kBlocked) {
      rejections_.block(result.in_the_way);
    }
    if (result.candidate) {
      candidates_.push_back(std::move(*result.candidate));
    }
  }

  [[nodiscard]] const PregraspRejections& rejections() const { return rejections_; }
  [[nodiscard]] double narrowest() const { return narrowest_; }
  [[nodiscard]] const std::vector<Candidate>& candidates() const { return candidates_; }
  [[nodiscard]] Candidate& candidate(std::size_t index) { return candidates_[index]; }
  /// Returns whether it helps to know why one more sample is rejected.
  [[nodiscard]] bool asks_why() const {
    return candidates_.empty() && rejections_.judged() < kMostJudged;
  }

 private:
  std::vector<Candidate> candidates_;
  PregraspRejections rejections_;
  double narrowest_ = HUGE_VAL;
};

/// Tries places of the hand around an object; one per thread.
class PregraspSearch {
 public:
  PregraspSearch(const PlanningProblem& problem, const geometric::SceneObject& object,
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

  /// Why there is nothing to try; empty if there is.
  [[nodiscard]] std::string invalid_problem_reason() const {
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

  [[nodiscard]] int palm() const { return ik_.palm(); }

  /// Tries one place of the hand.
  /// @param judges whether a rejected one is asked for what is in the way.
  [[nodiscard]] SampleResult sample(sampling::RandomStream random, bool judges) {
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
    const Place place{preshape, palm_at(preshape, chord, random),
                      chords_.core(chord.centre, kCoreShare * chord.length + kCoreRoom)};
    const Configuration opened = hand_.with_hand(problem_.start, preshape.open);
    const Pose X_BP = X_BO_ * place.X_OP;
    try_place(
        place, ik_.all(opened, X_BP, 1), [&] { return ik_.all(opened, X_BP); }, judges, result);
    return result;
  }

  /// Tries a place beside that of a measured candidate; finds a better grasp or none.
  [[nodiscard]] SampleResult neighbour(const Candidate& candidate, sampling::RandomStream random) {
    SampleResult result;
    const Place place = beside(candidate.place, random);
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

  /// Closes the hand of a candidate up to contact, measures how the object is held, and sets its
  /// score.
  /// @param needed epsilon (N) without which it is not wanted.
  /// @returns false if it has less: then not all of it is set.
  bool measure(Candidate& candidate, double needed = -HUGE_VAL) {
    Pregrasp& grasp = candidate.grasp;
    if (needed > kFullEpsilon || !measurement_->measure(grasp, candidate.place.core, needed)) {
      return false;
    }
    grasp.score = kEpsilonWeight * std::clamp(grasp.quality.epsilon / kFullEpsilon, 0.0, 1.0) +
                  (1.0 - kEpsilonWeight) * candidate.promise;
    return true;
  }

  [[nodiscard]] std::string why_none(const SampleResults& results) const {
    return why_no_grasp(results.rejections(), object_, results.narrowest(), hand_.widest(),
                        (X_BO_ * box_.centre()).norm());
  }

  /// Indices of the measured ones that differ, the best first; those in doubt if there are no
  /// others.
  [[nodiscard]] std::vector<std::size_t> best(const std::vector<Candidate>& candidates) const {
    const bool has_good = std::ranges::any_of(candidates, &Candidate::is_good);
    return distinct(
        candidates, [](const Candidate& candidate) { return candidate.grasp.score; },
        [&](const Candidate& candidate) {
          return has_good ? candidate.is_good() : candidate.is_measured();
        },
        options_.most);
  }

  /// Indices of those among the most promising ones that are to be measured.
  [[nodiscard]] std::vector<std::size_t> to_be_measured(
      const std::vector<Candidate>& candidates) const {
    std::vector<std::size_t> promising = distinct(
        candidates, [](const Candidate& candidate) { return candidate.promise; },
        [](const Candidate& candidate) { return !candidate.is_measured() || candidate.is_good(); },
        pool_size(options_));
    std::erase_if(promising, [&](std::size_t i) { return candidates[i].is_measured(); });
    return promising;
  }

 private:
  /// Closes the hand at a place and sets the result's end.
  /// @param reached a configuration with the opened hand there; none if the arm does not get there.
  /// @param others returns other postures of the arm, for the case that the first one collides.
  template <typename Others>
  void try_place(const Place& place, const std::vector<Configuration>& reached,
                 const Others& others, bool judges, SampleResult& result) {
    last_pair_ = 0;  // of this place alone: which pair is looked at first counts as work
    if (reached.empty()) {
      result.end = SampleEnd::kOutOfReach;
      return;
    }
    const Configuration wider = opened_wider(reached.front(), place.core);
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

  /// Epsilon (N) that `other` needs for a higher score than that of `candidate`.
  [[nodiscard]] static double needed_epsilon(const Candidate& candidate, const Candidate& other) {
    return candidate.is_good()
               ? kFullEpsilon / kEpsilonWeight *
                     (candidate.grasp.score - (1.0 - kEpsilonWeight) * other.promise)
               : candidate.grasp.quality.epsilon;
  }

  /// A place that is moved and turned about its grip by a little.
  [[nodiscard]] static Place beside(const Place& place, sampling::RandomStream& random) {
    const double size = random.uniform();
    const Vector3d shift = size * kNeighbourShift * signed_vector(random);
    const Vector3d turn = size * kNeighbourTurn * signed_vector(random);
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()).toRotationMatrix();
    const Vector3d p_OGrip = place.X_OP * place.preshape.grip;
    Place moved = place;
    moved.X_OP.linear() = R * place.X_OP.linear();
    moved.X_OP.translation() = p_OGrip + shift - moved.X_OP.linear() * place.preshape.grip;
    return moved;
  }

  /// Indices of the `most` admitted candidates with the highest value that have the palm at
  /// different places, the highest first.
  template <typename Value, typename Admits>
  [[nodiscard]] std::vector<std::size_t> distinct(const std::vector<Candidate>& candidates,
                                                  const Value& value, const Admits& admits,
                                                  int most) const {
    std::vector<std::size_t> ranked;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (admits(candidates[i])) {
        ranked.push_back(i);
      }
    }
    std::ranges::stable_sort(ranked, std::greater(),
                             [&](std::size_t i) { return value(candidates[i]); });
    std::vector<std::size_t> chosen;
    for (const std::size_t i : ranked) {
      const Pose& X_BP = candidates[i].X_BP;
      const bool is_known = std::ranges::any_of(chosen, [&](std::size_t other_index) {
        const Pose& other = candidates[other_index].X_BP;
        return (X_BP.translation() - other.translation()).norm() < kSamePlace &&
               Eigen::AngleAxisd(X_BP.linear().transpose() * other.linear()).angle() < kSameTurn;
      });
      if (!is_known) {
        chosen.push_back(i);
      }
      if (static_cast<int>(chosen.size()) >= most) {
        break;
      }
    }
    return chosen;
  }

  /// `q` with the hand of another one.
  [[nodiscard]] Configuration hand_in(Configuration q, const Configuration& other) const {
    q(problem_.joints.hand) = other(problem_.joints.hand);
    return q;
  }

  /// Finds what is in the way of a configuration that is no grasp.
  void judge(const Configuration& q, SampleResult& result) {
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

  /// Draws the orientation of the grip (the fingers' row, opposition, their normal) in the object:
  /// the opposition along a chord; the row square to it, along the object's axes as often as not.
  [[nodiscard]] static Eigen::Matrix3d orientation(const Chord& chord,
                                                   sampling::RandomStream& random) {
    const Vector3d across = (random.below(2) == 0 ? 1.0 : -1.0) * chord.direction;
    const Vector3d axis = Vector3d::Unit(static_cast<int>(random.below(3)));
    const bool is_along = random.below(2) == 0 && std::abs(axis.dot(across)) < kMaxAxisAlignment;
    const Vector3d square =
        (is_along ? Vector3d(axis - axis.dot(across) * across) : across.unitOrthogonal())
            .normalized();
    const double turn = is_along ? static_cast<double>(random.below(2)) : 2.0 * random.uniform();
    const Vector3d row = Eigen::AngleAxisd(std::numbers::pi * turn, across) * square;
    Eigen::Matrix3d R_OG;
    R_OG << row, across, row.cross(across);
    const double share = random.uniform();  // some nearly straight: a narrow gripper needs them
    const Vector3d tilt = share * kTilt * signed_vector(random);
    return R_OG * Eigen::AngleAxisd(tilt.norm(), tilt.stableNormalized()).toRotationMatrix();
  }

  /// With the object between the thumb and the fingers, anywhere from their tips to the palm.
  [[nodiscard]] static Pose palm_at(const HandClosing::Preshape& preshape, const Chord& chord,
                                    sampling::RandomStream& random) {
    Eigen::Matrix3d R_PG;
    R_PG << preshape.row, preshape.opposition, preshape.row.cross(preshape.opposition);
    Pose X_OP = Pose::Identity();
    X_OP.linear() = orientation(chord, random) * R_PG.transpose();
    const double share = random.uniform();
    const Vector3d aside = share * kLateralShift * signed_vector(random);
    const double depth = 1.0 - kMaxDepthShare * random.uniform();
    X_OP.translation() = chord.centre - X_OP.linear() * (depth * preshape.grip + aside);
    return X_OP;
  }

  std::optional<int> colliding(const Configuration& q) {
    const std::optional<int> pair = checker_->first_collision(q, last_pair_);
    last_pair_ = pair.value_or(last_pair_);
    return pair;
  }

  /// Checks the gaps of the configuration that was placed last.
  bool keeps_gaps() {
    const auto keep = [this](const std::vector<int>& pairs, double gap) {
      return std::ranges::all_of(
          pairs, [&](int pair) { return !checker_->pair_is_nearer_than(pair, gap); });
    };
    return keep(with_object_, options_.gap) && keep(of_hand_, options_.own_gap);
  }

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

  /// Is one of these links at the object?
  bool touches(const Configuration& q, const std::vector<int>& links) {
    checker_->place(q);
    const geometric::CollisionWorld& world = checker_->world();
    return std::ranges::any_of(with_object_, [&](int pair) {
      const int link = world.body(world.pairs()[static_cast<std::size_t>(pair)].a).link;
      return std::ranges::count(links, link) > 0 &&
             checker_->pair_is_nearer_than(pair, options_.gap);
    });
  }

  /// Opens the fingers that are in the object.
  Configuration opened_wider(Configuration q, const geometric::Aabb& core) {
    for (const HandClosing::Finger& finger : hand_.fingers()) {
      if (!touches(q, finger.links)) {
        continue;
      }
      Eigen::VectorXd posture = hand_.hand_of(q);
      const Eigen::VectorXd rates = hand_.towards(finger, posture, core, object_in_palm(q));
      for (int step = 0; step < kOpeningSteps && touches(q, finger.links); ++step) {
        posture(finger.joints) -= kOpeningStep * rates;
        posture = posture.cwiseMax(0.0).cwiseMin(1.0);
        q = hand_.with_hand(q, posture);
      }
    }
    return q;
  }

  [[nodiscard]] Pose object_in_palm(const Configuration& q) const {
    return ik_.pose(q).inverse() * X_BO_;
  }

  /// The grasp of a closed hand, if two fingers are at different sides of the object.
  std::optional<Candidate> candidate_of(const Configuration& q, const Place& place) {
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
    grasp.subspace_distance =
        has_directions(problem_) ? sampling::distance_to_subspace(*problem_.basis, hand_.hand_of(q))
                                 : 0.0;
    Configuration arm_only = problem_.start;
    arm_only(problem_.joints.arm) = q(problem_.joints.arm);
    grasp.arm_travel = normalised_distance(problem_.model(), problem_.start, arm_only);
    const double promise = this->promise(grasp, imbalance(sides));
    return Candidate{std::move(grasp), place, promise, ik_.pose(q)};
  }

  /// From the core of the object to the point of a link's surface that is nearest to it.
  [[nodiscard]] static Vector3d side_of(const Pose& X_OL, const std::vector<Vector3d>& surface,
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

  /// @param unopposed imbalance() of the fingers' sides: such a grasp slips off, as jaws do that
  /// close on a chord of what is round.
  [[nodiscard]] double promise(const Pregrasp& grasp, double unopposed) const {
    const double hold = std::clamp(
        (kSlippingImbalance - unopposed) / (kSlippingImbalance - kHoldingImbalance), 0.0, 1.0);
    return (kHoldWeight * hold + 1.0 - kHoldWeight) * plain_promise(grasp);
  }

  [[nodiscard]] double plain_promise(const Pregrasp& grasp) const {
    const auto full = [](double value, double most) { return std::min(value / most, 1.0); };
    return 0.35 * grasp.fingers / static_cast<double>(hand_.fingers().size()) +
           0.25 * grasp.enclosure + 0.15 * full(grasp.clearance, 0.03) +
           0.15 * (1.0 - full(grasp.subspace_distance, 1.0)) +
           0.1 * (1.0 - full(grasp.arm_travel, 1.0));
  }

  /// The finger's link that is nearest to the object, if it is near.
  std::optional<int> nearest_link(const HandClosing::Finger& finger) {
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

  const PlanningProblem& problem_;
  PregraspOptions options_;
  std::stop_token stop_;
  std::unique_ptr<geometric::CollisionChecker> checker_;
  PalmIk ik_;
  HandClosing hand_;
  geometric::Aabb box_;
  ObjectChords chords_;
  bool is_too_large_ = false;
  Pose X_BO_;
  std::vector<int> with_object_;
  std::vector<int> with_others_;
  std::vector<int> of_hand_;  ///< Pairs of its links.
  std::unique_ptr<FingerClosing> closing_;
  std::unique_ptr<GraspMeasurement> measurement_;
  std::vector<std::vector<Vector3d>>
      surfaces_;  ///< Points on every link of a finger, in its frame.
  std::string object_;
  int last_pair_ = 0;
};

/// When a search has found enough: as many as are wanted, and none better for a while.
class Patience {
 public:
  explicit Patience(const PregraspOptions& options) : most_(options.most) {}

  void note(const std::vector<Pregrasp>& found, int samples) {
    double sum = 0.0;
    for (const Pregrasp& grasp : found) {
      sum += grasp.score;
    }
    if (sum > sum_ + kScoreGain * most_ ||
        (!found.empty() && found.front().score > best_ + kScoreGain)) {
      sum_ = sum;
      best_ = found.front().score;
      since_ = samples;
    }
    ended_ = !found.empty() && samples >= kLeastSamples && samples - since_ >= patience(found, sum);
  }
  [[nodiscard]] bool ended() const { return ended_; }

 private:
  /// Samples without gain that end the search. @param sum of the scores.
  [[nodiscard]] int patience(const std::vector<Pregrasp>& found, double sum) const {
    if (static_cast<int>(found.size()) < most_) {
      return kMorePatience;
    }
    return sum >= kGoodScore * most_ ? kGoodPatience : kSamplesWithoutGain;
  }

  int most_;
  double sum_ = 0.0;
  double best_ = 0.0;
  int since_ = 0;
  bool ended_ = false;
};

/// Runs the samples of a search on several threads, in batches that are added in their order: the
/// number of threads changes nothing.
class SampleRunner {
 public:
  SampleRunner(const PlanningProblem& problem, const geometric::SceneObject& object,
               const PregraspOptions& options, const std::stop_token& stop)
      : stop_(stop),
        measurements_left_(static_cast<std::size_t>(kMostMeasured * pool_size(options))),
        wanted_(options.most),
        random_(options.seed),
        threads_(std::max(options.threads, 1)) {
    for (int thread = 0; thread < threads_.size(); ++thread) {
      searches_.push_back(std::make_unique<PregraspSearch>(problem, object, options, stop));
    }
  }

  [[nodiscard]] const PregraspSearch& search() const { return *searches_.front(); }
  [[nodiscard]] const SampleResults& results() const { return results_; }

  /// Runs samples first, first + 1, …, last - 1.
  /// @returns false, and adds none of them, if a stop was requested.
  [[nodiscard]] bool run(int first, int last) {
    std::vector<SampleResult> batch(static_cast<std::size_t>(last - first));
    std::atomic<int> next = first;
    threads_.run(0, threads_.size(), [&, asks_why = results_.asks_why()](int thread) {
      PregraspSearch& search = *searches_[static_cast<std::size_t>(thread)];
      for (int i = next++; i < last && !stop_.stop_requested(); i = next++) {
        const sampling::RandomStream random = random_.fork(static_cast<std::uint64_t>(i));
        const Candidate* parent = improvable(i);
        batch[static_cast<std::size_t>(i - first)] =
            parent ? search.neighbour(*parent, random) : search.sample(random, asks_why);
      }
    });
    if (stop_.stop_requested()) {
      return false;
    }
    for (SampleResult& result : batch) {
      results_.add(std::move(result));
    }
    measure();
    best_ = search().best(results_.candidates());
    improvable_ = best_;
    std::erase_if(improvable_, [this](std::size_t i) {
      return results_.candidates()[i].grasp.quality.epsilon >= kFullEpsilon;
    });
    return true;
  }

  /// The grasps that differ, the best first; see PregraspSearch::best().
  [[nodiscard]] std::vector<Pregrasp> best() const {
    std::vector<Pregrasp> grasps;
    for (const std::size_t i : best_) {
      grasps.push_back(results_.candidates()[i].grasp);
    }
    return grasps;
  }

 private:
  /// The grasp that a sample is to be taken beside; null for one anywhere.
  [[nodiscard]] const Candidate* improvable(int sample) const {
    const int since = sample - kFirstNeighbour;
    if (improvable_.empty() || since < 0 || since % kNeighbourEach != 0 ||
        since / kNeighbourEach >= kNeighbours * wanted_) {
      return nullptr;
    }
    const auto turn = static_cast<std::size_t>(since / kNeighbourEach);
    return &results_.candidates()[improvable_[turn % improvable_.size()]];
  }

  /// Measures the most promising candidates, a few at a time.
  void measure() {
    std::vector<std::size_t> next = search().to_be_measured(results_.candidates());
    next.resize(std::min<std::size_t>({next.size(), kMeasuredEach, measurements_left_}));
    measurements_left_ -= next.size();
    std::atomic<std::size_t> begun = 0;
    threads_.run(0, threads_.size(), [&](int thread) {
      for (std::size_t i = begun++; i < next.size() && !stop_.stop_requested(); i = begun++) {
        Candidate& candidate = results_.candidate(next[i]);
        searches_[static_cast<std::size_t>(thread)]->measure(candidate);
      }
    });
  }

  std::stop_token stop_;
  std::size_t measurements_left_;
  int wanted_;
  sampling::RandomStream random_;
  ThreadPool threads_;
  std::vector<std::unique_ptr<PregraspSearch>> searches_;
  SampleResults results_;
  std::vector<std::size_t> best_;        ///< Indices of candidates, …
  std::vector<std::size_t> improvable_;  ///< … and of those that more epsilon makes better.
};

}  // namespace

Pregrasps find_pregrasps(const PlanningProblem& problem, std::string_view object,
                         const PregraspOptions& options, const std::stop_token& stop,
                         const PregraspProgress& progress) {
  const geometric::SceneObject& needed = graspable_object(problem, object);
  const PlanningProblem of_hand = with_nearest_hand(problem, needed);
  SampleRunner runner(of_hand, needed, options, stop);
  if (std::string reason = runner.search().invalid_problem_reason(); !reason.empty()) {
    return {{}, std::move(reason), runner.search().palm()};
  }
  Pregrasps grasps;
  grasps.palm = runner.search().palm();
  Patience patience(options);
  for (int done = 0; done < options.samples && !stop.stop_requested() && !patience.ended();) {
    const int last = std::min(done + kBatch, options.samples);
    if (!runner.run(done, last)) {
      break;
    }
    done = last;
    grasps.found = runner.best();
    patience.note(grasps.found, done);
    if (progress) {
      progress(grasps.found, patience.ended() ? 1.0 : static_cast<double>(done) / options.samples);
    }
  }
  if (grasps.found.empty() && !stop.stop_requested()) {
    grasps.why_none = runner.search().why_none(runner.results());
  }
  return grasps;
}

}  // namespace handway::planning
