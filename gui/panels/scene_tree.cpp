#include "panels/scene_tree.h"

#include "style/icons.h"
#include "style/theme.h"
#include "view3d/view_colors.h"

#include <QHeaderView>
#include <QPainter>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QTreeWidgetItemIterator>

#include <algorithm>
#include <functional>
#include <vector>

namespace handway::gui {
namespace {

using Kind = SceneItem::Kind;

constexpr int kLockWidth = 24;
constexpr int kKindRole = Qt::UserRole;
constexpr int kRobotRole = Qt::UserRole + 1;
constexpr int kNameRole = Qt::UserRole + 2;

QColor to_qcolor(const geometric::Color& color) {
  return QColor::fromRgbF(color.red, color.green, color.blue);
}

QTreeWidgetItem* make_row(const QString& text, const QIcon& picture, const SceneItem& item) {
  auto* row = new QTreeWidgetItem({text});
  row->setIcon(0, picture);
  row->setData(0, kKindRole, static_cast<int>(item.kind));
  row->setData(0, kRobotRole, QString::fromStdString(item.robot));
  row->setData(0, kNameRole, QString::fromStdString(item.name));
  return row;
}

QString mm(double metres) { return QString::number(metres * 1e3, 'f', 0); }

struct SizeText {
  QString operator()(const geometric::Box& box) const {
    return QStringLiteral("box %1 × %2 × %3 mm")
        .arg(mm(box.size.x()), mm(box.size.y()), mm(box.size.z()));
  }
  QString operator()(const geometric::Sphere& sphere) const {
    return QStringLiteral("sphere, radius %1 mm").arg(mm(sphere.radius));
  }
  QString operator()(const geometric::Cylinder& cylinder) const {
    return QStringLiteral("cylinder, radius %1 mm, length %2 mm")
        .arg(mm(cylinder.radius), mm(cylinder.length));
  }
  QString operator()(const geometric::Cone& cone) const {
    return QStringLiteral("cone, radius %1 mm, height %2 mm").arg(mm(cone.radius), mm(cone.length));
  }
  QString operator()(const geometric::Mesh& mesh) const {
    return QStringLiteral("mesh %1, %2 triangles")
        .arg(QString::fromStdString(mesh.file.filename().string()))
        .arg(mesh.triangles ? mesh.triangles->triangles.size() : 0);
  }
};

}  // namespace

SceneTree::SceneTree(QWidget* parent) : QTreeWidget(parent) {
  setHeaderHidden(true);
  setColumnCount(2);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(0, QHeaderView::Stretch);
  header()->setSectionResizeMode(1, QHeaderView::Fixed);
  header()->resizeSection(1, kLockWidth);
  setEditTriggers(QAbstractItemView::EditKeyPressed);
  setIndentation(16);
  setUniformRowHeights(true);
  setFrameShape(QFrame::NoFrame);
  setIconSize({16, 16});
  connect(this, &QTreeWidget::currentItemChanged, this,
          [this](QTreeWidgetItem* row) { emit item_selected(item_at(row)); });
  connect(this, &QTreeWidget::itemDoubleClicked, this, [this](QTreeWidgetItem* row) {
    const SceneItem item = item_at(row);
    if (item.kind == Kind::kStart || item.kind == Kind::kGoal) {
      emit posture_activated(item);
    }
  });
  connect(this, &QTreeWidget::itemChanged, this, &SceneTree::take_change);
}

void SceneTree::take_change(QTreeWidgetItem* row) {
  const SceneItem changed = item_at(row);
  if (changed.kind == Kind::kObject) {
    // Whoever hears of it may build the tree anew: not while a row is in use.
    const bool shown = row->checkState(0) == Qt::Checked;
    const std::string text = row->text(0).trimmed().toStdString();
    QMetaObject::invokeMethod(
        this,
        [this, changed, shown, text] {
          if (text != changed.name) {
            emit object_renamed(changed.name, text);
          }
          if (shown == state_.hidden.contains(changed.name)) {
            emit object_toggled(changed.name, shown);
          }
        },
        Qt::QueuedConnection);
    return;
  }
  bool start = true, goal = true;
  for (QTreeWidgetItemIterator it(this); *it; ++it) {
    const bool shown = (*it)->checkState(0) == Qt::Checked;
    const Kind kind = item_at(*it).kind;
    start = kind == Kind::kStart ? shown : start;
    goal = kind == Kind::kGoal ? shown : goal;
  }
  emit ghosts_toggled(start, goal);
}

void SceneTree::set_scene(std::shared_ptr<const geometric::Scene> scene) {
  state_ = {std::move(scene)};
  rebuild();
}

void SceneTree::update_scene(const SceneState& state) {
  state_ = state;
  std::vector<SceneItem> folded, unticked;
  for (QTreeWidgetItemIterator it(this); *it; ++it) {
    const SceneItem item = item_at(*it);
    if ((*it)->childCount() > 0 && !(*it)->isExpanded()) {
      folded.push_back(item);
    }
    if ((item.kind == Kind::kStart || item.kind == Kind::kGoal) &&
        (*it)->checkState(0) != Qt::Checked) {
      unticked.push_back(item);
    }
  }
  const SceneItem selected = item_at(currentItem());
  const int scrolled = verticalScrollBar()->value();
  rebuild();
  const QSignalBlocker quiet(this);
  for (QTreeWidgetItemIterator it(this); *it; ++it) {
    const SceneItem item = item_at(*it);
    if ((*it)->childCount() > 0) {
      (*it)->setExpanded(std::ranges::find(folded, item) == folded.end());
    }
    if (std::ranges::find(unticked, item) != unticked.end()) {
      (*it)->setCheckState(0, Qt::Unchecked);
    }
  }
  select(selected);
  verticalScrollBar()->setValue(scrolled);
}

void SceneTree::edit_name() {
  if (currentItem() && item_at(currentItem()).kind == Kind::kObject) {
    editItem(currentItem(), 0);
  }
}

void SceneTree::rebuild() {
  const QSignalBlocker quiet(this);
  clear();
  if (!state_.scene) {
    return;
  }
  for (const geometric::RobotInstance& robot : state_.scene->robots) {
    add_robot(robot);
  }
  add_objects(*state_.scene);
  add_query(*state_.scene);
}

void SceneTree::paintEvent(QPaintEvent* event) {
  QTreeWidget::paintEvent(event);
  if (topLevelItemCount() == 0) {
    QPainter painter(viewport());
    painter.setPen(colors_of(current_theme()).muted);
    painter.drawText(viewport()->rect().adjusted(12, 10, -12, -10),
                     Qt::AlignTop | Qt::AlignLeft | Qt::TextWordWrap,
                     tr("Robots, objects and the task appear here"));
  }
}

void SceneTree::add_robot(const geometric::RobotInstance& robot) {
  const geometric::RobotModel& model = *robot.model;
  QTreeWidgetItem* top =
      make_row(QString::fromStdString(robot.name), icon("robot"), {Kind::kRobot, robot.name, ""});
  top->setToolTip(0, tr("%1: %2 links, %3 joints that move on their own")
                         .arg(QString::fromStdString(model.name()))
                         .arg(model.link_count())
                         .arg(model.variable_count()));
  addTopLevelItem(top);
  std::vector<QTreeWidgetItem*> rows;
  for (int i = 0; i < model.link_count(); ++i) {
    const std::string& name = model.link(i).name;
    rows.push_back(
        make_row(QString::fromStdString(name), icon("link"), {Kind::kLink, robot.name, name}));
    const int parent = model.parent(i);
    // A serial chain stays flat; only branches (fingers) are indented.
    QTreeWidgetItem* above = parent < 0 ? top : rows[static_cast<std::size_t>(parent)];
    int siblings = 0;
    for (int k = 1; k < model.link_count(); ++k) {
      siblings += parent >= 0 && model.parent(k) == parent ? 1 : 0;
    }
    if (parent >= 0 && siblings == 1 && above->parent()) {
      above = above->parent();
    }
    above->addChild(rows.back());
  }
}

void SceneTree::add_objects(const geometric::Scene& scene) {
  if (scene.objects.empty()) {
    return;
  }
  QTreeWidgetItem* top = make_row(tr("Objects"), icon("objects"), {});
  addTopLevelItem(top);
  for (const geometric::SceneObject& object : scene.objects) {
    QTreeWidgetItem* row = make_row(QString::fromStdString(object.name),
                                    icon("object", to_qcolor(object.color).darker(115)),
                                    {Kind::kObject, "", object.name});
    QString words = std::visit(SizeText{}, object.shape);
    if (object.attachment) {
      words += tr(", carried by %1").arg(QString::fromStdString(object.attachment->link));
    }
    const bool locked = state_.locked.contains(object.name);
    if (locked) {
      row->setIcon(1, icon("lock"));
    } else {
      row->setFlags(row->flags() | Qt::ItemIsEditable);
    }
    row->setFlags(row->flags() | Qt::ItemIsUserCheckable);
    row->setCheckState(0, state_.hidden.contains(object.name) ? Qt::Unchecked : Qt::Checked);
    row->setToolTip(0, words);
    top->addChild(row);
  }
  top->setExpanded(true);
}

void SceneTree::add_query(const geometric::Scene& scene) {
  if (!scene.start && !scene.goal) {
    return;
  }
  QTreeWidgetItem* top = make_row(tr("Task"), icon("route"), {});
  addTopLevelItem(top);
  const auto add = [&](const QString& text, const geometric::Color& color, Kind kind) {
    QTreeWidgetItem* row = make_row(text, icon("posture", to_qcolor(color)), {kind, "", ""});
    row->setFlags(row->flags() | Qt::ItemIsUserCheckable);
    row->setCheckState(0, Qt::Checked);
    row->setToolTip(0, tr("The box shows its ghost; a double click moves the robot there"));
    top->addChild(row);
  };
  if (scene.start) {
    add(tr("Start"), kStartColor, Kind::kStart);
  }
  if (scene.goal) {
    add(tr("Goal"), kGoalColor, Kind::kGoal);
  }
  top->setExpanded(true);
}

SceneItem SceneTree::item_at(const QTreeWidgetItem* row) const {
  if (!row) {
    return {};
  }
  return {static_cast<Kind>(row->data(0, kKindRole).toInt()),
          row->data(0, kRobotRole).toString().toStdString(),
          row->data(0, kNameRole).toString().toStdString()};
}

void SceneTree::select(const SceneItem& item) {
  const QSignalBlocker quiet(this);
  for (QTreeWidgetItemIterator it(this); *it; ++it) {
    if (item.kind != Kind::kNone && item_at(*it) == item) {
      setCurrentItem(*it);
      scrollToItem(*it);
      return;
    }
  }
  setCurrentItem(nullptr);
}

void SceneTree::refresh_icons() { update_scene(SceneState(state_)); }

}  // namespace handway::gui
