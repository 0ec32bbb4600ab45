#include "handway/device/core/stream_statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace handway::device {

namespace {

constexpr double kWindow = 1.0;  // s
// More than any device sends within the window, unless it sends without pause.
constexpr std::size_t kMostRecent = 10000;
constexpr double kDropoutPeriods = 3.5;  // Less is what a busy computer does to any stream.

}  // namespace

void StreamStatisticsCounter::connected(double rate, double round_trip) {
  period_ = rate > 0.0 ? 1.0 / rate : 0.0;
  statistics_.latency = round_trip;
  statistics_.reconnects += begun_ ? 1 : 0;
  begun_ = true;
}

void StreamStatisticsCounter::frame(double time, double handled) {
  if (statistics_.frames > 0) {
    const double gap = time - last_time_;
    statistics_.longest_gap = std::max(statistics_.longest_gap, gap);
    if (period_ > 0.0 && gap > kDropoutPeriods * period_) {
      ++statistics_.dropouts;
    }
  }
  last_time_ = time;
  ++statistics_.frames;
  recent_.push_back({time, std::max(handled - time, 0.0)});
  while (recent_.front().time < time - kWindow || recent_.size() > kMostRecent) {
    recent_.pop_front();
  }
}

StreamStatistics StreamStatisticsCounter::at(double now) const {
  StreamStatistics result = statistics_;
  const auto first = std::ranges::find_if(
      recent_, [&](const Arrival& arrival) { return arrival.time >= now - kWindow; });
  const auto count = recent_.end() - first;
  if (count < 2) {
    result.rate = static_cast<double>(count) / kWindow;
    return result;
  }
  const double mean = (recent_.back().time - first->time) / static_cast<double>(count - 1);
  // A stream that has stopped slows down from one second's worth of frames to none.
  const double span = std::max(recent_.back().time, now - 2.0 * mean) - first->time;
  result.rate = span > 0.0 ? static_cast<double>(count - 1) / span : 0.0;
  double deviation = 0.0;
  for (auto at = first + 1; at != recent_.end(); ++at) {
    deviation += std::abs(at->time - (at - 1)->time - mean);
  }
  result.jitter = deviation / static_cast<double>(count - 1);
  result.handling =
      std::accumulate(first, recent_.end(), 0.0,
                      [](double sum, const Arrival& arrival) { return sum + arrival.handling; }) /
      static_cast<double>(count);
  return result;
}

}  // namespace handway::device
