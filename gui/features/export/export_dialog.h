#pragma once

#include "features/export/export_runner.h"
#include "model/planning/timing_runner.h"

#include <QDialog>
#include <QTimer>

class QCheckBox;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;

namespace handway::gui {

class Document;
class MotionPreview;
struct SceneState;

/// Exports a path for a controller: format, timing, a preview of all that would be written, and
/// the folder. What fails the pre-flight can't be exported, nor what was timed before an edit.
class ExportDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param document outlives it. @param path of its robot. @param name of the scene, for files.
  ExportDialog(std::shared_ptr<const planning::Extensions> extensions, Document& document,
               planning::Path path, const QString& name, QWidget* parent = nullptr);

  /// Leaves the choice as it is if there is no such exporter.
  void choose_format(const std::string& name);
  void set_folder(const QString& folder);

 signals:
  void exported(const QStringList& files);

 private:
  QWidget* make_settings();
  QWidget* make_destination();
  [[nodiscard]] std::string format() const;
  void take_edit(const SceneState& before);
  void time_again();
  void export_now();
  [[nodiscard]] planning::ExportOptions options() const;
  void show_problem(const QString& message);

  std::shared_ptr<const planning::Extensions> extensions_;
  Document& document_;
  planning::Path path_;
  TimingRunner timing_;
  ExportRunner export_;
  QTimer settle_;  ///< Settings are timed when they have been left alone for a moment.
  DerivedMotion motion_;
  QListWidget* formats_;
  QLineEdit* name_;
  QDoubleSpinBox* speed_;
  QDoubleSpinBox* period_;
  QCheckBox* arcs_;
  QDoubleSpinBox* deviation_;
  QCheckBox* any_robot_;  ///< Shown where the format objects to the robot.
  MotionPreview* preview_;
  QLineEdit* folder_;
  QPushButton* export_button_;
  QLabel* problem_text_;
};

}  // namespace handway::gui
