#include "features/planning/roadmap_legend.h"

#include "view3d/pmd_colors.h"
#include "view3d/roadmap_node.h"

#include <QAction>
#include <QCheckBox>
#include <QColor>
#include <QLabel>
#include <QLocale>
#include <QVBoxLayout>

#include <cmath>

namespace handway::gui {
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

}  // namespace handway::gui
