#include "workers/glove_link.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace handway::gui {
namespace {

using device::GloveFrame;
using device::StreamState;

constexpr std::size_t kMostWaiting = 4096;

}  // namespace

// Shared with the stream's thread; owner is null once nobody waits for more.
struct GloveLink::Inbox {
  std::mutex mutex;
  GloveLink* owner = nullptr;
  std::vector<GloveFrame> frames;
  bool told = false;
  std::chrono::steady_clock::time_point arrival;  // of the first that waits

  void push(const std::shared_ptr<Inbox>& self, const GloveFrame& frame) {
    const std::lock_guard lock(mutex);
    if (!owner) {
      return;
    }
    if (frames.size() >= kMostWaiting) {
      frames.erase(frames.begin(), frames.begin() + kMostWaiting / 2);
    }
    frames.push_back(frame);
    if (!std::exchange(told, true)) {
      arrival = std::chrono::steady_clock::now();
      QMetaObject::invokeMethod(
          owner,
          [self] {
            if (self->owner) {
              self->owner->told();
            }
          },
          Qt::QueuedConnection);
    }
  }

  void push(const std::shared_ptr<Inbox>& self, StreamState state) {
    const std::lock_guard lock(mutex);
    if (owner) {
      QMetaObject::invokeMethod(
          owner,
          [self, state] {
            if (self->owner) {
              self->owner->take_state(state);
            }
          },
          Qt::QueuedConnection);
    }
  }
};

// The stream ends before the emulator that it talks to.
struct GloveLink::Running {
  std::unique_ptr<device::GloveEmulator> emulator;
  std::unique_ptr<device::GloveStream> stream;
};

GloveLink::GloveLink(QObject* parent) : QObject(parent), tap_(std::make_shared<RecordingTap>()) {
  timer_.setSingleShot(true);
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, &GloveLink::deliver);
}

GloveLink::~GloveLink() {
  blockSignals(true);
  stop();
}

void GloveLink::start(std::unique_ptr<device::Glove> glove,
                      std::unique_ptr<device::GloveEmulator> emulator) {
  stop();
  inbox_ = std::make_shared<Inbox>();
  inbox_->owner = this;
  running_ = std::make_shared<Running>();
  running_->emulator = std::move(emulator);
  state_ = StreamState::kConnecting;
  device::GloveStreamHandlers handlers;
  handlers.on_frame = [inbox = inbox_, tap = tap_](const GloveFrame& frame) {
    tap->take(frame);
    inbox->push(inbox, frame);
  };
  handlers.on_state = [inbox = inbox_](StreamState state) { inbox->push(inbox, state); };
  running_->stream = std::make_unique<device::GloveStream>(
      std::move(glove), device::StreamSettings{}, std::move(handlers));
  emit state_changed(state_, {});
}

void GloveLink::stop() {
  if (!running_) {
    return;
  }
  {
    const std::lock_guard lock(inbox_->mutex);
    inbox_->owner = nullptr;
  }
  timer_.stop();
  running_->stream->request_stop();
  closing_.run([ending = std::exchange(running_, nullptr)]() mutable { ending.reset(); });
  state_ = StreamState::kStopped;
  emit state_changed(state_, {});
}

device::GloveInfo GloveLink::info() const {
  return running_ ? running_->stream->info() : device::GloveInfo{};
}

device::StreamStatistics GloveLink::statistics() const {
  return running_ ? running_->stream->statistics() : device::StreamStatistics{};
}

void GloveLink::take_state(StreamState state) {
  state_ = state;
  const bool broken = state == StreamState::kLost || state == StreamState::kFailed;
  const QString error = broken ? QString::fromStdString(running_->stream->error()) : QString();
  emit state_changed(state, error);
}

void GloveLink::told() {
  const qint64 passed = since_delivery_.isValid() ? since_delivery_.elapsed() : kPeriodMs;
  if (passed >= kPeriodMs) {
    deliver();
  } else {
    timer_.start(static_cast<int>(kPeriodMs - passed));
  }
}

void GloveLink::deliver() {
  since_delivery_.start();
  std::vector<GloveFrame> frames;
  {
    const std::lock_guard lock(inbox_->mutex);
    frames.swap(inbox_->frames);
    inbox_->told = false;
    arrival_ = inbox_->arrival;
  }
  if (!frames.empty()) {
    emit arrived(frames);
  }
}

}  // namespace handway::gui
