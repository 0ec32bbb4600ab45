#pragma once

#include "handway/planning/core/plan_result.h"
#include "handway/planning/export.h"
#include "handway/planning/planners/planner.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// @file
/// Experiments: planners with their parameters on problems, once for each of many seeds.
namespace handway::planning {

/// Keys and values as text, in the order of the planner's own parameters.
using ParameterTexts = std::vector<std::pair<std::string, std::string>>;

/// Properties of a problem by which reports group the runs, for example "set" and "shelf"; each key
/// once.
using ProblemTags = std::vector<std::pair<std::string, std::string>>;

/// A problem of a campaign.
struct CampaignProblem {
  std::string name;  ///< Unique in the campaign.
  std::filesystem::path file;
  /// Files that `file` refers to: robots, meshes, bases, …, itself included; empty: not known.
  std::vector<std::filesystem::path> files = {};
  ProblemTags tags = {};

  /// Returns the value of a tag; empty if the problem does not have it.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT std::string tag(std::string_view key) const;
};

/// A planner with one value for each of its parameters.
struct CampaignPlanner {
  std::string label;          ///< Unique in the campaign, for example "pmd-prm n_a=5".
  std::string planner;        ///< Key in the registry.
  ParameterTexts parameters;  ///< Values of all parameters, defaults included.
};

/// One run of a campaign: indices into its lists.
struct RunSpec {
  int problem = 0;
  int planner = 0;
  std::uint64_t seed = 1;

  auto operator<=>(const RunSpec&) const = default;
};

/// Resolution at which campaigns check paths again (check_path()), m.
inline constexpr double kCheckResolution = 1e-3;

/// problems × planners × seeds.
struct HANDWAY_PLANNING_EXPORT Campaign {
  std::string name;
  std::string description;
  std::vector<CampaignProblem> problems;
  std::vector<CampaignPlanner> planners;
  std::vector<std::uint64_t> seeds;  ///< Each once.
  int threads = 1;                   ///< Threads of a run.
  double time_limit_s = 60.0;        ///< Time limit of a run.
  bool check_paths = false;          ///< Check every path again, at kCheckResolution.
  bool measure_motions = false;      ///< Time every path and measure its motion.
  bool skip_unreadable = false;      ///< Leave out problems that can't be read.

  [[nodiscard]] std::size_t run_count() const {
    return problems.size() * planners.size() * seeds.size();
  }
  /// All runs: for each seed every problem, for each problem every planner, so that an interrupted
  /// campaign has run all of them about equally often.
  [[nodiscard]] std::vector<RunSpec> runs() const;
};

/// Returns the entry of a planner with its defaults. @throws InputError for an unknown planner.
[[nodiscard]] HANDWAY_PLANNING_EXPORT CampaignPlanner
default_entry(const std::string& planner, const PlannerRegistry& registry);

/// The planner of an entry, with its parameters set.
/// @throws InputError for an unknown planner, parameter or value.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::unique_ptr<Planner> make_planner(
    const CampaignPlanner& entry, const PlannerRegistry& registry);

/// RunRecord::status of a planner that can't plan the problem at all.
inline constexpr const char* kRefused = "refused";

/// How human-like a path is; see docs/human-likeness.md. NaN: does not apply, or not measured.
struct PathMeasures {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  double to_subspace = kNone;    ///< Mean distance of the hand from the PMD subspace.
  double hand_sparc = kNone;     ///< Spectral arc length of the hand's speed.
  double palm_sparc = kNone;     ///< Spectral arc length of the palm's speed.
  double arm_deviation = kNone;  ///< From the straight motion, normalised joints.
};

/// Result of one run of a campaign. Apart from the times, the same campaign gives the same
/// records on any machine, unless a run ended at its time limit. The statistics have no
/// rejections.
struct RunRecord : PlanStatistics {
  RunSpec spec;
  bool solved = false;
  std::string status;  ///< Text by to_string(PlanStatus); kRefused if the planner couldn't begin.
  std::string reason;  ///< One sentence.

  double time_s = 0.0;       ///< Planning alone, wall clock.
  double smoothing_s = 0.0;  ///< Wall clock.
  /// Processor time of planning, smoothing and certifying; NaN if the run has several threads.
  double cpu_s = std::numeric_limits<double>::quiet_NaN();

  std::uint64_t path_nodes = 0;  ///< 0 without a path.
  double path_length = 0.0;      ///< In joints normalised to [0, 1]; 0 without a path.
  double resolution = 0.0;       ///< Resolution of the certificate, m.
  double min_clearance = 0.0;    ///< m
  std::uint64_t certificate_checks = 0;
  std::string path;  ///< Text by to_csv(); empty: no path.

  double l2_length = 0.0;   ///< Euclidean length in joint space, rad and m; 0 without a path.
  bool is_checked = false;  ///< The path was checked again (Campaign::check_paths).
  std::string fault;        ///< First fault of that check; empty: none.
  PathMeasures measures;    ///< NaN where a measure does not apply.
};

/// Reads a campaign file (YAML; docs/campaigns.md).
///
/// Problems are paths relative to the campaign's folder or names of scenes that ship; `${NAME}` in
/// them is an environment variable. A problem marked optional is left out if its file, or a
/// variable in its name, is missing. Every combination of a planner's lists of values becomes a
/// CampaignPlanner of its own, and so does each value under `vary`; two with the same parameters
/// become one.
///
/// @throws InputError naming file, line and element of the error, planners, parameters and their
/// ranges included. The problems themselves are not opened.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Campaign read_campaign(const std::filesystem::path& file,
                                                             const PlannerRegistry& registry);

/// Returns whether the file is YAML with the key `campaign` at its top. Never throws.
[[nodiscard]] HANDWAY_PLANNING_EXPORT bool is_campaign(const std::filesystem::path& file);

}  // namespace handway::planning
