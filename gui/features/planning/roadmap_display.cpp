#include "features/planning/roadmap_display.h"

#include "model/document/document.h"
#include "model/planning/plan_settings.h"
#include "model/planning/planning_session.h"
#include "view3d/region_node.h"
#include "view3d/roadmap_node.h"
#include "view3d/scene_view.h"

#include <QAction>
#include <QCheckBox>
#include <QColor>
#include <QLabel>
#include <QLocale>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <exception>

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
      planning::parameter_called(settings_.planner()->parameters(), "rho_a") != nullptr;
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

QString legend_row(const QString& name, int count, const geometric::Color& color) {
  return QStringLiteral(
             "<tr><td style='color:%1'>&#9679;</td><td style='padding-left:6px'>%2</td>"
             "<td align='right' style='padding-left:18px'>%3</td></tr>")
      .arg(QColor::fromRgbF(color.red, color.green, color.blue).name(), name,
           QLocale().toString(count));
}

// What the colours mean, and what is searched, or was at last.
QString note_of(const PalmRoadmap& roadmap, int most, bool goes_on) {
  QString note = most > 0 ? QObject::tr("Nodes by principal directions used") : QString();
  const auto& [begin, end] = roadmap.roadmap.search_range;
  if ((begin > 0.0 || end < 1.0) && end - begin > 0.005) {
    note = (goes_on ? QObject::tr("Searching %1 to %2 % of the arm's way")
                    : QObject::tr("Searched %1 to %2 % of the arm's way at last"))
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
    : FloatingCard(host),
      title_(new QLabel),
      note_(new QLabel),
      counts_(new QLabel),
      boxes_(new QCheckBox) {
  setProperty("role", "legend");
  setObjectName(QStringLiteral("roadmap_legend"));
  title_->setProperty("role", "heading");
  title_->setObjectName(QStringLiteral("roadmap_title"));
  note_->setProperty("role", "note");
  note_->setObjectName(QStringLiteral("roadmap_note"));
  counts_->setObjectName(QStringLiteral("roadmap_counts"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 8, 12, 8);
  layout->setSpacing(3);
  for (QLabel* label : {title_, note_, counts_}) {
    layout->addWidget(label);
  }
  layout->addWidget(boxes_);
  boxes_->setObjectName(QStringLiteral("roadmap_boxes"));
  boxes_->setFocusPolicy(Qt::NoFocus);
  boxes_->setChecked(hypercubes.isChecked());
  boxes_->setToolTip(
      tr("Boxes around the palm's places in the hypercubes that arm configurations are drawn "
         "from (%1). Orange: still searched; grey: given up")
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
      rows += legend_row(count > 0 ? QString::number(count) : tr("none"),
                         counts[static_cast<std::size_t>(count)], pmd_color(count, most));
    }
  }
  counts_->setText(QStringLiteral("<table cellspacing='0'>%1</table>").arg(rows));
  counts_->setVisible(most > 0);
  boxes_->setVisible(search.half_side.has_value());
  if (search.half_side) {
    boxes_->setText(tr("Hypercubes, ρₐ %1").arg(*search.half_side, 0, 'g', 2));
  }
  appear();
}

void RoadmapLegend::place() {
  adjustSize();
  QRect place(QPoint(), size());
  place.moveBottomRight(parentWidget()->rect().bottomRight() - QPoint(kMargin, kMargin));
  for (const FloatingCard* other : others()) {  // above what is in its way
    if (place.intersects(other->geometry())) {
      place.moveBottom(other->geometry().top() - kMargin);
    }
  }
  move(place.topLeft());
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

}  // namespace handway::gui
