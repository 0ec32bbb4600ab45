#include "layout_audit.h"

#include "painted_text.h"
#include "widgets/panels/floating_card.h"
#include "widgets/style/color_math.h"
#include "widgets/style/theme.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractScrollArea>
#include <QAbstractSpinBox>
#include <QCheckBox>
#include <QComboBox>
#include <QHash>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QMainWindow>
#include <QPixmap>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QStyleOptionComboBox>
#include <QStyleOptionFrame>
#include <QTabBar>
#include <QTextBlock>
#include <QTextDocument>
#include <QToolButton>

#include <algorithm>

namespace handway::test {
namespace {

constexpr double kLeastContrast = 4.5;
constexpr double kLeastOfMarks = 3.0;
constexpr double kZoom = 3.0;  // at which strokes of letters are wider than a pixel
constexpr int kRounding = 1;   // px
constexpr int kLineEditMargin = 4;
constexpr double kAir = 1.5;  // px, by which letters may reach over an edge unseen

QString name_of(const QWidget& widget) {
  QStringList names;
  for (const QWidget* part = &widget; part && names.size() < 4; part = part->parentWidget()) {
    if (!part->objectName().isEmpty() && !part->objectName().startsWith(QLatin1String("qt_"))) {
      names.prepend(part->objectName());
    } else if (part == &widget) {
      names.prepend(QLatin1String(part->metaObject()->className()));
    }
  }
  return names.join(QLatin1Char('/'));
}

QString plain(const QString& text) {
  if (!Qt::mightBeRichText(text)) {
    return text;
  }
  QTextDocument document;
  document.setHtml(text);
  return document.toPlainText();
}

bool tells(const QString& tool_tip, const QString& text) {
  return !tool_tip.isEmpty() && plain(tool_tip).contains(plain(text).trimmed());
}

/// Collects the faults of one tree of widgets.
class Audit {
 public:
  /// @param checked places and texts whose contrast is good.
  Audit(QWidget& root, QSet<QString>& checked) : root_(root), checked_(checked) {}

  QStringList run() {
    QList<QWidget*> widgets = root_.findChildren<QWidget*>();
    widgets.prepend(&root_);
    for (QWidget* widget : widgets) {
      if (widget->isVisible() && widget->window() == root_.window() && !is_parked(*widget)) {
        check_place(*widget);
        check_text(*widget);
      }
    }
    return faults_;
  }

 private:
  using Colors = QHash<QRgb, int>;  ///< Number of pixels of each colour.

  void report(const QWidget& widget, const QString& fault) {
    faults_ << QStringLiteral("%1: %2").arg(name_of(widget), fault);
  }
  void report_cut(const QWidget& widget, const QString& text, int has, int needs) {
    report(widget, QStringLiteral("\"%1\" is cut, %2 px of %3")
                       .arg(plain(text).left(60).simplified())
                       .arg(has)
                       .arg(needs));
  }

  // QMainWindow puts aside what is behind tabs, and what it draws its separators with.
  static bool is_parked(const QWidget& widget) {
    for (const QWidget* part = &widget; part && !part->isWindow(); part = part->parentWidget()) {
      if (part->parentWidget()->isWindow() &&
          (part->geometry().bottom() < 0 || part->metaObject() == &QWidget::staticMetaObject)) {
        return qobject_cast<QMainWindow*>(part->parentWidget()) != nullptr;
      }
    }
    return false;
  }

  void check_place(const QWidget& widget) {
    const QWidget* parent = widget.parentWidget();
    if (widget.isWindow() || !parent || &widget == &root_) {
      return;
    }
    if (const auto* area = qobject_cast<const QAbstractScrollArea*>(parent->parentWidget());
        area && area->viewport() == parent) {
      const bool fixed = area->horizontalScrollBarPolicy() == Qt::ScrollBarAlwaysOff &&
                         qobject_cast<const QScrollArea*>(area);
      if (fixed && widget.width() > parent->width() + kRounding) {
        report(widget, QStringLiteral("is %1 px wide in a view of %2 px that can't be scrolled")
                           .arg(widget.width())
                           .arg(parent->width()));
      }
      return;
    }
    if (qobject_cast<const QTabBar*>(parent) || widget.size().isEmpty()) {
      return;
    }
    const QRect room = parent->rect().adjusted(-kRounding, -kRounding, kRounding, kRounding);
    if (!room.contains(widget.geometry())) {
      const QRect place = widget.geometry();
      report(widget, QStringLiteral("is outside of what it is in: %1,%2 %3x%4 in %5x%6")
                         .arg(place.x())
                         .arg(place.y())
                         .arg(place.width())
                         .arg(place.height())
                         .arg(parent->width())
                         .arg(parent->height()));
    }
  }

  void check_text(QWidget& widget) {
    if (auto* label = qobject_cast<QLabel*>(&widget)) {
      check_label(*label);
    } else if (auto* box = qobject_cast<QComboBox*>(&widget)) {
      check_choice(*box);
    } else if (auto* field = qobject_cast<QLineEdit*>(&widget)) {
      check_field(*field);
    } else if (auto* tabs = qobject_cast<QTabBar*>(&widget)) {
      check_tabs(*tabs);
    } else if (auto* header = qobject_cast<QHeaderView*>(&widget)) {
      check_header(*header);
    } else if (auto* view = qobject_cast<QAbstractItemView*>(&widget)) {
      check_items(*view);
    } else if (auto* button = qobject_cast<QAbstractButton*>(&widget)) {
      check_button(*button);
    } else if (!is_of_qt(widget)) {
      check_painted(widget);
    }
  }

  // Returns whether Qt paints the widget, or shows it while the user scrolls there.
  static bool is_of_qt(const QWidget& widget) {
    return QLatin1String(widget.metaObject()->className()).startsWith(QLatin1Char('Q')) &&
           !QLatin1String(widget.metaObject()->className()).startsWith(QLatin1String("Qwt"));
  }

  // Texts that a widget paints itself.
  void check_painted(QWidget& widget) {
    const QRectF room =
        QRectF(widget.rect()).adjusted(-kRounding, -kRounding, kRounding, kRounding);
    QList<PaintedText> before;
    for (const PaintedText& painted : painted_texts(widget)) {
      const QRectF letters = painted.outline.boundingRect();
      const QRectF seen = painted.room.isEmpty() ? room : room & painted.room;
      if (!tells(widget.toolTip(), painted.text) &&
          (letters.left() < seen.left() || letters.right() > seen.right() + kRounding ||
           letters.top() < seen.top() - kAir || letters.bottom() > seen.bottom() + kAir)) {
        report_cut(widget, painted.text, static_cast<int>((letters & seen).width()),
                   static_cast<int>(letters.width()));
      }
      for (const PaintedText& other : before) {
        const QRectF both = letters & other.outline.boundingRect();
        if (both.width() > kAir && both.height() > 0.4 * letters.height()) {
          report(widget, QStringLiteral("\"%1\" is painted over \"%2\"")
                             .arg(painted.text.left(40), other.text.left(40)));
        }
      }
      before << painted;
    }
  }

  void check_label(QLabel& label) {
    if (label.text().isEmpty()) {
      return;
    }
    const bool tells_all = tells(label.toolTip(), label.text());
    if (label.wordWrap()) {
      const int needs = label.heightForWidth(label.width());
      const int widest = label.minimumSizeHint().width();
      if (needs > label.height() + kRounding && !tells_all) {
        report_cut(label, label.text(), label.height(), needs);
      } else if (widest > label.width() + kRounding && !tells_all) {
        report_cut(label, label.text(), label.width(), widest);
      }
    } else if (const QSize needs = label.sizeHint(); !tells_all) {
      if (needs.width() > label.width() + kRounding) {
        report_cut(label, label.text(), label.width(), needs.width());
      } else if (needs.height() > label.height() + kRounding) {
        report_cut(label, label.text(), label.height(), needs.height());
      }
    }
    if (Qt::mightBeRichText(label.text())) {
      check_colors(label);
    } else {
      check_contrast(label, label.rect(), label.text());
    }
  }

  // A rich text has colours of its own.
  void check_colors(QLabel& label) {
    if (!label.isEnabled()) {
      return;
    }
    const QImage picture = picture_of(label, label.rect());
    if (picture.isNull()) {
      return;
    }
    const QColor paper = paper_of(colors_of(picture));
    QTextDocument document;
    document.setHtml(label.text());
    for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
      for (auto it = block.begin(); !it.atEnd(); ++it) {
        const QTextCharFormat format = it.fragment().charFormat();
        const QString text = it.fragment().text().trimmed();
        const QColor ink = format.foreground().style() == Qt::NoBrush
                               ? label.palette().color(label.foregroundRole())
                               : format.foreground().color();
        const bool is_mark = text == QString(QChar(0x25CF));
        const double contrast = gui::contrast(ink, paper);
        if (!text.isEmpty() && contrast < (is_mark ? kLeastOfMarks : kLeastContrast)) {
          report_contrast(label, text, contrast);
        }
      }
    }
  }

  void check_choice(QComboBox& box) {
    if (box.isEditable() || box.currentText().isEmpty()) {
      return;
    }
    QStyleOptionComboBox option;
    option.initFrom(&box);
    const int has =
        box.style()
            ->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, &box)
            .width();
    const int icon = box.itemIcon(box.currentIndex()).isNull() ? 0 : box.iconSize().width() + 4;
    const int needs = box.fontMetrics().horizontalAdvance(box.currentText()) + icon;
    if (needs > has + kRounding && !tells(box.toolTip(), box.currentText())) {
      report_cut(box, box.currentText(), has, needs);
    }
    check_contrast(box, box.rect(), box.currentText());
  }

  void check_field(QLineEdit& field) {
    const QString text = field.text().isEmpty() ? field.placeholderText() : field.text();
    if (text.isEmpty()) {
      return;
    }
    const bool is_of_spin_box = qobject_cast<const QAbstractSpinBox*>(field.parentWidget());
    QStyleOptionFrame option;
    option.initFrom(&field);
    option.lineWidth = field.hasFrame() ? 1 : 0;
    const int has =
        field.style()->subElementRect(QStyle::SE_LineEditContents, &option, &field).width();
    const int needs = field.fontMetrics().horizontalAdvance(text) + kLineEditMargin;
    const QString tool_tip = is_of_spin_box ? QString() : field.toolTip();
    if (needs > has + kRounding && !tells(tool_tip, text)) {
      report_cut(field, text, has, needs);
    }
    check_contrast(field, field.rect(), text);
  }

  void check_tabs(QTabBar& tabs) {
    for (int i = 0; i < tabs.count(); ++i) {
      const QRect tab = tabs.tabRect(i);
      if (!tabs.rect().contains(tab) || !tabs.isTabEnabled(i)) {
        continue;  // a person scrolls to it
      }
      const int needs = tabs.fontMetrics().horizontalAdvance(tabs.tabText(i));
      if (needs > tab.width() && !tells(tabs.tabToolTip(i), tabs.tabText(i))) {
        report_cut(tabs, tabs.tabText(i), tab.width(), needs);
      }
      check_contrast(tabs, tab, tabs.tabText(i));
    }
  }

  void check_header(QHeaderView& header) {
    for (int i = 0; header.orientation() == Qt::Horizontal && i < header.count(); ++i) {
      const QString text = header.model()->headerData(i, Qt::Horizontal).toString();
      const int needs = header.fontMetrics().horizontalAdvance(text);
      const QString tool_tip =
          header.model()->headerData(i, Qt::Horizontal, Qt::ToolTipRole).toString();
      if (!header.isSectionHidden(i) && needs > header.sectionSize(i) + kRounding &&
          tool_tip.isEmpty()) {
        report_cut(header, text, header.sectionSize(i), needs);
      }
    }
  }

  void check_items(QAbstractItemView& view) {
    if (!view.model()) {
      return;
    }
    const bool scrolls = view.horizontalScrollBarPolicy() != Qt::ScrollBarAlwaysOff &&
                         view.horizontalScrollBar()->maximum() > 0;
    QModelIndex last;
    for (int y = 2; y < view.viewport()->height(); y += 6) {
      for (int x = 4; x < view.viewport()->width(); x += 24) {
        const QModelIndex index = view.indexAt({x, y});
        if (index.isValid() && index != last) {
          last = index;
          check_item(view, index, scrolls);
        }
      }
    }
  }

  void check_item(QAbstractItemView& view, const QModelIndex& index, bool scrolls) {
    const QString text = index.data().toString();
    const QRect place = view.visualRect(index);
    if (text.isEmpty() || view.indexWidget(index) || !view.viewport()->rect().contains(place) ||
        seen_.contains(index)) {
      return;
    }
    seen_ << index;
    const auto* list = qobject_cast<const QListView*>(&view);
    const int needs = list && list->wordWrap() ? 0 : view.sizeHintForIndex(index).width();
    if (!scrolls && needs > place.width() + kRounding &&
        !tells(index.data(Qt::ToolTipRole).toString(), text)) {
      report_cut(view, text, place.width(), needs);
    }
    if (index.flags() & Qt::ItemIsEnabled) {
      check_contrast(*view.viewport(), place, text);
    }
  }

  void check_button(QAbstractButton& button) {
    const auto* tool = qobject_cast<const QToolButton*>(&button);
    const bool has_text =
        tool ? tool->toolButtonStyle() != Qt::ToolButtonIconOnly || tool->icon().isNull()
             : qobject_cast<QPushButton*>(&button) || qobject_cast<QCheckBox*>(&button);
    if (button.text().isEmpty() || !has_text) {
      return;
    }
    const QSize needs = button.sizeHint();
    if (needs.width() > button.width() + kRounding && !tells(button.toolTip(), button.text())) {
      report_cut(button, button.text(), button.width(), needs.width());
    }
    QRect words = button.rect();
    if (qobject_cast<QCheckBox*>(&button)) {
      words.setLeft(words.height());
    }
    check_contrast(button, words, button.text());
  }

  void report_contrast(const QWidget& widget, const QString& text, double contrast) {
    report(widget, QStringLiteral("\"%1\" has a contrast of %2")
                       .arg(text.left(60).simplified())
                       .arg(contrast, 0, 'f', 2));
  }

  // Checks the contrast of the painted text: the most frequent colour is the paper, the one
  // farthest from it the ink.
  void check_contrast(QWidget& widget, const QRect& place, const QString& text) {
    const QString key = name_of(widget) + QLatin1Char('\n') + text;
    if (!widget.isEnabled() || text.trimmed().isEmpty() || checked_.contains(key)) {
      return;
    }
    const QImage picture = picture_of(widget, place);
    if (picture.isNull()) {
      return;
    }
    const Colors colors = colors_of(picture);
    double best = 1.0;
    for (auto it = colors.constBegin(); it != colors.constEnd(); ++it) {
      best = std::max(best, gui::contrast(QColor(it.key()), paper_of(colors)));
    }
    if (best < kLeastContrast) {
      report_contrast(widget, text, best);
    } else {
      checked_.insert(key);
    }
  }

  // Returns a picture of the widget with what is behind it, but without the 3-D view, which cards
  // float over; null if a user has to scroll to it in a list.
  static QImage picture_of(QWidget& widget, const QRect& place) {
    QWidget* behind = widget.window();
    for (QWidget* part = &widget; part; part = part->parentWidget()) {
      const auto* area = part->parentWidget()
                             ? qobject_cast<QScrollArea*>(part->parentWidget()->parentWidget())
                             : nullptr;
      if (qobject_cast<gui::FloatingCard*>(part) || (area && area->widget() == part)) {
        behind = part;
        break;
      }
    }
    const QRect there(widget.mapTo(behind, place.topLeft()), place.size());
    if (behind == widget.window() && !(widget.visibleRegion().boundingRect().contains(place))) {
      return {};
    }
    QPixmap picture((QSizeF(place.size()) * kZoom).toSize());
    if (picture.isNull()) {
      return {};
    }
    picture.setDevicePixelRatio(kZoom);
    picture.fill(gui::colors_of(gui::current_theme()).surface);
    behind->render(&picture, {}, QRegion(there));
    return picture.toImage().convertToFormat(QImage::Format_RGB32);
  }

  static Colors colors_of(const QImage& picture) {
    Colors colors;
    for (int y = 0; y < picture.height(); ++y) {
      const auto* line = reinterpret_cast<const QRgb*>(picture.constScanLine(y));
      for (int x = 0; x < picture.width(); ++x) {
        ++colors[line[x]];
      }
    }
    return colors;
  }

  static QColor paper_of(const Colors& colors) {
    const auto most = std::max_element(colors.constBegin(), colors.constEnd());
    return most == colors.constEnd() ? QColor() : QColor(most.key());
  }

  QWidget& root_;
  QStringList faults_;
  QSet<QString>& checked_;
  QList<QModelIndex> seen_;
};

}  // namespace

QStringList LayoutAudit::new_faults(QWidget& root) {
  QStringList faults;
  for (const QString& fault : Audit(root, checked_).run()) {
    if (!known_.contains(fault)) {
      known_.insert(fault);
      faults << fault;
    }
  }
  return faults;
}

}  // namespace handway::test
