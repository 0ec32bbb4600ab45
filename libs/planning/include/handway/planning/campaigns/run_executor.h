#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/run_record.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/planning/extensions/plugin.h"

#include <optional>
#include <stop_token>
#include <vector>

namespace handway::planning {

/// Carries out single runs of a campaign; may be asked by several threads at once.
class HANDWAY_PLANNING_EXPORT RunExecutor {
 public:
  /// Opens all problems.
  /// @param extensions must outlive it.
  /// @throws InputError if one can't be read or has no start or goal.
  RunExecutor(Campaign campaign, const Extensions& extensions);

  /// Plans with checkers that remember nothing of other runs.
  /// @returns nothing if it was cancelled.
  [[nodiscard]] std::optional<RunRecord> run(const RunSpec& spec, std::stop_token stop = {}) const;

  /// The campaign, each problem with all files that it was read from.
  [[nodiscard]] const Campaign& campaign() const { return campaign_; }

 private:
  Campaign campaign_;
  const Extensions& extensions_;
  std::vector<PlanningProblem> problems_;
};

}  // namespace handway::planning
