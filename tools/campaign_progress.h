#pragma once

#include "handway/planning/campaigns/campaign.h"

#include <chrono>
#include <cstddef>
#include <span>
#include <string>

namespace handway::tools {

/// Reports a campaign's progress on standard error: a line that is overwritten on a terminal,
/// otherwise a line now and then.
class CampaignProgress {
 public:
  /// @param kept runs done before. @param total all of the campaign's.
  CampaignProgress(std::string name, std::size_t kept, std::size_t total, int workers);
  ~CampaignProgress();
  CampaignProgress(const CampaignProgress&) = delete;
  CampaignProgress& operator=(const CampaignProgress&) = delete;

  void add(std::span<const planning::RunRecord> records);
  /// Seconds since the beginning.
  [[nodiscard]] double elapsed_s() const;

 private:
  [[nodiscard]] std::string line() const;
  void show(bool last);

  std::string name_;
  std::size_t kept_;
  std::size_t total_;
  std::size_t done_ = 0;    ///< Runs done since the beginning.
  std::size_t solved_ = 0;  ///< Solved ones of `done_`.
  bool terminal_;
  std::chrono::steady_clock::time_point begin_;
  std::chrono::steady_clock::time_point next_;
};

/// Duration for display: "12 s", "3 min 20 s", "2 h 5 min".
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace handway::tools
