#pragma once

#include "handway/device/core/device_stream.h"

#include <QWidget>

class QFrame;
class QLabel;

namespace handway::gui {

/// Shows the connection to a glove or a tracker: state and device, errors, and rate, delay and
/// dropouts.
class LinkStatus : public QWidget {
  Q_OBJECT

 public:
  /// @param name of the device, in front of the object names of the labels: "glove_rate".
  explicit LinkStatus(const QString& name, QWidget* parent = nullptr);

  /// @param what is connected: "CyberGlove, right hand". @param device its model and port.
  /// @param error why; empty if nothing is wrong.
  void show_state(device::StreamState state, const QString& what, const QString& device,
                  const QString& error);
  /// @param to_screen from a frame's arrival to its picture, s; nothing if not known.
  void show_statistics(const device::StreamStatistics& statistics, double to_screen = 0.0);
  void clear_statistics();

  /// Returns the error; empty if there is none.
  [[nodiscard]] QString error() const;

 private:
  QLabel* state_;
  QFrame* problem_;
  QLabel* problem_text_;
  QLabel* rate_;
  QLabel* delay_;
  QLabel* dropouts_;
};

}  // namespace handway::gui
