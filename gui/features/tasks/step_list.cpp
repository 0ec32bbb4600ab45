#include "features/tasks/step_list.h"

#include <QDropEvent>
#include <QFont>
#include <QHeaderView>
#include <QSignalBlocker>

#include <algorithm>
#include <cstddef>

namespace handway::gui {
namespace {

constexpr int kMostRows = 6;   // more are scrolled to
constexpr int kLeastRows = 2;  // in a small view

}  // namespace

QString words_of(const geometric::ProgramStep& step) {
  return QString::fromStdString(geometric::to_string(step));
}

StepList::StepList(QWidget* parent) : QTreeWidget(parent) {
  setAccessibleName(tr("Steps"));
  setFrameShape(QFrame::NoFrame);
  setHeaderHidden(true);
  setColumnCount(2);
  setRootIsDecorated(false);
  setUniformRowHeights(true);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  setDragDropMode(QAbstractItemView::InternalMove);
}

void StepList::show_steps(const std::vector<geometric::ProgramStep>& steps, int selected) {
  const QSignalBlocker quiet(this);
  ensurePolished();  // the style sheet has a say in the height of rows
  clear();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const QString words = words_of(steps[i]);
    auto* item = new QTreeWidgetItem(this, {QString::number(i + 1), words});
    item->setFlags(item->flags() & ~Qt::ItemIsDropEnabled);  // steps are dropped between others
    if (steps[i].disabled) {
      QFont font = item->font(1);
      font.setStrikeOut(true);
      item->setFont(1, font);
      item->setToolTip(1, tr("Disabled: the program is planned without this step"));
      item->setData(1, Qt::AccessibleTextRole, tr("%1, disabled").arg(words));
    }
  }
  const int last = static_cast<int>(steps.size()) - 1;
  setCurrentItem(topLevelItem(std::clamp(selected, 0, std::max(0, last))));
  setMaximumHeight(height_of(kMostRows));
  updateGeometry();
}

int StepList::height_of(int rows) const {
  return std::min(rows, topLevelItemCount()) * std::max(0, sizeHintForRow(0)) + 2;
}

void StepList::resizeEvent(QResizeEvent* event) {
  QTreeWidget::resizeEvent(event);
  scrollTo(currentIndex());
}

QSize StepList::sizeHint() const { return {QTreeWidget::sizeHint().width(), height_of(kMostRows)}; }

QSize StepList::minimumSizeHint() const {
  return {QTreeWidget::minimumSizeHint().width(), height_of(kLeastRows)};
}

int StepList::row() const { return indexOfTopLevelItem(currentItem()); }

void StepList::dropEvent(QDropEvent* event) {
  const int from = row();
  int before = topLevelItemCount();  // the row before which it is dropped
  if (QTreeWidgetItem* item = itemAt(event->pos())) {
    const bool is_below = event->pos().y() > visualItemRect(item).center().y();
    before = indexOfTopLevelItem(item) + (is_below ? 1 : 0);
  }
  const int to = before > from ? before - 1 : before;
  if (from >= 0 && to != from) {
    // Receivers list the steps anew, which is not allowed while one is dragged.
    QMetaObject::invokeMethod(
        this, [this, from, to] { emit step_dragged(from, to); }, Qt::QueuedConnection);
  }
  event->setDropAction(Qt::IgnoreAction);  // the editor moves the rows
  event->accept();
  stopAutoScroll();
  setState(NoState);
  viewport()->update();
}

}  // namespace handway::gui
