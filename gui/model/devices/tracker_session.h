#pragma once

#include "model/devices/tracker_link.h"

#include <QObject>
#include <QString>
#include <QStringList>

#include <vector>

namespace handway::gui {

/// The wrist tracker that the workbench listens to.
class TrackerSession : public QObject {
  Q_OBJECT

 public:
  explicit TrackerSession(QObject* parent = nullptr);
  ~TrackerSession() override;

  /// What a tracker may speak, as it is written in front of an address; "emulator", the
  /// built-in one, has none.
  [[nodiscard]] static QStringList protocols();

  /// Connects to "emulator", "fastrak:/dev/ttyUSB0", "liberty:HOST:PORT" or "udp:5005". What
  /// goes wrong is told by state_changed().
  void connect_to(const QString& device);
  void disconnect_tracker();
  /// As connect_to() was told; empty before.
  [[nodiscard]] const QString& device() const { return device_; }
  [[nodiscard]] TrackerLink& link() { return link_; }

 signals:
  void state_changed(handway::device::StreamState state, const QString& error);
  /// Samples of all sensors since the last time, oldest first.
  void sampled(const std::vector<handway::device::TrackerSample>& samples);

 private:
  void start(const QString& protocol, const QString& address);

  TrackerLink link_;
  QString device_;
};

}  // namespace handway::gui
