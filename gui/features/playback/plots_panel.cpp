#include "features/playback/plots_panel.h"

#include "features/playback/joint_curve_list.h"
#include "features/playback/path_opening.h"
#include "features/playback/path_traces.h"
#include "features/playback/plot_columns.h"
#include "features/workbench.h"
#include "handway/geometric/io/replace_file.h"
#include "model/document/document.h"
#include "model/playback/motion_analysis.h"
#include "model/playback/path_player.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/file_dialogs.h"
#include "widgets/panels/log_panel.h"
#include "widgets/panels/playback_bar.h"
#include "widgets/plots/cursor_plot.h"
#include "widgets/plots/screen_colors.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QFileInfo>
#include <QLabel>
#include <QObject>
#include <QPushButton>
#include <QSplitter>
#include <QStackedWidget>

#include <algorithm>
#include <exception>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kListWidth = 210;

QString number(double value, const QString& unit) {
  const int decimals = unit.isEmpty() ? 3 : 1;
  const QString text =
      QString::number(value, 'f', decimals).replace(QLatin1Char('-'), QChar(0x2212));
  return unit == QStringLiteral("°") || unit.isEmpty() ? text + unit : text + QChar(0x2009) + unit;
}

}  // namespace

PlotsPanel::PlotsPanel(Document& document, PathPlayer& player, MotionAnalysis& analysis,
                       QWidget* parent)
    : QWidget(parent),
      document_(document),
      player_(player),
      analysis_(analysis),
      quantities_(named("plot_quantity", new QComboBox)),
      value_(named("plot_value", note())),
      export_(named("plot_export", new QPushButton(tr("Export…")))),
      all_(new QPushButton(tr("Show all"))),
      middle_(new QStackedWidget),
      note_(note()),
      curves_(new QSplitter),
      joints_(new JointCurveList),
      plot_(new CursorPlot) {
  setAttribute(Qt::WA_StyledBackground);
  value_->setTextFormat(Qt::RichText);
  note_->setAlignment(Qt::AlignCenter);
  note_->setWordWrap(true);
  curves_->addWidget(joints_);
  curves_->addWidget(plot_);
  curves_->setStretchFactor(1, 1);
  curves_->setSizes({kListWidth, 3 * kListWidth});
  curves_->setChildrenCollapsible(false);
  middle_->addWidget(note_);
  middle_->addWidget(curves_);
  lay_out(*this, in_column({make_top(), {middle_, 1}}, 4), {10, 6, 10, 6});
  connect(quantities_, qOverload<int>(&QComboBox::currentIndexChanged), this, &PlotsPanel::draw);
  connect(joints_, &JointCurveList::choice_changed, this, &PlotsPanel::draw);
  connect(all_, &QPushButton::clicked, this, [this] { plot_->show_all(); });
  connect(export_, &QPushButton::clicked, this, &PlotsPanel::ask_for_file);
  connect(&analysis_, &MotionAnalysis::changed, this, &PlotsPanel::take_analysis);
  connect(&player_, &PathPlayer::moved, this, &PlotsPanel::show_cursor);
  connect(&player_, &PathPlayer::retimed, this, &PlotsPanel::show_cursor);
  plot_->on_scrub([this](double time) {
    player_.pause();
    player_.seek(time / player_.duration());
  });
  follow_theme(*this,
               [this] { plot_->set_colors(screen_colors(), colors_of(current_theme()).accent); });
  take_analysis();
}

QWidget* PlotsPanel::make_top() {
  using Quantity = PlotQuantity;
  for (const auto& [title, quantity] : {std::pair(tr("Position"), Quantity::kPosition),
                                        {tr("Velocity"), Quantity::kVelocity},
                                        {tr("Acceleration"), Quantity::kAcceleration},
                                        {tr("Clearance"), Quantity::kClearance},
                                        {tr("Human-likeness"), Quantity::kUnlikeness}}) {
    quantities_->addItem(title, static_cast<int>(quantity));
  }
  quantities_->setItemData(
      static_cast<int>(Quantity::kUnlikeness),
      tr("Distance of the hand from the subspace of its principal motion directions, and from the "
         "nearest recorded posture, in normalised joints; smaller is more human-like"),
      Qt::ToolTipRole);
  all_->setToolTip(
      tr("The whole path (double click). The wheel zooms, with Ctrl in values; drag "
         "with the right button to move"));
  export_->setToolTip(tr("Export the plot as a picture (PNG, SVG) or a table (CSV)"));
  return boxed(in_row({quantities_, {value_, 1}, all_, export_}, 10));
}

PlotQuantity PlotsPanel::quantity() const {
  return static_cast<PlotQuantity>(quantities_->currentData().toInt());
}

void PlotsPanel::show_quantity(PlotQuantity quantity) {
  quantities_->setCurrentIndex(quantities_->findData(static_cast<int>(quantity)));
}

void PlotsPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  show_cursor();
}

void PlotsPanel::take_analysis() {
  using State = MotionAnalysis::State;
  if (const geometric::RobotInstance* robot = document_.robot()) {
    joints_->set_robot(robot->model, document_.joints());
  }
  switch (analysis_.state()) {
    case State::kNoPath:
      note_->setText(
          tr("No path yet. Plan one (Ctrl+P) to plot its joints, its clearance and the "
             "human-likeness of its hand over time."));
      break;
    case State::kTiming:
      note_->setText(tr("Timing the path…"));
      break;
    case State::kFailed:
      note_->setText(tr("The path can't be timed: %1").arg(analysis_.fault()));
      break;
    case State::kTimed:
      break;
  }
  draw();
}

void PlotsPanel::draw() {
  times_.clear();
  drawn_.clear();
  values_.clear();
  columns_.clear();
  std::vector<PlotLine> lines;
  const auto& motion = analysis_.motion();
  if (!motion) {
    middle_->setCurrentWidget(note_);
    value_->clear();
    export_->setEnabled(false);
    all_->setEnabled(false);
    plot_->set_lines({}, {});
    return;
  }
  for (const planning::TrajectoryPoint& point : motion->trajectory.points) {
    times_.push_back(point.time);
  }
  bool any_slides = false;
  bool any_turns = false;
  if (is_of_joints(quantity())) {
    drawn_ = joints_->chosen();
    for (const int variable : drawn_) {
      values_.push_back(joint_values(*motion, variable, quantity()));
      lines.push_back({QString::fromStdString(motion->model->variable(variable).name),
                       JointCurveList::color_of(variable), JointCurveList::is_dashed(variable),
                       values_.back(), joint_limits(*motion, variable, quantity())});
      (slides(*motion->model, variable) ? any_slides : any_turns) = true;
    }
  } else if (analysis_.curves()) {
    columns_ = motion_columns(*analysis_.curves(), quantity());
    for (const PlotColumn& column : columns_) {
      const int place = static_cast<int>(lines.size());
      lines.push_back(
          {title_of(column), JointCurveList::color_of(place), false, column.values, {}});
    }
  }
  const bool has_none = !is_of_joints(quantity()) && lines.empty();
  if (has_none) {
    note_->setText(analysis_.curves()
                       ? tr("The scene has no hand basis, so human-likeness can't be measured.")
                       : tr("Measuring along the path…"));
  }
  middle_->setCurrentWidget(has_none ? static_cast<QWidget*>(note_) : curves_);
  joints_->setVisible(is_of_joints(quantity()));
  export_->setEnabled(!has_none);
  all_->setEnabled(!has_none);
  plot_->set_titles(tr("time, s"), axis_title(quantity(), any_slides && !any_turns));
  plot_->set_marks(motion->waypoint_times);
  plot_->set_lines(times_, has_none ? std::vector<PlotLine>{} : std::move(lines));
  show_cursor();
}

std::size_t PlotsPanel::point_at_cursor() const {
  const auto after = std::ranges::lower_bound(times_, player_.time() - 1e-9);
  return std::min(static_cast<std::size_t>(after - times_.begin()), times_.size() - 1);
}

void PlotsPanel::show_cursor() {
  if (times_.empty() || !analysis_.motion()) {  // the curves of a path that is no more
    return;
  }
  plot_->set_cursor(player_.time());
  if (!isVisible()) {
    return;
  }
  const std::size_t point = point_at_cursor();
  const planning::Motion& motion = *analysis_.motion();
  if (is_of_joints(quantity())) {
    std::vector<QString> texts(static_cast<std::size_t>(motion.model->variable_count()));
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
      texts[static_cast<std::size_t>(drawn_[i])] =
          number(values_[i][point], unit_of(quantity(), slides(*motion.model, drawn_[i])));
    }
    joints_->show_values(texts);
    value_->setText(drawn_.empty() ? tr("Tick the joints to draw") : QString());
  } else {
    value_->setText(value_text(point));
  }
}

QString PlotsPanel::value_text(std::size_t point) const {
  const auto value = [&](const PlotColumn& column) {
    return number(column.values[point], unit_of(quantity(), false));
  };
  if (quantity() == PlotQuantity::kClearance && !columns_.empty()) {
    const QString pair = QString::fromStdString(analysis_.curves()->closest[point]).toHtmlEscaped();
    return (pair.isEmpty() ? tr("%1 or more") : tr("%1: %2").arg(QStringLiteral("%1"), pair))
        .arg(value(columns_.front()));
  }
  QString text;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    text += QStringLiteral("<span style='color:%1'>&#9632;</span> %2 %3&nbsp;&nbsp; ")
                .arg(html(JointCurveList::color_of(static_cast<int>(i))), value(columns_[i]),
                     title_of(columns_[i]));
  }
  return text;
}

void PlotsPanel::ask_for_file() {
  const QString file =
      ask_where_to_save(window(), tr("Export the plot"), quantities_->currentText().toLower(),
                        tr("Picture (*.png);;Drawing (*.svg);;Table (*.csv)"));
  if (file.isEmpty()) {
    return;
  }
  try {
    write(file);
    emit exported(file);
  } catch (const std::exception& error) {
    emit failed(tr("The plot was not exported"), QString::fromUtf8(error.what()));
  }
}

void PlotsPanel::write(const QString& file) const {
  if (QFileInfo(file).suffix().toLower() != QStringLiteral("csv")) {
    plot_->write(file, quantities_->currentText());
    return;
  }
  const planning::Motion& motion = *analysis_.motion();
  std::vector<PlotColumn> columns = columns_;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const bool mm = slides(*motion.model, drawn_[i]);
    const char* const unit[] = {"deg", "deg_per_s", "deg_per_s2"};
    const char* const sliding_unit[] = {"mm", "mm_per_s", "mm_per_s2"};
    const auto which = static_cast<std::size_t>(quantity());
    columns.push_back(
        {motion.model->variable(drawn_[i]).name + "_" + (mm ? sliding_unit : unit)[which],
         values_[i]});
  }
  geometric::replace_file(file.toStdString(), csv_of(times_, columns));
}

void add_playback(Workbench& workbench) {
  workbench.own<PathOpening>(workbench);
  workbench.own<PathTraces>(workbench.document, workbench.player, workbench.view,
                            workbench.playback_bar.traces());
  auto* plots = new PlotsPanel(workbench.document, workbench.player, workbench.analysis);
  workbench.add_dock(DockArea::kBelow, 1, {"plots", QObject::tr("Plots"), plots});
  QObject::connect(plots, &PlotsPanel::failed, &workbench, &Workbench::show_error);
  QObject::connect(plots, &PlotsPanel::exported, &workbench, [&](const QString& file) {
    workbench.log.add(LogPanel::Level::kNote, QObject::tr("Exported %1").arg(file));
  });
}

}  // namespace handway::gui
