#include "app/dock_layout.h"

#include <QDockWidget>
#include <QMenu>
#include <QSettings>
#include <QTabBar>
#include <QTabWidget>
#include <QUndoView>
#include <QVBoxLayout>

namespace handway::gui {
namespace {

constexpr int kVersion = 1;  // raised when docks come or go

QString key() { return QStringLiteral("window/layout"); }

QDockWidget* make_dock(QMainWindow& window, const QString& name, const QString& title,
                       QWidget* content, Qt::DockWidgetArea area) {
  auto* dock = new QDockWidget(title, &window);
  dock->setObjectName(name);
  dock->setFeatures(QDockWidget::DockWidgetMovable | QDockWidget::DockWidgetClosable);
  dock->setWidget(content);
  window.addDockWidget(area, dock);
  return dock;
}

}  // namespace

void build_docks(QMainWindow& window, const DockContents& contents, QMenu& view_menu,
                 QMenu& edit_menu) {
  auto* tabs = new QTabWidget;
  tabs->setObjectName(QStringLiteral("control_tabs"));
  tabs->setDocumentMode(true);
  tabs->tabBar()->setDrawBase(false);
  tabs->tabBar()->setExpanding(true);
  contents.plan->setObjectName(QStringLiteral("plan"));
  contents.joints->setObjectName(QStringLiteral("joints"));
  contents.hand->setObjectName(QStringLiteral("hand"));
  contents.glove->setObjectName(QStringLiteral("glove"));
  contents.history->setEmptyLabel(QObject::tr("As opened"));
  tabs->addTab(contents.plan, QObject::tr("Plan"));
  tabs->addTab(contents.joints, QObject::tr("Joints"));
  tabs->addTab(contents.hand, QObject::tr("Hand"));
  tabs->addTab(contents.glove, QObject::tr("Glove"));
  const auto left = [&](const char* name, const QString& title, QWidget* content) {
    return make_dock(window, QLatin1String(name), title, content, Qt::LeftDockWidgetArea);
  };
  QDockWidget* scene = left("scene", QObject::tr("Scene"), contents.scene);
  QDockWidget* properties = left("properties", QObject::tr("Properties"), contents.properties);
  QDockWidget* log = left("messages", QObject::tr("Messages"), contents.messages);
  QDockWidget* history = left("history", QObject::tr("History"), contents.history);
  window.tabifyDockWidget(log, history);
  history->hide();
  QDockWidget* right = make_dock(window, QStringLiteral("control"), QObject::tr("Control"), tabs,
                                 Qt::RightDockWidgetArea);
  right->setTitleBarWidget(new QWidget);
  window.resizeDocks({scene, right}, {270, 340}, Qt::Horizontal);
  window.resizeDocks({scene, properties, log}, {290, 350, 110}, Qt::Vertical);
  history->toggleViewAction()->setText(QObject::tr("Undo &history"));
  QObject::connect(history->toggleViewAction(), &QAction::triggered, history, &QWidget::raise);
  edit_menu.addSeparator();
  edit_menu.addAction(history->toggleViewAction());
  for (QDockWidget* dock : {scene, properties, log, right}) {
    view_menu.addAction(dock->toggleViewAction());
  }
}

QWidget* stacked(std::initializer_list<QWidget*> parts, int stretched) {
  auto* box = new QWidget;
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  int index = 0;
  for (QWidget* part : parts) {
    layout->addWidget(part, index++ == stretched ? 1 : 0);
  }
  return box;
}

void save_layout(const QMainWindow& window) {
  QSettings().setValue(key(), window.saveState(kVersion));
}

bool restore_layout(QMainWindow& window) {
  const QByteArray kept = QSettings().value(key()).toByteArray();
  return !kept.isEmpty() && window.restoreState(kept, kVersion);
}

}  // namespace handway::gui
