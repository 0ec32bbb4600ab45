#include "features/comparison/comparison_window.h"

#include "features/workbench.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/paths/path_file.h"
#include "handway/planning/queries/dynamic_time_warping.h"
#include "model/playback/path_player.h"
#include "model/playback/path_timeline.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/panels/playback_bar.h"
#include "widgets/style/actions.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QSignalBlocker>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

namespace handway::gui {
namespace {

enum class Better { kLess, kMore, kNeither };
enum Column { kName, kLeft, kRight, kDifference, kColumns };

constexpr int kFigureRowHeight = 24;
constexpr int kFewestVisibleRows = 9;
constexpr int kUsualVisibleRows = 12;  // the views need the rest
constexpr double kNoDifference = 1e-9;

struct Figure {
  QString name;
  int decimals;
  Better better;
  std::optional<double> left;
  std::optional<double> right;
  std::optional<double> most = std::nullopt;  ///< More is not distinguished.
};

QString number(double value, int decimals) {
  return QString::number(value, 'f', decimals).replace(QLatin1Char('-'), QChar(0x2212));
}

QString value_text(const Figure& figure, const std::optional<double>& value) {
  if (!value) {
    return QChar(0x2013);
  }
  const QString text = number(*value, figure.decimals);
  return figure.most && *value >= *figure.most ? QStringLiteral("≥ ") + text : text;
}

QString difference_text(const Figure& figure) {
  if (!figure.left || !figure.right) {
    return QChar(0x2013);
  }
  const double by = *figure.right - *figure.left;
  if (const QString none = number(0.0, figure.decimals);
      number(std::abs(by), figure.decimals) == none) {
    return none;
  }
  const QString text = (by > 0.0 ? QStringLiteral("+") : QString()) + number(by, figure.decimals);
  const double percent = 100.0 * by / std::abs(*figure.left);
  return std::abs(*figure.left) < kNoDifference
             ? text
             : QObject::tr("%1 (%2 %)")
                   .arg(text,
                        (percent > 0.0 ? QStringLiteral("+") : QString()) + number(percent, 0));
}

bool left_is_better(const Figure& figure) {
  return figure.better == Better::kLess ? *figure.left < *figure.right
                                        : *figure.left > *figure.right;
}

// The column of the better value, if one is.
std::optional<Column> better_column(const Figure& figure) {
  if (figure.better == Better::kNeither || !figure.left || !figure.right ||
      value_text(figure, figure.left) == value_text(figure, figure.right)) {
    return std::nullopt;
  }
  return left_is_better(figure) ? kLeft : kRight;
}

using Read = std::optional<double> (*)(const PathFigures& figures);

template <auto member, auto part>
std::optional<double> distance(const PathFigures& figures) {
  return figures.*member ? std::optional((figures.*member).value().*part) : std::nullopt;
}

std::vector<Figure> figures(const std::optional<PathFigures>& left,
                            const std::optional<PathFigures>& right) {
  using planning::DistanceAlong;
  const auto most = geometric::millimetres(kMostClearance);
  std::vector<Figure> list;
  const auto add = [&](const QString& name, int decimals, Better better, Read read,
                       std::optional<double> limit = std::nullopt) {
    list.push_back({name, decimals, better, left ? read(*left) : std::nullopt,
                    right ? read(*right) : std::nullopt, limit});
  };
  const auto add_distance = [&](const QString& name, Read read) {
    add(name, 3, Better::kLess, read);
    if (!list.back().left && !list.back().right) {
      list.pop_back();
    }
  };
  using Value = std::optional<double>;
  add(QObject::tr("Duration, s"), 2, Better::kLess,
      [](const PathFigures& f) { return Value(f.duration); });
  add(QObject::tr("Length, in normalised joints"), 3, Better::kLess,
      [](const PathFigures& f) { return Value(f.length); });
  add(QObject::tr("Turning at waypoints, rad"), 2, Better::kLess,
      [](const PathFigures& f) { return Value(f.turning); });
  add(QObject::tr("Path length of the palm, m"), 3, Better::kLess,
      [](const PathFigures& f) { return Value(f.palm_travel); });
  add(QObject::tr("Waypoints"), 0, Better::kNeither,
      [](const PathFigures& f) { return Value(f.waypoints); });
  add(
      QObject::tr("Least clearance, mm"), 1, Better::kMore,
      [](const PathFigures& f) { return Value(geometric::millimetres(f.least_clearance)); }, most);
  add(
      QObject::tr("Mean clearance, mm"), 1, Better::kMore,
      [](const PathFigures& f) {
        return f.mean_clearance ? Value(geometric::millimetres(*f.mean_clearance)) : std::nullopt;
      },
      most);
  add_distance(QObject::tr("Hand to the PMD subspace, mean"),
               distance<&PathFigures::to_subspace, &DistanceAlong::mean>);
  add_distance(QObject::tr("Hand to the PMD subspace, largest"),
               distance<&PathFigures::to_subspace, &DistanceAlong::largest>);
  add_distance(QObject::tr("Hand to recorded postures, mean"),
               distance<&PathFigures::to_recorded, &DistanceAlong::mean>);
  add_distance(QObject::tr("Hand to recorded postures, largest"),
               distance<&PathFigures::to_recorded, &DistanceAlong::largest>);
  return list;
}

using planning::MotionLikeness;

// Adds a figure of a motion unless both are missing. @param read returns an optional number.
template <typename Read>
void add_motion_figure(std::vector<Figure>& list, const QString& name, int decimals, Better better,
                       const MotionLikeness& left, const MotionLikeness& right, const Read& read) {
  const std::optional<double> of_left = read(left);
  const std::optional<double> of_right = read(right);
  if (of_left || of_right) {
    list.push_back({name, decimals, better, of_left, of_right});
  }
}

// Returns a getter of `value` of an optional measure, in units of `unit`.
template <typename Measure>
auto measure(std::optional<Measure> MotionLikeness::*measure, double Measure::*value,
             double unit = 1.0) {
  return [=](const MotionLikeness& motion) {
    const std::optional<Measure>& measured = motion.*measure;
    return measured ? std::optional((*measured).*value / unit) : std::nullopt;
  };
}

void add_motion_figures(std::vector<Figure>& list, const MotionLikeness& left,
                        const MotionLikeness& right) {
  using planning::MovementSmoothness;
  const auto add = [&](const QString& name, int decimals, Better better, const auto& read) {
    add_motion_figure(list, name, decimals, better, left, right, read);
  };
  add(QObject::tr("Log dimensionless jerk of the hand"), 2, Better::kMore,
      measure(&MotionLikeness::hand, &MovementSmoothness::log_dimensionless_jerk));
  add(QObject::tr("Log dimensionless jerk of the palm"), 2, Better::kMore,
      measure(&MotionLikeness::palm, &MovementSmoothness::log_dimensionless_jerk));
  add(QObject::tr("Spectral arc length of the hand"), 2, Better::kMore,
      measure(&MotionLikeness::hand, &MovementSmoothness::spectral_arc_length));
  add(QObject::tr("Spectral arc length of the palm"), 2, Better::kMore,
      measure(&MotionLikeness::palm, &MovementSmoothness::spectral_arc_length));
  add(QObject::tr("Arm off the straight motion, largest"), 3, Better::kLess,
      measure(&MotionLikeness::deviation, &planning::StraightDeviation::arm));
  add(QObject::tr("Palm off the straight motion, largest, mm"), 1, Better::kLess,
      measure(&MotionLikeness::deviation, &planning::StraightDeviation::palm,
              geometric::kMillimetre));
  add(QObject::tr("Hand off recorded motions, RMS, °"), 1, Better::kLess,
      measure(&MotionLikeness::components, &planning::ComponentError::error, geometric::kDegree));
}

}  // namespace

FigureTable::FigureTable(QWidget* parent) : QTableWidget(parent) {
  setProperty("role", "figures");
  setColumnCount(kColumns);
  setHorizontalHeaderLabels({QString(), tr("Left"), tr("Right"), tr("Right − left")});
  for (int column = kLeft; column < kColumns; ++column) {
    horizontalHeaderItem(column)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  }
  verticalHeader()->hide();
  verticalHeader()->setDefaultSectionSize(scaled(kFigureRowHeight));
  horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  horizontalHeader()->setSectionResizeMode(kName, QHeaderView::ResizeToContents);
  horizontalHeader()->setSectionsClickable(false);
  setShowGrid(false);
  setAlternatingRowColors(true);
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  setSelectionMode(QAbstractItemView::NoSelection);
  setFocusPolicy(Qt::TabFocus);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setVerticalScrollBarPolicy(Qt::ScrollBarAsNeeded);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  follow_theme(*this, [this] { fill(); });
}

void FigureTable::show_figures(const std::optional<PathFigures>& left,
                               const std::optional<PathFigures>& right) {
  left_ = left;
  right_ = right;
  fill();
}

void FigureTable::show_motions(const planning::MotionLikeness* left,
                               const planning::MotionLikeness* right) {
  left_motion_ = left != nullptr ? std::optional(*left) : std::nullopt;
  right_motion_ = right != nullptr ? std::optional(*right) : std::nullopt;
  fill();
}

QSize FigureTable::sizeHint() const { return {QTableWidget::sizeHint().width(), usual_height_}; }

void FigureTable::fill() {
  std::vector<Figure> list = figures(left_, right_);
  if (left_motion_ || right_motion_) {
    add_motion_figures(list, left_motion_.value_or(MotionLikeness()),
                       right_motion_.value_or(MotionLikeness()));
  }
  const QColor good = colors_of(current_theme()).good;
  setRowCount(static_cast<int>(list.size()));
  for (int row = 0; row < rowCount(); ++row) {
    const Figure& figure = list[static_cast<std::size_t>(row)];
    const std::optional<Column> better = better_column(figure);
    const std::array<QString, kColumns> texts{figure.name, value_text(figure, figure.left),
                                              value_text(figure, figure.right),
                                              difference_text(figure)};
    for (int column = 0; column < kColumns; ++column) {
      auto* item = new QTableWidgetItem(texts.at(static_cast<std::size_t>(column)));
      item->setTextAlignment((column == kName ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
      if (better == column) {
        QFont bold = font();
        bold.setBold(true);
        item->setFont(bold);
        item->setForeground(good);
        item->setToolTip(tr("Better of the two"));
      }
      setItem(row, column, item);
    }
  }
  const auto height_of = [&](int rows) {
    return horizontalHeader()->sizeHint().height() + rows * scaled(kFigureRowHeight) +
           2 * frameWidth();
  };
  usual_height_ = height_of(std::min(rowCount(), kUsualVisibleRows));
  setMinimumHeight(height_of(std::min(rowCount(), kFewestVisibleRows)));
  setMaximumHeight(height_of(rowCount()));
  updateGeometry();
}

namespace {

bool same(const OrbitCamera::Placement& a, const OrbitCamera::Placement& b) {
  return a.target == b.target && a.distance == b.distance && a.azimuth == b.azimuth &&
         a.elevation == b.elevation;
}

}  // namespace

LockedViews::LockedViews(QWidget* parent) : QWidget(parent), views_{new SceneView, new SceneView} {
  lay_out(*this, in_row({{views_[0], 1}, {views_[1], 1}}, 2));
  for (std::size_t i = 0; i < views_.size(); ++i) {
    SceneView* const view = views_.at(i);
    follow_theme(*view, [view] { view->set_colors(colors_of(current_theme()).view); });
    view->setMinimumSize(240, 200);
    connect(view, &SceneView::frameSwapped, this, [this, i] { follow(i); });
  }
}

void LockedViews::follow(std::size_t index) {
  const OrbitCamera::Placement& wanted = views_.at(index)->camera().placement();
  SceneView& other = *views_.at(1 - index);
  if (!same(other.camera().placement(), wanted)) {
    other.set_camera(wanted);
  }
}

ComparisonWindow::ComparisonWindow(PathHistory& history, Query query, QWidget* parent)
    : QDialog(parent),
      history_(history),
      query_(std::move(query)),
      views_(new LockedViews),
      bar_(new PlaybackBar(player_)),
      choosers_{new QComboBox, new QComboBox},
      table_(named("comparison_figures", new FigureTable)),
      note_(named("comparison_note", note())) {
  setWindowTitle(tr("Compare two paths"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(within_window(*this, {1180, 800}));
  note_->setWordWrap(true);
  table_->setAccessibleName(tr("Figures of both paths"));
  bar_->setProperty("role", "playback");
  bar_->hide_traces();
  lay_out(*this,
          in_column({in_row({{make_chooser(0), 1}, {make_chooser(1), 1}}, 14),
                     {views_, 1},
                     bar_,
                     table_,
                     note_},
                    8),
          {12, 10, 12, 12});
  connect(&player_, &PathPlayer::moved, this, &ComparisonWindow::show_moment);
  connect(&history_, &PathHistory::changed, this, &ComparisonWindow::take_history);
  connect(&job_, &LatestJob::failed, note_, &QLabel::setText);
  for (const LatestJob& measuring : measuring_) {
    connect(&measuring, &LatestJob::failed, note_, &QLabel::setText);
  }
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
  box->setAccessibleName(side == 0 ? tr("Path on the left") : tr("Path on the right"));
  connect(box, &QComboBox::currentTextChanged, box, &QWidget::setToolTip);
  box->setPlaceholderText(tr("Choose a path"));
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  connect(box, qOverload<int>(&QComboBox::activated), this,
          [this, side](int index) { choose(side, static_cast<std::size_t>(index)); });
  auto* from_file = new QPushButton(tr("From a file…"));
  from_file->setToolTip(tr("A path as handway plan and the export write it (CSV)"));
  from_file->setEnabled(query_.problem != nullptr);
  connect(from_file, &QPushButton::clicked, this, [this, side] { ask_for_file(side); });
  return boxed(in_row({{box, 1}, from_file}));
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

// New paths take a place where nothing is shown yet; paths that are shown may have more curves.
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
  const PalmPath palm = palm_path(record.scene->robots.front(), timelines_.at(side), record.palm);
  view.set_path(palm.points, palm.waypoints);
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
  const auto likeness = [&](std::size_t side) {
    const MeasuredMotion* const motion = measured(side);
    return motion != nullptr ? &motion->likeness : nullptr;
  };
  table_->show_motions(likeness(0), likeness(1));
  measure_motions();
  QStringList notes{note_on_both()};
  notes << notes_on_motions();
  for (const auto& shown : shown_) {
    if (shown && !shown->remark.isEmpty()) {
      notes << shown->remark + QLatin1Char('.');
    }
  }
  notes.removeDuplicates();
  note_->setText(notes.join(QLatin1Char(' ')));
}

const MeasuredMotion* ComparisonWindow::measured(std::size_t side) const {
  return measured_.at(side).is_of(shown_.at(side)) ? &measured_.at(side) : nullptr;
}

void ComparisonWindow::measure_motions() {
  for (std::size_t side = 0; side < shown_.size(); ++side) {
    const auto& shown = shown_.at(side);
    // Paths of another scene would need its problem.
    if (shown && query_.problem && shown->scene == query_.scene &&
        shown->motion != measured_.at(side).motion) {
      measured_.at(side) = {shown->motion, {}, {}};
      measure_motion(side);
    }
  }
}

void ComparisonWindow::measure_motion(std::size_t side) {
  measuring_.at(side).run([this, side, result = measured_.at(side),
                           query = query_](const std::stop_token& stop) -> LatestJob::Answer {
    const PreparedProblem::Problem problem = query.problem->wait(stop);
    if (!problem) {
      return {};
    }
    const auto timed = planning::likeness_trajectory(*problem, result.motion->path, stop);
    const auto* trajectory = std::get_if<planning::Trajectory>(&timed);
    if (trajectory == nullptr) {
      return {};
    }
    MeasuredMotion measured = result;
    measured.likeness = motion_likeness(*problem, *trajectory, query.postures.get());
    measured.comparable = comparable_motion(*problem, *trajectory);
    return [this, side, measured = std::move(measured)] {
      measured_.at(side) = measured;
      show_figures();
    };
  });
}

QStringList ComparisonWindow::notes_on_motions() const {
  QStringList notes;
  const MeasuredMotion* const left = measured(0);
  const MeasuredMotion* const right = measured(1);
  if (left != nullptr && right != nullptr && left != right && left->motion != right->motion &&
      left->comparable.cols() == right->comparable.cols()) {
    notes << tr("The motions differ by %1 in normalised joints (dynamic time warping).")
                 .arg(number(planning::warped_distance(left->comparable, right->comparable), 3));
  }
  for (const MeasuredMotion* motion : {left, right}) {
    if (motion != nullptr && motion->likeness.components) {
      const planning::ComponentError& error = *motion->likeness.components;
      notes << tr("%1 recorded motions of the hand are off by %2° (median): %3.")
                   .arg(error.motions)
                   .arg(number(geometric::degrees(error.recorded_median), 1),
                        QString::fromStdString(query_.postures->source()));
    }
  }
  return notes;
}

QString ComparisonWindow::note_on_both() const {
  if (!shown_[0] || !shown_[1]) {
    return tr(
        "There is one path so far. Plan again with another seed or planner, which adds a path "
        "here, or open one from a file.");
  }
  if (shown_[0]->motion == shown_[1]->motion) {
    return tr("Both sides show the same path.");
  }
  if (shown_[0]->scene != shown_[1]->scene) {
    return tr("The two paths are of different scenes.");
  }
  return tr("Bold and green: the better of the two. Both views have the same camera.");
}

void ComparisonWindow::ask_for_file(std::size_t side) {
  const QString file = QFileDialog::getOpenFileName(this, tr("Compare with a path"), {},
                                                    tr("Paths (*.csv *.yaml *.json)"));
  if (!file.isEmpty()) {
    open_file(side, file);
  }
}

void ComparisonWindow::open_file(std::size_t side, const QString& file) {
  note_->setText(tr("Timing %1…").arg(QFileInfo(file).fileName()));
  job_.run([this, side, file, query = query_](const std::stop_token& stop) -> LatestJob::Answer {
    const PreparedProblem::Problem problem = query.problem->wait(stop);
    if (!problem) {
      return {};
    }
    planning::JointsAtRest rest{problem->start};
    const PathMotion timed =
        motion_of(*problem, planning::read_path(problem->model(), file.toStdString(), &rest));
    if (!timed.motion) {
      return [this, fault = timed.fault] { note_->setText(QString::fromStdString(fault)); };
    }
    const auto curves = std::make_shared<const MotionCurves>(
        motion_curves(*problem, query.postures, timed.motion->trajectory, stop));
    PathRecord record;
    record.label = QFileInfo(file).fileName();
    record.scene = query.scene;
    record.palm = query.palm;
    record.motion = timed.motion;
    record.curves = curves;
    record.remark = QString::fromStdString(rest.remark(record.label.toStdString()));
    return [this, side, record = std::move(record)] {
      const auto motion = history_.add(record);
      const std::vector<PathRecord> paths = history_.paths();
      const auto place = std::ranges::find(paths, motion, &PathRecord::motion);
      choose(side, static_cast<std::size_t>(place - paths.begin()));
    };
  });
}

void add_comparison(Workbench& workbench) {
  QAction* compare = workbench.make_action({}, QObject::tr("Compare two &paths…"), {},
                                           QObject::tr("Two paths side by side"));
  compare->setObjectName(QStringLiteral("compare"));
  const QString no_path = QObject::tr("Plan a path first (Ctrl+P), or open one.");
  allow(*compare, no_path);
  workbench.add_to_menu(MainMenu::kPlan, {0, 10}, compare);
  QObject::connect(&workbench.history, &PathHistory::changed, compare, [&, compare, no_path] {
    allow(*compare, workbench.history.paths().empty() ? no_path : QString());
  });
  QObject::connect(compare, &QAction::triggered, &workbench, [&workbench] {
    Document& document = workbench.document;
    auto* dialog =
        new ComparisonWindow(workbench.history,
                             {document.robot() ? document.problem() : nullptr, document.scene(),
                              document.palm(), document.recorded_hand().postures()},
                             &workbench.window);
    dialog->show();
  });
}

}  // namespace handway::gui
