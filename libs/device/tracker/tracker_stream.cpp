#include "handway/device/tracker/tracker_stream.h"

#include "core/device_stream.h"

#include <mutex>
#include <utility>

namespace handway::device {

namespace {

/// A tracker, and what its stream reports of it.
class StreamedTracker final : public StreamedDevice {
 public:
  struct Reports {
    mutable std::mutex mutex;
    TrackerInfo info;
  };

  StreamedTracker(std::unique_ptr<Tracker> tracker, TrackerStreamHandlers handlers,
                  std::shared_ptr<Reports> reports)
      : tracker_(std::move(tracker)),
        handlers_(std::move(handlers)),
        reports_(std::move(reports)) {}

  Pace connect(const std::stop_token& stop) override {
    const TrackerInfo info = tracker_->connect(stop);
    {
      const std::lock_guard lock(reports_->mutex);
      reports_->info = info;
    }
    if (handlers_.on_connected) {
      handlers_.on_connected(info);
    }
    return {};  // a Polhemus doesn't tell how fast it is
  }

  Event next(std::chrono::milliseconds timeout, const std::stop_token& stop) override {
    const TrackerReading reading = tracker_->next(timeout, stop);
    switch (reading.event) {
      case TrackerEvent::kSample:
        sample_ = reading.sample;
        return Event::kSample;
      case TrackerEvent::kUnplugged:
        return Event::kUnplugged;
      case TrackerEvent::kNothing:
        break;
    }
    return Event::kNothing;
  }

  double hand_over() override {
    if (handlers_.on_sample) {
      handlers_.on_sample(sample_);
    }
    return tracker_->now() - sample_.time;
  }

  void disconnect() noexcept override { tracker_->disconnect(); }

  [[nodiscard]] std::uint64_t resynchronisations() const override {
    return tracker_->faults().resynchronisations;
  }

 private:
  std::unique_ptr<Tracker> tracker_;
  TrackerStreamHandlers handlers_;
  std::shared_ptr<Reports> reports_;
  TrackerSample sample_;
};

}  // namespace

struct TrackerStream::Running {
  std::shared_ptr<StreamedTracker::Reports> reports = std::make_shared<StreamedTracker::Reports>();
  DeviceStream stream;

  Running(std::unique_ptr<Tracker> tracker, const StreamSettings& settings,
          const TrackerStreamHandlers& handlers)
      : stream(std::make_unique<StreamedTracker>(std::move(tracker), handlers, reports), settings,
               handlers.on_state) {}
};

TrackerStream::TrackerStream(std::unique_ptr<Tracker> tracker, const StreamSettings& settings,
                             const TrackerStreamHandlers& handlers)
    : running_(std::make_unique<Running>(std::move(tracker), settings, handlers)) {}

TrackerStream::~TrackerStream() = default;

void TrackerStream::request_stop() { running_->stream.request_stop(); }

bool TrackerStream::wait(std::chrono::milliseconds timeout) const {
  return running_->stream.wait(timeout);
}

StreamState TrackerStream::state() const { return running_->stream.state(); }

TrackerInfo TrackerStream::info() const {
  const std::lock_guard lock(running_->reports->mutex);
  return running_->reports->info;
}

std::string TrackerStream::error() const { return running_->stream.error(); }

StreamStatistics TrackerStream::statistics() const { return running_->stream.statistics(); }

}  // namespace handway::device
