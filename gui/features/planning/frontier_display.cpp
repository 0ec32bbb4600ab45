#include "features/planning/frontier_display.h"

#include "model/document/document.h"
#include "model/planning/planning_session.h"
#include "model/settings/view_colors.h"
#include "view3d/scene_view.h"

#include <QColor>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QStringList>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <utility>

namespace handway::gui {
namespace {

QString bullet(const geometric::Color& color) {
  return QStringLiteral("<span style='color:%1'>&#9679;</span> ")
      .arg(QColor::fromRgbF(color.red, color.green, color.blue).name());
}

QString reach_text(const geometric::Color& color, const QString& end, double share) {
  return bullet(color) +
         QObject::tr("%1 % of the motion from the %2").arg(std::lround(100.0 * share)).arg(end);
}

QString colliding_text(const std::vector<std::string>& bodies) {
  constexpr geometric::Color kRed{0.86F, 0.13F, 0.11F, 1.0F};
  QStringList names;
  for (const std::string& body : bodies) {
    names << QString::fromStdString(body).toHtmlEscaped();
  }
  return bullet(kRed) + QObject::tr("collided most: %1").arg(names.join(QObject::tr(" and ")));
}

}  // namespace

FrontierLegend::FrontierLegend(QWidget* host)
    : FloatingCard(host), from_start_(nullptr), from_goal_(nullptr), colliding_(new QLabel) {
  setProperty("role", "legend");
  setObjectName(QStringLiteral("frontier_legend"));
  auto* title = new QLabel(tr("No path: how far the search came"));
  title->setProperty("role", "heading");
  auto* close = new QToolButton;
  close->setObjectName(QStringLiteral("frontier_close"));
  close->setText(QStringLiteral("×"));
  close->setAutoRaise(true);
  close->setToolTip(tr("Hide these ghosts"));
  connect(close, &QToolButton::clicked, this, &FrontierLegend::closed);
  colliding_->setObjectName(QStringLiteral("frontier_colliding"));
  auto* head = new QHBoxLayout;
  head->addWidget(title, 1);
  head->addWidget(close);
  auto* rows = new QGridLayout;
  rows->setHorizontalSpacing(14);
  rows->setVerticalSpacing(3);
  from_start_ = add_row(*rows, "frontier_from_start", true);
  from_goal_ = add_row(*rows, "frontier_from_goal", false);
  rows->addWidget(colliding_, 2, 0, 1, 2);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 6, 8, 10);
  layout->setSpacing(3);
  layout->addLayout(head);
  layout->addLayout(rows);
}

QLabel* FrontierLegend::add_row(QGridLayout& rows, const char* name, bool from_start) {
  auto* label = new QLabel;
  label->setObjectName(QLatin1String(name));
  auto* visit = new QPushButton(tr("Show"));
  visit->setObjectName(QLatin1String(name) + QStringLiteral("_show"));
  visit->setProperty("role", "link");
  visit->setToolTip(tr("Put the robot there"));
  connect(visit, &QPushButton::clicked, this, [this, from_start] { emit visited(from_start); });
  const int row = from_start ? 0 : 1;
  rows.addWidget(label, row, 0);
  rows.addWidget(visit, row, 1);
  return label;
}

void FrontierLegend::show_frontier(const planning::SearchReach& reach,
                                   const std::vector<std::string>& colliding) {
  from_start_->setText(reach_text(kFromStartColor, tr("start"), reach.from_start));
  from_goal_->setText(reach_text(kFromGoalColor, tr("goal"), 1.0 - reach.from_goal));
  colliding_->setText(colliding_text(colliding));
  colliding_->setVisible(!colliding.empty());
  appear();
}

void FrontierLegend::place() {
  constexpr int kMargin = 12;
  adjustSize();
  move(kMargin, kMargin);
}

FrontierDisplay::FrontierDisplay(Document& document, PlanningSession& session, SceneView& view,
                                 QObject* parent)
    : QObject(parent), document_(document), view_(view), legend_(new FrontierLegend(&view)) {
  connect(&session, &PlanningSession::started, this, &FrontierDisplay::clear);
  connect(&session, &PlanningSession::run_ended, this, &FrontierDisplay::note);
  connect(&session, &PlanningSession::ended, this, [this](bool solved) {
    if (!solved && last_) {
      shown_ = std::exchange(last_, std::nullopt);
      show();
    }
  });
  connect(&session, &PlanningSession::path_changed, this, &FrontierDisplay::clear);
  connect(&document_, &Document::opened, this, &FrontierDisplay::clear);
  connect(&document_, &Document::edited, this, [this](const SceneState& before) {
    if (before.scene != document_.scene()) {
      clear();
    }
  });
  connect(legend_, &FrontierLegend::closed, this, &FrontierDisplay::clear);
  connect(legend_, &FrontierLegend::visited, this, [this](bool from_start) {
    const planning::SearchReach& reach = *shown_->reach;
    document_.set_configuration(from_start ? reach.farthest_from_start : reach.farthest_from_goal);
  });
}

void FrontierDisplay::note(const PathRecord& record) {
  const planning::PlanResult& result = record.run->result;
  if (!result.solved() && result.reach) {
    last_ = result;
  }
}

void FrontierDisplay::show() {
  const planning::PlanResult& result = *shown_;
  Frontier frontier{result.reach->farthest_from_start, result.reach->farthest_from_goal, {}};
  const auto& rejections = result.statistics.rejections;
  const auto most = std::ranges::max_element(rejections, {},
                                             [](const auto& rejected) { return rejected.second; });
  if (most != rejections.end() && !most->first.second.empty()) {
    frontier.colliding = {most->first.first, most->first.second};
  }
  view_.show_frontier(frontier);
  legend_->show_frontier(*result.reach, frontier.colliding);
}

void FrontierDisplay::clear() {
  last_.reset();
  if (shown_) {
    shown_.reset();
    legend_->hide();
    view_.show_frontier({});
  }
}

}  // namespace handway::gui
