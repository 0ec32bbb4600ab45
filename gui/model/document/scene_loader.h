#pragma once

#include "handway/planning/core/plugin.h"
#include "model/jobs/background_threads.h"

#include <QObject>
#include <QString>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace handway::gui {

/// Reads scene files off the GUI thread.
class SceneLoader : public QObject {
  Q_OBJECT

 public:
  explicit SceneLoader(std::shared_ptr<const planning::Extensions> extensions,
                       QObject* parent = nullptr);
  ~SceneLoader() override;

  /// Reads `file`, without waiting; what an earlier call is still reading is dropped.
  void load(const std::filesystem::path& file);

  /// Makes a new scene with a robot of the library in the same way.
  void create(const std::string& robot);

 signals:
  void loaded(const handway::planning::LoadedScene& scene);
  /// @param message one sentence for a person.
  void failed(const QString& message);

 private:
  void run(std::function<planning::LoadedScene()> read);

  std::shared_ptr<const planning::Extensions> extensions_;
  int generation_ = 0;
  BackgroundThreads threads_;
};

}  // namespace handway::gui
