#pragma once

#include "handway/device/glove/glove_stream.h"

#include <QWidget>

class QFrame;
class QLabel;

namespace handway::gui {

/// How the connection to the glove is: state and device, what went wrong, and
/// rate, delay and dropouts.
class LinkStatus : public QWidget {
  Q_OBJECT

 public:
  explicit LinkStatus(QWidget* parent = nullptr);

  /// @param error why; empty if nothing is wrong.
  void show_state(device::StreamState state, const device::GloveInfo& info, const QString& error);
  /// @param to_screen from a frame's arrival to its picture, s; 0 if not known.
  void show_statistics(const device::StreamStatistics& statistics, double to_screen);
  void clear_statistics();

  /// What went wrong; empty if nothing.
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
