#include "widgets/panels/dock_layout.h"

#include "widgets/forms/arrangement.h"
#include "widgets/style/theme.h"

#include <QAction>
#include <QDockWidget>
#include <QEvent>
#include <QScreen>
#include <QScrollBar>
#include <QSettings>
#include <QTabBar>
#include <QTabWidget>

#include <algorithm>
#include <memory>
#include <utility>

namespace handway::gui {

void bring_to_front(const QWidget& widget) {
  for (QWidget* part = widget.parentWidget(); part; part = part->parentWidget()) {
    auto* tabs = qobject_cast<QTabWidget*>(part);
    for (int page = 0; tabs && page < tabs->count(); ++page) {
      if (tabs->widget(page) == &widget || tabs->widget(page)->isAncestorOf(&widget)) {
        tabs->setCurrentIndex(page);
      }
    }
    if (auto* dock = qobject_cast<QDockWidget*>(part)) {
      dock->show();
      dock->raise();
    }
  }
}

bool is_dock_shown(const QWidget& widget) {
  const QWidget* part = &widget;
  while (part && !qobject_cast<const QDockWidget*>(part)) {
    part = part->parentWidget();
  }
  return part && !part->isHidden();
}

namespace {

constexpr int kVersion = 3;        // raised when docks come or go
constexpr int kHeightBelow = 280;  // px, at first

QString key() { return QStringLiteral("window/layout"); }
QString geometry_key() { return QStringLiteral("window/geometry"); }

QDockWidget* make_dock(QMainWindow& window, const DockContent& content, Qt::DockWidgetArea area) {
  auto* dock = new QDockWidget(content.title, &window);
  dock->setObjectName(QLatin1String(content.name));
  dock->setFeatures(QDockWidget::DockWidgetMovable | QDockWidget::DockWidgetClosable);
  content.widget->setAttribute(Qt::WA_StyledBackground);
  dock->setWidget(content.widget);
  window.addDockWidget(area, dock);
  return dock;
}

// Makes docks as high as they need be when the first of them is opened: hidden ones have no height.
void open_high(QMainWindow& window, const QList<QDockWidget*>& docks) {
  const auto opened = std::make_shared<bool>(false);
  for (QDockWidget* dock : docks) {
    QObject::connect(
        dock->toggleViewAction(), &QAction::triggered, dock, [&window, dock, opened](bool open) {
          if (open && !std::exchange(*opened, true) && dock->height() < scaled(kHeightBelow)) {
            window.resizeDocks({dock}, {scaled(kHeightBelow)}, Qt::Vertical);
          }
        });
  }
}

// Docks between those on the left and those on the right.
QList<QDockWidget*> make_docks_below(QMainWindow& window,
                                     const std::vector<DockContent>& contents) {
  window.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  window.setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  QList<QDockWidget*> docks;
  for (const DockContent& content : contents) {
    docks.append(make_dock(window, content, Qt::BottomDockWidgetArea));
    if (docks.size() > 1) {
      window.tabifyDockWidget(docks.front(), docks.back());
    }
    QObject::connect(docks.back()->toggleViewAction(), &QAction::triggered, docks.back(),
                     &QWidget::raise);
  }
  for (QDockWidget* dock : docks) {
    dock->hide();
  }
  open_high(window, docks);
  return docks;
}

QTabWidget* make_tabs(const std::vector<DockContent>& contents) {
  auto* tabs = named("control_tabs", new QTabWidget);
  tabs->setDocumentMode(true);
  tabs->tabBar()->setDrawBase(false);
  tabs->tabBar()->setExpanding(true);
  tabs->tabBar()->setUsesScrollButtons(true);  // where a narrow window has no room for all
  for (const DockContent& content : contents) {
    content.widget->setObjectName(QLatin1String(content.name));
    tabs->addTab(content.widget, content.title);
  }
  return tabs;
}

}  // namespace

DockSwitches build_docks(QMainWindow& window, const DockContents& contents) {
  constexpr int kLeftWidth = 302;
  constexpr int kRightWidth = 340;
  DockSwitches switches;
  QList<QDockWidget*> left;
  QList<int> heights;
  for (const DockContent& content : contents.left) {
    left.append(make_dock(window, content, Qt::LeftDockWidgetArea));
    heights.append(content.height);
  }
  for (const DockContent& content : contents.history) {
    QDockWidget* history = make_dock(window, content, Qt::LeftDockWidgetArea);
    window.tabifyDockWidget(left.back(), history);
    history->hide();
    history->toggleViewAction()->setText(QObject::tr("Undo &history"));
    QObject::connect(history->toggleViewAction(), &QAction::triggered, history, &QWidget::raise);
    open_high(window, {history});
    switches.history.append(history->toggleViewAction());
  }
  QTabWidget* tabs = make_tabs(contents.control);
  QDockWidget* right =
      make_dock(window, {"control", QObject::tr("Control panels"), tabs}, Qt::RightDockWidgetArea);
  right->setTitleBarWidget(new QWidget);
  const QList<QDockWidget*> below = make_docks_below(window, contents.below);
  window.resizeDocks(
      {left.front(), right},
      {scaled(kLeftWidth), std::max(scaled(kRightWidth), tabs->tabBar()->sizeHint().width())},
      Qt::Horizontal);
  window.resizeDocks(left, heights, Qt::Vertical);
  for (QDockWidget* dock : left + QList<QDockWidget*>{right} + below) {
    switches.panels.append(dock->toggleViewAction());
  }
  return switches;
}

void order_tabs(QWidget& widget) {
  QWidget* last = &widget;
  for (auto* inside : widget.findChildren<QWidget*>()) {
    if ((inside->focusPolicy() & Qt::TabFocus) && !inside->focusProxy() &&
        inside->window() == widget.window()) {
      QWidget::setTabOrder(last, inside);
      last = inside;
    }
  }
}

ScrollingPage::ScrollingPage(QWidget* parent) : QScrollArea(parent) {
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
}

bool ScrollingPage::focusNextPrevChild(bool next) {
  order_tabs(*this);
  return QScrollArea::focusNextPrevChild(next);
}

PanelArea::PanelArea(QWidget* content, QWidget* parent) : ScrollingPage(parent) {
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  if (content) {
    setWidget(content);
  }
}

int PanelArea::width_around(const QSize& content) const {
  return content.width() + verticalScrollBar()->sizeHint().width() + 2 * frameWidth();
}

QSize PanelArea::sizeHint() const {
  const QSize content = widget() ? widget()->sizeHint() : QSize();
  return {width_around(content), content.height() + 2 * frameWidth()};
}

QSize PanelArea::minimumSizeHint() const {
  const QSize least = QScrollArea::minimumSizeHint();
  return {widget() ? width_around(widget()->minimumSizeHint()) : least.width(), least.height()};
}

// The style sheet has a say in how large widgets are, also those that are shown later.
void PanelArea::showEvent(QShowEvent* event) {
  for (const QWidget* part : findChildren<QWidget*>()) {
    part->ensurePolished();
  }
  QScrollArea::showEvent(event);
}

bool PanelArea::eventFilter(QObject* watched, QEvent* event) {
  if (watched == widget() && event->type() == QEvent::LayoutRequest) {
    updateGeometry();
  }
  return QScrollArea::eventFilter(watched, event);
}

QSize within_window(const QWidget& dialog, const QSize& wanted) {
  constexpr int kAround = 40;  // px, of the window's frame and of what is behind
  const QWidget* parent = dialog.parentWidget();
  return parent ? wanted.boundedTo(parent->window()->size() - QSize(kAround, kAround)) : wanted;
}

void save_layout(const QMainWindow& window) {
  QSettings().setValue(key(), window.saveState(kVersion));
  QSettings().setValue(geometry_key(), window.saveGeometry());
}

bool restore_layout(QMainWindow& window) {
  const QByteArray kept = QSettings().value(key()).toByteArray();
  return !kept.isEmpty() && window.restoreState(kept, kVersion);
}

void restore_geometry(QMainWindow& window, const QSize& wanted) {
  if (window.restoreGeometry(QSettings().value(geometry_key()).toByteArray())) {
    return;
  }
  constexpr QSize kFrame{16, 48};  // px; the window's own is known once it is shown
  const QSize room = window.screen()->availableSize() - kFrame;
  window.resize(wanted.boundedTo(room));
  if (window.size() != wanted) {
    window.setWindowState(window.windowState() | Qt::WindowMaximized);
  }
}

}  // namespace handway::gui
