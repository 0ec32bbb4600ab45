#include "features/comparison/comparison_window.h"

#include "features/comparison/figure_table.h"
#include "features/comparison/locked_views.h"
#include "handway/planning/paths/path_csv.h"
#include "model/playback/palm_path.h"
#include "view3d/scene_view.h"
#include "widgets/panels/playback_bar.h"

#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>
#include <exception>
#include <utility>

namespace handway::gui {

ComparisonWindow::ComparisonWindow(PathHistory& history, Query query, QWidget* parent)
    : QDialog(parent),
      history_(history),
      query_(std::move(query)),
      views_(new LockedViews),
      bar_(new PlaybackBar(player_)),
      choosers_{new QComboBox, new QComboBox},
      table_(new FigureTable),
      note_(new QLabel) {
  setWindowTitle(tr("Compare two paths"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(1180, 800);
  auto* top = new QHBoxLayout;
  top->setSpacing(14);
  top->addWidget(make_chooser(0), 1);
  top->addWidget(make_chooser(1), 1);
  note_->setObjectName(QStringLiteral("comparison_note"));
  note_->setWordWrap(true);
  note_->setProperty("role", "note");
  table_->setObjectName(QStringLiteral("comparison_figures"));
  bar_->setProperty("role", "playback");
  bar_->hide_traces();
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 10, 12, 12);
  layout->setSpacing(8);
  layout->addLayout(top);
  layout->addWidget(views_, 1);
  layout->addWidget(bar_);
  layout->addWidget(table_);
  layout->addWidget(note_);
  connect(&player_, &PathPlayer::moved, this, &ComparisonWindow::show_moment);
  connect(&history_, &PathHistory::changed, this, &ComparisonWindow::take_history);
  fill_choosers();
  for (std::size_t side = 0; side < choosers_.size(); ++side) {
    views_->view(side).set_scene(query_.scene);
    views_->view(side).show_ghosts(false, false);
  }
  show_figures();
  if (history_.paths().size() > 1) {
    choose(0, 1);
    choose(1, 0);
  } else {
    choose(0, 0);
  }
}

QWidget* ComparisonWindow::make_chooser(std::size_t side) {
  QComboBox* const box = choosers_.at(side);
  box->setObjectName(QStringLiteral("comparison_%1").arg(side == 0 ? "left" : "right"));
  box->setPlaceholderText(tr("Choose a path"));
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  connect(box, qOverload<int>(&QComboBox::activated), this,
          [this, side](int index) { choose(side, static_cast<std::size_t>(index)); });
  auto* from_file = new QPushButton(tr("From a file…"));
  from_file->setToolTip(tr("A path as handway plan and the export write it (CSV)"));
  from_file->setEnabled(query_.problem != nullptr);
  connect(from_file, &QPushButton::clicked, this, [this, side] { ask_for_file(side); });
  auto* chooser = new QWidget;
  auto* layout = new QHBoxLayout(chooser);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(box, 1);
  layout->addWidget(from_file);
  return chooser;
}

void ComparisonWindow::fill_choosers() {
  for (std::size_t side = 0; side < choosers_.size(); ++side) {
    QComboBox& box = *choosers_.at(side);
    const QSignalBlocker quiet(box);
    box.clear();
    int current = -1;
    for (const PathRecord& record : history_.paths()) {
      if (shown_.at(side) && record.motion == shown_.at(side)->motion) {
        current = box.count();
      }
      box.addItem(record.label);
    }
    box.setCurrentIndex(current);
  }
}

// What is new goes where nothing is shown yet; what is shown may have got more curves.
void ComparisonWindow::take_history() {
  fill_choosers();
  const std::vector<PathRecord> paths = history_.paths();
  for (auto& shown : shown_) {
    for (const PathRecord& record : paths) {
      if (shown && record.motion == shown->motion) {
        shown = record;
      }
    }
  }
  for (std::size_t side = 0; side < shown_.size(); ++side) {
    const auto& other = shown_.at(1 - side);
    if (!shown_.at(side) && other && !paths.empty() && paths.front().motion != other->motion) {
      choose(side, 0);
      return;
    }
  }
  show_figures();
}

void ComparisonWindow::choose(std::size_t side, std::size_t index) {
  const std::vector<PathRecord> paths = history_.paths();
  if (index >= paths.size()) {
    return;
  }
  shown_.at(side) = paths[index];
  choosers_.at(side)->setCurrentIndex(static_cast<int>(index));
  show_side(side);
  update_player();
  show_figures();
}

void ComparisonWindow::show_side(std::size_t side) {
  const PathRecord& record = *shown_.at(side);
  timelines_.at(side) = PathTimeline(*record.motion->model, record.motion->path);
  timelines_.at(side).set_motion(record.motion);
  SceneView& view = views_->view(side);
  view.set_scene(record.scene);
  view.show_ghosts(false, false);
  const PalmPath way = palm_path(record.scene->robots.front(), timelines_.at(side), record.palm);
  view.set_path(way.points, way.waypoints);
}

void ComparisonWindow::update_player() {
  const double time = player_.timeline().empty() ? 0.0 : player_.time();
  const bool first_is_longer = timelines_[0].empty() || timelines_[1].empty()
                                   ? timelines_[1].empty()
                                   : timelines_[0].duration() > timelines_[1].duration();
  player_.set_timeline(timelines_.at(first_is_longer ? 0 : 1));
  player_.seek(time / player_.duration());
  show_moment();
}

void ComparisonWindow::show_moment() {
  for (std::size_t side = 0; side < timelines_.size(); ++side) {
    const PathTimeline& timeline = timelines_.at(side);
    if (!timeline.empty()) {
      views_->view(side).set_configuration(timeline.at(player_.time() / timeline.duration()));
    }
  }
}

void ComparisonWindow::show_figures() {
  const auto figures = [](const std::optional<PathRecord>& record) {
    return record ? record->figures : std::nullopt;
  };
  table_->show_figures(figures(shown_[0]), figures(shown_[1]));
  if (!shown_[0] || !shown_[1]) {
    note_->setText(
        tr("There is one path so far: plan again with another seed or planner (it comes here by "
           "itself), or open one from a file."));
  } else if (shown_[0]->motion == shown_[1]->motion) {
    note_->setText(tr("Both sides show the same path."));
  } else if (shown_[0]->scene != shown_[1]->scene) {
    note_->setText(tr("The two paths are of different scenes."));
  } else {
    note_->setText(tr("Bold and green: the better of the two. Both views look from one place."));
  }
}

void ComparisonWindow::ask_for_file(std::size_t side) {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Compare with a path"), {}, tr("Paths (*.csv)"));
  if (!file.isEmpty()) {
    open_file(side, file);
  }
}

void ComparisonWindow::open_file(std::size_t side, const QString& file) {
  note_->setText(tr("Timing %1…").arg(QFileInfo(file).fileName()));
  job_.run([this, side, file, query = query_](const std::stop_token& stop) -> LatestJob::Answer {
    try {
      const PreparedProblem::Problem problem = query.problem->wait(stop);
      if (!problem) {
        return {};
      }
      const PathMotion timed =
          motion_of(*problem, planning::read_path_csv(problem->model(), file.toStdString()));
      if (!timed.motion) {
        return [this, fault = timed.fault] { note_->setText(QString::fromStdString(fault)); };
      }
      const auto curves = std::make_shared<const MotionCurves>(
          motion_curves(*problem, query.postures, timed.motion->trajectory, stop));
      return [this, side,
              record = PathRecord{QFileInfo(file).fileName(), query.scene, query.palm, timed.motion,
                                  curves, nullptr, std::nullopt}] {
        const auto motion = history_.add(record);
        const std::vector<PathRecord> paths = history_.paths();
        const auto place = std::ranges::find(paths, motion, &PathRecord::motion);
        choose(side, static_cast<std::size_t>(place - paths.begin()));
      };
    } catch (const std::exception& error) {
      return [this, message = QString::fromUtf8(error.what())] { note_->setText(message); };
    }
  });
}

}  // namespace handway::gui
