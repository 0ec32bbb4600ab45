#include "model/document/document.h"

#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/robot/composed_robot.h"
#include "handway/geometric/robot/hand_structure.h"
#include "handway/geometric/setup/mounting.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/core/select_joints.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "model/document/new_scene.h"
#include "model/meshes/shaded_meshes.h"

#include <algorithm>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

namespace handway::gui {

std::vector<geometric::JointIndices> moving_parts(const geometric::RobotModel& model,
                                                  const geometric::JointSelection& joints) {
  std::vector<geometric::JointIndices> parts;
  if (!joints.arm.empty()) {
    parts.push_back(joints.arm);
  }
  const auto carries = [&model](int variable, int other) {
    int link = model.variable_link(other);
    while (link >= 0 && link != model.variable_link(variable)) {
      link = model.parent(link);
    }
    return link >= 0;
  };
  std::vector<geometric::JointIndices> fingers;
  for (const int variable : joints.hand) {
    const auto finger = std::ranges::find_if(fingers, [&](const geometric::JointIndices& part) {
      return std::ranges::any_of(
          part, [&](int other) { return carries(variable, other) || carries(other, variable); });
    });
    if (finger == fingers.end()) {
      fingers.push_back({variable});
    } else {
      finger->push_back(variable);
    }
  }
  parts.insert(parts.end(), fingers.begin(), fingers.end());
  return parts;
}

RecordedHand::RecordedHand(QObject* parent) : QObject(parent) {
  connect(&job_, &LatestJob::failed, this, [this](const QString& message) {
    fault_ = message;
    state_ = State::kFailed;
    emit changed();
  });
}

void RecordedHand::set_basis(std::shared_ptr<const sampling::PmdBasis> basis) {
  if (basis != basis_) {
    basis_ = std::move(basis);
    read();
  }
}

void RecordedHand::choose(const std::filesystem::path& file) {
  if (basis_) {
    chosen_ = file;
    chosen_for_ = basis_->hand;
    read();
  }
}

void RecordedHand::read() {
  job_.cancel();
  postures_.reset();
  fault_.clear();
  const bool has_choice = basis_ && !chosen_.empty() && chosen_for_ == basis_->hand;
  const std::filesystem::path file =
      has_choice ? chosen_ : (basis_ ? basis_->postures : std::filesystem::path());
  state_ = file.empty() ? State::kNone : State::kReading;
  if (state_ == State::kReading) {
    job_.run([this, file, basis = basis_](const std::stop_token&) {
      return [this, read = sampling::load_recorded_postures(*basis, file)] {
        postures_ = read;
        state_ = State::kReady;
        emit changed();
      };
    });
  }
  emit changed();
}

void save_scene(const planning::SceneState& loaded, const geometric::Configuration& shown,
                const geometric::PlannerRequest& planner, const std::filesystem::path& file) {
  geometric::Scene scene = *loaded.scene;
  scene.planner = planner;
  if (!scene.robots.empty()) {
    // A task without a start begins here.
    const geometric::Configuration stood = std::exchange(scene.robots.front().configuration, shown);
    if (!scene.start && (scene.goal || !scene.goal_poses.empty())) {
      scene.start = stood;
    }
  }
  if (loaded.basis && scene.hand_basis.empty()) {
    const std::filesystem::path basis = file.parent_path() / (file.stem().string() + "_hand.yaml");
    sampling::write_pmd_basis(*loaded.basis, basis);
    scene.hand_basis = std::filesystem::absolute(basis);
  }
  geometric::write_scene(scene, file);
}

SceneLoader::SceneLoader(std::shared_ptr<const planning::PluginManager> plugins, QObject* parent)
    : QObject(parent), plugins_(std::move(plugins)) {}

SceneLoader::~SceneLoader() = default;

void SceneLoader::load(const std::filesystem::path& file,
                       const geometric::XacroArguments& arguments) {
  run([file, arguments, plugins = plugins_] {
    return planning::load_scene(file, *plugins, arguments);
  });
}

void SceneLoader::create(const std::string& robot, const std::string& hand) {
  run([robot, hand, plugins = plugins_] { return new_scene(robot, hand, *plugins); });
}

void SceneLoader::run(std::function<planning::SceneState()> read) {
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
  jobs_.run([this, deliver, read = std::move(read)] {
    try {
      const planning::SceneState scene = read();
      shade_meshes(*scene.scene);
      deliver([this, scene] { emit loaded(scene); });
    } catch (const std::exception& error) {
      deliver([this, message = QString::fromUtf8(error.what())] { emit failed(message); });
    }
  });
}

namespace {

using geometric::RobotInstance;

bool has_same_robots(const geometric::Scene& a, const geometric::Scene& b) {
  return std::ranges::equal(a.robots, b.robots, [](const RobotInstance& one, const auto& other) {
    return one.model == other.model && one.name == other.name;
  });
}

// Returns the configuration of the first robot of `after`, with joints that it has in both scenes
// as they are shown.
geometric::Configuration configuration_in(const geometric::Scene& before,
                                          const geometric::Configuration& shown,
                                          const geometric::Scene& after) {
  const RobotInstance& robot = after.robots.front();
  geometric::Configuration q = robot.configuration;
  if (before.robots.empty() || before.robots.front().name != robot.name) {
    return q;
  }
  const geometric::RobotModel& old = *before.robots.front().model;
  for (int v = 0; v < robot.model->variable_count(); ++v) {
    if (const auto variable = old.find_variable(robot.model->variable(v).name)) {
      q[v] = shown[*variable];
    }
  }
  return q;
}

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

Document::Document(std::shared_ptr<const planning::PluginManager> plugins, QObject* parent)
    : QObject(parent), loader_(std::move(plugins)) {
  connect(&loader_, &SceneLoader::loaded, this, [this](const planning::SceneState& scene) {
    stamp_ = requested_stamp_;
    set_scene(scene, requested_);
  });
  connect(&loader_, &SceneLoader::failed, this, &Document::open_failed);
}

const geometric::RobotInstance* Document::robot() const {
  return scene() && !scene()->robots.empty() ? &scene()->robots.front() : nullptr;
}

namespace {

// Returns the stamp of a file; for none, that of a missing file.
FileStamp stamp_of(const std::filesystem::path& file) {
  FileStamp stamp;
  std::error_code missing;
  stamp.time = std::filesystem::last_write_time(file, missing);
  stamp.size = std::filesystem::file_size(file, missing);
  return missing ? FileStamp{} : stamp;
}

}  // namespace

bool Document::is_changed_on_disk() const {
  return !file_.empty() && stamp_of(file_) != stamp_ && std::filesystem::exists(file_);
}

void Document::open(const std::filesystem::path& file, const geometric::XacroArguments& arguments) {
  request(file, file, arguments);
}

void Document::open_copy(const std::filesystem::path& copy, const std::filesystem::path& file) {
  request(copy, file, {});
}

void Document::request(const std::filesystem::path& read, const std::filesystem::path& file,
                       const geometric::XacroArguments& arguments) {
  requested_ = file;
  requested_stamp_ = stamp_of(file);
  emit opening(QString::fromStdString(read.string()));
  loader_.load(read, arguments);
}

void Document::create(const std::string& robot, const std::string& hand) {
  requested_.clear();
  emit opening(QString::fromStdString(robot));
  loader_.create(robot, hand);
}

void Document::close() {
  loader_.cancel();
  requested_.clear();
  set_scene({});
}

void Document::save(const std::filesystem::path& file, const geometric::PlannerRequest& planner) {
  save_scene(loaded_, q_, planner, file);
  file_ = file;
  stamp_ = stamp_of(file);
}

void Document::set_scene(planning::SceneState scene, const std::filesystem::path& file) {
  hide_measured();
  loaded_ = std::move(scene);
  state_ = {loaded_.scene, loaded_.basis};
  revision_ = {revision_.scene + 1, revision_.robot + 1, revision_.basis + 1, revision_.limits + 1};
  file_ = file;
  use_first_robot(robot() ? robot()->configuration : geometric::Configuration());
  emit opened(Opened::kScene);
  if (robot()) {
    emit configuration_changed(q_);
  }
}

void Document::take_hand() {
  joints_ = planning::select_movable_joints(*loaded_.scene, loaded_.basis.get());
  palm_ = geometric::HandStructure::of(*robot()->model, joints_.arm, joints_.hand).palm;
}

void Document::use_first_robot(const geometric::Configuration& q) {
  problem_.reset();
  joints_ = {};
  palm_ = 0;
  q_ = q;
  if (robot()) {
    take_hand();
    problem_ = std::make_shared<const PreparedProblem>(loaded_, revision_, preparations_);
  }
  recorded_hand_.set_basis(loaded_.basis);
}

void Document::change_robots(planning::SceneState state) {
  hide_measured();
  const planning::SceneState before = std::exchange(state_, std::move(state));
  const geometric::Configuration q = configuration_in(*before.scene, q_, *state_.scene);
  revision_ = after_edit(revision_, *before.scene, *state_.scene);
  revision_.basis += before.basis == state_.basis ? 0 : 1;
  loaded_ = {state_.scene, state_.basis};
  use_first_robot(q);
  emit opened(Opened::kRobots);
  emit edited(before);
  emit configuration_changed(q_);
}

void Document::set_state(planning::SceneState state) {
  if (state.scene != state_.scene && !has_same_robots(*state_.scene, *state.scene)) {
    change_robots(std::move(state));
    return;
  }
  const planning::SceneState before = std::exchange(state_, std::move(state));
  const bool has_other_hand =
      robot() && (before.basis != state_.basis || before.scene->group != state_.scene->group);
  if (has_other_hand) {
    loaded_ = {state_.scene, state_.basis};
    ++revision_.basis;
    take_hand();
  }
  if (before.scene != state_.scene) {
    loaded_.scene = state_.scene;
    revision_ = after_edit(revision_, *before.scene, *state_.scene);
    if (robot()) {
      problem_ = std::make_shared<const PreparedProblem>(loaded_, revision_, preparations_,
                                                         problem_.get());
    }
  }
  if (has_other_hand) {
    recorded_hand_.set_basis(loaded_.basis);
  }
  emit edited(before);
  if (has_other_hand) {
    emit hand_changed();
  }
  if (robot() && before.scene != state_.scene) {
    emit configuration_changed(q_);
  }
}

// Items that were dragged return to where they are shown.
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
    if (const auto variable = geometric::find_variable_of_part(*robot()->model, joint)) {
      q[*variable] = value;
    }
  }
  set_configuration(q);
}

}  // namespace handway::gui
