#pragma once

#include "model/planning/optimize_runner.h"
#include "model/planning/plan_settings.h"

#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>

class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QVBoxLayout;

namespace handway::gui {

class ParameterForm;
class PlanningSession;
class PresetBar;

/// Chooses a planner and its settings, starts and stops it, shows how it went.
class PlanPanel : public QWidget {
  Q_OBJECT

 public:
  /// @param settings outlive the panel, which shows and edits them.
  explicit PlanPanel(PlanSettings& settings, QWidget* parent = nullptr);

  /// Shows how the session's runs go, and starts and stops them.
  void follow(PlanningSession& session);
  /// Adds the figures of a result's motion, once they are known. @param history outlives the panel.
  void follow(const PathHistory& history);
  /// Greys out the planners that need what the scene has not.
  void show_planners_that_serve(bool has_basis);
  /// Enters a number into the field of a parameter, if the planner has one of that name and
  /// does not run.
  void enter(const char* key, double value);
  /// Adds a row below the usual settings.
  void add_row(const QString& label, QWidget* row);
  /// Adds a section below the parameters, among the advanced settings.
  void add_section(QWidget* section);
  /// Shows the reason why the path is not valid in the present scene; empty: it is valid.
  void show_validity(const QString& reason);
  [[nodiscard]] PresetBar& presets() const { return *presets_; }

  /// Sets whether planning is possible and, if not, the reason.
  void set_ready(bool ready, const QString& why_not = {});
  /// Sets whether there is a path that can be optimised.
  void set_optimizable(bool optimizable);

 signals:
  void plan_requested();
  void optimize_requested();
  void cancel_requested();
  void runs_requested();

 private:
  QWidget* make_settings();
  QWidget* make_advanced();
  QWidget* make_seeds();
  QWidget* make_actions();
  QWidget* make_results();
  QWidget* make_optimizing();
  void connect_settings();
  void show_request();
  /// Rebuilds the form of the chosen planner. @param from_defaults presets begin with the planner's
  /// own values.
  void rebuild_form(bool from_defaults);
  void show_running();
  /// Shows the present activity and its elapsed time.
  void show_elapsed();
  void show_optimizing();
  void show_optimize_progress(const OptimizeProgress& progress);
  void show_progress(double fraction, const QString& activity);
  /// Shows how many of several seeds are done, and how many of them found a path.
  void show_seeds(int done, int solved);
  /// @param note to be said first; may be empty.
  void show_result(const planning::PlanResult& result, const QString& note);
  /// Shows a path that was replanned after an edit of the scene. @param origin source of the path,
  /// one word.
  void show_replanned(const planning::PlanResult& result, const QString& origin);
  void show_failure(const QString& message);
  void begin_run();
  /// Shows which parameters differ from the preset, and offers its values if no planner runs.
  void show_modified();
  /// Shows the controls that apply to one seed, or to several.
  void show_whether_several();
  void end_run();

  PlanSettings& settings_;
  QComboBox* planners_;
  QLabel* description_;
  QSpinBox* seed_;
  QSpinBox* seeds_;
  QComboBox* merit_;
  QDoubleSpinBox* time_limit_;
  QDoubleSpinBox* margin_;
  QSpinBox* threads_;
  PresetBar* presets_;
  QLabel* modified_;
  QPushButton* reset_;
  QWidget* changes_;  ///< The row of the last two.
  QVBoxLayout* form_place_;
  QVBoxLayout* sections_;
  QFormLayout* usual_;
  ParameterForm* form_ = nullptr;  ///< Form of the chosen planner, or null.
  QPushButton* plan_;
  QPushButton* cancel_;
  QWidget* optimizing_;  ///< The row of the next two.
  QPushButton* optimize_;
  QDoubleSpinBox* optimize_limit_;
  QProgressBar* progress_;
  QLabel* missing_;  ///< Reason why planning is impossible.
  QLabel* validity_;
  QLabel* result_;
  QPushButton* all_runs_;
  /// The result that is shown, and the note before it.
  struct Shown {
    planning::PlanResult result;
    QString note;
  };
  std::optional<Shown> shown_;  ///< Empty while a planner runs, and for other texts.
  QString activity_;            ///< Activity of the running planner, or empty.
  QElapsedTimer since_start_;
  QTimer clock_;
  bool ready_ = false;
};

}  // namespace handway::gui
