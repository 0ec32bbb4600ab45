#include "app/document.h"

#include "app/save_scene.h"

#include <utility>

namespace handway::gui {

Document::Document(std::shared_ptr<const planning::Extensions> extensions, QObject* parent)
    : QObject(parent), loader_(std::move(extensions)) {
  connect(&loader_, &SceneLoader::loaded, this, [this](const planning::LoadedScene& scene) {
    file_ = requested_;
    set_scene(scene);
  });
  connect(&loader_, &SceneLoader::failed, this, &Document::open_failed);
}

const geometric::RobotInstance* Document::robot() const {
  return loaded_.scene && !loaded_.scene->robots.empty() ? &loaded_.scene->robots.front() : nullptr;
}

void Document::open(const std::filesystem::path& file) {
  requested_ = file;
  emit opening(QString::fromStdString(file.string()));
  loader_.load(file);
}

void Document::save(const std::filesystem::path& file, const geometric::PlannerChoice& planner) {
  save_scene(loaded_, q_, planner, file);
  file_ = file;
}

void Document::set_scene(planning::LoadedScene scene) {
  loaded_ = std::move(scene);
  problem_.reset();
  groups_ = {};
  palm_ = 0;
  q_ = {};
  if (const geometric::RobotInstance* first = robot()) {
    groups_ = joint_groups(*first->model, loaded_.basis.get());
    palm_ = palm_link(*first->model, groups_);
    q_ = first->configuration;
    problem_ = std::make_shared<const PreparedProblem>(loaded_, threads_);
  }
  emit opened();
  if (robot()) {
    emit configuration_changed(q_);
  }
}

void Document::set_configuration(const geometric::Configuration& q) {
  if (robot()) {
    q_ = q;
    emit configuration_changed(q_);
  }
}

void Document::apply_posture(const geometric::NamedPosture& posture) {
  if (!robot()) {
    return;
  }
  geometric::Configuration q = q_;
  for (const auto& [joint, value] : posture.values) {
    if (const auto variable = robot()->model->find_variable(joint)) {
      q[*variable] = value;
    }
  }
  set_configuration(q);
}

}  // namespace handway::gui
