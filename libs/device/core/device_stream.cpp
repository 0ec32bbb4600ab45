#include "handway/device/core/device_stream.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace handway::device {
const char* state_name(StreamState state) {
  switch (state) {
    case StreamState::kConnecting:
      return "connecting";
    case StreamState::kStreaming:
      return "streaming";
    case StreamState::kUnplugged:
      return "unplugged";
    case StreamState::kLost:
      return "lost";
    case StreamState::kEnded:
      return "ended";
    case StreamState::kStopped:
      return "stopped";
    case StreamState::kFailed:
      return "failed";
  }
  return "unknown";
}

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

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kReadTimeout{50};

bool is_over(StreamState state) {
  return state == StreamState::kEnded || state == StreamState::kStopped ||
         state == StreamState::kFailed;
}

}  // namespace

StreamThread::StreamThread(std::unique_ptr<StreamSource> source, const StreamSettings& settings,
                           std::function<void(StreamState)> on_state)
    : source_(std::move(source)),
      settings_(settings),
      on_state_(std::move(on_state)),
      thread_([this](const std::stop_token& stop) {
        const StreamState why = run_to_end(stop);
        source_->disconnect();
        enter(why);
      }) {}

void StreamThread::enter(StreamState next) {
  {
    const std::lock_guard lock(mutex_);
    if (state_ == next) {
      return;
    }
    state_ = next;
  }
  if (on_state_) {
    on_state_(next);
  }
  changed_.notify_all();
}

void StreamThread::keep_error(const std::exception& problem) {
  const std::lock_guard lock(mutex_);
  error_ = problem.what();
}

double StreamThread::now() const {
  return std::chrono::duration<double>(Clock::now() - begin_).count();
}

// @returns whether to continue.
bool StreamThread::pause(milliseconds delay, const std::stop_token& stop) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, stop, delay, [] { return false; });
  return !stop.stop_requested();
}

bool StreamThread::connect(const std::stop_token& stop) {
  try {
    const StreamSource::Pace pace = source_->connect(stop);
    {
      const std::lock_guard lock(mutex_);
      counter_.connected(pace.rate, pace.round_trip);
    }
    enter(StreamState::kStreaming);
    return true;
  } catch (const std::exception& problem) {
    if (!stop.stop_requested()) {
      keep_error(problem);
    }
    return false;
  }
}

void StreamThread::hand_over() {
  enter(StreamState::kStreaming);
  const double handling = source_->hand_over();
  const double time = now();
  const std::lock_guard lock(mutex_);
  counter_.frame(time - handling, time);
  counter_.resynchronised(source_->resynchronisations());
}

// Reads until the end of the samples. @returns the reason.
StreamState StreamThread::read(const std::stop_token& stop) {
  try {
    while (!stop.stop_requested()) {
      switch (source_->next(kReadTimeout, stop)) {
        case SampleEvent::kSample:
          hand_over();
          break;
        case SampleEvent::kUnplugged:
          enter(StreamState::kUnplugged);
          break;
        case SampleEvent::kEnd:
          return StreamState::kEnded;
        case SampleEvent::kNothing:
          break;
      }
    }
    return StreamState::kStopped;
  } catch (const std::exception& problem) {
    keep_error(problem);
    return StreamState::kLost;
  }
}

StreamState StreamThread::run_to_end(const std::stop_token& stop) {
  milliseconds delay = settings_.first_delay;
  bool ever = false;
  while (!stop.stop_requested()) {
    if (connect(stop)) {
      ever = true;
      delay = settings_.first_delay;
      const StreamState why = read(stop);
      if (why != StreamState::kLost) {
        return why;
      }
      source_->disconnect();
    }
    if (stop.stop_requested()) {
      break;
    }
    if (ever ? !settings_.reconnect : !settings_.wait_for_device) {
      return StreamState::kFailed;
    }
    enter(ever ? StreamState::kLost : StreamState::kConnecting);
    if (!pause(delay, stop)) {
      break;
    }
    delay = std::min(2 * delay, settings_.longest_delay);
  }
  return StreamState::kStopped;
}

bool StreamThread::wait(milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, timeout, [this] { return is_over(state_); });
}

StreamState StreamThread::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

std::string StreamThread::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

StreamStatistics StreamThread::statistics() const {
  const std::lock_guard lock(mutex_);
  return counter_.at(now());
}

}  // namespace handway::device
