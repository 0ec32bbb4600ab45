#include "handway/device/glove/glove_stream.h"

#include "core/device_stream.h"

#include <mutex>
#include <utility>

namespace handway::device {

namespace {

/// A glove, and what its stream reports of it.
class StreamedGlove final : public StreamedDevice {
 public:
  struct Reports {
    mutable std::mutex mutex;
    GloveInfo info;
  };

  StreamedGlove(std::unique_ptr<Glove> glove, GloveStreamHandlers handlers,
                std::shared_ptr<Reports> reports)
      : glove_(std::move(glove)), handlers_(std::move(handlers)), reports_(std::move(reports)) {}

  Pace connect(const std::stop_token& stop) override {
    const GloveInfo info = glove_->connect(stop);
    {
      const std::lock_guard lock(reports_->mutex);
      reports_->info = info;
    }
    if (handlers_.on_connected) {
      handlers_.on_connected(info);
    }
    return {info.rate, info.round_trip};
  }

  Event next(std::chrono::milliseconds timeout, const std::stop_token& stop) override {
    const GloveReading reading = glove_->next(timeout, stop);
    switch (reading.event) {
      case GloveEvent::kFrame:
        frame_ = reading.frame;
        return Event::kSample;
      case GloveEvent::kUnplugged:
        return Event::kUnplugged;
      case GloveEvent::kEnd:
        return Event::kEnd;
      case GloveEvent::kNothing:
        break;
    }
    return Event::kNothing;
  }

  double hand_over() override {
    if (handlers_.on_frame) {
      handlers_.on_frame(frame_);
    }
    return glove_->now() - frame_.time;
  }

  void disconnect() noexcept override { glove_->disconnect(); }

  [[nodiscard]] std::uint64_t resynchronisations() const override {
    return glove_->line_faults().resynchronisations;
  }

 private:
  std::unique_ptr<Glove> glove_;
  GloveStreamHandlers handlers_;
  std::shared_ptr<Reports> reports_;
  GloveFrame frame_;
};

}  // namespace

struct GloveStream::Running {
  std::shared_ptr<StreamedGlove::Reports> reports = std::make_shared<StreamedGlove::Reports>();
  DeviceStream stream;

  Running(std::unique_ptr<Glove> glove, const StreamSettings& settings,
          const GloveStreamHandlers& handlers)
      : stream(std::make_unique<StreamedGlove>(std::move(glove), handlers, reports), settings,
               handlers.on_state) {}
};

GloveStream::GloveStream(std::unique_ptr<Glove> glove, const StreamSettings& settings,
                         const GloveStreamHandlers& handlers)
    : running_(std::make_unique<Running>(std::move(glove), settings, handlers)) {}

GloveStream::~GloveStream() = default;

void GloveStream::request_stop() { running_->stream.request_stop(); }

bool GloveStream::wait(std::chrono::milliseconds timeout) const {
  return running_->stream.wait(timeout);
}

StreamState GloveStream::state() const { return running_->stream.state(); }

GloveInfo GloveStream::info() const {
  const std::lock_guard lock(running_->reports->mutex);
  return running_->reports->info;
}

std::string GloveStream::error() const { return running_->stream.error(); }

StreamStatistics GloveStream::statistics() const { return running_->stream.statistics(); }

}  // namespace handway::device
