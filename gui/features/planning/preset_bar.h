#pragma once

#include "handway/planning/planners/planner.h"
#include "model/planning/preset_store.h"

#include <QWidget>

#include <functional>
#include <memory>
#include <string>
#include <vector>

class QAction;
class QComboBox;
class QToolButton;

namespace handway::gui {

/// Chooses among the presets of a planner, and keeps what a person has set up as one.
class PresetBar : public QWidget {
  Q_OBJECT

 public:
  /// @param registry outlives the bar.
  explicit PresetBar(const planning::PlannerRegistry& registry, QWidget* parent = nullptr);

  /// Offers the presets of another planner, or the same with other values; chooses the first that
  /// has its values, or else, if `reset`, the planner's own, or else stays with what is chosen.
  /// @param planner outlives this or the next call.
  void show_planner(planning::Planner& planner, bool reset);
  /// Returns whether the planner's values differ from those of the chosen preset.
  [[nodiscard]] bool is_modified() const { return modified_; }
  /// The parameters that differ from what is chosen.
  [[nodiscard]] std::vector<std::string> modified_keys() const;
  /// Returns the displayed name: "Fast", or "Fast, modified".
  [[nodiscard]] QString words() const;
  /// Compares with the preset; call this whenever the value of a parameter has changed.
  void look_again();
  /// Gives the planner the values of the chosen preset.
  void restore();
  [[nodiscard]] const PresetStore& store() const { return store_; }

  /// Carries out the menu's command once there is a name. @throws InputError
  void save_as(const QString& name);
  void rename(const QString& name);
  void remove();

 signals:
  /// The planner has the values of a preset.
  void applied();
  /// Emitted when another preset is chosen, or its values change.
  void changed();
  void failed(const QString& title, const QString& message);

 private:
  void fill();
  void choose(const QString& name);
  [[nodiscard]] const PlannerPreset& chosen() const;
  void apply(const QString& name);
  void ask_to_save();
  void ask_for_other_name();
  /// Runs a function that may throw, and reports its error.
  void attempt(const QString& title, const std::function<void()>& what);

  const planning::PlannerRegistry& registry_;
  PresetStore store_;
  planning::Planner* planner_ = nullptr;
  std::unique_ptr<planning::Planner> fresh_;  ///< Planner of this kind with its default values.
  std::vector<PlannerPreset> presets_;        ///< Presets of the planner, in the list's order.
  std::size_t chosen_ = 0;
  bool modified_ = false;
  QComboBox* list_;
  QToolButton* more_;
  QAction* rename_;
  QAction* remove_;
};

}  // namespace handway::gui
