#include "widgets/style/text_rules.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QComboBox>
#include <QFileDialog>
#include <QFontMetrics>
#include <QHelpEvent>
#include <QLabel>
#include <QStringList>
#include <QTextLayout>
#include <QToolTip>

namespace handway::gui {
namespace {

constexpr int kLettersInALine = 70;

int widest_line() { return kLettersInALine * QFontMetrics(QToolTip::font()).averageCharWidth(); }

bool is_too_wide(const QString& tip) {
  return QFontMetrics(QToolTip::font()).size(0, tip).width() > widest_line();
}

QString broken_into_lines(const QString& text) {
  QTextOption option;
  option.setWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
  QStringList lines;
  for (const QString& paragraph : text.split(QLatin1Char('\n'))) {
    QTextLayout layout(paragraph, QToolTip::font());
    layout.setTextOption(option);
    layout.beginLayout();
    for (QTextLine line = layout.createLine(); line.isValid(); line = layout.createLine()) {
      line.setLineWidth(widest_line());
      lines << paragraph.mid(line.textStart(), line.textLength()).trimmed();
    }
    layout.endLayout();
  }
  return lines.join(QLatin1Char('\n'));
}

// Breaks the tool tip of a widget, or of an item of a list, tree or table, into lines. Returns
// whether it was shown so; Qt shows those that fit.
bool show_in_lines(QWidget& widget, const QHelpEvent& event) {
  auto* view = qobject_cast<QAbstractItemView*>(widget.parentWidget());
  const QModelIndex item =
      view && view->viewport() == &widget ? view->indexAt(event.pos()) : QModelIndex();
  const QString tip = item.isValid() ? item.data(Qt::ToolTipRole).toString() : widget.toolTip();
  if (!is_too_wide(tip)) {
    return false;
  }
  QToolTip::showText(event.globalPos(), broken_into_lines(tip), &widget,
                     item.isValid() ? view->visualRect(item) : QRect());
  return true;
}

void show_all_in_tips(const QFileDialog& dialog) {
  for (auto* choice : dialog.findChildren<QComboBox*>()) {
    choice->setToolTip(choice->currentText());
    QObject::connect(choice, &QComboBox::currentTextChanged, choice, &QWidget::setToolTip,
                     Qt::UniqueConnection);
  }
}

}  // namespace

TextRules::TextRules(QObject* parent) : QObject(parent) { qApp->installEventFilter(this); }

bool TextRules::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::Polish:  // before a widget is measured or shown
    case QEvent::Show:
      // Qt's tool tips are labels, too.
      if (auto* label = qobject_cast<QLabel*>(watched);
          label && label->textFormat() == Qt::AutoText) {
        label->setTextFormat(Qt::PlainText);
      }
      if (const auto* dialog = qobject_cast<QFileDialog*>(watched)) {
        show_all_in_tips(*dialog);
      }
      break;
    case QEvent::ToolTip:
      if (watched->isWidgetType() &&
          show_in_lines(*static_cast<QWidget*>(watched), *static_cast<const QHelpEvent*>(event))) {
        return true;
      }
      break;
    default:
      break;
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace handway::gui
