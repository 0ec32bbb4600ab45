#pragma once

#include "handway/planning/extensions/plugin.h"
#include "model/jobs/background.h"

#include <QDateTime>
#include <QLockFile>
#include <QObject>
#include <QString>

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace handway::gui {

/// Data kept of a scene with unsaved changes.
struct UnsavedScene {
  planning::SceneState loaded;
  geometric::Configuration shown;  ///< Configuration of the first robot.
  geometric::PlannerRequest planner;
  std::filesystem::path file;  ///< File it was opened from; may be empty.
  QString name;                ///< Displayed name.
};

/// A scene that a window left behind when its program ended in the middle of work.
struct LostScene {
  std::filesystem::path folder;  ///< Folder of that window.
  std::filesystem::path scene;   ///< To be opened instead of `file`.
  std::filesystem::path file;
  QString name;
  QDateTime time;  ///< Time of the last change.
};

/// Saves a copy of the scene with its unsaved changes in a folder of this window, written in
/// the background and replaced as a whole. The folder is removed when the window closes
/// normally; otherwise it is found at the next start.
class Autosave : public QObject {
  Q_OBJECT

 public:
  /// @param folder of all windows; made if there is none.
  explicit Autosave(std::filesystem::path folder, QObject* parent = nullptr);
  ~Autosave() override;

  /// The user's folder for it.
  [[nodiscard]] static std::filesystem::path default_folder();

  /// Writes `scene` soon; one that still waits is dropped.
  /// @param then_forget left by another window; removed when `scene` is safe.
  void store(UnsavedScene scene, const std::optional<LostScene>& then_forget = std::nullopt);
  /// Removes the copy, as there are no unsaved changes any more.
  void clear();

  /// Returns the scenes that windows which ended have left, the newest first.
  [[nodiscard]] std::vector<LostScene> find_lost() const;
  static void forget(const LostScene& lost);

 signals:
  void stored();
  void failed(const QString& message);

 private:
  /// @param scene nothing: none is kept.
  void keep(std::optional<UnsavedScene> scene, const std::optional<LostScene>& then_forget);

  std::filesystem::path all_;
  std::filesystem::path folder_;
  std::unique_ptr<QLockFile> lock_;
  std::optional<LostScene> to_forget_;  ///< By what is written next.
  std::unique_ptr<LatestJob> job_;
};

}  // namespace handway::gui
