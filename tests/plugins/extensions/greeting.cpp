#include "handway/planning/extensions/plugin.h"

namespace {

using handway::planning::Importer;
using handway::planning::SceneState;

// Makes an empty scene called as the file says.
class GreetingImporter final : public Importer {
 public:
  std::string name() const override { return "greetings (.hello)"; }
  bool can_read(const std::filesystem::path& file) const override {
    return file.extension() == ".hello";
  }
  SceneState read(const std::filesystem::path& file) const override {
    auto scene = std::make_shared<handway::geometric::Scene>();
    scene->name = "hello " + file.stem().string();
    return {scene, nullptr};
  }
};

}  // namespace

HANDWAY_PLUGIN({.name = "greeting",
                .version = "1.2",
                .register_planners =
                    [](handway::planning::PlannerRegistry& registry) {
                      registry.add("hello-planner", [] { return nullptr; });
                    },
                .make_importer = []() -> std::unique_ptr<Importer> {
                  return std::make_unique<GreetingImporter>();
                }});
