#pragma once

#include "handway/planning/extensions/exporter.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/timing/time_path.h"
#include "handway/planning/timing/timing_settings.h"
#include "model/jobs/background.h"
#include "model/planning/motion_source.h"
#include "model/planning/timing_runner.h"

#include <QDialog>
#include <QObject>
#include <QString>
#include <QTimer>
#include <QWidget>

#include <memory>
#include <optional>
#include <vector>

class QCheckBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;

namespace handway::planning {
struct SceneState;
}

namespace handway::gui {

class Document;
class MotionPreview;
class ParameterForm;
class Workbench;

/// Makes and writes the files of a motion off the GUI thread. Only the answer to the latest
/// request counts.
class ExportRunner : public QObject {
  Q_OBJECT

 public:
  using Files = std::vector<planning::ExportedFile>;

  explicit ExportRunner(std::shared_ptr<const planning::PluginManager> plugins,
                        QObject* parent = nullptr);

  /// Makes the files; prepared() or failed() follows.
  /// @param format name of an exporter. @pre the motion is cleared().
  void prepare(const std::string& format, std::shared_ptr<const planning::TimedPath> motion,
               const planning::ExportOptions& options);
  /// Writes them; written() or failed() follows.
  void write(const std::string& format, std::shared_ptr<const planning::TimedPath> motion,
             std::filesystem::path folder, const planning::ExportOptions& options);
  /// No answer is wanted any more.
  void forget() { job_.cancel(); }

 signals:
  void prepared(const std::shared_ptr<const handway::gui::ExportRunner::Files>& files);
  void written(const QStringList& files);
  void failed(const QString& message);

 private:
  std::shared_ptr<const planning::PluginManager> plugins_;
  LatestJob job_;
};

/// Dialog to export a path or another motion for a controller: format, timing, a preview of the
/// files, and the folder. Motions that fail the pre-flight check, or that were timed before an
/// edit, can't be exported; those that keep too little clearance only if that is confirmed. The
/// dialog stays open for other formats, and lists what was written.
class ExportDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param document outlives it. @param path of its robot. @param name of the scene, for files.
  ExportDialog(std::shared_ptr<const planning::PluginManager> plugins, Document& document,
               planning::Path path, const QString& name, QWidget* parent = nullptr);
  /// Exports the motion of a source; the dialog closes when the scene is edited.
  /// @param document outlives it; it is that of the source.
  ExportDialog(std::shared_ptr<const planning::PluginManager> plugins, Document& document,
               const DerivedSource& source, QWidget* parent = nullptr);

  /// Chooses the exporter of this name; without such an exporter, the choice is unchanged.
  void choose_format(const std::string& name);
  void set_folder(const QString& folder);
  /// Sets the clearance that has to remain beyond the robot's following error, m.
  void set_margin(double margin);

 signals:
  void exported(const QStringList& files);

 private:
  ExportDialog(std::shared_ptr<const planning::PluginManager> plugins, Document& document,
               planning::Path path, std::optional<DerivedSource> source, const QString& title,
               const QString& name, QWidget* parent);
  QWidget* make_settings();
  QWidget* make_destination();
  [[nodiscard]] std::string format() const;
  void take_edit(const planning::SceneState& before);
  void time_again();
  void export_now();
  /// Returns whether the motion may be exported: cleared, and confirmed where it is too close.
  [[nodiscard]] bool is_allowed() const;
  void update_button();
  [[nodiscard]] planning::ExportOptions options() const;
  void show_problem(const QString& message);
  void show_written(const QStringList& files);

  std::shared_ptr<const planning::PluginManager> plugins_;
  Document& document_;
  planning::Path path_;
  std::optional<DerivedSource> source_;  ///< Instead of the path.
  TimingRunner timing_;
  ExportRunner export_;
  QTimer settle_;  ///< Settings are timed when they have been left alone for a moment.
  DerivedMotion motion_;
  bool has_files_ = false;  ///< The motion's files are made.
  planning::SafetyMargin safety_;
  QListWidget* formats_;
  QLineEdit* name_;
  planning::TimingSettings timing_settings_;
  ParameterForm* timing_form_;
  QCheckBox* any_robot_;  ///< Shown where the format objects to the robot.
  QCheckBox* too_close_;  ///< Shown where the motion keeps too little clearance.
  MotionPreview* preview_;
  QLineEdit* folder_;
  QPushButton* export_button_;
  QLabel* problem_text_;
  QListWidget* written_;  ///< Exports so far, the latest first.
  QPushButton* open_folder_;
};

/// Adds the commands that export the path and pictures of it.
void add_export(Workbench& workbench);

}  // namespace handway::gui
