#include "features/planning/roadmap_display.h"

#include "model/document/document.h"
#include "model/planning/plan_settings.h"
#include "model/planning/planning_session.h"
#include "model/settings/options.h"
#include "view3d/frontier.h"
#include "view3d/overlay.h"
#include "view3d/region_drawings.h"
#include "view3d/roadmap_drawings.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/color_math.h"
#include "widgets/style/theme.h"

#include <QAction>
#include <QCheckBox>
#include <QColor>
#include <QGridLayout>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QStringList>
#include <QToolButton>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace handway::gui {
HypercubeDisplay::HypercubeDisplay(Document& document, PlanSettings& settings,
                                   PlanningSession& session, SceneView& view, QAction& shown,
                                   QObject* parent)
    : QObject(parent),
      document_(document),
      settings_(settings),
      session_(session),
      view_(view),
      shown_(shown) {
  connect(&session_, &PlanningSession::started, this, &HypercubeDisplay::begin_run);
  connect(&session_, &PlanningSession::roadmap_changed, this, &HypercubeDisplay::take_roadmap);
  connect(&shown_, &QAction::toggled, this, &HypercubeDisplay::take_roadmap);
}

void HypercubeDisplay::begin_run() {
  regions_ = planning::first_regions(*settings_.planner(), 0);
  const bool has_corridor =
      regions_.size() > 1 ||
      geometric::parameter_called(settings_.planner()->parameters(), "rho_a") != nullptr;
  if (!has_corridor) {
    regions_.clear();
  }
}

std::size_t HypercubeDisplay::search() const {
  return static_cast<std::size_t>(session_.roadmap()->roadmap.winner.value_or(0));
}

std::optional<double> HypercubeDisplay::half_side() const {
  if (!session_.roadmap() || search() >= regions_.size()) {
    return std::nullopt;
  }
  double largest = 0.0;
  for (const auto& node : session_.roadmap()->roadmap.nodes) {
    if (static_cast<std::size_t>(node.search) == search()) {
      largest = std::max(largest, node.rho_a);
    }
  }
  return largest > 0.0 ? std::optional(largest) : std::nullopt;
}

void HypercubeDisplay::take_roadmap() {
  const std::optional<double> rho = half_side();
  if (!rho || !shown_.isChecked()) {
    clear();
    return;
  }
  Subject subject{regions_[search()], session_.roadmap()->roadmap.search_range};
  subject.region.rho_a = *rho;
  if (!drawn_ || drawn_->region.rho_a != *rho || drawn_->range != subject.range ||
      drawn_->region.corridor != subject.region.corridor) {
    draw(subject);
  }
}

void HypercubeDisplay::clear() {
  job_.cancel();
  drawn_.reset();
  boxes_.clear();
  view_.set_overlay(Overlay::kHypercubes, nullptr);
  emit changed();
}

void HypercubeDisplay::draw(const Subject& subject) {
  drawn_ = subject;
  job_.run([this, subject, problem = document_.problem(),
            palm = document_.palm()](const std::stop_token& stop) -> LatestJob::Answer {
    try {
      const PreparedProblem::Problem prepared = problem->wait(stop);
      if (!prepared) {
        return {};
      }
      return [this, subject,
              boxes = planning::palm_boxes(*prepared, palm, subject.region, kMostBoxes, stop)] {
        boxes_ = boxes;
        view_.set_overlay(Overlay::kHypercubes, make_boxes_node(boxes, subject.range));
        emit changed();
      };
    } catch (const std::exception&) {
      return [this] { clear(); };  // planning has said what is wrong
    }
  });
}

namespace {

constexpr int kMargin = 12;

QColor mark_color(const geometric::Color& color) {
  return seen_on(colors_of(current_theme()).surface,
                 QColor::fromRgbF(color.red, color.green, color.blue));
}

QString legend_row(const QString& name, int count, const geometric::Color& color) {
  return QStringLiteral(
             "<tr><td style='color:%1'>&#9679;</td><td style='padding-left:6px'>%2</td>"
             "<td align='right' style='padding-left:18px'>%3</td></tr>")
      .arg(mark_color(color).name(), name, QLocale().toString(count));
}

// Returns the meaning of the colours, and the part that is searched, or was last.
QString note_of(const PalmRoadmap& roadmap, int most, bool goes_on) {
  QString note = most > 0 ? QObject::tr("Nodes by number of PMDs") : QString();
  const auto& [begin, end] = roadmap.roadmap.search_range;
  if ((begin > 0.0 || end < 1.0) && end - begin > 0.005) {
    note = (goes_on ? QObject::tr("Searching %1 to %2 % of the arm's path")
                    : QObject::tr("Last searched %1 to %2 % of the arm's path"))
               .arg(std::lround(100.0 * begin))
               .arg(std::lround(100.0 * end)) +
           (note.isEmpty() ? QString() : QStringLiteral("<br>")) + note;
  }
  if (roadmap.roadmap.left_out > 0) {
    note += QObject::tr("<br>%n more node(s) not shown", nullptr,
                        static_cast<int>(roadmap.roadmap.left_out));
  }
  return note;
}

}  // namespace

RoadmapLegend::RoadmapLegend(QAction& hypercubes, QWidget* host)
    : FloatingCard(host, "roadmap_legend", "legend"),
      title_(named("roadmap_title", heading())),
      details_(new QWidget),
      fold_(make_fold(QStringLiteral("roadmap_fold"), *details_)),
      note_(named("roadmap_note", note())),
      counts_(named("roadmap_counts", new QLabel)),
      boxes_(named("roadmap_boxes", new QCheckBox)) {
  lay_out(*this, in_column({in_row({{title_, 1}, fold_}), details_}, 3), {12, 8, 12, 8});
  lay_out(*details_, in_column({note_, counts_, boxes_}, 3));
  note_->setTextFormat(Qt::RichText);
  counts_->setTextFormat(Qt::RichText);
  boxes_->setFocusPolicy(Qt::NoFocus);
  boxes_->setChecked(hypercubes.isChecked());
  boxes_->setToolTip(tr("Boxes around the positions of the palm in the sampling cells of the arm "
                        "(%1). Orange: still searched; grey: abandoned")
                         .arg(hypercubes.shortcut().toString(QKeySequence::NativeText)));
  connect(boxes_, &QCheckBox::toggled, &hypercubes, &QAction::setChecked);
  connect(&hypercubes, &QAction::toggled, boxes_, &QCheckBox::setChecked);
}

void RoadmapLegend::show_roadmap(const SharedRoadmap& roadmap, const Search& search) {
  if (!roadmap || roadmap->roadmap.nodes.empty()) {
    hide();
    return;
  }
  const std::vector<int> counts = nodes_per_pmds(*roadmap);
  const int most = static_cast<int>(counts.size()) - 1;
  title_->setText(tr("Roadmap: %1 nodes, %2 edges")
                      .arg(QLocale().toString(static_cast<int>(roadmap->roadmap.nodes.size())),
                           QLocale().toString(static_cast<int>(roadmap->roadmap.edges.size()))));
  const QString note = note_of(*roadmap, most, search.goes_on);
  note_->setText(note);
  note_->setVisible(!note.isEmpty());
  QString rows;
  for (int count = 0; count <= most; ++count) {
    if (counts[static_cast<std::size_t>(count)] > 0) {
      rows += legend_row(QString::number(count), counts[static_cast<std::size_t>(count)],
                         pmd_color(count, most));
    }
  }
  counts_->setText(QStringLiteral("<table cellspacing='0'>%1</table>").arg(rows));
  counts_->setVisible(most > 0);
  boxes_->setVisible(search.half_side.has_value());
  if (search.half_side) {
    boxes_->setText(tr("Sampling cells (ρₐ = %1)").arg(*search.half_side, 0, 'g', 2));
  }
  appear();
}

void RoadmapLegend::place() {
  adjustSize();
  if (!fold_->isChecked() && height() + 2 * kMargin > parentWidget()->height()) {
    fold_->setChecked(true);  // and so comes back here
    return;
  }
  stand_at_lower_right();
}

std::vector<int> nodes_per_pmds(const PalmRoadmap& roadmap) {
  std::vector<int> counts(static_cast<std::size_t>(most_pmds(roadmap)) + 1);
  for (const auto& node : roadmap.roadmap.nodes) {
    ++counts[static_cast<std::size_t>(node.pmd_count)];
  }
  return counts;
}

RoadmapDisplay::RoadmapDisplay(PlanningSession& session, SceneView& view, QAction& shown,
                               HypercubeDisplay& hypercubes, QAction& hypercubes_shown,
                               QObject* parent)
    : QObject(parent),
      session_(session),
      view_(view),
      shown_(shown),
      hypercubes_(hypercubes),
      legend_(new RoadmapLegend(hypercubes_shown, &view)) {
  connect(&hypercubes_, &HypercubeDisplay::changed, this, &RoadmapDisplay::show_legend);
  connect(&session_, &PlanningSession::ended, this, &RoadmapDisplay::show_legend);
  connect(&session_, &PlanningSession::roadmap_changed, this, &RoadmapDisplay::draw);
  view_.set_overlay_visible(Overlay::kRoadmap, shown_.isChecked());
  connect(&shown_, &QAction::toggled, this, [this](bool on) {
    view_.set_overlay_visible(Overlay::kRoadmap, on);
    show_legend();
  });
}

void RoadmapDisplay::draw() {
  const SharedRoadmap& roadmap = session_.roadmap();
  if (roadmap && !roadmap->palms.empty()) {
    view_.set_overlay(Overlay::kRoadmap, make_roadmap_node(*roadmap));
  } else {
    view_.set_overlay(Overlay::kRoadmap, nullptr);
  }
  show_legend();
}

void RoadmapDisplay::show_legend() {
  legend_->show_roadmap(shown_.isChecked() ? session_.roadmap() : nullptr,
                        {session_.is_running(), hypercubes_.half_side()});
}

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
    : FloatingCard(host, "frontier_legend", "legend"),
      from_start_(nullptr),
      from_goal_(nullptr),
      colliding_(named("frontier_colliding", new QLabel)) {
  colliding_->setTextFormat(Qt::RichText);
  auto* close = named("frontier_close", new QToolButton);
  close->setText(QStringLiteral("×"));
  close->setAutoRaise(true);
  close->setToolTip(tr("Hide these ghosts"));
  connect(close, &QToolButton::clicked, this, &FrontierLegend::closed);
  auto* rows = new QGridLayout;
  rows->setHorizontalSpacing(14);
  rows->setVerticalSpacing(3);
  from_start_ = add_row(*rows, "frontier_from_start", true);
  from_goal_ = add_row(*rows, "frontier_from_goal", false);
  rows->addWidget(colliding_, 2, 0, 1, 2);
  lay_out(
      *this,
      in_column({in_row({{heading(tr("No path: configurations reached")), 1}, close}), rows}, 3),
      {12, 6, 8, 10});
}

QLabel* FrontierLegend::add_row(QGridLayout& rows, const char* name, bool from_start) {
  auto* label = new QLabel;
  label->setObjectName(QLatin1String(name));
  label->setTextFormat(Qt::RichText);
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
  connect(&document_, &Document::edited, this, [this](const planning::SceneState& before) {
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
