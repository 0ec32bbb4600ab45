#include "model/document/scene_loader.h"

#include "model/document/new_scene.h"
#include "model/meshes/shaded_meshes.h"

#include <exception>
#include <functional>
#include <utility>

namespace handway::gui {

SceneLoader::SceneLoader(std::shared_ptr<const planning::Extensions> extensions, QObject* parent)
    : QObject(parent), extensions_(std::move(extensions)) {}

SceneLoader::~SceneLoader() = default;

void SceneLoader::load(const std::filesystem::path& file) {
  run([file, extensions = extensions_] { return planning::load_scene(file, *extensions); });
}

void SceneLoader::create(const std::string& robot) {
  run([robot, extensions = extensions_] { return new_scene(robot, *extensions); });
}

void SceneLoader::run(std::function<planning::LoadedScene()> read) {
  const int generation = ++generation_;
  const auto deliver = [this, generation](std::function<void()> report) {
    QMetaObject::invokeMethod(
        this,
        [this, generation, report = std::move(report)] {
          if (generation == generation_) {
            report();
          }
        },
        Qt::QueuedConnection);
  };
  threads_.run([this, deliver, read = std::move(read)] {
    try {
      const planning::LoadedScene scene = read();
      shade_meshes(*scene.scene);
      deliver([this, scene] { emit loaded(scene); });
    } catch (const std::exception& error) {
      deliver([this, message = QString::fromUtf8(error.what())] { emit failed(message); });
    }
  });
}

}  // namespace handway::gui
