#pragma once

#include "handway/device/core/device_stream.h"
#include "model/jobs/background.h"

#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <QTimer>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace handway::gui {

/// Brings what a device's stream reports to the window's thread. Items wait in a box and are handed
/// over together, at most once every kPeriodMs: a window that is busy gets the latest late, never a
/// queue of old ones. To be made, asked and destroyed by the window's thread.
template <typename Item>
class StreamInbox {
 public:
  static constexpr int kPeriodMs = 8;  ///< Twice the rate of common displays.
  using Items = std::vector<Item>;

  /// @param on_items gets items since the last time, oldest first, never none.
  StreamInbox(std::function<void(const Items&)> on_items,
              std::function<void(device::StreamState)> on_state)
      : box_(std::make_shared<Box>()),
        on_items_(std::move(on_items)),
        on_state_(std::move(on_state)) {
    box_->owner = this;
    timer_.setSingleShot(true);
    timer_.setTimerType(Qt::PreciseTimer);
    QObject::connect(&timer_, &QTimer::timeout, &context_, [this] { deliver(); });
  }

  ~StreamInbox() { close(); }

  StreamInbox(const StreamInbox&) = delete;
  StreamInbox& operator=(const StreamInbox&) = delete;

  /// Drops all waiting and later items.
  void close() {
    timer_.stop();
    const std::lock_guard lock(box_->mutex);
    box_->owner = nullptr;
  }

  /// Returns a function that passes items to the link. It may be called from any thread, at any
  /// time.
  [[nodiscard]] std::function<void(const Item&)> item_slot() const {
    return [box = box_](const Item& item) { push(box, item); };
  }
  [[nodiscard]] std::function<void(device::StreamState)> state_slot() const {
    return [box = box_](device::StreamState state) { push(box, state); };
  }

  /// When the first of the items that were handed over last came in.
  [[nodiscard]] std::chrono::steady_clock::time_point arrival() const { return arrival_; }

 private:
  static constexpr std::size_t kMostWaiting = 4096;

  /// State shared with the stream's thread; the owner is null once the link has ended.
  struct Box {
    std::mutex mutex;
    StreamInbox* owner = nullptr;
    Items items;
    bool notified = false;
    std::chrono::steady_clock::time_point arrival;  ///< Arrival of the first waiting item.
  };

  template <typename Action>
  static void invoke(const std::shared_ptr<Box>& box, Action action) {
    QMetaObject::invokeMethod(
        &box->owner->context_,
        [box, action] {
          if (box->owner) {
            action(*box->owner);
          }
        },
        Qt::QueuedConnection);
  }

  static void push(const std::shared_ptr<Box>& box, const Item& item) {
    const std::lock_guard lock(box->mutex);
    if (!box->owner) {
      return;
    }
    if (box->items.size() >= kMostWaiting) {
      box->items.erase(box->items.begin(), box->items.begin() + kMostWaiting / 2);
    }
    box->items.push_back(item);
    if (!std::exchange(box->notified, true)) {
      box->arrival = std::chrono::steady_clock::now();
      invoke(box, [](StreamInbox& owner) { owner.take(); });
    }
  }

  static void push(const std::shared_ptr<Box>& box, device::StreamState state) {
    const std::lock_guard lock(box->mutex);
    if (box->owner) {
      invoke(box, [state](StreamInbox& owner) { owner.on_state_(state); });
    }
  }

  void take() {
    const qint64 passed = since_delivery_.isValid() ? since_delivery_.elapsed() : kPeriodMs;
    if (passed >= kPeriodMs) {
      deliver();
    } else {
      timer_.start(static_cast<int>(kPeriodMs - passed));
    }
  }

  void deliver() {
    since_delivery_.start();
    Items items;
    {
      const std::lock_guard lock(box_->mutex);
      items.swap(box_->items);
      box_->notified = false;
      arrival_ = box_->arrival;
    }
    if (!items.empty()) {
      on_items_(items);
    }
  }

  QObject context_;
  std::shared_ptr<Box> box_;
  std::function<void(const Items&)> on_items_;
  std::function<void(device::StreamState)> on_state_;
  QTimer timer_;
  QElapsedTimer since_delivery_;
  std::chrono::steady_clock::time_point arrival_;
};

/// Base class of links to devices of all kinds, for Qt's signals.
class StreamLink : public QObject {
  Q_OBJECT

 public:
  [[nodiscard]] device::StreamState state() const { return state_; }

 signals:
  /// @param error why, of kLost and kFailed.
  void state_changed(handway::device::StreamState state, const QString& error);

 protected:
  using QObject::QObject;

  void set_state(device::StreamState state, const std::string& error = {}) {
    state_ = state;
    emit state_changed(state, QString::fromStdString(error));
  }

 private:
  device::StreamState state_ = device::StreamState::kStopped;
};

/// A device's stream brought to the window's thread.
/// @tparam Device device::Glove or device::Tracker. @tparam Item what becomes of its samples.
template <typename Device, typename Item>
class DeviceLink : public StreamLink {
 public:
  using Items = std::vector<Item>;
  using Info = typename Device::Info;

  ~DeviceLink() override {
    blockSignals(true);
    stop();
  }
  DeviceLink(const DeviceLink&) = delete;
  DeviceLink& operator=(const DeviceLink&) = delete;

  /// Returns at once.
  void stop() {
    if (!running_) {
      return;
    }
    inbox_->close();
    running_->stream->request_stop();
    closing_.run([ending = std::exchange(running_, nullptr)]() mutable { ending.reset(); });
    set_state(device::StreamState::kStopped);
  }

  [[nodiscard]] bool is_running() const { return running_ != nullptr; }
  [[nodiscard]] Info info() const { return running_ ? running_->stream->info() : Info{}; }
  [[nodiscard]] device::StreamStatistics statistics() const {
    return running_ ? running_->stream->statistics() : device::StreamStatistics{};
  }
  /// When the first of the items that were handed over last came in.
  [[nodiscard]] std::chrono::steady_clock::time_point arrival() const {
    return inbox_ ? inbox_->arrival() : std::chrono::steady_clock::time_point{};
  }

 protected:
  using StreamLink::StreamLink;
  using Stream = device::DeviceStream<Device>;

  /// Replaces the stream.
  /// @param emulator that the device talks to, kept as long; may be null.
  /// @param make_item called by the stream's thread.
  /// @param on_items gets items since the last time, oldest first, never none.
  void run(std::unique_ptr<Device> device, const std::shared_ptr<void>& emulator,
           std::function<Item(const typename Device::Sample&)> make_item,
           std::function<void(const Items&)> on_items) {
    stop();
    inbox_ = std::make_unique<StreamInbox<Item>>(
        std::move(on_items), [this](device::StreamState state) { on_state_changed(state); });
    typename Stream::Handlers handlers;
    handlers.on_sample = [push = inbox_->item_slot(), make = std::move(make_item)](
                             const typename Device::Sample& sample) { push(make(sample)); };
    handlers.on_state = inbox_->state_slot();
    running_ = std::make_shared<Running>();
    running_->emulator = emulator;
    running_->stream =
        std::make_unique<Stream>(std::move(device), device::StreamSettings{}, handlers);
    set_state(device::StreamState::kConnecting);
  }

 private:
  // The stream ends before the emulator that it talks to.
  struct Running {
    std::shared_ptr<void> emulator;
    std::unique_ptr<Stream> stream;
  };

  void on_state_changed(device::StreamState state) {
    const bool broken =
        state == device::StreamState::kLost || state == device::StreamState::kFailed;
    set_state(state, broken ? running_->stream->error() : std::string());
  }

  std::unique_ptr<StreamInbox<Item>> inbox_;
  std::shared_ptr<Running> running_;
  BackgroundJobs closing_;
};

}  // namespace handway::gui
