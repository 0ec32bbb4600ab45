#pragma once

#include "app/main_window.h"

#include <QObject>
#include <QTimer>

namespace handway::gui {

/// Saves a picture of the whole window as soon as it shows the requested content: the scene,
/// checked for collisions; with a plan, its path half-way played.
class Snapshot : public QObject {
  Q_OBJECT

 public:
  /// @param window outlives the snapshot.
  Snapshot(MainWindow& window, const Options& options, QObject* parent = nullptr);

 signals:
  /// @param problem empty if the picture was saved.
  void done(int exit_code, const QString& problem);

 private:
  void wait_until_settled();
  void save();

  MainWindow& window_;
  QString file_;
  bool view_only_;
  double glove_time_;  ///< To listen to the glove, s; 0: there is none.
  QTimer poll_;
  int calm_polls_ = 0;
};

}  // namespace handway::gui
