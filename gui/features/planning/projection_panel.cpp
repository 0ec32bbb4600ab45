#include "features/planning/projection_panel.h"

#include "view3d/roadmap_drawings.h"
#include "widgets/forms/arrangement.h"
#include "widgets/plots/projection_plot.h"
#include "widgets/style/color_math.h"
#include "widgets/style/theme.h"

#include <QColor>
#include <QComboBox>
#include <QLabel>
#include <QLocale>
#include <QObject>
#include <QSignalBlocker>
#include <QStackedWidget>
#include <QToolButton>

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

Eigen::MatrixXd coordinates(const planning::HandArmChart& chart, std::size_t count,
                            const auto& configuration) {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(chart.axes().size()),
                         static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    result.col(static_cast<Eigen::Index>(i)) = chart.at(configuration(i));
  }
  return result;
}

QColor shown(const geometric::Color& color) {
  return QColor::fromRgbF(color.red, color.green, color.blue);
}

QColor color_of(int pmds, int most) {
  return seen_on(colors_of(current_theme()).surface, shown(pmd_color(pmds, most)));
}

QString legend(const PalmRoadmap& roadmap) {
  QString text;
  const int most = most_pmds(roadmap);
  for (int count = 1; count <= most; ++count) {
    text += QStringLiteral(" <span style='color:%1'>&#9679;</span>&nbsp;%2")
                .arg(color_of(count, most).name())
                .arg(count);
  }
  return most > 0 ? QObject::tr("PMDs used:") + text : QString();
}

}  // namespace

ChartedRoadmap charted(PreparedProblem::Problem problem, SharedRoadmap roadmap,
                       const std::vector<geometric::Configuration>& path) {
  ChartedRoadmap result;
  result.chart = std::make_shared<ProblemChart>(ProblemChart{std::move(problem)});
  result.roadmap = std::move(roadmap);
  const planning::HandArmChart& chart = result.chart->chart;
  if (result.roadmap) {
    const auto& nodes = result.roadmap->roadmap.nodes;
    result.nodes = coordinates(
        chart, nodes.size(), [&](std::size_t i) -> const auto& { return nodes[i].q; });
  }
  result.path = coordinates(
      chart, path.size(), [&](std::size_t i) -> const auto& { return path[i]; });
  result.start = chart.at(result.chart->problem->start);
  result.goal = chart.at(result.chart->problem->goal);
  return result;
}

QStringList titles_of(const planning::HandArmChart& chart) {
  using Kind = planning::HandArmChart::Axis::Kind;
  QStringList titles;
  int direction = 0;
  for (const auto& [kind, name] : chart.axes()) {
    switch (kind) {
      case Kind::kArmWay:
        titles << QObject::tr("Along the arm's path, start to goal");
        break;
      case Kind::kArmDistance:
        titles << QObject::tr("Distance from the arm's path");
        break;
      case Kind::kFreeJoint:
        titles << QObject::tr("Joint %1").arg(QString::fromStdString(name));
        break;
      case Kind::kDirection:
        titles << QObject::tr("PMD %1").arg(++direction);
        break;
      case Kind::kHandDistance:
        titles << QObject::tr("Distance from the PMD subspace");
        break;
    }
  }
  return titles;
}

ProjectionPanel::ProjectionPanel(QWidget* parent)
    : QWidget(parent),
      x_(named("projection_x", new QComboBox)),
      y_(named("projection_y", new QComboBox)),
      pages_(new QStackedWidget),
      plot_(new ProjectionPlot),
      note_(named("projection_note", note())) {
  x_->setToolTip(tr("Horizontal axis"));
  y_->setToolTip(tr("Vertical axis"));
  note_->setTextFormat(Qt::RichText);
  note_->setContentsMargins(12, 0, 12, 6);
  note_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  for (QComboBox* axis : {x_, y_}) {
    axis->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  }
  auto* all = new QToolButton;
  all->setText(tr("Show all"));
  all->setToolTip(tr("Show the whole roadmap (double click beside the nodes)"));
  auto* row = in_row({new QLabel(tr("Across")), x_, new QLabel(tr("Up")), y_, all, room()}, 8);
  row->setContentsMargins(12, 6, 12, 0);
  QLabel* empty = named("projection_empty", note());
  empty->setText(
      tr("The nodes that a planner finds appear here, seen along two of their coordinates: how "
         "far the arm is, and what the hand does.\nPlan a path, then click a node to see the robot "
         "there."));
  empty->setAlignment(Qt::AlignCenter);
  empty->setWordWrap(true);
  plot_->setContentsMargins(4, 0, 12, 4);
  auto* page = boxed(in_column({row, {plot_, 1}, note_}, 2));
  pages_->addWidget(empty);
  pages_->addWidget(page);
  lay_out(*this, in_column({pages_}));
  note_->setWordWrap(true);
  setMinimumHeight(180);
  follow_theme(*this, [this] {
    const ThemeColors colors = colors_of(current_theme());
    plot_->set_colors({colors.surface, colors.text, colors.muted, colors.border, shown(kStartColor),
                       shown(kGoalColor), colors.accent});
  });
  for (QComboBox* axis : {x_, y_}) {
    connect(axis, &QComboBox::currentTextChanged, axis, &QWidget::setToolTip);
    connect(axis, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] { redraw(false); });
  }
  connect(all, &QToolButton::clicked, this, [this] { plot_->show_all(); });
  plot_->on_hover([this](std::optional<int> node) { notify(node); });
  plot_->on_pick([this](int node) {
    emit picked(charted_.roadmap->roadmap.nodes[static_cast<std::size_t>(node)].q);
  });
}

void ProjectionPanel::show_roadmap(ChartedRoadmap charted) {
  const bool first = pages_->currentIndex() == 0;
  charted_ = std::move(charted);
  name_axes(charted_.chart->chart);
  pages_->setCurrentIndex(1);
  redraw(!first);
  notify(std::nullopt);
}

void ProjectionPanel::show_nothing() {
  charted_ = {};
  pages_->setCurrentIndex(0);
  plot_->set_roadmap({}, true);
  plot_->set_robot(std::nullopt);
}

// At first the arm's way and the first principal direction, if there is one.
void ProjectionPanel::name_axes(const planning::HandArmChart& chart) {
  const QStringList titles = titles_of(chart);
  QStringList shown;
  for (int i = 0; i < x_->count(); ++i) {
    shown << x_->itemText(i);
  }
  if (titles == shown) {
    return;
  }
  const auto direction =
      std::ranges::find(chart.axes(), planning::HandArmChart::Axis::Kind::kDirection,
                        &planning::HandArmChart::Axis::kind);
  const auto up = direction == chart.axes().end() ? 1 : direction - chart.axes().begin();
  for (QComboBox* axis : {x_, y_}) {
    const QSignalBlocker quiet(axis);
    axis->clear();
    axis->addItems(titles);
    axis->setCurrentIndex(axis == x_ ? 0 : static_cast<int>(up));
    axis->setToolTip(axis->currentText());
  }
}

QPointF ProjectionPanel::in_plane(const Eigen::VectorXd& coordinates) const {
  return {coordinates[x_->currentIndex()], coordinates[y_->currentIndex()]};
}

void ProjectionPanel::redraw(bool keeps_view) {
  if (!charted_.chart) {
    return;
  }
  PlaneRoadmap plane;
  if (charted_.roadmap) {
    const auto& nodes = charted_.roadmap->roadmap.nodes;
    const int most = most_pmds(*charted_.roadmap);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      plane.nodes.push_back({in_plane(charted_.nodes.col(static_cast<Eigen::Index>(i))),
                             color_of(nodes[i].pmd_count, most)});
    }
    plane.edges = charted_.roadmap->roadmap.edges;
  }
  for (Eigen::Index i = 0; i < charted_.path.cols(); ++i) {
    plane.path << in_plane(charted_.path.col(i));
  }
  plane.start = in_plane(charted_.start);
  plane.goal = in_plane(charted_.goal);
  plot_->set_titles(x_->currentText(), y_->currentText());
  plot_->set_roadmap(std::move(plane), keeps_view);
  draw_robot();
}

void ProjectionPanel::set_robot(const geometric::Configuration& q) {
  q_ = q;
  if (isVisible()) {
    draw_robot();
  }
}

void ProjectionPanel::draw_robot() {
  if (charted_.chart && q_.size() == charted_.chart->problem->start.size()) {
    plot_->set_robot(in_plane(charted_.chart->chart.at(q_)));
  }
}

void ProjectionPanel::notify(std::optional<int> node) {
  if (!charted_.roadmap) {
    note_->clear();
    return;
  }
  const planning::RecordedRoadmap& roadmap = charted_.roadmap->roadmap;
  if (!node) {
    note_->setText(tr("%1 nodes. Click one to see the robot there. %2")
                       .arg(QLocale().toString(static_cast<int>(roadmap.nodes.size())),
                            legend(*charted_.roadmap)));
    return;
  }
  const auto& found = roadmap.nodes[static_cast<std::size_t>(*node)];
  const QPointF place = plot_->roadmap().nodes[static_cast<std::size_t>(*node)].place;
  QString text = tr("Node %1: %2 %3, %4 %5")
                     .arg(*node + 1)
                     .arg(x_->currentText().toHtmlEscaped())
                     .arg(place.x(), 0, 'f', 3)
                     .arg(y_->currentText().toHtmlEscaped())
                     .arg(place.y(), 0, 'f', 3);
  if (found.pmd_count > 0) {
    text += tr("; %n PMD(s) used", nullptr, found.pmd_count);
  }
  if (found.rho_a > 0.0) {
    text += tr("; ρₐ %1").arg(found.rho_a, 0, 'g', 3);
  }
  note_->setText(text);
}

void ProjectionPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  emit visibility_changed(true);
}

void ProjectionPanel::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  emit visibility_changed(false);
}

}  // namespace handway::gui
