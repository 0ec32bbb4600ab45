#include "features/editing/scene_tree.h"

#include "handway/planning/edits/arranging.h"
#include "model/settings/options.h"
#include "widgets/style/color_math.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

#include <QDragMoveEvent>
#include <QHeaderView>
#include <QMimeData>
#include <QPainter>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QTreeWidgetItemIterator>

#include <algorithm>
#include <map>
#include <string>
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
  row->setToolTip(0, text);
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
        .arg(QString::fromStdString(mesh.file.filename().string()),
             QString::number(mesh.triangles ? mesh.triangles->triangles.size() : 0));
  }
  QString operator()(const geometric::Cloud& cloud) const {
    return QStringLiteral("point cloud %1, %2 points, cells of %3 mm")
        .arg(QString::fromStdString(cloud.file.filename().string()))
        .arg(cloud.points->size())
        .arg(mm(cloud.cells.size));
  }
};

}  // namespace

SceneTree::SceneTree(QWidget* parent) : QTreeWidget(parent) {
  setHeaderHidden(true);
  setAccessibleName(tr("Scene"));
  setColumnCount(2);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(0, QHeaderView::Stretch);
  header()->setSectionResizeMode(1, QHeaderView::Fixed);
  header()->resizeSection(1, kLockWidth);
  setEditTriggers(QAbstractItemView::EditKeyPressed);
  setIndentation(16);
  setUniformRowHeights(true);
  setFrameShape(QFrame::NoFrame);
  setIconSize({scaled(16), scaled(16)});
  setSelectionMode(QAbstractItemView::ExtendedSelection);
  setDragDropMode(QAbstractItemView::DragDrop);
  setDropIndicatorShown(false);
  setContextMenuPolicy(Qt::CustomContextMenu);
  connect(this, &QTreeWidget::itemSelectionChanged, this, &SceneTree::take_selection);
  connect(this, &QTreeWidget::itemDoubleClicked, this, [this](QTreeWidgetItem* row) {
    const SceneItem item = item_at(row);
    if (item.kind == Kind::kStart || item.kind == Kind::kGoal) {
      emit posture_activated(item);
    }
  });
  connect(this, &QTreeWidget::itemChanged, this, &SceneTree::take_change);
}

std::vector<std::string> SceneTree::objects_of(const QList<QTreeWidgetItem*>& rows) const {
  std::vector<QTreeWidgetItem*> ordered(rows.begin(), rows.end());
  // The one that was clicked comes last.
  std::stable_partition(ordered.begin(), ordered.end(),
                        [this](auto* row) { return row != currentItem(); });
  std::vector<std::string> names;
  for (const QTreeWidgetItem* row : ordered) {
    const SceneItem item = item_at(row);
    if (item.kind == Kind::kObject) {
      names.push_back(item.name);
    } else if (item.kind == Kind::kGroup) {
      const std::vector<std::string> members = planning::group_members(*state_.scene, item.name);
      names.insert(names.end(), members.begin(), members.end());
    }
  }
  return names;
}

void SceneTree::take_selection() {
  const QList<QTreeWidgetItem*> rows = selectedItems();
  const std::vector<std::string> names = objects_of(rows);
  if (names.empty()) {
    const bool has_current = rows.contains(currentItem());
    emit item_selected(rows.empty() ? SceneItem{}
                                    : item_at(has_current ? currentItem() : rows.back()));
  } else {
    emit objects_selected(names);
  }
}

std::vector<std::string> SceneTree::dragged_objects(const QMimeData& data) {
  std::vector<std::string> names;
  for (const QByteArray& name : data.data(QLatin1String(kDraggedObjects)).split('\n')) {
    if (!name.isEmpty()) {
      names.push_back(name.toStdString());
    }
  }
  return names;
}

QStringList SceneTree::mimeTypes() const { return {QLatin1String(kDraggedObjects)}; }

QMimeData* SceneTree::mimeData(const QList<QTreeWidgetItem*> rows) const {
  QByteArray lines;
  for (const std::string& name : objects_of(rows)) {
    lines += QByteArray::fromStdString(name) + '\n';
  }
  if (lines.isEmpty()) {
    return nullptr;
  }
  auto* dragged = new QMimeData;
  dragged->setData(QLatin1String(kDraggedObjects), lines);
  return dragged;
}

std::optional<SceneItem> SceneTree::drop_place(const QPoint& position) const {
  const QTreeWidgetItem* row = itemAt(position);
  if (!row) {
    return std::nullopt;
  }
  const SceneItem item = item_at(row);
  const bool is_all_objects =
      item.kind == Kind::kNone && row->childCount() > 0 &&
      (item_at(row->child(0)).kind == Kind::kObject || item_at(row->child(0)).kind == Kind::kGroup);
  const bool takes = item.kind == Kind::kLink || item.kind == Kind::kGroup ||
                     item.kind == Kind::kObject || is_all_objects;
  return takes ? std::optional(item) : std::nullopt;
}

void SceneTree::dragMoveEvent(QDragMoveEvent* event) {
  QTreeWidget::dragMoveEvent(event);  // which scrolls
  event->setAccepted(event->mimeData()->hasFormat(QLatin1String(kDraggedObjects)) &&
                     drop_place(event->pos()));
}

void SceneTree::dropEvent(QDropEvent* event) {
  if (const auto onto = drop_place(event->pos())) {
    emit objects_dropped(dragged_objects(*event->mimeData()), *onto);
  }
  event->setDropAction(Qt::CopyAction);  // the scene's editor moves the rows
  event->accept();
  stopAutoScroll();
  setState(NoState);
  viewport()->update();
}

void SceneTree::take_object_change(const SceneItem& changed, const std::string& text, bool shown) {
  const bool is_group = changed.kind == Kind::kGroup;
  if (text != changed.name) {
    is_group ? emit group_renamed(changed.name, text) : emit object_renamed(changed.name, text);
    return;
  }
  const std::vector<std::string> names =
      is_group ? planning::group_members(*state_.scene, changed.name) : std::vector{changed.name};
  const auto is_hidden = [this](const std::string& name) { return state_.is_hidden(name); };
  if (shown ? std::ranges::any_of(names, is_hidden) : !std::ranges::all_of(names, is_hidden)) {
    emit objects_toggled(names, shown);
  }
}

void SceneTree::take_change(QTreeWidgetItem* row) {
  const SceneItem changed = item_at(row);
  if (changed.kind == Kind::kObject || changed.kind == Kind::kGroup) {
    // Receivers may rebuild the tree, which is not allowed while a row is in use.
    const bool shown = row->checkState(0) == Qt::Checked;
    const std::string text = row->text(0).trimmed().toStdString();
    QMetaObject::invokeMethod(
        this, [this, changed, shown, text] { take_object_change(changed, text, shown); },
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
  selection_ = {};
  rebuild();
}

void SceneTree::update_scene(const planning::SceneState& state) {
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
  select(selection_);
  verticalScrollBar()->setValue(scrolled);
}

void SceneTree::edit_name() {
  const Kind kind = item_at(currentItem()).kind;
  if (kind == Kind::kObject || kind == Kind::kGroup) {
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
  add_frames(*state_.scene);
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

std::map<std::string, QTreeWidgetItem*> SceneTree::add_parts(const geometric::RobotInstance& robot,
                                                             QTreeWidgetItem& top) {
  std::map<std::string, QTreeWidgetItem*> rows;
  for (const geometric::RobotPart& part : robot.parts) {
    if (part.carrier < 0) {
      continue;
    }
    const QString name = QString::fromStdString(part.name);
    QTreeWidgetItem* row = make_row(name, icon("robot"), {Kind::kRobot, part.name, ""});
    row->setToolTip(
        0,
        tr("%1: mounted on %2 of %3")
            .arg(name, QString::fromStdString(part.link),
                 QString::fromStdString(robot.parts[static_cast<std::size_t>(part.carrier)].name)));
    top.addChild(row);
    rows[part.links.at(part.model->link(0).name)] = row;
  }
  return rows;
}

void SceneTree::add_robot(const geometric::RobotInstance& robot) {
  const geometric::RobotModel& model = *robot.model;
  QTreeWidgetItem* top =
      make_row(QString::fromStdString(robot.name), icon("robot"), {Kind::kRobot, robot.name, ""});
  top->setToolTip(
      0, tr("%1: %2 links, %3 independent joints")
             .arg(QString::fromStdString(model.name()), QString::number(model.link_count()),
                  QString::number(model.variable_count())));
  addTopLevelItem(top);
  const std::map<std::string, QTreeWidgetItem*> parts = add_parts(robot, *top);
  std::vector<QTreeWidgetItem*> rows;
  for (int i = 0; i < model.link_count(); ++i) {
    const std::string& name = model.link(i).name;
    rows.push_back(
        make_row(QString::fromStdString(name), icon("link"), {Kind::kLink, robot.name, name}));
    if (const auto part = parts.find(name); part != parts.end()) {
      part->second->addChild(rows.back());
      continue;
    }
    const int parent = model.parent(i);
    // A serial chain stays flat; only branches (fingers) are indented.
    QTreeWidgetItem* above = parent < 0 ? top : rows[static_cast<std::size_t>(parent)];
    int siblings = 0;
    for (int k = 1; k < model.link_count(); ++k) {
      const bool is_beside = parent >= 0 && model.parent(k) == parent;
      siblings += is_beside && !parts.contains(model.link(k).name) ? 1 : 0;
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
  std::map<std::string, QTreeWidgetItem*> groups;
  for (const geometric::SceneObject& object : scene.objects) {
    QTreeWidgetItem* above = top;
    if (const std::string& group = scene.display.of(object.name).group; !group.empty()) {
      QTreeWidgetItem*& row = groups[group];
      if (!row) {
        row = group_row(scene, group);
        top->addChild(row);
        row->setExpanded(true);
      }
      above = row;
    }
    above->addChild(object_row(object));
  }
  top->setExpanded(true);
}

QTreeWidgetItem* SceneTree::group_row(const geometric::Scene& scene,
                                      const std::string& group) const {
  const std::vector<std::string> members = planning::group_members(scene, group);
  const auto hidden = std::ranges::count_if(
      members, [this](const std::string& name) { return state_.is_hidden(name); });
  const bool locked = std::ranges::all_of(
      members, [this](const std::string& name) { return state_.is_locked(name); });
  QTreeWidgetItem* row =
      make_row(QString::fromStdString(group), icon("objects"), {Kind::kGroup, "", group});
  row->setFlags(row->flags() | Qt::ItemIsUserCheckable | Qt::ItemIsEditable);
  row->setCheckState(0, hidden == 0                     ? Qt::Checked
                        : hidden == std::ssize(members) ? Qt::Unchecked
                                                        : Qt::PartiallyChecked);
  row->setToolTip(0,
                  tr("%1: group of %2 objects").arg(row->text(0), QString::number(members.size())));
  if (locked) {
    row->setIcon(1, icon("lock"));
  }
  return row;
}

QTreeWidgetItem* SceneTree::object_row(const geometric::SceneObject& object) const {
  QTreeWidgetItem* row =
      make_row(QString::fromStdString(object.name),
               icon("object", seen_on(palette().color(QPalette::Base), to_qcolor(object.color))),
               {Kind::kObject, "", object.name});
  QString words = std::visit(SizeText{}, object.shape);
  if (object.attachment) {
    words += tr(", attached to %1").arg(QString::fromStdString(object.attachment->link));
  }
  if (state_.is_locked(object.name)) {
    row->setIcon(1, icon("lock"));
  } else {
    row->setFlags(row->flags() | Qt::ItemIsEditable);
  }
  row->setFlags(row->flags() | Qt::ItemIsUserCheckable);
  row->setCheckState(0, state_.is_hidden(object.name) ? Qt::Unchecked : Qt::Checked);
  row->setToolTip(0, QStringLiteral("%1: %2").arg(row->text(0), words));
  return row;
}

void SceneTree::add_frames(const geometric::Scene& scene) {
  if (scene.frames.empty()) {
    return;
  }
  QTreeWidgetItem* top = make_row(tr("Frames"), icon("local_axes"), {});
  addTopLevelItem(top);
  for (const geometric::NamedFrame& frame : scene.frames) {
    QTreeWidgetItem* row =
        make_row(QString::fromStdString(frame.name), icon("local_axes"), frame_item(frame.name));
    row->setToolTip(
        0, frame.parent.empty()
               ? tr("%1: a frame of the world").arg(row->text(0))
               : tr("%1: a frame on %2").arg(row->text(0), QString::fromStdString(frame.parent)));
    top->addChild(row);
  }
  top->setExpanded(true);
}

void SceneTree::add_query(const geometric::Scene& scene) {
  if (!scene.start && !scene.goal && scene.goal_poses.empty()) {
    return;
  }
  QTreeWidgetItem* top = make_row(tr("Task"), icon("route"), {});
  addTopLevelItem(top);
  const auto add = [&](const QString& text, const geometric::Color& color, Kind kind) {
    QTreeWidgetItem* row = make_row(text, icon("posture", to_qcolor(color)), {kind, "", ""});
    row->setFlags(row->flags() | Qt::ItemIsUserCheckable);
    row->setCheckState(0, Qt::Checked);
    row->setToolTip(
        0,
        tr("%1: the box shows its ghost; a double click moves the robot there").arg(row->text(0)));
    top->addChild(row);
  };
  if (scene.start) {
    add(tr("Start"), kStartColor, Kind::kStart);
  }
  if (scene.goal) {
    add(tr("Goal"), kGoalColor, Kind::kGoal);
  }
  for (std::size_t i = 0; i < scene.goal_poses.size(); ++i) {
    const QString link = QString::fromStdString(scene.goal_poses[i].link);
    const QString text = scene.goal_poses.size() == 1
                             ? tr("Goal pose of %1").arg(link)
                             : tr("Goal pose %1 of %2").arg(i + 1).arg(link);
    QTreeWidgetItem* row = make_row(text, icon("goal", to_qcolor(kGoalColor)), goal_pose_item(i));
    row->setToolTip(0, tr("%1: any of the goal poses will do").arg(text));
    top->addChild(row);
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

void SceneTree::select(const Selection& selection) {
  selection_ = selection;
  const QSignalBlocker quiet(this);
  const auto is_selected = [&](const std::string& name) {
    return std::ranges::find(selection.objects, name) != selection.objects.end();
  };
  clearSelection();
  QTreeWidgetItem* current = nullptr;
  for (QTreeWidgetItemIterator it(this); *it; ++it) {
    const SceneItem item = item_at(*it);
    bool marked = item.kind != Kind::kNone && item == selection.item;
    if (item.kind == Kind::kGroup) {
      const std::vector<std::string> members = planning::group_members(*state_.scene, item.name);
      marked = members.size() > 1 && std::ranges::all_of(members, is_selected);
    } else if (item.kind == Kind::kObject) {
      marked = is_selected(item.name) && !((*it)->parent() && (*it)->parent()->isSelected());
    }
    (*it)->setSelected(marked);
    current = marked && (!current || item == selection.item) ? *it : current;
  }
  setCurrentItem(current, 0, QItemSelectionModel::NoUpdate);
  if (current) {
    scrollToItem(current);
  }
}

void SceneTree::refresh_icons() { update_scene(planning::SceneState(state_)); }

}  // namespace handway::gui
