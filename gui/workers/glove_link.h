#pragma once

#include "handway/device/glove/glove_emulator.h"
#include "handway/device/glove/glove_stream.h"
#include "workers/background_threads.h"
#include "workers/recording_tap.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <chrono>
#include <memory>
#include <vector>

namespace handway::gui {

/// A glove's stream brought to the window's thread. Frames wait in an inbox and are handed over
/// together, at most once every kPeriodMs: a window that is busy gets the latest late,
/// never a queue of old ones. The recording tap sees every frame, on the stream's thread.
class GloveLink : public QObject {
  Q_OBJECT

 public:
  static constexpr int kPeriodMs = 8;  ///< Twice the rate of common displays.

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
  [[nodiscard]] std::chrono::steady_clock::time_point arrival() const { return arrival_; }
  [[nodiscard]] RecordingTap& tap() { return *tap_; }

 signals:
  /// @param error why, of kLost and kFailed.
  void state_changed(handway::device::StreamState state, const QString& error);
  /// Frames since the last time, oldest first, never none.
  void arrived(const std::vector<handway::device::GloveFrame>& frames);

 private:
  struct Inbox;
  struct Running;

  void told();
  void deliver();
  void take_state(device::StreamState state);

  std::shared_ptr<RecordingTap> tap_;
  std::shared_ptr<Inbox> inbox_;
  std::shared_ptr<Running> running_;
  device::StreamState state_ = device::StreamState::kStopped;
  QTimer timer_;
  QElapsedTimer since_delivery_;
  std::chrono::steady_clock::time_point arrival_;
  BackgroundThreads closing_;
};

}  // namespace handway::gui
