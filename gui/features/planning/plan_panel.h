#pragma once

#include "handway/planning/core/planner.h"
#include "handway/planning/core/planner_registry.h"
#include "model/planning/optimize_runner.h"
#include "model/planning/path_figures.h"

#include <QWidget>

#include <memory>
#include <string>
#include <vector>

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QVBoxLayout;

namespace handway::gui {

class ParameterForm;
class PresetBar;

/// Chooses a planner and its settings, starts and stops it, shows how it went.
class PlanPanel : public QWidget {
  Q_OBJECT

 public:
  /// @param registry outlives the panel.
  explicit PlanPanel(const planning::PlannerRegistry& registry, QWidget* parent = nullptr);

  /// Takes over a scene's wishes: its planner with its settings.
  /// @throws InputError if it names an unknown planner, key or value.
  void apply(const geometric::PlannerChoice& choice);
  /// Chooses a planner with its defaults, keeping settings if it is chosen already.
  /// @throws InputError if there is none of that name.
  void choose_planner(const std::string& name);
  /// Greys out the planners that need what the scene has not.
  void show_planners_that_serve(bool has_basis);
  /// Sets KEY=VALUE of the chosen planner. @throws InputError
  void set_parameter(const std::string& key, const std::string& value);
  /// Enters a number into the field of a parameter, if the planner has one of that name and
  /// does not run.
  void enter(const char* key, double value);
  /// Puts something below the parameters.
  void add_section(QWidget* section);
  /// Why the path that was found is not valid in the scene as it is; empty: it is.
  void show_validity(const QString& reason);
  void set_seed(std::uint64_t seed);
  /// Seed and time limit as they were; one seed.
  void restore(const planning::PlanRequest& request);
  /// How many seeds are planned with, from the seed on.
  void set_seeds(int seeds);
  /// The planner of scenes that name none; one that does not exist: the registry's first.
  void set_usual_planner(const std::string& name);
  /// @param threads 0: one a processor.
  void set_threads(int threads);
  /// @param seconds 0: none.
  void set_time_limit(double seconds);

  [[nodiscard]] const std::shared_ptr<planning::Planner>& planner() const { return planner_; }
  /// So many planners like the chosen one.
  [[nodiscard]] std::vector<std::shared_ptr<planning::Planner>> copies(int count) const;
  [[nodiscard]] planning::PlanRequest request() const;
  [[nodiscard]] int seeds() const;
  /// For how long a path is optimised at most, s; infinite: until it is stopped.
  [[nodiscard]] double optimize_limit() const;
  /// By which the best of several seeds' paths is told.
  [[nodiscard]] PathMerit merit() const;
  /// The chosen planner with the settings that differ from its defaults.
  [[nodiscard]] geometric::PlannerChoice choice() const;
  [[nodiscard]] PresetBar& presets() const { return *presets_; }

  /// Whether there is something to plan, and if not, why.
  void set_ready(bool ready, const QString& why_not = {});
  /// Whether there is a path that optimising can go on with.
  void set_optimizable(bool optimizable);
  void show_running();
  void show_optimizing();
  void show_optimizing(const OptimizeProgress& progress);
  void show_progress(double fraction, const QString& activity);
  /// Of several seeds, so many are done, of which so many found a path.
  void show_seeds(int done, int solved);
  /// @param note to be said first; may be empty.
  void show_result(const planning::PlanResult& result, const QString& note = {});
  /// Of a path that follows the edits of its scene. @param way where it came from, one word.
  void show_replanned(const planning::PlanResult& result, const QString& way);
  void show_failure(const QString& message);
  void clear_result();

 signals:
  void plan_requested();
  void optimize_requested();
  void cancel_requested();
  void runs_requested();
  /// Another planner, or another value of a parameter.
  void settings_changed();

 private:
  QWidget* make_settings();
  QWidget* make_seeds();
  QWidget* make_actions();
  QWidget* make_optimizing();
  void begin_run();
  void use_planner(const std::string& name);
  /// @param anew presets begin with the planner's own values.
  void rebuild_form(bool anew);
  /// Says which parameters differ from the preset, and offers its values if no planner runs.
  void show_modified();
  /// What makes sense with one seed, or with several.
  void show_whether_several();
  void end_run();

  const planning::PlannerRegistry& registry_;
  std::shared_ptr<planning::Planner> planner_;
  QComboBox* planners_;
  QLabel* description_;
  QSpinBox* seed_;
  QSpinBox* seeds_;
  QComboBox* merit_;
  QDoubleSpinBox* time_limit_;
  QDoubleSpinBox* margin_;
  QSpinBox* threads_;
  std::string usual_planner_;
  PresetBar* presets_;
  QLabel* modified_;
  QPushButton* reset_;
  QVBoxLayout* form_place_;
  QVBoxLayout* sections_;
  ParameterForm* form_ = nullptr;  ///< Of the chosen planner; null if there is none.
  QPushButton* plan_;
  QPushButton* cancel_;
  QWidget* optimizing_;  ///< The row of the next two.
  QPushButton* optimize_;
  QDoubleSpinBox* optimize_limit_;
  QProgressBar* progress_;
  QLabel* validity_;
  QLabel* result_;
  QPushButton* all_runs_;
  bool ready_ = false;
};

}  // namespace handway::gui
