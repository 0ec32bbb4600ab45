#include "model/devices/glove_link.h"

#include <utility>

namespace handway::gui {

using device::StreamState;

// The stream ends before the emulator that it talks to.
struct GloveLink::Running {
  std::unique_ptr<device::GloveEmulator> emulator;
  std::unique_ptr<device::GloveStream> stream;
};

GloveLink::GloveLink(QObject* parent) : QObject(parent), tap_(std::make_shared<RecordingTap>()) {}

GloveLink::~GloveLink() {
  blockSignals(true);
  stop();
}

void GloveLink::start(std::unique_ptr<device::Glove> glove,
                      std::unique_ptr<device::GloveEmulator> emulator) {
  stop();
  inbox_ = std::make_unique<Inbox>([this](const Inbox::Items& frames) { emit arrived(frames); },
                                   [this](StreamState state) { take_state(state); });
  running_ = std::make_shared<Running>();
  running_->emulator = std::move(emulator);
  state_ = StreamState::kConnecting;
  device::GloveStreamHandlers handlers;
  handlers.on_frame = [push = inbox_->item_slot(), tap = tap_](const device::GloveFrame& frame) {
    tap->take(frame);
    push(frame);
  };
  handlers.on_state = inbox_->state_slot();
  running_->stream =
      std::make_unique<device::GloveStream>(std::move(glove), device::StreamSettings{}, handlers);
  emit state_changed(state_, {});
}

void GloveLink::stop() {
  if (!running_) {
    return;
  }
  inbox_->close();
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

std::chrono::steady_clock::time_point GloveLink::arrival() const {
  return inbox_ ? inbox_->arrival() : std::chrono::steady_clock::time_point{};
}

void GloveLink::take_state(StreamState state) {
  state_ = state;
  const bool broken = state == StreamState::kLost || state == StreamState::kFailed;
  const QString error = broken ? QString::fromStdString(running_->stream->error()) : QString();
  emit state_changed(state, error);
}

}  // namespace handway::gui
