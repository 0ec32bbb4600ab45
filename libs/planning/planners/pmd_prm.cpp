#include "handway/geometric/robot/normalised_joints.h"
#include "handway/planning/core/observer.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/paths/roadmap_smoothing.h"
#include "handway/planning/spaces/state_space.h"
#include "handway/planning/spaces/target_sampler.h"
#include "handway/sampling/sequences/low_discrepancy.h"
#include "handway/sampling/sequences/random_stream.h"
#include "planners/built_in.h"
#include "roadmap/roadmap.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace handway::planning {
namespace {

using sampling::RandomStream;
namespace lines = algorithm_lines;

constexpr int kStart = 0;
constexpr int kGoal = 1;
// Limit of unlimited growth, for the sake of the arithmetic. Joints lie in [0, 1]: long before, all
// samples are corners of the arm's joint ranges.
constexpr double kUnlimitedRho = 1e6;

/// Time at which numSamples is compared with N.
enum class SampleLimit {
  kEachTrial,  ///< Before each hand trial; free ones count, too.
  kEachPass,   ///< At the end of a pass, failed trials alone, as printed (Algorithm 4).
};

/// The growth of ρ_a from pass to pass; k counts the passes from 1.
enum class RhoGrowth {
  kFactorial,  ///< ρ_a ← k ρ_a, as printed (Algorithm 4).
  kLinear,     ///< k times the initial ρ_a, as in the authors' program.
};

/// Values of the settings that follow the print, or the authors' program, unless they are set.
enum class PmdPrmPreset {
  kShipped,
  kPrint,    ///< The listings, literally.
  kAuthors,  ///< The authors' program, which departs from their listings.
};

/// Symbols are the paper's (sections 5 and 7, Table 3), where good results are reported for ρ_a
/// between 0.001 and 0.05.
struct PmdPrmSettings {
  int preset = static_cast<int>(PmdPrmPreset::kShipped);
  double rho_a = 0.001;
  double rho_max = 0.05;
  int growth = static_cast<int>(RhoGrowth::kFactorial);
  bool fill_gaps = true;
  int n_checked = static_cast<int>(SampleLimit::kEachTrial);
  int smoothing = static_cast<int>(SmoothingEdges::kForwards);
  int corridor = static_cast<int>(CorridorForm::kJoint);
  int n_a = 10;
  int n_h = 10;
  int k = 10;
  int max_samples = 1000000;
  int max_pmds = 4;
  int arm_trials = 10;
  double neighbour_distance = 1.0;
  int goal_samples = 0;
};

/// One run of Algorithm 4.
class RoadmapSearch {
 public:
  RoadmapSearch(PlanningContext& context, const PmdPrmSettings& settings, HandSpace space)
      : context_(context),
        watcher_(context.observer().algorithm()),
        settings_(settings),
        largest_rho_(settings.rho_max > 0.0 ? settings.rho_max : kUnlimitedRho),
        each_trial_counts_(static_cast<SampleLimit>(settings.n_checked) == SampleLimit::kEachTrial),
        grows_(space == HandSpace::kPrincipalDirections),
        region_(context.problem(), space, static_cast<CorridorForm>(settings.corridor)),
        joints_(make_corridor_space(context.problem(), CorridorForm::kJoint)),
        threshold_(settings.neighbour_distance * (joints_->coordinates(context.problem().goal) -
                                                  joints_->coordinates(context.problem().start))
                                                     .norm()),
        goal_draws_(RandomStream(context.request().seed).fork(3)) {
    const RandomStream seeds(context.request().seed);
    arm_points_ = context.make_sampler(std::max(1, region_.space().corridor_dimension()),
                                       seeds.fork(1).seed(), [this](const Eigen::VectorXd& u) {
                                         const std::optional<Configuration> q = arm_at(u);
                                         return q && !context_.validator().arm_collides(*q);
                                       });
    hand_points_ = context.make_sampler(
        std::max(1, region_.basis().dimension()), seeds.fork(2).seed(),
        [this](const Eigen::VectorXd& u) { return !context_.validator().collision(with_hand(u)); });
    add_node(context.problem().start, 0.0, 0);
    add_node(context.problem().goal, 1.0, 0);
    statistics().samples = 2;
  }

  // Algorithm 4.
  void run(PlanResult& result) {
    std::optional<PlanStatus> end = sample_around_goal();
    double rho = settings_.rho_a;
    for (int k = 1; !end; ++k) {
      rho = std::min(grown(rho, k), largest_rho_);
      statistics().final_rho_a = rho;
      ++statistics().passes;
      notify({.line = lines::kWiden, .rho_a = rho});
      end = sweep(rho);
    }
    result.status = *end;
    if (!result.solved()) {
      notify({.line = lines::kFailure});
    }
  }

  [[nodiscard]] Path path() const {
    Path path;
    for (const int node : roadmap_.shortest_path(kStart, kGoal)) {
      path.waypoints.push_back(roadmap_.configuration(node));
    }
    return path;
  }

 private:
  PlanStatistics& statistics() { return context_.statistics(); }

  void notify(const AlgorithmStep& step) {
    if (watcher_) {
      watcher_->on_step(step);
    }
  }

  // Samples of the goal's hypercube before the first pass, as in the authors' program.
  std::optional<PlanStatus> sample_around_goal() {
    constexpr int kTrialsPerSample = 10;
    const int trials = kTrialsPerSample * settings_.goal_samples;
    statistics().final_rho_a = settings_.rho_a;
    hypercube_ = {1.0, settings_.rho_a};
    int free_count = 0;
    for (int i = 0; i < trials && free_count < settings_.goal_samples; ++i) {
      if (const auto interruption = context_.interruption()) {
        return interruption;
      }
      if (trials_left() <= 0) {
        return PlanStatus::kSamplesSpent;
      }
      const std::optional<Configuration> q =
          near_goal(goal_draws_.fork(static_cast<std::uint64_t>(i)));
      const bool is_free = q && !context_.validator().collision(*q);
      statistics().samples += each_trial_counts_ || !is_free ? 1 : 0;
      if (!is_free) {
        continue;
      }
      ++free_count;
      notify({.line = lines::kHypercube, .position = 1.0, .rho_a = settings_.rho_a});
      connect(*q, 1.0, 0);
      if (roadmap_.same_component(kStart, kGoal)) {
        return PlanStatus::kSolved;
      }
    }
    return std::nullopt;
  }

  // The arm anywhere in the goal's hypercube, the hand as at the goal, or half of the times up to
  // 0.3 of the box's sides away from it.
  [[nodiscard]] std::optional<Configuration> near_goal(RandomStream draw) const {
    constexpr double kShare = 0.3;
    const std::optional<Configuration> arm =
        arm_at(draw.uniform(std::max(1, region_.space().corridor_dimension())));
    if (!arm) {
      return std::nullopt;
    }
    const geometric::JointIndices& hand = context_.problem().joints.hand;
    Eigen::VectorXd joints = geometric::normalised(context_.problem().model(), *arm);
    joints(hand) = geometric::normalised(context_.problem().model(), context_.problem().goal)(hand);
    if (draw.uniform() < 0.5) {
      const int axes = hand_dimension(settings_.max_pmds);
      const Eigen::VectorXd sides = 2.0 * sampling::half_sides_of(region_.basis()).head(axes);
      const Eigen::VectorXd offset =
          kShare * (2.0 * draw.uniform(axes).array() - 1.0).matrix().cwiseProduct(sides);
      joints(hand) = (joints(hand) + sampling::axes_of(region_.basis()).leftCols(axes) * offset)
                         .cwiseMax(0.0)
                         .cwiseMin(1.0);
    }
    return geometric::denormalised(context_.problem().model(), joints);
  }

  // ρ_a of pass `k`, from that of the pass before.
  [[nodiscard]] double grown(double rho, int k) const {
    return k *
           (static_cast<RhoGrowth>(settings_.growth) == RhoGrowth::kLinear ? settings_.rho_a : rho);
  }

  // Remaining budget N for the trials of one arm configuration.
  [[nodiscard]] int trials_left() {
    return each_trial_counts_ ? settings_.max_samples - static_cast<int>(statistics().samples)
                              : settings_.n_h;
  }

  // One pass: a status when the search is over.
  std::optional<PlanStatus> sweep(double rho) {
    const std::uint64_t drawn_before = hand_draw_count_;
    if (const std::optional<PlanStatus> end = visit_hypercubes(rho)) {
      return end;
    }
    if (!each_trial_counts_ &&
        statistics().samples > static_cast<std::uint64_t>(settings_.max_samples)) {
      return PlanStatus::kSamplesSpent;
    }
    // All samples for the arm failed: a wider corridor may help, another pass in this one hardly.
    const bool widest = rho >= std::min(largest_rho_, 1.0);
    if (hand_draw_count_ == drawn_before && widest) {
      return PlanStatus::kStalled;
    }
    return std::nullopt;
  }

  std::optional<PlanStatus> visit_hypercubes(double rho) {
    const int max_steps = region_.space().steps(rho);
    std::pair<double, double> range{0.0, 1.0};
    for (int i = 0; i <= max_steps; ++i) {
      const double step = sampling::sweep_position(static_cast<std::uint64_t>(i));
      if (step < range.first || step > range.second) {
        continue;
      }
      if (const std::optional<PlanStatus> end = explore_hypercube(step, rho)) {
        return end;
      }
      range = search_range();
      context_.observer().on_search_range(range.first, range.second);
      notify({.line = lines::kSearchRange, .position = range.first, .range_end = range.second});
    }
    // Hypercubes of a wide corridor are far apart. If the range has none any more, its
    // middle is explored: else passes would add to the first hypercube alone, for
    // ever.
    if (settings_.fill_gaps && std::ceil(range.first * max_steps) > range.second * max_steps) {
      return explore_hypercube(0.5 * (range.first + range.second), rho);
    }
    return std::nullopt;
  }

  // The j-loop of Algorithm 4.
  std::optional<PlanStatus> explore_hypercube(double step, double rho) {
    const std::uint64_t before = hand_draw_count_;
    notify({.line = lines::kHypercube, .position = step, .rho_a = rho});
    for (int j = 0; j < settings_.n_a; ++j) {
      if (const auto interruption = context_.interruption()) {
        return interruption;
      }
      if (trials_left() <= 0) {
        return PlanStatus::kSamplesSpent;
      }
      PhaseClock sampling_time(statistics().sampling_s);
      const std::optional<Configuration> arm = sample_arm(step, rho);
      if (!arm) {
        continue;
      }
      std::optional<std::pair<Configuration, int>> sample = sample_hand(*arm, step);
      sampling_time.stop();
      statistics().max_trials = std::max(statistics().max_trials, hand_draw_count_ - before);
      context_.observer().on_progress(
          static_cast<double>(statistics().samples) / settings_.max_samples, "sampling");
      if (sample) {
        const PhaseClock connection_time(statistics().connection_s);
        connect(sample->first, step, sample->second);
        const bool joined = roadmap_.same_component(kStart, kGoal);
        notify({.line = lines::kJoined, .yes = joined, .from = kStart, .to = kGoal});
        return joined ? std::optional(PlanStatus::kSolved) : std::nullopt;
      }
    }
    return std::nullopt;
  }

  // Algorithm 1.
  std::optional<Configuration> sample_arm(double step, double rho) {
    hypercube_ = {step, rho};
    for (int i = 0; i < settings_.arm_trials; ++i) {
      const std::optional<Configuration> q = arm_at(arm_points_->point(arm_draw_count_++));
      const bool is_free = q && !context_.validator().arm_collides(*q);
      notify({.line = lines::kArmFree, .yes = is_free, .q = q ? &*q : nullptr, .position = step});
      if (is_free) {
        return q;
      }
    }
    notify({.line = lines::kNoArm, .yes = false, .position = step});
    return std::nullopt;
  }

  // Axes of SC^h for the h-th hand trial with one arm configuration: the free
  // joints and one direction first, one more with every failure.
  [[nodiscard]] int hand_dimension(int h) const {
    const sampling::PmdBasis& basis = region_.basis();
    if (!grows_) {
      return basis.dimension();
    }
    const int free_joints = static_cast<int>(basis.free_joints.size());
    return std::min(basis.dimension(), free_joints + std::min(1 + h, settings_.max_pmds));
  }

  // Algorithm 2 in the h-loop of Algorithm 4, all trials of one arm configuration.
  std::optional<std::pair<Configuration, int>> sample_hand(const Configuration& arm, double step) {
    const int count = std::min(settings_.n_h, trials_left());
    std::vector<Eigen::VectorXd> points;
    arm_ = arm;
    for (int h = 0; h < count; ++h) {
      hand_axes_ = hand_dimension(h);
      points.push_back(hand_points_->point(hand_draw_count_ + static_cast<std::uint64_t>(h)));
    }
    const auto trial = [&](int h) {
      return region_.with_hand(arm, points[static_cast<std::size_t>(h)].head(hand_dimension(h)));
    };
    const auto trials = context_.validator().first_free(count, trial);
    for (const int pair : trials.rejecting_pairs) {
      context_.count_rejection(pair, step);
    }
    if (watcher_) {
      notify_trials(trials, trial, step);
    }
    const std::uint64_t failed = trials.rejecting_pairs.size();
    const std::uint64_t all = failed + (trials.index ? 1 : 0);
    hand_draw_count_ += all;
    statistics().samples += each_trial_counts_ ? all : failed;
    if (!trials.index) {
      return std::nullopt;
    }
    const int free_joints = static_cast<int>(region_.basis().free_joints.size());
    return std::pair(trial(*trials.index), hand_dimension(*trials.index) - free_joints);
  }

  // Reports the results of the trials, the free one last.
  void notify_trials(const MotionValidator::FirstFree& trials,
                     const std::function<Configuration(int)>& trial, double step) {
    const int rejected = static_cast<int>(trials.rejecting_pairs.size());
    for (int h = 0; h < rejected + (trials.index ? 1 : 0); ++h) {
      const bool is_free = h == rejected;
      const int pair = is_free ? -1 : trials.rejecting_pairs[static_cast<std::size_t>(h)];
      const Configuration q = trial(h);
      notify({.line = is_free || touches_object(pair) ? lines::kHandFree : lines::kHandFreeOfSelf,
              .yes = is_free,
              .q = &q,
              .pair = pair,
              .count = hand_dimension(h),
              .position = step});
    }
  }

  [[nodiscard]] bool touches_object(int pair) const {
    const geometric::CollisionWorld& world = context_.problem().checker->world();
    return world.constraint(pair) ||
           !world.is_self_pair(world.pairs()[static_cast<std::size_t>(pair)]);
  }

  // The arm in the hypercube explored, or projected onto the constraints next to it, and the hand:
  // the configuration for points of the unit cube.
  [[nodiscard]] std::optional<Configuration> arm_at(const Eigen::VectorXd& u) const {
    const std::optional<Configuration> q = region_.arm_at(
        hypercube_.first, hypercube_.second, u.head(region_.space().corridor_dimension()));
    const auto& constraints = context_.problem().checker->world().constraints();
    return q && !constraints.empty()
               ? geometric::project_onto_constraints(context_.problem().model(), constraints,
                                                     context_.problem().joints.arm, *q)
               : q;
  }
  [[nodiscard]] Configuration with_hand(const Eigen::VectorXd& u) const {
    return region_.with_hand(arm_, u.head(hand_axes_));
  }

  int add_node(const Configuration& q, double step, int pmd_count) {
    const int node = roadmap_.add_node(q, joints_->coordinates(q));
    steps_.push_back(step);
    statistics().nodes = static_cast<std::uint64_t>(roadmap_.node_count());
    context_.observer().on_node({node, q, pmd_count, step, statistics().final_rho_a});
    notify({.line = lines::kAddNode, .q = &q, .from = node, .position = step});
    return node;
  }

  // Algorithm 3.
  void connect(const Configuration& q, double step, int pmd_count) {
    const int node = add_node(q, step, grows_ ? pmd_count : 0);
    if (grows_) {
      auto& per_count = statistics().nodes_per_pmds;
      per_count.resize(std::max(per_count.size(), static_cast<std::size_t>(pmd_count) + 1));
      ++per_count[static_cast<std::size_t>(pmd_count)];
    }
    const std::vector<int> neighbours = neighbours_of(node, step);
    notify(
        {.line = lines::kNeighbours, .from = node, .count = static_cast<int>(neighbours.size())});
    std::vector<MotionValidator::Edge> candidates;
    candidates.reserve(neighbours.size());
    for (const int neighbour : neighbours) {
      const Configuration& from = roadmap_.configuration(neighbour);
      candidates.push_back({from, context_.problem().model().nearest_equivalent(from, q)});
    }
    const auto edge_free = context_.validator().edges(std::move(candidates));
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
      if (roadmap_.same_component(neighbours[i], node)) {
        notify({.line = lines::kSameComponent, .from = neighbours[i], .to = node});
        continue;
      }
      const bool is_free = edge_free(i);
      notify({.line = lines::kLocalPlan, .yes = is_free, .from = neighbours[i], .to = node});
      if (is_free) {
        roadmap_.edge(neighbours[i], node);
        statistics().edges = static_cast<std::uint64_t>(roadmap_.edge_count());
        context_.observer().on_edge(neighbours[i], node);
        notify({.line = lines::kAddEdge, .from = neighbours[i], .to = node});
      }
    }
  }

  // FINDNEIGHBORS, with the end of the segment whose own hypercube the sample
  // came from as a forced neighbour (section 5.2, item 2).
  [[nodiscard]] std::vector<int> neighbours_of(int node, double step) const {
    std::vector<int> neighbours = roadmap_.nearest(node, settings_.k, threshold_);
    for (const auto& [end, position] : {std::pair(kStart, 0.0), std::pair(kGoal, 1.0)}) {
      if (step == position && std::ranges::count(neighbours, end) == 0) {
        neighbours.insert(neighbours.begin(), end);
      }
    }
    return neighbours;
  }

  // UPDATESEARCHRANGE (section 5.3, item 3): [d_ini, d_goal]. The two components may overlap along
  // the segment; then the range between stays in search.
  [[nodiscard]] std::pair<double, double> search_range() const {
    double d_ini = 0.0;
    double d_goal = 1.0;
    for (int node = 0; node < roadmap_.node_count(); ++node) {
      const double step = steps_[static_cast<std::size_t>(node)];
      if (roadmap_.same_component(node, kStart)) {
        d_ini = std::max(d_ini, step);
      } else if (roadmap_.same_component(node, kGoal)) {
        d_goal = std::min(d_goal, step);
      }
    }
    return std::minmax(d_ini, d_goal);
  }

  PlanningContext& context_;
  AlgorithmObserver* watcher_;  ///< Observer of the algorithm; or null.
  const PmdPrmSettings& settings_;
  double largest_rho_;
  bool each_trial_counts_;
  bool grows_;
  HandArmRegion region_;
  std::unique_ptr<CorridorSpace> joints_;  ///< Space in which distances are measured.
  double threshold_;
  RandomStream goal_draws_;
  std::unique_ptr<sampling::Sampler> arm_points_;
  std::unique_ptr<sampling::Sampler> hand_points_;
  std::pair<double, double> hypercube_;  ///< Step and half side of the one explored.
  Configuration arm_;                    ///< Arm of the hand postures being sampled.
  int hand_axes_ = 0;                    ///< Number of their axes.
  std::uint64_t arm_draw_count_ = 0;
  std::uint64_t hand_draw_count_ = 2;  ///< Begins as numSamples does.
  Roadmap<> roadmap_{joints_->periods()};
  std::vector<double> steps_;  ///< Place of each node on the arm segment.
};

class PmdPrm final : public BuiltInPlanner {
 public:
  explicit PmdPrm(HandSpace space)
      : BuiltInPlanner(
            with_pmds(space) ? "pmd-prm" : "full-prm",
            with_pmds(space) ? "Roadmap in a corridor around the arm's motion and in a few "
                               "principal motion directions of the hand"
                             : "The roadmap of pmd-prm with every hand joint sampled independently",
            {.uses_pmds = with_pmds(space), .needs_basis = with_pmds(space), .uses_threads = true}),
        space_(space) {
    if (!with_pmds(space)) {  // Table 3, in parentheses
      shipped_.n_a = 20;
      shipped_.n_h = 20;
    }
    settings_ = shipped_;
  }

 protected:
  void do_plan(PlanningContext& context, PlanResult& result) override {
    RoadmapSearch search(context, settings_, space_);
    search.run(result);
    if (result.solved()) {
      PhaseClock smoothing_time(result.smoothing_s);
      result.path = smooth_by_roadmap(context, search.path(),
                                      static_cast<SmoothingEdges>(settings_.smoothing));
    }
  }

  [[nodiscard]] std::vector<geometric::BoundParameter> own_parameters() override {
    return describe(settings_);
  }

  [[nodiscard]] std::vector<geometric::Parameter> preset_values() override {
    PmdPrmSettings values = shipped_;
    values.preset = settings_.preset;
    switch (static_cast<PmdPrmPreset>(settings_.preset)) {
      case PmdPrmPreset::kShipped:
        break;
      case PmdPrmPreset::kPrint:
        for (const geometric::BoundParameter& parameter : describe(values)) {
          if (!parameter.as_printed.empty()) {
            set_from_text(parameter, parameter.as_printed);
          }
        }
        break;
      case PmdPrmPreset::kAuthors:
        values.growth = static_cast<int>(RhoGrowth::kLinear);
        values.rho_max = 0.2;
        values.fill_gaps = false;
        values.smoothing = static_cast<int>(SmoothingEdges::kBothWays);
        values.corridor = static_cast<int>(CorridorForm::kCartesian);
        values.neighbour_distance = 4.0;
        values.goal_samples = 10;
        break;
    }
    return geometric::values_of(describe(values));
  }

 private:
  [[nodiscard]] std::vector<geometric::BoundParameter> describe(PmdPrmSettings& settings) const {
    geometric::BoundParameter corridor = corridor_parameter(settings.corridor);
    corridor.as_printed = "joint";
    std::vector<geometric::BoundParameter> list = {
        {"preset", "Preset", "",
         "Values of the parameters that are not set. shipped: the defaults below; print: the "
         "paper's algorithms literally; authors: as the authors' program, which differs from "
         "them.",
         geometric::BoundChoice{&settings.preset, {"shipped", "print", "authors"}}},
        {"rho_a", "Corridor half-width ρₐ", "",
         "Initial half-side of the arm's sampling hypercubes, in joints normalised to [0, 1]. It "
         "grows with every pass.",
         &settings.rho_a, 1e-5, 0.5},
        {"rho_max", "Largest ρₐ", "",
         "Largest half-width of the corridor. 0: no limit, as in the paper.", &settings.rho_max,
         0.0, 0.5, "0"},
        {"growth", "Growth of ρₐ", "",
         "Growth of ρₐ with the number k of the pass. factorial: times k, as in the paper; linear: "
         "k times the initial one, as in the authors' program.",
         geometric::BoundChoice{&settings.growth, {"factorial", "linear"}}, 0.0, 0.0, "factorial"},
        {"fill_gaps", "Fill gaps", "",
         "Sample the middle of the search range if no hypercube lies in it. The paper does not.",
         &settings.fill_gaps, 0.0, 0.0, "false"},
        std::move(corridor),
        {"n_a", "Arm trials nA", "",
         "Number of arm configurations that are sampled in each hypercube.", &settings.n_a, 1,
         1000},
        {"n_h", "Hand trials nH", "",
         "Number of hand configurations that are sampled for each arm configuration.",
         &settings.n_h, 1, 1000},
        {"k", "Neighbours K", "", "Number of nearest nodes that a new node is connected to.",
         &settings.k, 1, 1000},
        {"max_samples", "Samples N", "",
         "Largest number of hand samples; the planner then gives up.", &settings.max_samples, 1,
         100000000},
        {"n_checked", "Check N", "",
         "When the number of hand samples is compared with max_samples. trial: at every sample; "
         "pass: at the end of each pass, counting only failed samples, as in the paper.",
         geometric::BoundChoice{&settings.n_checked, {"trial", "pass"}}, 0.0, 0.0, "pass"},
        {"smoothing", "Smoothing", "",
         "Edges between nodes of the path that smoothing uses. forwards: only edges forwards along "
         "the path; both-ways: also edges back along it if the path gets shorter, as in the paper.",
         geometric::BoundChoice{&settings.smoothing, {"forwards", "both-ways"}}, 0.0, 0.0,
         "both-ways"},
        {"arm_trials", "Arm samples", "",
         "Largest number of samples to find an arm configuration without self-collision (Algorithm "
         "1).",
         &settings.arm_trials, 1, 1000},
        {"neighbour_distance", "Neighbour distance", "",
         "Largest distance of a neighbour, in distances from start to goal.",
         &settings.neighbour_distance, 0.01, 100.0, "1"},
        {"goal_samples", "Samples at the goal", "",
         "Number of free configurations that are sampled around the goal before the first pass, "
         "with at most ten trials each. The paper does not; the authors' program samples ten.",
         &settings.goal_samples, 0, 10000, "0"},
    };
    if (with_pmds(space_)) {
      list.push_back({"max_pmds", "Principal directions", "",
                      "Largest number of principal motion directions that are used together.",
                      &settings.max_pmds, 1, 13});
    }
    return list;
  }

  HandSpace space_;
  PmdPrmSettings shipped_;
  PmdPrmSettings settings_;
};

}  // namespace

std::unique_ptr<Planner> make_pmd_prm(HandSpace hand) { return std::make_unique<PmdPrm>(hand); }

}  // namespace handway::planning
