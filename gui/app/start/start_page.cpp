#include "app/start/start_page.h"

#include "app/recent_files.h"
#include "app/start/scene_card.h"
#include "app/start/shipped_scenes.h"
#include "handway/geometric/io/resources.h"
#include "widgets/style/icons.h"

#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace handway::gui {
namespace {

constexpr int kColumns = 3;
constexpr int kGap = 16;
constexpr int kMostRecent = 3;

QLabel* make_label(const QString& text, const char* role) {
  auto* label = new QLabel(text);
  label->setProperty("role", role);
  return label;
}

}  // namespace

StartPage::StartPage(QWidget* parent) : QScrollArea(parent) {
  setObjectName(QStringLiteral("start_page"));
  setFrameShape(QFrame::NoFrame);
  setWidgetResizable(true);
  setProperty("role", "start");
  refresh();
}

void StartPage::refresh() {
  auto* page = new QWidget;
  auto* column = new QWidget;
  column->setFixedWidth(kColumns * SceneCard::kWidth + (kColumns - 1) * kGap);
  auto* layout = new QVBoxLayout(column);
  layout->setContentsMargins(0, 28, 0, 28);
  layout->setSpacing(8);
  layout->addWidget(make_label(tr("Handway"), "title"));
  layout->addWidget(
      make_label(tr("Open a scene, plan a motion of hand and arm, watch it. Or drop a file here."),
                 "subtitle"));
  add_scenes(*layout);
  add_robots(*layout);
  add_recent(*layout);
  layout->addStretch(1);
  auto* across = new QHBoxLayout(page);
  across->setContentsMargins(24, 0, 24, 0);
  across->addStretch(1);
  across->addWidget(column);
  across->addStretch(1);
  setWidget(page);
}

void StartPage::add_scenes(QVBoxLayout& layout) {
  layout.addSpacing(14);
  layout.addWidget(make_label(tr("Scenes"), "heading"));
  auto* grid = new QGridLayout;
  grid->setSpacing(kGap);
  int index = 0;
  for (const ShippedScene& scene : shipped_scenes()) {
    auto* card = new SceneCard(scene.title, scene.picture);
    const QString file = QString::fromStdString(scene.file.string());
    card->setObjectName(QStringLiteral("open ") + QFileInfo(file).baseName());
    connect(card, &QAbstractButton::clicked, this, [this, file] { emit open_requested(file); });
    grid->addWidget(card, index / kColumns, index % kColumns, Qt::AlignLeft);
    ++index;
  }
  layout.addLayout(grid);
}

void StartPage::add_robots(QVBoxLayout& layout) {
  layout.addSpacing(14);
  layout.addWidget(make_label(tr("New scene with"), "heading"));
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  for (const std::string& robot : geometric::resource_names(geometric::ResourceKind::kRobot)) {
    auto* button = new QPushButton(icon("robot"), QString::fromStdString(robot));
    button->setObjectName(QStringLiteral("new ") + QString::fromStdString(robot));
    connect(button, &QPushButton::clicked, this, [this, robot] { emit new_requested(robot); });
    row->addWidget(button);
  }
  row->addStretch(1);
  layout.addLayout(row);
}

void StartPage::add_recent(QVBoxLayout& layout) {
  layout.addSpacing(14);
  layout.addWidget(make_label(tr("Recent"), "heading"));
  for (const QString& file : RecentFiles::files().mid(0, kMostRecent)) {
    const QFileInfo info(file);
    auto* button = new QPushButton(info.fileName());
    button->setProperty("role", "link");
    button->setToolTip(file);
    button->setCursor(Qt::PointingHandCursor);
    connect(button, &QPushButton::clicked, this, [this, file] { emit open_requested(file); });
    layout.addWidget(button, 0, Qt::AlignLeft);
  }
  auto* browse = new QPushButton(tr("Open another file…"));
  browse->setProperty("role", "link");
  browse->setCursor(Qt::PointingHandCursor);
  connect(browse, &QPushButton::clicked, this, &StartPage::browse_requested);
  layout.addWidget(browse, 0, Qt::AlignLeft);
}

}  // namespace handway::gui
