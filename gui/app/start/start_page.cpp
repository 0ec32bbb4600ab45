#include "app/start/start_page.h"

#include "app/file_commands.h"
#include "handway/geometric/io/resources.h"
#include "widgets/style/theme.h"

#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QPainterPath>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <system_error>

namespace handway::gui {
namespace fs = std::filesystem;

std::vector<ShippedScene> shipped_scenes() {
  std::vector<ShippedScene> scenes;
  std::error_code none;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(geometric::resource_dir().parent_path() / "scenes", none)) {
    if (entry.path().extension() != ".yaml") {
      continue;
    }
    const QString stem = QString::fromStdString(entry.path().stem().string());
    QString title = stem;
    title.replace('_', ' ');
    title[0] = title[0].toUpper();
    scenes.push_back({entry.path(), title, QStringLiteral(":/thumbnails/%1.jpg").arg(stem)});
  }
  std::ranges::sort(scenes, {}, &ShippedScene::file);
  return scenes;
}

namespace {

constexpr int kNameHeight = 38;
constexpr double kCorner = 7.0;

}  // namespace

SceneCard::SceneCard(const QString& title, const QString& picture, QWidget* parent)
    : QAbstractButton(parent), picture_(picture) {
  setText(title);
  setToolTip(title);  // a long one is elided
  setCursor(Qt::PointingHandCursor);
  setFocusPolicy(Qt::TabFocus);
  setFixedSize(sizeHint());
}

QSize SceneCard::sizeHint() const { return {kWidth, kPictureHeight + scaled(kNameHeight)}; }

void SceneCard::enterEvent(QEvent* event) {
  QAbstractButton::enterEvent(event);
  update();
}

void SceneCard::leaveEvent(QEvent* event) {
  QAbstractButton::leaveEvent(event);
  update();
}

void SceneCard::paintEvent(QPaintEvent* /*event*/) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  const QRectF frame = QRectF(rect()).adjusted(0.75, 0.75, -0.75, -0.75);
  QPainterPath outline;
  outline.addRoundedRect(frame, kCorner, kCorner);
  painter.setClipPath(outline);
  painter.fillRect(rect(), isDown() ? colors.window : colors.surface);
  const QRect place(0, 0, width(), kPictureHeight);
  if (picture_.isNull()) {
    painter.fillRect(place, colors.window);
    gui::icon(QStringLiteral("objects")).paint(&painter, place.adjusted(90, 50, -90, -50));
  } else {
    painter.drawPixmap(place, picture_);
  }
  painter.setPen(colors.text);
  painter.drawText(QRect(12, kPictureHeight, width() - 24, scaled(kNameHeight)),
                   Qt::AlignLeft | Qt::AlignVCenter,
                   fontMetrics().elidedText(text(), Qt::ElideRight, width() - 24));
  painter.setClipping(false);
  const bool hot = underMouse() || hasFocus();
  painter.setPen(QPen(hot ? colors.accent : colors.border, hot ? 2.0 : 1.0));
  painter.drawPath(outline);
}

namespace {

constexpr int kColumns = 3;
constexpr int kGap = 16;
constexpr int kMostRecent = 3;

// A file in the library; there may be none.
QString robot_picture(const std::string& robot) {
  return QString::fromStdString(
      (geometric::resource_dir() / "thumbnails" / "robots" / (robot + ".jpg")).string());
}

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
  QLabel* words =
      make_label(tr("Open a scene, plan a motion of hand and arm, watch it. Or drop a file here."),
                 "subtitle");
  words->setWordWrap(true);
  layout->addWidget(words);
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
  auto* grid = new QGridLayout;
  grid->setSpacing(kGap);
  int index = 0;
  for (const std::string& robot : geometric::resource_names(geometric::ResourceKind::kRobot)) {
    auto* card = new SceneCard(QString::fromStdString(robot), robot_picture(robot));
    card->setObjectName(QStringLiteral("new ") + QString::fromStdString(robot));
    connect(card, &QAbstractButton::clicked, this, [this, robot] { emit new_requested(robot); });
    grid->addWidget(card, index / kColumns, index % kColumns, Qt::AlignLeft);
    ++index;
  }
  layout.addLayout(grid);
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
  browse->setObjectName(QStringLiteral("start_browse"));
  browse->setProperty("role", "link");
  browse->setCursor(Qt::PointingHandCursor);
  connect(browse, &QPushButton::clicked, this, &StartPage::browse_requested);
  layout.addWidget(browse, 0, Qt::AlignLeft);
}

}  // namespace handway::gui
