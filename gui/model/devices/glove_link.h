#pragma once

#include "handway/device/glove/glove_emulator.h"
#include "handway/device/glove/glove_stream.h"
#include "model/devices/recording_tap.h"
#include "model/devices/stream_inbox.h"
#include "model/jobs/background_threads.h"

#include <QObject>

#include <chrono>
#include <memory>
#include <vector>

namespace handway::gui {

/// A glove's stream brought to the window's thread. The recording tap sees every frame, on the
/// stream's thread.
class GloveLink : public QObject {
  Q_OBJECT

 public:
  explicit GloveLink(QObject* parent = nullptr);
  ~GloveLink() override;

  /// Takes the place of the stream before.
  /// @param emulator that the glove talks to, kept as long; may be null.
  void start(std::unique_ptr<device::Glove> glove,
             std::unique_ptr<device::GloveEmulator> emulator = nullptr);
  /// Returns at once.
  void stop();

  [[nodiscard]] bool is_running() const { return running_ != nullptr; }
  [[nodiscard]] device::StreamState state() const { return state_; }
  [[nodiscard]] device::GloveInfo info() const;
  [[nodiscard]] device::StreamStatistics statistics() const;
  /// When the first of the frames that arrived() told last came in.
  [[nodiscard]] std::chrono::steady_clock::time_point arrival() const;
  [[nodiscard]] RecordingTap& tap() { return *tap_; }

 signals:
  /// @param error why, of kLost and kFailed.
  void state_changed(handway::device::StreamState state, const QString& error);
  /// Frames since the last time, oldest first, never none.
  void arrived(const std::vector<handway::device::GloveFrame>& frames);

 private:
  using Inbox = StreamInbox<device::GloveFrame>;
  struct Running;

  void take_state(device::StreamState state);

  std::shared_ptr<RecordingTap> tap_;
  std::unique_ptr<Inbox> inbox_;
  std::shared_ptr<Running> running_;
  device::StreamState state_ = device::StreamState::kStopped;
  BackgroundThreads closing_;
};

}  // namespace handway::gui
