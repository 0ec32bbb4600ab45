#include "workers/scene_loader.h"

#include <exception>
#include <functional>
#include <utility>

namespace handway::gui {

SceneLoader::SceneLoader(std::shared_ptr<const planning::Extensions> extensions, QObject* parent)
    : QObject(parent), extensions_(std::move(extensions)) {}

SceneLoader::~SceneLoader() = default;

void SceneLoader::load(const std::filesystem::path& file) {
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
  threads_.run([this, file, deliver, extensions = extensions_] {
    try {
      const planning::LoadedScene scene = planning::load_scene(file, *extensions);
      deliver([this, scene] { emit loaded(scene); });
    } catch (const std::exception& error) {
      deliver([this, message = QString::fromUtf8(error.what())] { emit failed(message); });
    }
  });
}

}  // namespace handway::gui
