#include "features/workbench.h"

#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/panels/floating_card.h"
#include "widgets/panels/log_panel.h"
#include "widgets/panels/playback_bar.h"
#include "widgets/panels/xacro_dialog.h"
#include "widgets/style/actions.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

#include <QHelpEvent>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QTime>
#include <QToolBar>
#include <QToolButton>

#include <algorithm>
#include <iterator>

namespace handway::gui {
namespace {

constexpr int kPanelsSection = 2;   // of the View menu
constexpr int kHistorySection = 9;  // of the Edit menu: the last
constexpr int kLast = 1000;         // among docks: those that have no place of their own
constexpr int kIconSize = 20;       // px

}  // namespace

Workbench::Workbench(std::shared_ptr<planning::PluginManager> loaded_plugins,
                     QMainWindow& main_window, QWidget& centre)
    : QObject(&main_window),
      plugins(std::move(loaded_plugins)),
      document(plugins),
      editor(document),
      posing(document, player),
      plan_settings(plugins->planners()),
      session(document, plan_settings, player),
      validity(player),
      analysis(document, player),
      window(main_window),
      view(*new SceneView),
      banner(*new Banner(&centre)),
      playback_bar(*new PlaybackBar(player)),
      log(*new LogPanel) {
  const std::pair<MainMenu, QString> menus[] = {
      {MainMenu::kFile, tr("&File")}, {MainMenu::kEdit, tr("&Edit")},
      {MainMenu::kAdd, tr("&Add")},   {MainMenu::kPlan, tr("&Plan")},
      {MainMenu::kView, tr("&View")}, {MainMenu::kHelp, tr("&Help")}};
  for (const auto& [menu, title] : menus) {
    menus_[menu] = window.menuBar()->addMenu(title);
  }
  connect(this, &Workbench::theme_changed, this, [this] {
    for (QAction* action : with_icon_) {
      action->setIcon(icon(action->objectName()));
    }
  });
  follow_document();
}

Workbench::~Workbench() {
  while (!tools_.empty()) {
    tools_.pop_back();
  }
}

void Workbench::follow_document() {
  connect(&document, &Document::configuration_changed, &collisions, &CollisionMonitor::check);
  connect(&document, &Document::configuration_changed, &view, &SceneView::set_configuration);
  connect(&document, &Document::edited, this, [this](const planning::SceneState& before) {
    if (before.scene != document.scene()) {
      collisions.set_problem(document.problem());
    }
    validity.follow(document.problem());
  });
  connect(&document, &Document::opened, this, [this] {
    history.begin_scene();
    collisions.set_problem(document.problem());
    validity.follow(document.problem());
  });
  connect(&analysis, &MotionAnalysis::changed, this, &Workbench::remember_path);
  add_work([this] { return session.is_running() || session.is_replanning(); });
  add_work([this] { return collisions.is_busy() || player.is_playing(); });
  add_work([this] { return document.scene() && view.frame_time_ms() <= 0.0; });
}

void Workbench::remember_path() {
  if (!analysis.curves()) {
    return;
  }
  const QString& given = session.opened_from();
  const QString source = given.isEmpty()
                             ? tr("%1, seed %2")
                                   .arg(QString::fromStdString(plan_settings.choice().name))
                                   .arg(plan_settings.request().seed)
                             : given;
  history.add({label_of(source, *analysis.motion(), QTime::currentTime()), document.scene(),
               document.palm(), analysis.motion(), analysis.curves(), nullptr, std::nullopt});
}

QAction* Workbench::make_action(const QString& name, const QString& text, const QKeySequence& keys,
                                const QString& tip) {
  QAction* action = gui::make_action(window, name, text, keys, tip);
  if (!name.isEmpty()) {
    keep_icon(*action);
  }
  return action;
}

void Workbench::keep_icon(QAction& action) {
  with_icon_.push_back(&action);
  action.setIcon(icon(action.objectName()));
}

void Workbench::add_to_menu(MainMenu menu, Position position, QAction* action) {
  menu_entries_[menu].push_back({position, action});
}

void Workbench::add_to_bar(MainBar bar, Position position, QAction* action, bool with_text) {
  bar_entries_[bar].push_back({position, action, with_text});
}

void Workbench::add_to_bar(MainBar bar, Position position, QWidget* widget) {
  bar_entries_[bar].push_back({position, widget});
}

void Workbench::add_dock(DockArea area, int order, const DockContent& content) {
  docks_[area].emplace(order, content);
}

void Workbench::add_page(const char* panel, const QString& title, QWidget* page) {
  pages_.push_back({panel, title, page});
}

std::vector<DockContent> Workbench::docks_of(DockArea area) const {
  std::vector<DockContent> contents;
  if (const auto found = docks_.find(area); found != docks_.end()) {
    for (const auto& [order, content] : found->second) {
      contents.push_back(content);
    }
  }
  return contents;
}

void Workbench::build() {
  build_pages();
  const DockSwitches switches = build_docks(window, {.left = docks_of(DockArea::kLeft),
                                                     .history = docks_of(DockArea::kHistory),
                                                     .control = docks_of(DockArea::kControl),
                                                     .below = docks_of(DockArea::kBelow)});
  for (QAction* panel : switches.panels) {
    add_to_menu(MainMenu::kView, {kPanelsSection, 0}, panel);
  }
  for (QAction* history_shown : switches.history) {
    add_to_menu(MainMenu::kEdit, {kHistorySection, 0}, history_shown);
  }
  build_menus();
  build_bars();
}

void Workbench::build_pages() {
  auto& tabs = docks_[DockArea::kControl];
  for (const Page& page : pages_) {
    const auto host = std::ranges::find_if(tabs, [&](const auto& entry) {
      return entry.second.add_page && QLatin1String(entry.second.name) == QLatin1String(page.panel);
    });
    if (host != tabs.end()) {
      host->second.add_page(page.title, page.widget);
    } else {
      tabs.emplace(kLast, DockContent{page.panel, page.title, page.widget});
    }
  }
}

void Workbench::fill(QMenu& menu, const std::vector<Entry>& entries) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i > 0 && entries[i].position.section != entries[i - 1].position.section) {
      menu.addSeparator();
    }
    menu.addAction(std::get<QAction*>(entries[i].content));
  }
}

void Workbench::show_context_menu(const QPoint& place) {
  std::vector<Entry> possible;
  std::ranges::copy_if(
      menu_entries_[MainMenu::kContext], std::back_inserter(possible),
      [](const Entry& entry) { return std::get<QAction*>(entry.content)->isEnabled(); });
  if (!possible.empty()) {
    auto* menu = named("context_menu", new QMenu(&window));
    menu->setAttribute(Qt::WA_DeleteOnClose);
    fill(*menu, possible);
    menu->popup(place);
  }
}

namespace {

QString letter_of(const QString& text) {
  return QKeySequence::mnemonic(text).toString(QKeySequence::PortableText);
}

// An underlined letter of its own for each entry: the one that it asks for if it is the first to
// do so, else the first that is free.
void give_letters(QMenu& menu) {
  QStringList taken;
  QList<QAction*> without;
  for (QAction* action : menu.actions()) {
    const QString letter = letter_of(action->text());
    if (action->isSeparator()) {
      continue;
    }
    if (letter.isEmpty() || taken.contains(letter)) {
      without << action;
    }
    taken << letter;
  }
  for (QAction* action : without) {
    QString text = action->text().remove(QLatin1Char('&'));
    for (int place = 0; place < text.size(); ++place) {
      const QString marked = QString(text).insert(place, QLatin1Char('&'));
      if (text[place].isLetterOrNumber() && !taken.contains(letter_of(marked))) {
        taken << letter_of(marked);
        text = marked;
        break;
      }
    }
    action->setText(text);
  }
}

/// In menus tool tips say why an entry is grey; others would be in the way.
class TipsOfGreyEntries : public QObject {
 public:
  explicit TipsOfGreyEntries(QMenu* menu) : QObject(menu), menu_(*menu) {}

  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::ToolTip) {
      const QAction* entry = menu_.actionAt(static_cast<QHelpEvent*>(event)->pos());
      return !entry || entry->isEnabled();
    }
    return QObject::eventFilter(watched, event);
  }

 private:
  QMenu& menu_;
};

}  // namespace

void Workbench::build_menus() {
  for (auto& [name, entries] : menu_entries_) {
    std::ranges::stable_sort(entries, {}, &Entry::position);
    if (name != MainMenu::kContext) {
      fill(menu(name), entries);
    }
  }
  for (const auto& [name, built] : menus_) {
    built->menuAction()->setVisible(!built->isEmpty());
    built->setToolTipsVisible(true);
    built->installEventFilter(new TipsOfGreyEntries(built));
    give_letters(*built);
  }
}

void Workbench::build_bars() {
  const std::tuple<MainBar, const char*, QString> bars[] = {
      {MainBar::kTools, "tools", tr("Tools")}, {MainBar::kEditing, "editing", tr("Editing")}};
  for (const auto& [name, object_name, title] : bars) {
    QToolBar& bar = *window.addToolBar(title);
    bar.setObjectName(QLatin1String(object_name));
    bar.setMovable(false);
    bar.setIconSize({scaled(kIconSize), scaled(kIconSize)});
    std::vector<Entry>& entries = bar_entries_[name];
    std::ranges::stable_sort(entries, {}, &Entry::position);
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (i > 0 && entries[i].position.section != entries[i - 1].position.section) {
        bar.addSeparator();
      }
      if (QWidget* const* widget = std::get_if<QWidget*>(&entries[i].content)) {
        bar.addWidget(*widget);
        continue;
      }
      QAction* action = std::get<QAction*>(entries[i].content);
      bar.addAction(action);
      if (entries[i].with_text) {
        qobject_cast<QToolButton*>(bar.widgetForAction(action))
            ->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
      }
    }
  }
}

void Workbench::show_panel(const char* name) const {
  for (const auto& [area, contents] : docks_) {
    for (const auto& [order, content] : contents) {
      if (QLatin1String(content.name) == QLatin1String(name)) {
        bring_to_front(*content.widget);
      }
    }
  }
}

void Workbench::trigger(const char* action) const {
  if (auto* command = window.findChild<QAction*>(QLatin1String(action))) {
    command->trigger();
  }
}

QString Workbench::scene_name() const {
  const std::string& name = document.scene()->name;
  return QString::fromStdString(!name.empty()             ? name
                                : document.file().empty() ? tr("New scene").toStdString()
                                                          : document.file().filename().string());
}

void Workbench::open(const std::filesystem::path& file, const Options& with) {
  if (may_leave()) {
    with_xacro_arguments(&window, file,
                         [this, file, with](const geometric::XacroArguments& arguments) {
                           options = with;
                           document.open(file, arguments);
                         });
  }
}

void Workbench::create(const std::string& robot, const std::string& hand) {
  if (may_leave()) {
    options = {};
    document.create(robot, hand);
  }
}

void Workbench::close() {
  if (may_leave()) {
    options = {};
    document.close();
  }
}

void Workbench::ask_before_leaving(std::function<bool()> may_leave) {
  leave_guards_.push_back(std::move(may_leave));
}

bool Workbench::may_leave() const {
  return std::ranges::all_of(leave_guards_, [](const auto& asked) { return asked(); });
}

void Workbench::add_work(std::function<bool()> busy) { works_.push_back(std::move(busy)); }

bool Workbench::is_busy() const {
  return std::ranges::any_of(works_, [](const auto& busy) { return busy(); });
}

void Workbench::add_stream(std::function<std::optional<double>()> time) {
  streams_.push_back(std::move(time));
}

std::optional<double> Workbench::listening_time() const {
  std::optional<double> longest;
  for (const auto& time : streams_) {
    longest = std::max(longest, time());
  }
  return longest;
}

void Workbench::show_error(const QString& title, const QString& message) {
  log.add(LogPanel::Level::kError, message);
  banner.show_message(title, message);
}

}  // namespace handway::gui
