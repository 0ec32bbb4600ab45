#include "panels/grasp_card.h"

#include "handway/geometric/math/units.h"
#include "style/icons.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>
#include <QVariant>

namespace handway::gui {
namespace {

constexpr int kWidth = 290;
constexpr int kMargin = 12;

QString row_text(int rank, const planning::Pregrasp& grasp) {
  return QObject::tr("%1.  %2 fingers, %3 mm clear, %4 % around")
      .arg(rank)
      .arg(grasp.fingers)
      .arg(geometric::millimetres(grasp.clearance), 0, 'f', 0)
      .arg(100.0 * grasp.enclosure, 0, 'f', 0);
}

QString row_tip(const planning::Pregrasp& grasp) {
  return QObject::tr(
             "Score %1; %2 from the hand's principal motion directions, arm travel %3 "
             "(normalised joints)")
      .arg(grasp.score, 0, 'f', 2)
      .arg(grasp.subspace_distance, 0, 'f', 2)
      .arg(grasp.arm_travel, 0, 'f', 2);
}

}  // namespace

GraspCard::GraspCard(QWidget* host)
    : QFrame(host),
      title_(new QLabel),
      note_(new QLabel),
      list_(new QListWidget),
      plan_(new QPushButton(tr("Plan to this grasp"))) {
  setAttribute(Qt::WA_StyledBackground);
  setProperty("role", "offer");
  setObjectName(QStringLiteral("grasps"));
  title_->setProperty("role", "heading");
  note_->setProperty("role", "note");
  note_->setObjectName(QStringLiteral("grasp_note"));
  note_->setWordWrap(true);
  list_->setObjectName(QStringLiteral("grasp_list"));
  list_->setFrameShape(QFrame::NoFrame);
  plan_->setObjectName(QStringLiteral("grasp_plan"));
  plan_->setProperty("role", "primary");
  plan_->setToolTip(tr("Take it for the goal and plan"));
  auto* close = new QToolButton;
  close->setObjectName(QStringLiteral("grasp_close"));
  close->setIcon(icon("close"));
  close->setAutoRaise(true);
  close->setToolTip(tr("Leave the goal as it is"));
  connect(close, &QToolButton::clicked, this, [this] {
    hide();
    emit closed();
  });
  connect(list_, &QListWidget::currentRowChanged, this, [this](int row) {
    plan_->setEnabled(row >= 0);
    if (row >= 0) {
      emit looked_at(row);
    }
  });
  connect(list_, &QListWidget::itemDoubleClicked, plan_, &QPushButton::click);
  connect(plan_, &QPushButton::clicked, this, [this] {
    hide();
    emit chosen(list_->currentRow());
  });
  auto* header = new QHBoxLayout;
  header->addWidget(title_, 1);
  header->addWidget(close, 0, Qt::AlignTop);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 6, 8, 10);
  layout->setSpacing(6);
  layout->addLayout(header);
  layout->addWidget(note_);
  layout->addWidget(list_, 1);
  layout->addWidget(plan_);
  host->installEventFilter(this);
  hide();
}

void GraspCard::show_search(const QString& object) {
  set_up(tr("Grasp %1").arg(object), tr("Looking for ways to grasp it…"), false);
}

void GraspCard::show_grasps(const QString& object, const std::vector<planning::Pregrasp>& grasps) {
  if (grasps.empty()) {
    show_failure(object, tr("No way to grasp it was found: it is too large for the hand, out of "
                            "reach, or other things are too close."));
    return;
  }
  list_->clear();
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    list_->addItem(row_text(static_cast<int>(i) + 1, grasps[i]));
    list_->item(static_cast<int>(i))->setToolTip(row_tip(grasps[i]));
  }
  set_up(tr("Grasp %1").arg(object), tr("The best first; the ghost shows the one chosen."), true);
  list_->setCurrentRow(0);
}

void GraspCard::show_failure(const QString& object, const QString& reason) {
  set_up(tr("Grasp %1").arg(object), reason, false);
}

void GraspCard::set_up(const QString& title, const QString& note, bool with_list) {
  title_->setText(title);
  note_->setText(note);
  list_->setVisible(with_list);
  plan_->setVisible(with_list);
  show();
  place();
  raise();
}

bool GraspCard::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && !isHidden()) {
    place();
  }
  return QFrame::eventFilter(watched, event);
}

void GraspCard::place() {
  const int height = list_->isVisibleTo(this) ? 290 : layout()->heightForWidth(kWidth);
  setGeometry(parentWidget()->width() - kWidth - kMargin, kMargin, kWidth, height);
}

}  // namespace handway::gui
