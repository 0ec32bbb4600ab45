#pragma once

#include "handway/planning/planners/planner.h"

#include <QObject>
#include <QString>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace handway::gui {

/// A named set of a planner's parameters.
struct PlannerPreset {
  QString name;
  /// Purpose, one sentence; empty for a user's own.
  QString purpose;
  /// Keys and values that differ from the planner's own, in any order.
  std::vector<std::pair<std::string, std::string>> settings;
  bool is_built_in = false;
};

/// The presets that come with the program for a planner: first the planner's own values. Values of
/// the paper's planners are those of its Table 3; what the others change is worth its time on the
/// scenes that ship (docs/planning.md).
[[nodiscard]] std::vector<PlannerPreset> built_in_presets(const std::string& planner);

/// Gives `planner` the preset's values, and every other parameter that of `fresh`, a planner of the
/// same kind with its own values.
/// @throws InputError naming a key or value that the planner does not know; nothing is changed
/// then.
void apply_preset(const PlannerPreset& preset, planning::Planner& fresh,
                  planning::Planner& planner);

/// Returns whether `planner` has the values that apply_preset() would give it; false for one that
/// can't be applied.
[[nodiscard]] bool has_values_of(const PlannerPreset& preset, planning::Planner& fresh,
                                 planning::Planner& planner);

/// The presets that there are for each planner: those that come with the program, and a person's
/// own, which are kept in `presets.yaml` beside the other settings.
///
/// A file that can't be understood is left as it is and reported; with the first preset that is
/// saved after that it is put aside, under another name, so that nothing in it is lost.
class PresetStore : public QObject {
  Q_OBJECT

 public:
  /// Reads what is kept.
  explicit PresetStore(QObject* parent = nullptr);

  /// Returns the presets that ship first, then the user's own by name.
  [[nodiscard]] std::vector<PlannerPreset> of(const std::string& planner) const;
  /// Returns the error in the file; empty if there is none.
  [[nodiscard]] const QString& fault() const { return fault_; }
  [[nodiscard]] static std::filesystem::path file();

  /// Saves a preset, or replaces the user's own one of that name.
  /// @throws InputError if it can't be written, or the name is blank or that of a preset that
  /// ships.
  void save(const std::string& planner, const PlannerPreset& preset);
  /// @throws InputError as save() does, and if there is one of the new name already.
  void rename(const std::string& planner, const QString& name, const QString& new_name);
  /// @throws InputError if it can't be written.
  void remove(const std::string& planner, const QString& name);

 signals:
  void changed();

 private:
  struct Entry {
    std::string planner;
    PlannerPreset preset;
  };
  using Entries = std::vector<Entry>;

  void read();
  [[nodiscard]] static Entries read_entries();
  /// Writes all of them; what another window has kept meanwhile is among them.
  void change(const std::function<void(Entries&)>& edit);
  static void refuse_name(const std::string& planner, const QString& name);

  Entries entries_;
  QString fault_;
};

}  // namespace handway::gui
