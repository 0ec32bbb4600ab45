#include "features/playback/path_opening.h"

#include "features/workbench.h"
#include "handway/planning/paths/path_file.h"
#include "widgets/panels/log_panel.h"
#include "widgets/style/actions.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMainWindow>

#include <memory>

namespace handway::gui {
namespace {

constexpr double kSame = 1e-3;  // rad or m

QString note_of(const planning::PlanningProblem& problem, const planning::Path& path,
                const planning::JointsAtRest& rest, const QString& file) {
  QString note = QObject::tr("Opened %1: %2 waypoints.")
                     .arg(QFileInfo(file).fileName(), QString::number(path.waypoints.size()));
  if (const std::string remark = rest.remark(QFileInfo(file).fileName().toStdString());
      !remark.empty()) {
    note += QStringLiteral(" %1.").arg(QString::fromStdString(remark));
  }
  if ((path.waypoints.front() - problem.start).lpNorm<Eigen::Infinity>() > kSame) {
    note += QObject::tr(" It does not begin at the scene's start.");
  }
  return note;
}

}  // namespace

PathOpening::PathOpening(Workbench& workbench)
    : workbench_(workbench),
      action_(workbench.make_action(
          {}, tr("Open a pa&th…"), {},
          tr("Open a path or trajectory file to play, check, export or run it"))) {
  action_->setObjectName(QStringLiteral("open_path"));
  workbench_.add_to_menu(MainMenu::kFile, {0, 3}, action_);
  workbench_.add_work([this] { return job_.is_busy(); });
  connect(action_, &QAction::triggered, this, &PathOpening::ask);
  connect(&job_, &LatestJob::failed, this, &PathOpening::refuse);
  connect(&workbench_, &Workbench::path_dropped, this, &PathOpening::open);
  connect(&workbench_, &Workbench::ready, this, &PathOpening::open_wanted);
  connect(&workbench_, &Workbench::scene_shown, this, [this] {
    job_.cancel();
    update_action();
  });
  connect(&workbench_.document, &Document::edited, this, &PathOpening::update_action);
  update_action();
}

void PathOpening::update_action() {
  allow(*action_, workbench_.document.robot() ? QString() : tr("Open a scene with a robot first."));
}

void PathOpening::ask() {
  const QString folder = QString::fromStdString(workbench_.document.file().parent_path().string());
  const QString file = QFileDialog::getOpenFileName(
      &workbench_.window, tr("Open a path"), folder,
      tr("Paths and joint trajectories (*.csv *.yaml *.yml *.json);;All files (*)"));
  if (!file.isEmpty()) {
    open(file);
  }
}

void PathOpening::open_wanted() {
  if (!workbench_.options.path.empty()) {
    open(QString::fromStdString(workbench_.options.path.string()));
  }
}

void PathOpening::open(const QString& file) {
  if (!workbench_.document.robot()) {
    refuse(tr("Open a scene with the robot of this path first."));
    return;
  }
  if (workbench_.session.is_running()) {
    refuse(tr("A planner is running: wait until it ends, or cancel it."));
    return;
  }
  job_.run([this, file, prepared = workbench_.document.problem()](
               const std::stop_token& stop) -> LatestJob::Answer {
    const PreparedProblem::Problem problem = prepared->wait(stop);
    if (!problem) {
      return {};
    }
    planning::JointsAtRest rest{problem->start};
    const auto path = std::make_shared<const planning::Path>(
        planning::read_path(problem->model(), file.toStdString(), &rest));
    return [this, file, problem, path, note = note_of(*problem, *path, rest, file)] {
      if (&problem->model() != workbench_.document.robot()->model.get()) {
        open(file);  // the robot was exchanged meanwhile
        return;
      }
      workbench_.session.show_opened(*path, QFileInfo(file).fileName(), note);
      workbench_.log.add(LogPanel::Level::kNote, note);
    };
  });
}

void PathOpening::refuse(const QString& message) {
  workbench_.show_error(tr("The path can't be opened"), message);
  emit workbench_.failed(message);
}

}  // namespace handway::gui
