#include "app/start/command_palette.h"

#include "app/menu_commands.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/theme.h"

#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMainWindow>

#include <algorithm>
#include <limits>
#include <vector>

namespace handway::gui {
namespace {

constexpr int kBeginsText = 12;
constexpr int kBeginsWord = 8;
constexpr int kFollows = 9;
constexpr int kAnywhere = 1;
constexpr int kNever = std::numeric_limits<int>::min() / 2;

}  // namespace

// best[j]: the most that the letters so far earn if the last of them is letter j of the text.
std::optional<int> fuzzy_score(const QString& typed, const QString& text) {
  QString wanted = typed.toCaseFolded();
  wanted.remove(' ');
  if (wanted.isEmpty()) {
    return 0;
  }
  const QString letters = text.toCaseFolded();
  std::vector<int> best(static_cast<std::size_t>(letters.size()), kNever);
  for (int i = 0; i < wanted.size(); ++i) {
    std::vector<int> next(best.size(), kNever);
    int best_before = i == 0 ? 0 : kNever;
    for (int j = 0; j < letters.size(); ++j) {
      const auto at = static_cast<std::size_t>(j);
      if (letters[j] == wanted[i]) {
        const bool begins_word = j > 0 && !letters[j - 1].isLetterOrNumber();
        const int worth = j == 0 ? kBeginsText : begins_word ? kBeginsWord : kAnywhere;
        const int apart = best_before + worth;
        const int follows = i > 0 && j > 0 ? best[at - 1] + kFollows : kNever;
        next[at] = std::max(apart, follows);
      }
      best_before = std::max(best_before, i == 0 ? 0 : best[at]);
    }
    best = std::move(next);
  }
  const int score = best.empty() ? kNever : *std::ranges::max_element(best);
  return score > 0 ? std::optional(score * 64 - static_cast<int>(letters.size())) : std::nullopt;
}

namespace {

constexpr int kWidth = 520;
constexpr int kMostRows = 11;
constexpr int kRowHeight = 30;
constexpr int kActionRole = Qt::UserRole;

}  // namespace

CommandPalette::CommandPalette(QMainWindow& window)
    : QFrame(&window, Qt::Popup),
      window_(window),
      field_(named("palette_field", new QLineEdit)),
      list_(named("palette_list", new QListWidget)) {
  setProperty("role", "palette");
  setAttribute(Qt::WA_StyledBackground);
  field_->setAccessibleName(tr("Letters of the command"));
  field_->setPlaceholderText(tr("Type a command"));
  field_->installEventFilter(this);
  list_->setAccessibleName(tr("Commands"));
  list_->setFrameShape(QFrame::NoFrame);
  list_->setFocusPolicy(Qt::NoFocus);
  list_->setIconSize({scaled(18), scaled(18)});
  list_->setUniformItemSizes(true);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setFixedWidth(scaled(kWidth));
  lay_out(*this, in_column({field_, list_}, 6), {8, 8, 8, 8});
  connect(field_, &QLineEdit::textChanged, this, &CommandPalette::list);
  connect(list_, &QListWidget::itemClicked, this, &CommandPalette::run_current);
}

void CommandPalette::ask() {
  commands_.clear();
  for (const MenuCommand& command : menu_commands(window_)) {
    if (command.action->isEnabled()) {
      commands_.push_back({command.menu + QStringLiteral(": ") + command.path, command.action});
    }
  }
  field_->clear();
  list({});
  move(window_.mapToGlobal(QPoint((window_.width() - scaled(kWidth)) / 2, 90)));
  show();
  field_->setFocus();
}

void CommandPalette::list(const QString& typed) {
  struct Found {
    int score;
    const Command* command;
  };
  std::vector<Found> found;
  for (const Command& command : commands_) {
    if (const auto score = fuzzy_score(typed, command.path)) {
      found.push_back({*score, &command});
    }
  }
  if (!typed.isEmpty()) {
    std::ranges::stable_sort(found, std::ranges::greater(), &Found::score);
  }
  list_->clear();
  for (const Found& entry : found) {
    const QAction* action = entry.command->action;
    auto* row = new QListWidgetItem(list_);
    row->setSizeHint({0, scaled(kRowHeight)});
    row->setData(kActionRole, QVariant::fromValue(entry.command->action));
    auto* picture = new QLabel;
    picture->setFixedWidth(scaled(22));
    picture->setPixmap(action->icon().pixmap(scaled(18), scaled(18)));
    auto* keys = note(action->shortcut().toString(QKeySequence::NativeText));
    auto* words =
        boxed(in_row({picture, {new QLabel(entry.command->path), 1}, keys}), {8, 0, 10, 0});
    row->setData(Qt::AccessibleTextRole, entry.command->path);
    list_->setItemWidget(row, words);
  }
  list_->setCurrentRow(0);
  list_->setFixedHeight(std::clamp(list_->count(), 1, kMostRows) * scaled(kRowHeight) + 4);
  adjustSize();
}

void CommandPalette::run_current() {
  const QListWidgetItem* row = list_->currentItem();
  auto* action = row ? row->data(kActionRole).value<QAction*>() : nullptr;
  hide();
  if (action) {
    action->trigger();
  }
}

bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
  if (watched != field_ || event->type() != QEvent::KeyPress) {
    return QFrame::eventFilter(watched, event);
  }
  const int key = static_cast<QKeyEvent*>(event)->key();
  if (key == Qt::Key_Down || key == Qt::Key_Up) {
    const int step = key == Qt::Key_Down ? 1 : -1;
    list_->setCurrentRow(
        std::clamp(list_->currentRow() + step, 0, std::max(0, list_->count() - 1)));
    return true;
  }
  if (key == Qt::Key_Return || key == Qt::Key_Enter) {
    run_current();
    return true;
  }
  if (key == Qt::Key_Escape) {
    hide();
    return true;
  }
  return QFrame::eventFilter(watched, event);
}

}  // namespace handway::gui
