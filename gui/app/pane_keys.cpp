#include "app/pane_keys.h"

#include <QApplication>
#include <QDockWidget>
#include <QMainWindow>
#include <QShortcut>

#include <algorithm>
#include <vector>

namespace handway::gui {
namespace {

bool takes_keys(const QWidget& widget) {
  return widget.isVisible() && widget.isEnabled() && (widget.focusPolicy() & Qt::TabFocus) != 0 &&
         !widget.visibleRegion().isEmpty();
}

// The pane itself, or the first widget in it in the order of the Tab key.
QWidget* first_that_takes_keys(QWidget& pane) {
  if (takes_keys(pane)) {
    return &pane;
  }
  for (QWidget* next = pane.nextInFocusChain(); next && next != &pane;
       next = next->nextInFocusChain()) {
    if (pane.isAncestorOf(next) && takes_keys(*next)) {
      return next;
    }
  }
  return nullptr;
}

}  // namespace

PaneKeys::PaneKeys(QMainWindow& window, QWidget& view, QWidget& playback)
    : QObject(&window), window_(window), view_(view), playback_(playback) {
  connect(new QShortcut(Qt::Key_F6, &window), &QShortcut::activated, this, [this] { step(1); });
  connect(new QShortcut(QKeySequence(QStringLiteral("Shift+F6")), &window), &QShortcut::activated,
          this, [this] { step(-1); });
}

void PaneKeys::step(int direction) {
  std::vector<QWidget*> panes{&view_, &playback_};
  for (auto* dock : window_.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
    panes.push_back(dock);
  }
  std::erase_if(panes, [](QWidget* pane) { return !first_that_takes_keys(*pane); });
  if (panes.empty()) {
    return;
  }
  const QWidget* focused = QApplication::focusWidget();
  const auto here = std::ranges::find_if(panes, [focused](const QWidget* pane) {
    return focused && (pane == focused || pane->isAncestorOf(focused));
  });
  const auto count = static_cast<int>(panes.size());
  const int from =
      here == panes.end() ? (direction > 0 ? -1 : 0) : static_cast<int>(here - panes.begin());
  const int to = (from + direction + count) % count;
  first_that_takes_keys(*panes[static_cast<std::size_t>(to)])->setFocus(Qt::TabFocusReason);
}

}  // namespace handway::gui
