#include "features/playback/joint_curve_list.h"

#include "model/document/document.h"

#include <QHeaderView>
#include <QPainter>
#include <QPixmap>
#include <QSignalBlocker>

#include <algorithm>
#include <array>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kName = 0;
constexpr int kValue = 1;
constexpr QSize kSwatch{18, 12};

// Colours that are distinct on white and on dark grey.
constexpr std::array<QRgb, 10> kColors{0xff3f7fdb, 0xffe2801f, 0xff2f9e5b, 0xffd64545, 0xff8f63c7,
                                       0xffa0674b, 0xffd964ad, 0xff7d8a98, 0xff9c9b22, 0xff1fa3b5};

QIcon swatch(int variable) {
  QPixmap picture(kSwatch);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setPen(QPen(JointCurveList::color_of(variable), 3.0,
                      JointCurveList::is_dashed(variable) ? Qt::DotLine : Qt::SolidLine));
  const int middle = kSwatch.height() / 2;
  painter.drawLine(1, middle, kSwatch.width() - 2, middle);
  return {picture};
}

// Returns the common beginning of the joints' names, up to a "_": "thumb".
QString common_name(const geometric::RobotModel& model, const std::vector<int>& variables) {
  QString name = QString::fromStdString(model.variable(variables.front()).name);
  name = name.section(QLatin1Char('_'), 0, -2);
  for (const int variable : variables) {
    if (!QString::fromStdString(model.variable(variable).name)
             .startsWith(name + QLatin1Char('_'))) {
      return {};
    }
  }
  return name.isEmpty() ? name : name.front().toUpper() + name.mid(1);
}

}  // namespace

JointCurveList::JointCurveList(QWidget* parent) : QTreeWidget(parent) {
  setColumnCount(2);
  setHeaderHidden(true);
  setAccessibleName(tr("Joints that are drawn"));
  setIconSize(kSwatch);
  setSelectionMode(QAbstractItemView::NoSelection);
  setFocusPolicy(Qt::TabFocus);
  setIndentation(14);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(kName, QHeaderView::Stretch);
  header()->setSectionResizeMode(kValue, QHeaderView::ResizeToContents);
  connect(this, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem*, int column) {
    if (column == kName) {
      emit choice_changed();
    }
  });
}

QColor JointCurveList::color_of(int variable) {
  return kColors[static_cast<std::size_t>(variable) % kColors.size()];
}

bool JointCurveList::is_dashed(int variable) {
  return (static_cast<std::size_t>(variable) / kColors.size()) % 2 == 1;
}

QTreeWidgetItem* JointCurveList::add_group(const std::vector<int>& variables, const QString& name) {
  auto* group = new QTreeWidgetItem(this, {name});
  group->setFlags(Qt::ItemIsEnabled | Qt::ItemIsUserCheckable | Qt::ItemIsAutoTristate);
  group->setToolTip(kName, name);
  for (const int variable : variables) {
    const std::string& joint = model_->variable(variable).name;
    auto* item = new QTreeWidgetItem(group, {QString::fromStdString(joint)});
    item->setToolTip(kName, QString::fromStdString(joint));
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsUserCheckable);
    item->setCheckState(kName, Qt::Unchecked);
    item->setIcon(kName, swatch(variable));
    item->setTextAlignment(kValue, Qt::AlignRight | Qt::AlignVCenter);
    items_[static_cast<std::size_t>(variable)] = item;
  }
  return group;
}

void JointCurveList::set_robot(std::shared_ptr<const geometric::RobotModel> model,
                               const geometric::JointSelection& joints) {
  if (model == model_) {
    return;
  }
  const QSignalBlocker quiet(this);
  model_ = std::move(model);
  clear();
  items_.assign(model_ ? static_cast<std::size_t>(model_->variable_count()) : 0, nullptr);
  if (!model_) {
    return;
  }
  int finger = 0;
  for (const geometric::JointIndices& part : moving_parts(*model_, joints)) {
    if (part == joints.arm) {
      QTreeWidgetItem* arm = add_group(part, tr("Arm"));
      arm->setCheckState(kName, Qt::Checked);
      arm->setExpanded(true);
      continue;
    }
    ++finger;
    const QString name = common_name(*model_, part);
    add_group(part, name.isEmpty() ? tr("Finger %1").arg(finger) : name);
  }
  if (const geometric::JointIndices others = joints.outside_arm_and_hand(); !others.empty()) {
    add_group(others, tr("Other"));
  }
}

std::vector<int> JointCurveList::chosen() const {
  std::vector<int> variables;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    if (items_[i] && items_[i]->checkState(kName) == Qt::Checked) {
      variables.push_back(static_cast<int>(i));
    }
  }
  return variables;
}

void JointCurveList::choose(const std::vector<int>& variables) {
  {
    const QSignalBlocker quiet(this);
    for (std::size_t i = 0; i < items_.size(); ++i) {
      if (items_[i]) {
        const bool on = std::ranges::find(variables, static_cast<int>(i)) != variables.end();
        items_[i]->setCheckState(kName, on ? Qt::Checked : Qt::Unchecked);
      }
    }
  }
  emit choice_changed();
}

void JointCurveList::show_values(const std::vector<QString>& texts) {
  for (std::size_t i = 0; i < items_.size() && i < texts.size(); ++i) {
    if (items_[i]) {
      items_[i]->setText(kValue, texts[i]);
    }
  }
}

}  // namespace handway::gui
