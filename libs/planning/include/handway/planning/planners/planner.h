#pragma once

#include "handway/geometric/io/parameter.h"
#include "handway/planning/core/objective.h"
#include "handway/planning/core/observer.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

#include <functional>
#include <memory>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace handway::planning {

class PlanningContext;

/// Capabilities of a planner; forms and the command line read it.
struct PlannerCapabilities {
  bool uses_pmds = false;     ///< Samples the hand in a PMD basis.
  bool needs_basis = false;   ///< Refuses problems without one.
  bool uses_threads = false;  ///< More threads make it faster.
  bool deterministic = true;  ///< The seed determines the result bitwise.
};

/// Finds a collision-free path from a problem's start to its goal.
///
/// Public functions check; derived classes compute. A planner object is for one run at a time and
/// may be reused.
class HANDWAY_PLANNING_EXPORT Planner {
 public:
  virtual ~Planner() = default;

  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual std::string description() const = 0;
  [[nodiscard]] virtual PlannerCapabilities capabilities() const = 0;
  /// The settings with their values: first the planner's own, then those of the objective and of
  /// optimising that all planners share.
  [[nodiscard]] std::vector<geometric::Parameter> parameters();
  /// Sets one setting from text, as set_from_text(). The setting `preset`, which some planners
  /// have, gives values to all settings that have not been set, so that the order does not matter.
  /// @throws InputError naming the valid keys, or the setting's values.
  void set_parameter(std::string_view key, std::string_view text);

  /// Objective of path optimisation.
  [[nodiscard]] ObjectiveSettings& objective() { return objective_; }
  [[nodiscard]] const ObjectiveSettings& objective() const { return objective_; }

  /// Checks start and goal, plans, optimises as requested, certifies. Of several goals the nearest
  /// is tried first; a goal without a path within a second has to wait until the others have been
  /// tried for as long, and then gets twice the time.
  /// @param stop ends the search within 100 ms with kCancelled.
  /// @param observer may be null.
  /// @throws InputError if the planner needs a basis and the problem has none.
  [[nodiscard]] PlanResult plan(const PlanningProblem& problem, const PlanRequest& request,
                                std::stop_token stop = {}, Observer* observer = nullptr);

  /// The search alone, as a part of another planner's: without checking the ends and without a
  /// certificate. Sets the results of do_plan().
  /// @pre start and goal are free, within limits and different; the problem has a basis if
  /// capabilities() need one.
  void plan_within(PlanningContext& context, PlanResult& result) { do_plan(context, result); }

 protected:
  /// Searches. Sets status, reason, path, statistics and, if it smooths, smoothing_s.
  virtual void do_plan(PlanningContext& context, PlanResult& result) = 0;

  /// The settings of this planner alone, bound to its members.
  [[nodiscard]] virtual std::vector<geometric::BoundParameter> own_parameters() = 0;

  /// The settings of this planner alone with the values of the chosen preset, if it has some.
  [[nodiscard]] virtual std::vector<geometric::Parameter> preset_values() { return {}; }

 private:
  [[nodiscard]] std::vector<geometric::BoundParameter> bound_parameters();
  [[nodiscard]] PlanResult plan_to_goal(const PlanningProblem& problem, const PlanRequest& request,
                                        const std::stop_token& stop, Observer* observer);
  [[nodiscard]] PlanResult plan_to_any(const PlanningProblem& problem, const PlanRequest& request,
                                       const std::stop_token& stop, Observer* observer);
  void optimize(PlanningContext& context, PlanResult& result) const;

  ObjectiveSettings objective_;
  int optimize_checks_ = 0;
  int sampler_ = 0;                              ///< A sampling::SamplerKind.
  std::set<std::string, std::less<>> keys_set_;  ///< A preset leaves these as they are.
};

/// Key of the parameter that chooses values for others.
inline constexpr const char* kPresetKey = "preset";

/// Description of the parameter that limits a planner's samples.
[[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::BoundParameter max_samples_parameter(int& value);
/// Description of the parameter that limits the edges tested to smooth a path.
[[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::BoundParameter smoothing_checks_parameter(
    int& value);

/// Function that makes a planner with its default settings.
using PlannerFactory = std::function<std::unique_ptr<Planner>()>;

/// The planners of a program, by name. Built-in ones are always there; plugins add
/// theirs.
class HANDWAY_PLANNING_EXPORT PlannerRegistry {
 public:
  PlannerRegistry();

  /// @throws std::invalid_argument if the name is taken.
  void add(std::string name, PlannerFactory factory);

  /// @param name or another name that a planner had before.
  /// @throws InputError naming the valid planners.
  [[nodiscard]] std::unique_ptr<Planner> create(std::string_view name) const;

  /// Returns `name`, or the present name for a former name of a planner.
  [[nodiscard]] static std::string_view current_name(std::string_view name);

  /// In order of registration; the first is the default.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  std::vector<std::pair<std::string, PlannerFactory>> factories_;
};

}  // namespace handway::planning
