#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/planners/planner.h"
#include "model/document/scene_editor.h"
#include "model/planning/path_history.h"

#include <QObject>
#include <QString>
#include <QTimer>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace handway::gui {

/// All that a run is asked for, to be kept and put back.
struct PlanChoices {
  geometric::PlannerRequest planner;  ///< With what differs from its defaults.
  planning::PlanRequest request;      ///< Seed, threads, time limit and margin.
  int seeds = 1;
  PathMerit merit = kPathMerits.front();
  double optimize_limit = 0.0;  ///< s
};

/// Settings of the next run: a planner with its parameters, seeds, limits.
class PlanSettings : public QObject {
  Q_OBJECT

 public:
  /// Begins with the registry's first planner. @param registry outlives the settings.
  explicit PlanSettings(const planning::PlannerRegistry& registry, QObject* parent = nullptr);

  [[nodiscard]] const planning::PlannerRegistry& registry() const { return registry_; }
  /// Returns the chosen planner; null if there is none. After changing its parameters, call
  /// announce_parameters().
  [[nodiscard]] const std::shared_ptr<planning::Planner>& planner() const { return planner_; }
  /// Returns this number of planners like the chosen one.
  [[nodiscard]] std::vector<std::shared_ptr<planning::Planner>> copies(int count) const;
  /// The chosen planner with the settings that differ from its defaults.
  [[nodiscard]] geometric::PlannerRequest choice() const;

  /// Applies a scene's planner with its settings.
  /// @throws InputError if it names an unknown planner, key or value.
  void apply(const geometric::PlannerRequest& choice);
  /// Resets to the initial settings of a scene: one seed, 1, no margin, and the usual time limit
  /// and threads.
  void begin_scene();
  /// Chooses a planner with its defaults. @throws InputError if there is none of that name.
  void use_planner(const std::string& name);
  /// Chooses a planner, but keeps the settings if it is chosen already.
  void choose_planner(const std::string& name);
  /// Sets KEY=VALUE of the chosen planner. @throws InputError
  void set_parameter(const std::string& key, const std::string& value);
  /// The planner of scenes that name none; one that does not exist: the registry's first.
  void set_usual_planner(const std::string& name);
  void announce_parameters() { emit parameters_changed(); }

  /// Seed, threads, time limit and margin.
  [[nodiscard]] const planning::PlanRequest& request() const { return request_; }
  void set_seed(std::uint64_t seed);
  /// Sets the threads for this scene, and for scenes that are opened from now on.
  void set_usual_threads(int threads);
  void set_usual_time_limit(double seconds);
  /// @param threads 0: one a processor.
  void set_threads(int threads);
  /// @param seconds 0: none.
  void set_time_limit(double seconds);
  void set_margin(double metres);
  /// Seed, time limit and margin as they were; one seed.
  void restore(const planning::PlanRequest& request);

  /// Returns the number of seeds to plan with, beginning with the seed.
  [[nodiscard]] int seeds() const { return seeds_; }
  void set_seeds(int seeds);
  /// Returns the criterion for the best of several seeds' paths.
  [[nodiscard]] PathMerit merit() const { return merit_; }
  void set_merit(PathMerit merit);
  /// Returns the longest time of optimising, s; infinite: until it is stopped.
  [[nodiscard]] double optimize_limit() const { return optimize_limit_; }
  /// @param seconds 0: until it is stopped.
  void set_optimize_limit(double seconds);
  [[nodiscard]] PlanChoices choices() const;
  void put_back(const PlanChoices& choices);
  /// The preset in words: "Fast", or "Fast, modified".
  [[nodiscard]] const QString& preset() const { return preset_; }
  void set_preset(const QString& words) { preset_ = words; }

 signals:
  /// Emitted when the planner has changed, or its parameters were set from outside its form.
  /// @param from_defaults presets begin with the planner's own values.
  void planner_changed(bool from_defaults);
  /// Emitted when the planner or the value of a parameter has changed.
  void parameters_changed();
  /// Emitted when a setting other than planner and parameters has changed.
  void request_changed();

 private:
  /// Stores `value` in `member`, and announces a change.
  template <typename Value>
  void keep(Value& member, const Value& value) {
    if (member != value) {
      member = value;
      emit request_changed();
    }
  }

  static constexpr double kUsualTimeLimit = 300.0;     // s
  static constexpr double kUsualOptimizeLimit = 10.0;  // s

  const planning::PlannerRegistry& registry_;
  std::shared_ptr<planning::Planner> planner_;
  std::string usual_planner_;
  planning::PlanRequest request_;
  int seeds_ = 1;
  PathMerit merit_ = kPathMerits.front();
  double optimize_limit_ = kUsualOptimizeLimit;
  double usual_time_limit_ = kUsualTimeLimit;
  int usual_threads_ = 0;
  QString preset_;
};

/// Puts the user's changes of the planner and its settings onto the undo stack, one entry for all
/// that changes at once. They don't count as unsaved work.
class SettingsHistory : public QObject {
  Q_OBJECT

 public:
  /// The settings and the editor outlive it.
  SettingsHistory(PlanSettings& settings, SceneEditor& editor, QObject* parent = nullptr);

  /// The settings as they are now are those to begin with, as of a scene that was opened.
  void begin();

 private:
  void note_change();

  PlanSettings& settings_;
  SceneEditor& editor_;
  PlanChoices before_;
  QTimer soon_;
};

}  // namespace handway::gui
