#include "model/devices/tracker_link.h"

#include <utility>

namespace handway::gui {

using device::StreamState;

// The stream ends before the emulator that it talks to.
struct TrackerLink::Running {
  std::unique_ptr<device::DeviceEmulator> emulator;
  std::unique_ptr<device::TrackerStream> stream;
};

TrackerLink::TrackerLink(QObject* parent) : QObject(parent) {}

TrackerLink::~TrackerLink() {
  blockSignals(true);
  stop();
}

void TrackerLink::start(std::unique_ptr<device::Tracker> tracker,
                        std::unique_ptr<device::DeviceEmulator> emulator) {
  stop();
  inbox_ = std::make_unique<Inbox>([this](const Inbox::Items& samples) { emit arrived(samples); },
                                   [this](StreamState state) { take_state(state); });
  running_ = std::make_shared<Running>();
  running_->emulator = std::move(emulator);
  state_ = StreamState::kConnecting;
  device::TrackerStreamHandlers handlers;
  handlers.on_sample = inbox_->item_slot();
  handlers.on_state = inbox_->state_slot();
  running_->stream = std::make_unique<device::TrackerStream>(std::move(tracker),
                                                             device::StreamSettings{}, handlers);
  emit state_changed(state_, {});
}

void TrackerLink::stop() {
  if (!running_) {
    return;
  }
  inbox_->close();
  running_->stream->request_stop();
  closing_.run([ending = std::exchange(running_, nullptr)]() mutable { ending.reset(); });
  state_ = StreamState::kStopped;
  emit state_changed(state_, {});
}

device::TrackerInfo TrackerLink::info() const {
  return running_ ? running_->stream->info() : device::TrackerInfo{};
}

device::StreamStatistics TrackerLink::statistics() const {
  return running_ ? running_->stream->statistics() : device::StreamStatistics{};
}

void TrackerLink::take_state(StreamState state) {
  state_ = state;
  const bool broken = state == StreamState::kLost || state == StreamState::kFailed;
  const QString error = broken ? QString::fromStdString(running_->stream->error()) : QString();
  emit state_changed(state, error);
}

}  // namespace handway::gui
