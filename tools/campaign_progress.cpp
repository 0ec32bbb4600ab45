#include "campaign_progress.h"

#include "handway/geometric/io/printable.h"
#include "handway/planning/campaigns/campaign.h"
#include "printing.h"
#include "version.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace handway::tools {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kTerminalPause(200);
constexpr std::chrono::seconds kLinePause(10);

}  // namespace

CampaignProgress::CampaignProgress(std::string name, std::size_t kept, std::size_t total,
                                   int workers)
    : name_(std::move(name)),
      kept_(kept),
      total_(total),
      terminal_(isatty(STDERR_FILENO) == 1),
      begin_(Clock::now()),
      next_(begin_ + (terminal_ ? Clock::duration::zero() : Clock::duration(kLinePause))) {
  const std::string kept_text = kept == 0 ? "" : fmt::format(", {} of them already done", kept);
  print_error("{}: {} runs{}, {} simultaneously\n", name_, total, kept_text, workers);
}

CampaignProgress::~CampaignProgress() {
  if (done_ > 0) {
    show(true);
  }
}

void CampaignProgress::add(std::span<const planning::RunRecord> records) {
  done_ += records.size();
  for (const planning::RunRecord& record : records) {
    solved_ += record.solved ? 1 : 0;
  }
  if (Clock::now() >= next_) {
    show(false);
  }
}

double CampaignProgress::elapsed_s() const {
  return std::chrono::duration<double>(Clock::now() - begin_).count();
}

std::string CampaignProgress::line() const {
  const std::size_t done = kept_ + done_;
  std::string text = fmt::format("{}: {}/{} runs ({:.0f} %)", name_, done, total_,
                                 100.0 * static_cast<double>(done) / static_cast<double>(total_));
  if (done_ > 0) {
    const double pace = elapsed_s() / static_cast<double>(done_);
    text += fmt::format(", {}/{} solved", solved_, done_);
    text += done == total_ ? fmt::format(", took {}", duration_text(elapsed_s()))
                           : fmt::format(", about {} left",
                                         duration_text(pace * static_cast<double>(total_ - done)));
  }
  return text;
}

void CampaignProgress::show(bool last) {
  if (terminal_) {
    fmt::print(stderr, "\r{}\x1b[K{}", geometric::printable(line()), last ? "\n" : "");
    std::fflush(stderr);
    next_ = Clock::now() + kTerminalPause;
  } else {
    print_error("{}\n", line());
    next_ = Clock::now() + kLinePause;
  }
}

std::string duration_text(double seconds) {
  constexpr long kMinute = 60;
  constexpr long kHour = 3600;
  const long whole = std::lround(seconds);
  if (whole < kMinute) {
    return fmt::format("{} s", whole);
  }
  if (whole < kHour) {
    return fmt::format("{} min {} s", whole / kMinute, whole % kMinute);
  }
  return fmt::format("{} h {} min", whole / kHour, whole % kHour / kMinute);
}

}  // namespace handway::tools
