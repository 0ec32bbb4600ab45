#pragma once

#include "handway/planning/campaigns/run_record.h"

#include <chrono>
#include <cstddef>
#include <span>
#include <string>

namespace handway::tools {

/// Tells on standard error how far a campaign is: a line that is overwritten where that is a
/// terminal, a line now and then otherwise.
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
  std::size_t done_ = 0;    ///< Since the beginning.
  std::size_t solved_ = 0;  ///< Of those.
  bool terminal_;
  std::chrono::steady_clock::time_point begin_;
  std::chrono::steady_clock::time_point next_;
};

/// "12 s", "3 min 20 s", "2 h 5 min": a duration for people.
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace handway::tools
