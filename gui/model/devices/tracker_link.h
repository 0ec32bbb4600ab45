#pragma once

#include "handway/device/core/device_emulator.h"
#include "handway/device/tracker/tracker_stream.h"
#include "model/devices/stream_inbox.h"
#include "model/jobs/background_threads.h"

#include <QObject>

#include <memory>
#include <vector>

namespace handway::gui {

/// A tracker's stream brought to the window's thread.
class TrackerLink : public QObject {
  Q_OBJECT

 public:
  explicit TrackerLink(QObject* parent = nullptr);
  ~TrackerLink() override;

  /// Takes the place of the stream before.
  /// @param emulator that the tracker talks to, kept as long; may be null.
  void start(std::unique_ptr<device::Tracker> tracker,
             std::unique_ptr<device::DeviceEmulator> emulator = nullptr);
  /// Returns at once.
  void stop();

  [[nodiscard]] bool is_running() const { return running_ != nullptr; }
  [[nodiscard]] device::StreamState state() const { return state_; }
  [[nodiscard]] device::TrackerInfo info() const;
  [[nodiscard]] device::StreamStatistics statistics() const;

 signals:
  /// @param error why, of kLost and kFailed.
  void state_changed(handway::device::StreamState state, const QString& error);
  /// Samples of all sensors since the last time, oldest first, never none.
  void arrived(const std::vector<handway::device::TrackerSample>& samples);

 private:
  using Inbox = StreamInbox<device::TrackerSample>;
  struct Running;

  void take_state(device::StreamState state);

  std::unique_ptr<Inbox> inbox_;
  std::shared_ptr<Running> running_;
  device::StreamState state_ = device::StreamState::kStopped;
  BackgroundThreads closing_;
};

}  // namespace handway::gui
