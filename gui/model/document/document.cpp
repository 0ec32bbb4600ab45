#include "model/document/document.h"

#include "model/document/save_scene.h"

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

using geometric::RobotInstance;

planning::Revision after_edit(planning::Revision revision, const geometric::Scene& before,
                              const geometric::Scene& after) {
  ++revision.scene;
  const auto same_model = [](const RobotInstance& a, const RobotInstance& b) {
    return a.model == b.model;
  };
  const auto same_robot = [](const RobotInstance& a, const RobotInstance& b) {
    return a.model == b.model && a.name == b.name && a.X_WB.matrix() == b.X_WB.matrix();
  };
  revision.robot += std::ranges::equal(before.robots, after.robots, same_robot) ? 0 : 1;
  revision.limits += std::ranges::equal(before.robots, after.robots, same_model) ? 0 : 1;
  return revision;
}

}  // namespace

Document::Document(std::shared_ptr<const planning::Extensions> extensions, QObject* parent)
    : QObject(parent), loader_(std::move(extensions)) {
  connect(&loader_, &SceneLoader::loaded, this,
          [this](const planning::LoadedScene& scene) { set_scene(scene, requested_); });
  connect(&loader_, &SceneLoader::failed, this, &Document::open_failed);
}

const geometric::RobotInstance* Document::robot() const {
  return scene() && !scene()->robots.empty() ? &scene()->robots.front() : nullptr;
}

void Document::open(const std::filesystem::path& file) { open_copy(file, file); }

void Document::open_copy(const std::filesystem::path& copy, const std::filesystem::path& file) {
  requested_ = file;
  emit opening(QString::fromStdString(copy.string()));
  loader_.load(copy);
}

void Document::create(const std::string& robot) {
  requested_.clear();
  emit opening(QString::fromStdString(robot));
  loader_.create(robot);
}

void Document::save(const std::filesystem::path& file, const geometric::PlannerChoice& planner) {
  save_scene(loaded_, q_, planner, file);
  file_ = file;
}

void Document::set_scene(planning::LoadedScene scene, const std::filesystem::path& file) {
  hide_measured();
  loaded_ = std::move(scene);
  state_ = {loaded_.scene};
  revision_ = {revision_.scene + 1, revision_.robot + 1, revision_.basis + 1, revision_.limits + 1};
  file_ = file;
  problem_.reset();
  groups_ = {};
  palm_ = 0;
  q_ = {};
  if (const geometric::RobotInstance* first = robot()) {
    groups_ = joint_groups(*first->model, loaded_.basis.get());
    palm_ = palm_link(*first->model, groups_);
    q_ = first->configuration;
    problem_ = std::make_shared<const PreparedProblem>(loaded_, revision_, preparations_);
  }
  recorded_hand_.set_basis(loaded_.basis);
  emit opened();
  if (robot()) {
    emit configuration_changed(q_);
  }
}

void Document::set_state(SceneState state) {
  const SceneState before = std::exchange(state_, std::move(state));
  if (before.scene != state_.scene) {
    loaded_.scene = state_.scene;
    revision_ = after_edit(revision_, *before.scene, *state_.scene);
    if (robot()) {
      problem_ = std::make_shared<const PreparedProblem>(loaded_, revision_, preparations_,
                                                         problem_.get());
    }
  }
  emit edited(before);
  if (robot() && before.scene != state_.scene) {
    emit configuration_changed(q_);
  }
}

// What has been dragged is put back where it is shown.
void Document::set_configuration(const geometric::Configuration& q) {
  if (robot()) {
    q_ = shows_measured_ ? q_ : q;
    emit configuration_changed(q_);
  }
}

void Document::show_measured(const geometric::Configuration& q) {
  if (!robot()) {
    return;
  }
  q_ = q;
  if (!std::exchange(shows_measured_, true)) {
    emit measured_shown(true);
  }
  emit configuration_changed(q_);
}

void Document::hide_measured() {
  if (std::exchange(shows_measured_, false)) {
    emit measured_shown(false);
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
