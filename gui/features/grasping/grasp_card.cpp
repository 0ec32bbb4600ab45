#include "features/grasping/grasp_card.h"

#include "handway/geometric/math/units.h"
#include "widgets/forms/arrangement.h"
#include "widgets/panels/film_bar.h"
#include "widgets/style/actions.h"
#include "widgets/style/theme.h"

#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QToolButton>
#include <QTreeWidget>
#include <QVariant>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kWidth = 400;
constexpr int kMargin = 12;
constexpr int kColumnWidth = 60;
constexpr int kFewestRows = 3;
constexpr int kProgressSteps = 1000;
constexpr int kHeldColumn = 5;

QStringList row_texts(int rank, const planning::Pregrasp& grasp) {
  return {QString::number(rank),
          QString::number(grasp.contacts.size()),
          QString::number(grasp.quality.epsilon, 'f', 3),
          QObject::tr("%1 mm").arg(geometric::millimetres(grasp.clearance), 0, 'f', 0),
          QString::number(grasp.score, 'f', 2),
          QString()};
}

QString hold_text(const planning::HoldResult& result) {
  return QObject::tr("%1 of 6").arg(result.directions_held());
}

QString hold_tip(const planning::HoldResult& result) {
  const planning::HoldConditions conditions;
  const QString forces = QObject::tr("Simulated: held against %1 of 6 forces of %2 N")
                             .arg(result.directions_held())
                             .arg(conditions.force);
  if (!result.lift) {
    return forces;
  }
  const QString lift = result.lift->held
                           ? QObject::tr("Raised by 10 cm and held for 5 s: slips by %1 mm and %2°")
                                 .arg(geometric::millimetres(result.lift->shift), 0, 'f', 1)
                                 .arg(geometric::degrees(result.lift->turn), 0, 'f', 1)
                           : QObject::tr("Dropped when it was raised");
  return forces + QLatin1Char('\n') + lift + QLatin1Char('\n') +
         QObject::tr("%1 kg, friction %2").arg(conditions.mass).arg(conditions.contact.friction);
}

QString row_tip(const planning::Pregrasp& grasp) {
  QString tip = QObject::tr(
                    "%1 fingers near the object, thumb and fingers %2 % on opposite sides\n"
                    "%3 from the hand's principal motion directions, arm travel %4 (normalised "
                    "joints)")
                    .arg(grasp.fingers)
                    .arg(100.0 * grasp.enclosure, 0, 'f', 0)
                    .arg(grasp.subspace_distance, 0, 'f', 2)
                    .arg(grasp.arm_travel, 0, 'f', 2);
  if (!grasp.doubt.empty()) {
    tip += QLatin1Char('\n') + QString::fromStdString(grasp.doubt);
  }
  return tip;
}

}  // namespace

GraspCard::GraspCard(QWidget* host, std::function<std::vector<QPoint>()> to_be_seen)
    : FloatingCard(host, "grasps", "offer"),
      to_be_seen_(std::move(to_be_seen)),
      title_(heading()),
      details_(new QWidget),
      fold_(make_fold(QStringLiteral("grasp_fold"), *details_)),
      note_(named("grasp_note", note())),
      list_(named("grasp_list", new QTreeWidget)),
      search_(new QWidget),
      progress_(named("grasp_progress", new QProgressBar)),
      film_(named("grasp_film", new QPushButton(tr("Watch the test")))),
      film_bar_(named("grasp_film_bar", new FilmBar)),
      search_others_(named("grasp_search", new QPushButton(tr("Search for others")))),
      keep_(named("grasp_keep", new QPushButton(tr("Keep…")))),
      plan_(named("grasp_plan", new QPushButton(tr("Plan to this grasp")))) {
  note_->setWordWrap(true);
  list_->setAccessibleName(tr("Grasps"));
  list_->setFrameShape(QFrame::NoFrame);
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setHeaderLabels(
      {QString(), tr("Contacts"), tr("Epsilon"), tr("Clear"), tr("Score"), tr("Held")});
  list_->header()->setStretchLastSection(false);
  list_->header()->setMinimumSectionSize(scaled(kColumnWidth));
  list_->header()->setSectionResizeMode(QHeaderView::Stretch);
  list_->header()->setSectionResizeMode(0, QHeaderView::Fixed);
  list_->header()->resizeSection(0, scaled(kColumnWidth));
  const QStringList words{tr("Rank"),
                          tr("Contacts of the closed hand with the object"),
                          tr("Smallest disturbance in N that 1 N of contact forces cannot resist, "
                             "with friction %1; 0 or less: it may slip")
                              .arg(planning::PregraspOptions{}.contact.friction),
                          tr("Clearance of robot and hand from all other bodies, up to 50 mm"),
                          tr("Score for the ranking, from 0 to 1"),
                          tr("Simulated: in how many of six directions the object stays in the "
                             "hand")};
  for (int column = 0; column < words.size(); ++column) {
    list_->headerItem()->setToolTip(column, words[column]);
  }
  progress_->setRange(0, kProgressSteps);
  progress_->setTextVisible(false);
  progress_->setFixedHeight(6);
  auto* stop = named("grasp_stop", new QPushButton(tr("Stop")));
  stop->setToolTip(tr("End the search and keep what was found"));
  connect(stop, &QPushButton::clicked, this, &GraspCard::stop_requested);
  lay_out(*search_, in_row({{progress_, 1}, stop}, 8));
  film_->setCheckable(true);
  film_->setToolTip(
      tr("Show the simulation of this grasp: the hand squeezes, six forces pull, it is raised"));
  connect(film_, &QPushButton::clicked, this,
          [this](bool wanted) { emit film_wanted(row(), wanted); });
  search_others_->setToolTip(tr("Search for grasps instead of showing those that the scene keeps"));
  connect(search_others_, &QPushButton::clicked, this, &GraspCard::search_requested);
  keep_->setToolTip(
      tr("Save these grasps in a file for the object: tasks pick it with the first "
         "of them that is possible"));
  connect(keep_, &QPushButton::clicked, this, &GraspCard::keep_requested);
  plan_->setProperty("role", "primary");
  plan_->setToolTip(tr("Set this grasp as the goal, and plan"));
  QToolButton* close = make_close("grasp_close", tr("Leave the goal as it is"));
  connect(close, &QToolButton::clicked, this, [this] {
    hide();
    emit closed();
  });
  connect(list_, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    const int row = list_->indexOfTopLevelItem(item);
    plan_->setEnabled(row >= 0);
    update_film();
    if (row >= 0) {
      emit looked_at(row);
    }
  });
  for (const auto by_person : {&QTreeWidget::itemClicked, &QTreeWidget::itemActivated}) {
    connect(list_, by_person, this, [this] { is_chosen_ = true; });
  }
  connect(list_, &QTreeWidget::itemDoubleClicked, plan_, &QPushButton::click);
  connect(plan_, &QPushButton::clicked, this, [this] {
    hide();
    emit chosen(row());
  });
  lay_out(
      *details_,
      in_column({note_, search_, {list_, 1}, film_bar_, film_, in_row({search_others_, keep_}, 8)},
                6));
  lay_out(*this,
          in_column({in_row({{title_, 1}, {fold_, 0, Qt::AlignTop}, {close, 0, Qt::AlignTop}}),
                     {details_, 1},
                     plan_},
                    6),
          {12, 6, 8, 10});
}

void GraspCard::show_search(const QString& object) {
  title_->setText(tr("Grasp %1").arg(object));
  listed_.clear();
  list_->clear();
  is_chosen_ = false;
  progress_->setValue(0);
  set_up(tr("Searching for grasps…"), {.progress = true});
}

void GraspCard::show_progress(const std::vector<planning::Pregrasp>& grasps, double fraction) {
  progress_->setValue(static_cast<int>(std::lround(kProgressSteps * fraction)));
  list(grasps);
  const int percent = static_cast<int>(std::lround(100.0 * fraction));
  set_up(
      grasps.empty()
          ? tr("Searching for grasps… %1 %").arg(percent)
          : tr("The best so far, %1 % searched. Choose one, or continue the search.").arg(percent),
      {.list = !grasps.empty(), .progress = true});
}

void GraspCard::show_grasps(const std::vector<planning::Pregrasp>& grasps, const QString& note,
                            GraspOrigin origin) {
  list(grasps);
  set_up(note, {.list = true,
                .others = origin != GraspOrigin::kSearch,
                .keep = origin != GraspOrigin::kFile});
}

void GraspCard::list(const std::vector<planning::Pregrasp>& grasps) {
  const auto same = [](const planning::Pregrasp& a, const planning::Pregrasp& b) {
    return a.q == b.q;
  };
  if (std::ranges::equal(grasps, listed_, same)) {
    return;
  }
  const int before = list_->indexOfTopLevelItem(list_->currentItem());
  int row = 0;
  if (is_chosen_ && before >= 0) {
    const auto& chosen = listed_[static_cast<std::size_t>(before)];
    const auto now =
        std::ranges::find_if(grasps, [&](const auto& grasp) { return same(grasp, chosen); });
    row = now == grasps.end() ? 0 : static_cast<int>(now - grasps.begin());
  }
  const bool is_first = listed_.empty();
  listed_ = grasps;
  {
    const QSignalBlocker quiet(list_);
    list_->clear();
    for (std::size_t i = 0; i < grasps.size(); ++i) {
      auto* item = new QTreeWidgetItem(list_, row_texts(static_cast<int>(i) + 1, grasps[i]));
      for (int column = 0; column < list_->columnCount(); ++column) {
        item->setToolTip(column, row_tip(grasps[i]));
        item->setTextAlignment(column, column == 0 ? Qt::AlignRight : Qt::AlignHCenter);
      }
    }
  }
  list_->setCurrentItem(list_->topLevelItem(row));
  if (is_first) {
    fold_->setChecked(false);
  }
}

void GraspCard::show_ranked(const std::vector<planning::Pregrasp>& grasps) {
  list(grasps);
  place();
}

void GraspCard::show_failure(const QString& object, const QString& reason, GraspOrigin origin) {
  title_->setText(tr("Grasp %1").arg(object));
  set_up(reason, {.others = origin != GraspOrigin::kSearch});
}

int GraspCard::row() const { return list_->indexOfTopLevelItem(list_->currentItem()); }

void GraspCard::show_tests(bool possible) { list_->setColumnHidden(kHeldColumn, !possible); }

void GraspCard::show_untested(const QString& reason) {
  show_tests(false);
  set_up(tr("Not simulated: %1").arg(reason), parts_);
}

void GraspCard::show_hold(int index, const planning::HoldResult& result) {
  QTreeWidgetItem* item = list_->topLevelItem(index);
  if (item == nullptr) {
    return;
  }
  item->setText(kHeldColumn, hold_text(result));
  item->setToolTip(kHeldColumn, hold_tip(result));
  update_film();
}

void GraspCard::update_film() {
  const QTreeWidgetItem* item = list_->currentItem();
  film_->setEnabled(item != nullptr && !item->text(kHeldColumn).isEmpty());
}

void GraspCard::show_film(const QString& what) {
  if (note_before_film_.isEmpty()) {
    note_before_film_ = note_->text();
  }
  film_->setChecked(!what.isEmpty());
  film_->setText(what.isEmpty() ? tr("Watch the test") : tr("Stop"));
  note_->setText(what.isEmpty() ? std::exchange(note_before_film_, QString()) : what);
}

void GraspCard::set_up(const QString& note, const Parts& parts) {
  parts_ = parts;
  note_->setText(note);
  search_->setVisible(parts.progress);
  list_->setVisible(parts.list);
  plan_->setVisible(parts.list);
  search_others_->setVisible(parts.others);
  keep_->setVisible(parts.keep);
  film_->setVisible(parts.list && !list_->isColumnHidden(kHeldColumn));
  film_bar_->setVisible(film_->isVisibleTo(this));
  fold_->setVisible(parts.list);
  appear();
}

void GraspCard::place() {
  const QRect within = parentWidget()->rect().adjusted(kMargin, kMargin, -kMargin, -kMargin);
  const int width = std::min(scaled(kWidth), within.width());
  const auto height_with = [this, width](int rows) {
    list_->setFixedHeight(list_->header()->sizeHint().height() + rows * list_->sizeHintForRow(0) +
                          2);
    details_->layout()->activate();
    return layout()->totalHeightForWidth(width);
  };
  int rows = list_->topLevelItemCount();
  int height = height_with(rows);
  while (height > within.height() && rows > kFewestRows) {
    height = height_with(--rows);
  }
  stand_where_it_hides_least({width, std::min(height, within.height())}, to_be_seen_());
}

}  // namespace handway::gui
