#include "handway/device/glove/glove_stream.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace handway::device {

namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr milliseconds kReadTimeout{50};

bool is_over(GloveState state) {
  return state == GloveState::kEnded || state == GloveState::kStopped ||
         state == GloveState::kFailed;
}

}  // namespace

const char* state_name(GloveState state) {
  switch (state) {
    case GloveState::kConnecting:
      return "connecting";
    case GloveState::kStreaming:
      return "streaming";
    case GloveState::kUnplugged:
      return "unplugged";
    case GloveState::kLost:
      return "lost";
    case GloveState::kEnded:
      return "ended";
    case GloveState::kStopped:
      return "stopped";
    case GloveState::kFailed:
      return "failed";
  }
  return "unknown";
}

struct GloveStream::Shared {
  std::unique_ptr<Glove> glove;
  GloveStreamSettings settings;
  GloveStreamHandlers handlers;

  mutable std::mutex mutex;
  mutable std::condition_variable_any changed;
  GloveState state = GloveState::kConnecting;
  GloveInfo info;
  std::string error;
  StreamStatisticsCounter counter;
  Clock::time_point begin = Clock::now();

  std::jthread thread;  ///< Last: it uses all the others.

  void enter(GloveState next);
  void keep_error(const std::exception& problem);
  bool pause(milliseconds delay, const std::stop_token& stop) const;
  bool connect(const std::stop_token& stop);
  GloveState read(const std::stop_token& stop);
  void hand_over(const GloveFrame& frame);
  GloveState run_to_end(const std::stop_token& stop);
};

void GloveStream::Shared::enter(GloveState next) {
  {
    const std::lock_guard lock(mutex);
    if (state == next) {
      return;
    }
    state = next;
  }
  if (handlers.on_state) {
    handlers.on_state(next);
  }
  changed.notify_all();
}

void GloveStream::Shared::keep_error(const std::exception& problem) {
  const std::lock_guard lock(mutex);
  error = problem.what();
}

// @returns whether to go on.
bool GloveStream::Shared::pause(milliseconds delay, const std::stop_token& stop) const {
  std::unique_lock lock(mutex);
  changed.wait_for(lock, stop, delay, [] { return false; });
  return !stop.stop_requested();
}

bool GloveStream::Shared::connect(const std::stop_token& stop) {
  try {
    const GloveInfo connected = glove->connect(stop);
    {
      const std::lock_guard lock(mutex);
      info = connected;
      counter.connected(connected.rate, connected.round_trip);
    }
    if (handlers.on_connected) {
      handlers.on_connected(connected);
    }
    enter(GloveState::kStreaming);
    return true;
  } catch (const std::exception& problem) {
    if (!stop.stop_requested()) {
      keep_error(problem);
    }
    return false;
  }
}

void GloveStream::Shared::hand_over(const GloveFrame& frame) {
  enter(GloveState::kStreaming);
  if (handlers.on_frame) {
    handlers.on_frame(frame);
  }
  const double handling = glove->now() - frame.time;
  const double now = std::chrono::duration<double>(Clock::now() - begin).count();
  const std::lock_guard lock(mutex);
  counter.frame(now - handling, now);
  counter.resynchronised(glove->line_faults().resynchronisations);
}

// Reads until there is nothing more to be read. @returns why.
GloveState GloveStream::Shared::read(const std::stop_token& stop) {
  try {
    while (!stop.stop_requested()) {
      const GloveReading reading = glove->next(kReadTimeout, stop);
      switch (reading.event) {
        case GloveEvent::kFrame:
          hand_over(reading.frame);
          break;
        case GloveEvent::kUnplugged:
          enter(GloveState::kUnplugged);
          break;
        case GloveEvent::kEnd:
          return GloveState::kEnded;
        case GloveEvent::kNothing:
          break;
      }
    }
    return GloveState::kStopped;
  } catch (const std::exception& problem) {
    keep_error(problem);
    return GloveState::kLost;
  }
}

GloveState GloveStream::Shared::run_to_end(const std::stop_token& stop) {
  milliseconds delay = settings.first_delay;
  bool ever = false;
  while (!stop.stop_requested()) {
    if (connect(stop)) {
      ever = true;
      delay = settings.first_delay;
      const GloveState why = read(stop);
      if (why != GloveState::kLost) {
        return why;
      }
      glove->disconnect();
    }
    if (stop.stop_requested()) {
      break;
    }
    if (ever ? !settings.reconnect : !settings.wait_for_device) {
      return GloveState::kFailed;
    }
    enter(ever ? GloveState::kLost : GloveState::kConnecting);
    if (!pause(delay, stop)) {
      break;
    }
    delay = std::min(2 * delay, settings.longest_delay);
  }
  return GloveState::kStopped;
}

GloveStream::GloveStream(std::unique_ptr<Glove> glove, const GloveStreamSettings& settings,
                         GloveStreamHandlers handlers)
    : shared_(std::make_unique<Shared>()) {
  shared_->glove = std::move(glove);
  shared_->settings = settings;
  shared_->handlers = std::move(handlers);
  shared_->thread = std::jthread([shared = shared_.get()](const std::stop_token& stop) {
    const GloveState why = shared->run_to_end(stop);
    shared->glove->disconnect();
    shared->enter(why);
  });
}

GloveStream::~GloveStream() = default;

void GloveStream::request_stop() { shared_->thread.request_stop(); }

bool GloveStream::wait(milliseconds timeout) const {
  std::unique_lock lock(shared_->mutex);
  return shared_->changed.wait_for(lock, timeout, [&] { return is_over(shared_->state); });
}

GloveState GloveStream::state() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->state;
}

GloveInfo GloveStream::info() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->info;
}

std::string GloveStream::error() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->error;
}

StreamStatistics GloveStream::statistics() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->counter.at(std::chrono::duration<double>(Clock::now() - shared_->begin).count());
}

}  // namespace handway::device
