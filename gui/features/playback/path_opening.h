#pragma once

#include "model/jobs/background.h"

#include <QObject>
#include <QString>

class QAction;

namespace handway::gui {

class Workbench;

/// Opens paths of files, to be played, checked, exported and run as if they had been planned: with
/// a command, with a drop on the window, or with the program's options.
class PathOpening : public QObject {
  Q_OBJECT

 public:
  /// @param workbench outlives it.
  explicit PathOpening(Workbench& workbench);

  /// Reads the file in the background and shows its path, or says why it can't.
  void open(const QString& file);

 private:
  void ask();
  void update_action();
  void open_wanted();
  void refuse(const QString& message);

  Workbench& workbench_;
  QAction* action_;
  LatestJob job_;
};

}  // namespace handway::gui
