#include "handway/planning/planners/planner.h"

#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/core/request_parameters.h"
#include "handway/planning/paths/anytime_optimizer.h"
#include "handway/planning/roadmap/roadmap_recorder.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "planners/built_in.h"

#include <boost/pending/disjoint_sets.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <deque>
#include <exception>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace handway::planning {
namespace {

// Progress of the searches from both ends, that of the best one; nothing if none has both ends. The
// first node of a search is taken for its start, the second for its goal.
std::optional<SearchReach> reach_of(const PlanningProblem& problem,
                                    const RecordedRoadmap& roadmap) {
  const auto at = [&](int node) -> const RecordedRoadmap::Node& {
    return roadmap.nodes[static_cast<std::size_t>(node)];
  };
  std::vector<int> ranks(roadmap.nodes.size());
  std::vector<int> parents(roadmap.nodes.size());
  boost::disjoint_sets components(ranks.data(), parents.data());
  std::map<int, std::vector<int>> searches;
  for (int node = 0; node < static_cast<int>(roadmap.nodes.size()); ++node) {
    components.make_set(node);
    searches[at(node).search].push_back(node);
  }
  for (const auto& [from, to] : roadmap.edges) {
    components.union_set(from, to);
  }
  std::vector<int> from_start;  // nodes that are connected to the start of their search
  std::vector<int> from_goal;
  SearchReach reach{.nodes = roadmap.nodes.size()};
  for (const auto& search : searches) {
    const std::vector<int>& nodes = search.second;
    if (nodes.size() < 2) {
      continue;
    }
    const auto add_connected = [&](int end, std::vector<int>& list) {
      const std::size_t before = list.size();
      std::ranges::copy_if(nodes, std::back_inserter(list), [&](int node) {
        return components.find_set(node) == components.find_set(end);
      });
      return list.size() - before;
    };
    reach.start_nodes = std::max(reach.start_nodes, add_connected(nodes[0], from_start));
    reach.goal_nodes = std::max(reach.goal_nodes, add_connected(nodes[1], from_goal));
  }
  if (from_start.empty()) {
    return std::nullopt;
  }
  const Eigen::VectorXd start = geometric::normalised(problem.model(), problem.start);
  const Eigen::VectorXd motion = geometric::normalised(problem.model(), problem.goal) - start;
  const auto progress = [&](int node) {
    const Eigen::VectorXd joints = geometric::normalised(problem.model(), at(node).q);
    return std::clamp((joints - start).dot(motion) / std::max(motion.squaredNorm(), 1e-12), 0.0,
                      1.0);
  };
  const int last = *std::ranges::max_element(from_start, {}, progress);
  const int first = *std::ranges::min_element(from_goal, {}, progress);
  reach.from_start = progress(last);
  reach.from_goal = progress(first);
  reach.farthest_from_start = at(last).q;
  reach.farthest_from_goal = at(first).q;
  return reach;
}

// Proves that no motion leads from the start to the goal; empty if that is not known. A body inside
// of a closed surface can leave it through the surface only.
std::string proof_of_infeasibility(const PlanningProblem& problem) {
  const std::unique_ptr<geometric::CollisionChecker> checker = problem.checker->clone();
  const std::vector<geometric::Enclosed> at_start = checker->enclosed(problem.start);
  const std::vector<geometric::Enclosed> at_goal = checker->enclosed(problem.goal);
  const auto sentence = [&](const geometric::Enclosed& enclosed, std::string_view end,
                            std::string_view other) {
    const auto name = [&](int body) { return checker->world().body(body).name; };
    return fmt::format(
        "There is no path: {} is inside of {} at the {} and outside at the {}, and {} "
        "is closed.",
        name(enclosed.inner), name(enclosed.outer), end, other, name(enclosed.outer));
  };
  const auto only_in = [](const auto& list, const auto& other) {
    std::vector<geometric::Enclosed> rest;
    std::ranges::set_difference(list, other, std::back_inserter(rest), {},
                                &geometric::Enclosed::key, &geometric::Enclosed::key);
    return rest;
  };
  if (const auto left = only_in(at_start, at_goal); !left.empty()) {
    return sentence(left.front(), "start", "goal");
  }
  const auto entered = only_in(at_goal, at_start);
  return entered.empty() ? "" : sentence(entered.front(), "goal", "start");
}

// A planner whose path ends elsewhere is faulty, and its path is discarded.
void require_ends(const PlanningProblem& problem, const Path& path, const std::string& planner) {
  constexpr double kSameEnd = 1e-9;  // rad or m
  const auto is_same = [](const Configuration& a, const Configuration& b) {
    return a.size() == b.size() && (a - b).lpNorm<Eigen::Infinity>() <= kSameEnd;
  };
  if (path.waypoints.size() < 2 || !is_same(path.waypoints.front(), problem.start) ||
      !is_same(path.waypoints.back(),
               problem.model().nearest_equivalent(path.waypoints.back(), problem.goal))) {
    throw std::logic_error("planner " + planner +
                           " returned a path that does not lead from the start to the goal");
  }
}

std::vector<OutOfMargin> out_of_margin(PlanningContext& context) {
  std::vector<OutOfMargin> list;
  if (context.request().margin <= 0.0) {
    return list;
  }
  const geometric::CollisionWorld& world = context.problem().checker->world();
  for (std::size_t end = 0; end < context.validator().ends().size(); ++end) {
    for (const geometric::EdgeEnd::NearPair& near : context.validator().ends()[end].near) {
      if (!world.constraint(near.pair) &&
          !world.is_self_pair(world.pairs()[static_cast<std::size_t>(near.pair)])) {
        list.push_back({end == 1, geometric::named_pair(world, near.pair, near.distance)});
      }
    }
  }
  return list;
}

// Names are looked up once at the end, not for each rejection.
PlanStatistics with_names(PlanStatistics statistics, const geometric::CollisionWorld& world) {
  for (std::size_t pair = 0; pair < statistics.rejections_per_pair.size(); ++pair) {
    if (const std::uint64_t count = statistics.rejections_per_pair[pair]; count > 0) {
      const geometric::NamedPair bodies = named_pair(world, static_cast<int>(pair), 0.0);
      statistics.rejections[{bodies.a, bodies.b}] += count;
    }
  }
  return statistics;
}

// Describes the end of the search, for a planner that has nothing to add.
std::string reason_of(const PlanResult& result, PlanningContext& context) {
  const std::string samples = context.statistics().samples_text();
  switch (result.status) {
    case PlanStatus::kSolved:
      return fmt::format("Found a path of {} waypoints after {}.", result.path.waypoints.size(),
                         samples);
    case PlanStatus::kTimeLimit:
      return fmt::format("No path found within the time limit of {:g} s, after {}.",
                         context.request().time_limit_s, samples);
    case PlanStatus::kCancelled:
      return fmt::format("Cancelled after {:.1f} s and {}.", result.time_s, samples);
    case PlanStatus::kStalled:
      return fmt::format(
          "No path found: the search stalled after {}, because no more configurations can be "
          "sampled.",
          samples);
    default:
      return fmt::format("No path found: all {} samples are used.", context.statistics().samples);
  }
}

namespace fs = std::filesystem;

std::string command(Planner& planner, const PlanRequest& request) {
  std::string text =
      fmt::format("handway plan scene.yaml --planner {} --seed {}", planner.name(), request.seed);
  PlanRequest requested = request;
  for (const geometric::Parameter& parameter : geometric::values_of(parameters_of(requested))) {
    const std::string value = to_text(parameter);
    if (value != to_text(find_parameter(request_parameters(), parameter.key))) {
      text += fmt::format(" {} {}", geometric::option_name(parameter.key), value);
    }
  }
  for (const geometric::Parameter& parameter : planner.parameters()) {
    text += fmt::format(" --set {}={}", parameter.key, to_text(parameter));
  }
  return text + "\n";
}

// Stores the problem for debugging, if $HANDWAY_LOG_PROBLEMS names a folder: in a folder of its own
// there, the scene with the problem's ends, the hand's basis and the command that plans it again. A
// failure to write is a warning in the program's log.
void log_problem(Planner& planner, const PlanningProblem& problem, const PlanRequest& request) {
  const char* folder = std::getenv("HANDWAY_LOG_PROBLEMS");
  if (folder == nullptr || *folder == '\0') {
    return;
  }
  static std::atomic<int> number{0};
  try {
    const fs::path own =
        fs::absolute(folder) / fmt::format("{}-{:04}-{}", ::getpid(), ++number, planner.name());
    fs::create_directories(own);
    geometric::Scene scene = *problem.scene;
    scene.start = problem.start;
    if (!problem.has_pose_goals()) {
      scene.goal = problem.goal;
      scene.goal_poses.clear();
    }
    if (problem.basis) {
      scene.hand_basis = own / "hand.yaml";
      sampling::write_pmd_basis(*problem.basis, scene.hand_basis);
    }
    geometric::write_scene(scene, own / "scene.yaml");
    geometric::replace_file(own / "command.txt", command(planner, request));
  } catch (const std::exception& error) {
    spdlog::warn("The problem was not logged: {}", error.what());
  }
}

}  // namespace

std::vector<geometric::Parameter> Planner::parameters() {
  return geometric::values_of(bound_parameters());
}

void Planner::set_parameter(std::string_view key, std::string_view text) {
  std::vector<geometric::Parameter> list = parameters();
  geometric::Parameter& parameter = find_parameter(list, key);
  set_from_text(parameter, text);
  assign(bound_parameters()[static_cast<std::size_t>(&parameter - list.data())], parameter);
  if (key != kPresetKey) {
    keys_set_.emplace(key);
    return;
  }
  const std::vector<geometric::Parameter> values = preset_values();
  const std::vector<geometric::BoundParameter> own = own_parameters();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!keys_set_.contains(values[i].key)) {
      assign(own[i], values[i]);
    }
  }
}

std::vector<geometric::BoundParameter> Planner::bound_parameters() {
  std::vector<geometric::BoundParameter> list = own_parameters();
  list.push_back(
      {"objective", "Objective", "",
       "Property that paths are optimised for. human-like: the hand stays near the principal "
       "motion directions; custom: the weights below.",
       geometric::BoundChoice{&objective_.preset,
                              {"human-like", "shortest", "safest", "fastest", "custom"}}});
  const auto weight = [&](const char* key, const char* label, const char* help, double& value) {
    list.push_back({key, label, "", help, &value, 0.0, 1e6});
  };
  weight("weight_length", "Weight of length",
         "Weight of the path's length in a custom objective, per normalised joint range.",
         objective_.custom.length);
  weight("weight_human_likeness", "Weight of human-likeness",
         "Weight of the hand's mean distance from the principal motion directions in a custom "
         "objective.",
         objective_.custom.human_likeness);
  weight("weight_clearance", "Weight of clearance",
         "Weight of the missing clearance in a custom objective: the mean share of 50 mm that the "
         "clearance lacks.",
         objective_.custom.clearance);
  weight("weight_duration", "Weight of duration",
         "Weight of the path's duration in a custom objective, per second.",
         objective_.custom.duration);
  list.push_back({"optimize_checks", "Optimisation checks", "",
                  "Number of configurations that are checked to optimise the path after planning "
                  "and smoothing.",
                  &optimize_checks_, 0, 1000000000});
  list.push_back(
      {"sampler", "Sampler", "",
       "Distribution of samples in a sampling region. random: uniform; halton, sdk: "
       "low-discrepancy sequences; gaussian: near obstacles; bridge-test: in narrow passages.",
       geometric::BoundChoice{&sampler_, sampling::sampler_names()}});
  return list;
}

void Planner::optimize(PlanningContext& context, PlanResult& result) const {
  const double seconds = context.request().optimize_s;
  const auto wanted = static_cast<std::uint64_t>(optimize_checks_);
  if (wanted == 0 && seconds <= 0.0) {
    return;
  }
  const double begin = context.elapsed_s();
  AnytimeOptimizer optimizer(context, objective_.weights(context.problem()), result.path,
                             context.request().seed);
  result.optimize_checks = optimizer.advance_in_rounds([&](std::uint64_t checks) {
    const double spent = context.elapsed_s() - begin;
    context.observer().on_progress(seconds > 0.0
                                       ? std::min(1.0, spent / seconds)
                                       : static_cast<double>(checks) / static_cast<double>(wanted),
                                   "optimising");
    context.observer().on_path(optimizer.path());
    return checks < wanted || spent < seconds;
  });
  result.path = optimizer.path();
  result.cost = PathCost{optimizer.cost(), optimizer.least_cost()};
  result.smoothing_s += context.elapsed_s() - begin;
}

PlanResult Planner::plan(const PlanningProblem& problem, const PlanRequest& request,
                         std::stop_token stop, Observer* observer) {
  if (request.threads < 1 || !(request.resolution > 0.0) || !(request.margin >= 0.0)) {
    throw std::invalid_argument(
        "planning needs a thread, a resolution above 0 and a margin of 0 or more");
  }
  if (capabilities().needs_basis) {
    require_directions(problem, "planner " + name());
  }
  log_problem(*this, problem, request);
  if (std::string fault = problem.goal_fault.empty() ? group_fault(problem) : problem.goal_fault;
      !fault.empty()) {
    PlanResult result;
    result.status = PlanStatus::kGoalInvalid;
    result.reason = std::move(fault);
    return result;
  }
  const std::stop_token end = std::move(stop);
  return problem.goals.empty() ? plan_to_goal(problem, request, end, observer)
                               : plan_to_any(problem, request, end, observer);
}

PlanResult Planner::plan_to_any(const PlanningProblem& problem, const PlanRequest& request,
                                const std::stop_token& stop, Observer* observer) {
  constexpr double kFirstLimit = 1.0;  // s
  const auto begin = std::chrono::steady_clock::now();
  const auto spent = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const auto left = [&] { return std::max(0.0, request.time_limit_s - spent()); };
  std::deque<std::pair<std::size_t, double>> open;  // goals, and for how long each is tried next, s
  for (std::size_t goal = 0; goal < problem.goals.size(); ++goal) {
    open.emplace_back(goal, kFirstLimit);
  }
  std::optional<PlanResult> nearest;  // the latest to the first goal, if none is reached
  const auto ends = [](PlanStatus status) {
    return status == PlanStatus::kStartInvalid || status == PlanStatus::kCancelled;
  };
  for (bool goes_on = true; goes_on && !open.empty();) {
    const auto [candidate, limit] = open.front();
    PlanningProblem to = problem;
    to.set_goal(problem.goals[candidate].q);
    PlanRequest attempt = request;
    attempt.time_limit_s = open.size() == 1 ? left() : std::min(limit, left());
    open.pop_front();
    PlanResult result = plan_to_goal(to, attempt, stop, observer);
    if (result.solved()) {
      result.goal = candidate;
      result.time_s = spent() - result.smoothing_s;
      result.reason += fmt::format(" It ends at {}, in configuration {} of {}.",
                                   name_of_pose_goal(*problem.scene, problem.goals[candidate].pose),
                                   candidate + 1, problem.goals.size());
      return result;
    }
    if (result.status == PlanStatus::kTimeLimit) {
      open.emplace_back(candidate, 2.0 * limit);
    }
    goes_on = left() > 0.0 && !ends(result.status);
    if (candidate == 0 || !nearest) {
      nearest = std::move(result);
    }
  }
  nearest->time_s = spent();
  if (nearest->status == PlanStatus::kTimeLimit) {
    nearest->reason =
        fmt::format("No path found within the time limit of {:g} s.", request.time_limit_s);
  }
  if (!ends(nearest->status) && problem.goals.size() > 1) {
    nearest->reason +=
        fmt::format(" The goal can be reached in {} configurations.", problem.goals.size());
  }
  return *std::move(nearest);
}

PlanResult Planner::plan_to_goal(const PlanningProblem& problem, const PlanRequest& request,
                                 const std::stop_token& stop, Observer* observer) {
  RoadmapRecorder recorder(std::numeric_limits<std::size_t>::max(), observer);
  PlanningContext context(problem, request, stop, recorder);
  context.set_sampler(static_cast<sampling::SamplerKind>(sampler_));
  PlanResult result;
  if (const std::string start = context.validator().invalid_end_reason(0); !start.empty()) {
    result.status = PlanStatus::kStartInvalid;
    result.reason = "The start " + start + ".";
  } else if (const std::string goal = context.validator().invalid_end_reason(1); !goal.empty()) {
    result.status = PlanStatus::kGoalInvalid;
    result.reason = "The goal " + goal + ".";
  } else if (problem.start == problem.goal) {
    result.status = PlanStatus::kSolved;
    result.reason = "The start equals the goal: nothing has to move.";
    result.path.waypoints = {problem.start, problem.goal};
  } else if (std::string proof = proof_of_infeasibility(problem); !proof.empty()) {
    result.status = PlanStatus::kInfeasible;
    result.reason = std::move(proof);
  } else {
    do_plan(context, result);
    result.time_s = context.elapsed_s() - result.smoothing_s;
    if (result.solved()) {
      require_ends(problem, result.path, name());
      result.path.waypoints = problem.model().in_half_turns(result.path.waypoints);
      optimize(context, result);
    } else {
      result.reach = reach_of(problem, recorder.roadmap());
    }
    if (result.reason.empty()) {
      result.reason = reason_of(result, context);
    }
  }
  result.statistics = with_names(context.statistics(), problem.checker->world());
  if (result.solved()) {
    result.certificate = context.validator().certify(result.path);
    result.out_of_margin = out_of_margin(context);
  }
  return result;
}

geometric::BoundParameter max_samples_parameter(int& value) {
  return {
      "max_samples", "Samples", "",       "Largest number of samples; the planner then gives up.",
      &value,        1,         100000000};
}

geometric::BoundParameter smoothing_checks_parameter(int& value) {
  return {"smoothing_checks",
          "Smoothing checks",
          "",
          "Number of configurations that are checked to shorten the path after it was found, per "
          "16 waypoints. 0: no smoothing.",
          &value,
          0,
          10000000};
}

// The default one first.
PlannerRegistry::PlannerRegistry() {
  add(kAutoPlanner, make_auto_planner);
  add("pmd-prm", [] { return make_pmd_prm(HandSpace::kPrincipalDirections); });
  add("full-prm", [] { return make_pmd_prm(HandSpace::kAllJoints); });
  add("pmd-rrt-connect", [] { return make_rrt_connect(HandSpace::kPrincipalDirections); });
  add("pmd-lazy", make_pmd_lazy);
  add("rrt-connect", [] { return make_rrt_connect(HandSpace::kAllJoints); });
}

void PlannerRegistry::add(std::string name, PlannerFactory factory) {
  if (std::ranges::count(names(), name) > 0) {
    throw std::invalid_argument("there already is a planner called " + name);
  }
  factories_.emplace_back(std::move(name), std::move(factory));
}

std::unique_ptr<Planner> PlannerRegistry::create(std::string_view name) const {
  for (const auto& [known, factory] : factories_) {
    if (known == current_name(name)) {
      return factory();
    }
  }
  throw geometric::InputError({"planner", std::string(name), "no planner of this name",
                               fmt::format("one of {}", fmt::join(names(), ", ")), ""});
}

std::string_view PlannerRegistry::current_name(std::string_view name) {
  return name == "pmd-auto" ? kAutoPlanner : name;
}

std::vector<std::string> PlannerRegistry::names() const {
  std::vector<std::string> names;
  names.reserve(factories_.size());
  for (const auto& [name, factory] : factories_) {
    names.push_back(name);
  }
  return names;
}

}  // namespace handway::planning
