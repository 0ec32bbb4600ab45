#pragma once

#include "handway/planning/extensions/exporter.h"
#include "handway/planning/timing/time_path.h"

#include <QObject>
#include <QString>
#include <QWidget>

#include <string>
#include <vector>

class QLabel;
class QListWidget;
class QPlainTextEdit;
class QTabWidget;

namespace handway::gui {

class TimePlot;

/// Preview of an export: its pre-flight report, the velocities of the joints, and the files.
class MotionPreview : public QWidget {
  Q_OBJECT

 public:
  explicit MotionPreview(QWidget* parent = nullptr);

  void show_waiting(const QString& text);
  /// @param warnings about parts of the motion that the files will lack.
  void show_motion(const planning::TimedPath& motion, const std::vector<std::string>& warnings);
  void show_files(std::vector<planning::ExportedFile> files);

 private:
  void show_velocities(const planning::Motion& motion);
  void show_file(int row);

  QTabWidget* tabs_;
  QLabel* report_;
  TimePlot* arm_;
  TimePlot* hand_;
  QListWidget* names_;
  QPlainTextEdit* content_;
  std::vector<planning::ExportedFile> files_;
};

}  // namespace handway::gui
