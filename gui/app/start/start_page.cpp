#include "app/start/start_page.h"

#include "app/file_commands.h"
#include "app/start/picture_card.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "widgets/forms/arrangement.h"

#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <system_error>

namespace handway::gui {
namespace fs = std::filesystem;

namespace {

// A scene that can't be read is listed all the same: opening it says what is wrong.
void take_words_of_file(ShippedScene& scene) {
  try {
    const auto top = geometric::YamlElement::read(scene.file, "a scene file");
    if (const auto name = top.find("name")) {
      scene.title = QString::fromStdString(name->text());
    }
    if (const auto description = top.find("description")) {
      scene.description = QString::fromStdString(description->text());
    }
  } catch (const geometric::InputError&) {
  }
}

fs::path folder_of_scenes() { return geometric::resource_dir().parent_path() / "scenes"; }

}  // namespace

bool is_shipped(const fs::path& scene) {
  std::error_code not_there;
  return fs::equivalent(scene.parent_path(), folder_of_scenes(), not_there);
}

std::vector<ShippedScene> shipped_scenes() {
  std::vector<ShippedScene> scenes;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_of_scenes(), none)) {
    if (entry.path().extension() != ".yaml") {
      continue;
    }
    const QString stem = QString::fromStdString(entry.path().stem().string());
    scenes.push_back({entry.path(), stem, {}, QStringLiteral(":/thumbnails/%1.jpg").arg(stem)});
    take_words_of_file(scenes.back());
  }
  std::ranges::sort(scenes, {}, &ShippedScene::file);
  return scenes;
}

namespace {

constexpr const char* kTriedScene = "two_cans_on_table";
constexpr int kMostColumns = 4;
constexpr int kGap = 16;
constexpr int kMargin = 24;
constexpr int kMostRecent = 3;

QLabel* make_label(const QString& text, const char* role) {
  auto* label = new QLabel(text);
  label->setProperty("role", role);
  return label;
}

QPushButton* make_link(const QString& text, const QString& name) {
  auto* link = new QPushButton(text);
  link->setObjectName(name);
  link->setProperty("role", "link");
  link->setCursor(Qt::PointingHandCursor);
  return link;
}

}  // namespace

StartPage::StartPage(QWidget* parent) : ScrollingPage(parent) {
  setObjectName(QStringLiteral("start_page"));
  setProperty("role", "start");
  refresh();
}

void StartPage::refresh() {
  auto* page = new QWidget;
  auto* column = new QWidget;
  const int width = columns_ * PictureCard::kWidth + (columns_ - 1) * kGap;
  column->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred);
  auto* layout = new QVBoxLayout(column);
  layout->setContentsMargins(0, 28, 0, 28);
  layout->setSpacing(8);
  layout->addWidget(make_label(tr("Handway"), "title"));
  QLabel* words =
      make_label(tr("Open a scene, plan a motion of hand and arm, watch it. Or drop a file here."),
                 "subtitle");
  words->setWordWrap(true);
  words->setMaximumWidth(width);
  layout->addWidget(words);
  add_trial(*layout);
  add_scenes(*layout);
  add_robots(*layout);
  add_recent(*layout);
  layout->addStretch(1);
  auto* across = new QHBoxLayout(page);
  across->setContentsMargins(kMargin, 0, kMargin, 0);
  across->addStretch(1);
  across->addWidget(column);
  across->addStretch(1);
  setWidget(page);
}

void StartPage::showEvent(QShowEvent* event) {
  ScrollingPage::showEvent(event);
  setFocus();
}

// Shows as many pictures beside each other as fit.
void StartPage::resizeEvent(QResizeEvent* event) {
  ScrollingPage::resizeEvent(event);
  const int room = viewport()->width() - 2 * kMargin + kGap;
  const int columns = std::clamp(room / (PictureCard::kWidth + kGap), 1, kMostColumns);
  if (columns != columns_) {
    columns_ = columns;
    refresh();
  }
}

void StartPage::add_trial(QVBoxLayout& layout) {
  const std::vector<ShippedScene> scenes = shipped_scenes();
  const auto tried = std::ranges::find_if(
      scenes, [](const ShippedScene& scene) { return scene.file.stem() == kTriedScene; });
  if (tried == scenes.end()) {
    return;
  }
  auto* button = named("start_try", new QPushButton(tr("Try it")));
  button->setProperty("role", "primary");
  button->setToolTip(tr("Open \"%1\", plan a motion and play it").arg(tried->title));
  const QString file = QString::fromStdString(tried->file.string());
  connect(button, &QPushButton::clicked, this, [this, file] { emit try_requested(file); });
  layout.addSpacing(4);
  layout.addWidget(button, 0, Qt::AlignLeft);
}

void StartPage::add_scenes(QVBoxLayout& layout) {
  layout.addSpacing(14);
  layout.addWidget(make_label(tr("Scenes"), "heading"));
  auto* grid = new QGridLayout;
  grid->setSpacing(kGap);
  int index = 0;
  for (const ShippedScene& scene : shipped_scenes()) {
    auto* card = new PictureCard(scene.title, scene.picture);
    const QString file = QString::fromStdString(scene.file.string());
    card->setObjectName(QStringLiteral("open ") + QFileInfo(file).baseName());
    card->setToolTip(scene.title + QLatin1Char('\n') + scene.description);
    connect(card, &QAbstractButton::clicked, this, [this, file] { emit open_requested(file); });
    grid->addWidget(card, index / columns_, index % columns_, Qt::AlignLeft);
    ++index;
  }
  layout.addLayout(grid);
}

void StartPage::add_robots(QVBoxLayout& layout) {
  layout.addSpacing(14);
  layout.addWidget(make_label(tr("New scene with"), "heading"));
  auto* grid = new QGridLayout;
  grid->setSpacing(kGap);
  int index = 0;
  for (const std::string& robot : geometric::resource_names(geometric::ResourceKind::kRobot)) {
    auto* card = new PictureCard(QString::fromStdString(robot), robot_picture(robot));
    card->setObjectName(QStringLiteral("new ") + QString::fromStdString(robot));
    connect(card, &QAbstractButton::clicked, this, [this, robot] { emit new_requested(robot); });
    grid->addWidget(card, index / columns_, index % columns_, Qt::AlignLeft);
    ++index;
  }
  layout.addLayout(grid);
  auto* choose = make_link(tr("Arm and hand…"), QStringLiteral("start_new"));
  connect(choose, &QPushButton::clicked, this, &StartPage::choice_requested);
  layout.addWidget(choose, 0, Qt::AlignLeft);
}

void StartPage::add_recent(QVBoxLayout& layout) {
  layout.addSpacing(14);
  layout.addWidget(make_label(tr("Recent"), "heading"));
  for (const QString& file : RecentFiles::files().mid(0, kMostRecent)) {
    const QFileInfo info(file);
    auto* button = make_link(info.fileName(), QString());
    button->setToolTip(file);
    connect(button, &QPushButton::clicked, this, [this, file] { emit open_requested(file); });
    layout.addWidget(button, 0, Qt::AlignLeft);
  }
  auto* browse = make_link(tr("Open another file…"), QStringLiteral("start_browse"));
  connect(browse, &QPushButton::clicked, this, &StartPage::browse_requested);
  layout.addWidget(browse, 0, Qt::AlignLeft);
}

}  // namespace handway::gui
