#include "core/device_stream.h"

#include <algorithm>
#include <utility>

namespace handway::device {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kReadTimeout{50};

bool is_over(StreamState state) {
  return state == StreamState::kEnded || state == StreamState::kStopped ||
         state == StreamState::kFailed;
}

}  // namespace

DeviceStream::DeviceStream(std::unique_ptr<StreamedDevice> device, const StreamSettings& settings,
                           std::function<void(StreamState)> on_state)
    : device_(std::move(device)),
      settings_(settings),
      on_state_(std::move(on_state)),
      thread_([this](const std::stop_token& stop) {
        const StreamState why = run_to_end(stop);
        device_->disconnect();
        enter(why);
      }) {}

void DeviceStream::enter(StreamState next) {
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

void DeviceStream::keep_error(const std::exception& problem) {
  const std::lock_guard lock(mutex_);
  error_ = problem.what();
}

double DeviceStream::now() const {
  return std::chrono::duration<double>(Clock::now() - begin_).count();
}

// @returns whether to go on.
bool DeviceStream::pause(milliseconds delay, const std::stop_token& stop) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, stop, delay, [] { return false; });
  return !stop.stop_requested();
}

bool DeviceStream::connect(const std::stop_token& stop) {
  try {
    const StreamedDevice::Pace pace = device_->connect(stop);
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

void DeviceStream::hand_over() {
  enter(StreamState::kStreaming);
  const double handling = device_->hand_over();
  const double time = now();
  const std::lock_guard lock(mutex_);
  counter_.frame(time - handling, time);
  counter_.resynchronised(device_->resynchronisations());
}

// Reads until there is nothing more to be read. @returns why.
StreamState DeviceStream::read(const std::stop_token& stop) {
  try {
    while (!stop.stop_requested()) {
      switch (device_->next(kReadTimeout, stop)) {
        case StreamedDevice::Event::kSample:
          hand_over();
          break;
        case StreamedDevice::Event::kUnplugged:
          enter(StreamState::kUnplugged);
          break;
        case StreamedDevice::Event::kEnd:
          return StreamState::kEnded;
        case StreamedDevice::Event::kNothing:
          break;
      }
    }
    return StreamState::kStopped;
  } catch (const std::exception& problem) {
    keep_error(problem);
    return StreamState::kLost;
  }
}

StreamState DeviceStream::run_to_end(const std::stop_token& stop) {
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
      device_->disconnect();
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

bool DeviceStream::wait(milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, timeout, [this] { return is_over(state_); });
}

StreamState DeviceStream::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

std::string DeviceStream::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

StreamStatistics DeviceStream::statistics() const {
  const std::lock_guard lock(mutex_);
  return counter_.at(now());
}

}  // namespace handway::device
