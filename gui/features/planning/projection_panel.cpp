#include "features/planning/projection_panel.h"

#include "view3d/pmd_colors.h"
#include "view3d/roadmap_node.h"
#include "widgets/plots/projection_plot.h"
#include "widgets/style/theme.h"

#include <QColor>
#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QSignalBlocker>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

QColor shown(const geometric::Color& color) {
  return QColor::fromRgbF(color.red, color.green, color.blue);
}

QColor color_of(int pmds, int most) { return shown(pmd_color(pmds, most)); }

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

ProjectionPanel::ProjectionPanel(QWidget* parent)
    : QWidget(parent),
      x_(new QComboBox),
      y_(new QComboBox),
      pages_(new QStackedWidget),
      plot_(new ProjectionPlot),
      note_(new QLabel) {
  x_->setObjectName(QStringLiteral("projection_x"));
  y_->setObjectName(QStringLiteral("projection_y"));
  x_->setToolTip(tr("What goes from left to right"));
  y_->setToolTip(tr("What goes upwards"));
  note_->setObjectName(QStringLiteral("projection_note"));
  note_->setProperty("role", "note");
  note_->setContentsMargins(12, 0, 12, 6);
  note_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  for (QComboBox* axis : {x_, y_}) {
    axis->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  }
  auto* all = new QToolButton;
  all->setText(tr("Show all"));
  all->setToolTip(tr("Look at the whole roadmap (double click beside the nodes)"));
  auto* row = new QHBoxLayout;
  row->setContentsMargins(12, 6, 12, 0);
  row->setSpacing(8);
  row->addWidget(new QLabel(tr("Across")));
  row->addWidget(x_);
  row->addWidget(new QLabel(tr("Up")));
  row->addWidget(y_);
  row->addWidget(all);
  row->addStretch();
  auto* empty = new QLabel(
      tr("The nodes that a planner finds appear here, seen along two of their coordinates: how "
         "far the arm is, and what the hand does.\nPlan a path, then click a node to see the robot "
         "there."));
  empty->setObjectName(QStringLiteral("projection_empty"));
  empty->setAlignment(Qt::AlignCenter);
  empty->setWordWrap(true);
  empty->setProperty("role", "note");
  auto* page = new QWidget;
  auto* page_layout = new QVBoxLayout(page);
  page_layout->setContentsMargins(0, 0, 0, 0);
  page_layout->setSpacing(2);
  page_layout->addLayout(row);
  plot_->setContentsMargins(4, 0, 12, 4);
  page_layout->addWidget(plot_, 1);
  page_layout->addWidget(note_);
  pages_->addWidget(empty);
  pages_->addWidget(page);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(pages_);
  setMinimumHeight(180);
  take_theme();
  for (QComboBox* axis : {x_, y_}) {
    connect(axis, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] { redraw(false); });
  }
  connect(all, &QToolButton::clicked, this, [this] { plot_->show_all(); });
  plot_->on_hover([this](std::optional<int> node) { tell(node); });
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
  tell(std::nullopt);
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

void ProjectionPanel::tell(std::optional<int> node) {
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
                     .arg(x_->currentText())
                     .arg(place.x(), 0, 'f', 3)
                     .arg(y_->currentText())
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

void ProjectionPanel::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::StyleChange) {
    take_theme();
  }
}

void ProjectionPanel::take_theme() {
  const ThemeColors colors = colors_of(current_theme());
  plot_->set_colors({colors.surface, colors.text, colors.muted, colors.border, shown(kStartColor),
                     shown(kGoalColor), colors.accent});
}

}  // namespace handway::gui
