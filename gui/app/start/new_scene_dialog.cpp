#include "app/start/new_scene_dialog.h"

#include "app/start/picture_card.h"
#include "handway/geometric/formats/srdf.h"
#include "handway/geometric/io/resources.h"
#include "widgets/forms/arrangement.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/style/theme.h"

#include <QButtonGroup>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>
#include <QVariant>

#include <algorithm>

namespace handway::gui {
namespace {

using geometric::ResourceKind;

constexpr int kCardGap = 10;     // px
constexpr int kDialogEdge = 16;  // px
constexpr int kCardWidth = 146;  // px

}  // namespace

std::vector<LibraryRobot> library_robots() {
  std::vector<LibraryRobot> robots;
  for (const std::string& name : geometric::resource_names(ResourceKind::kRobot)) {
    std::filesystem::path srdf =
        geometric::find_resource(ResourceKind::kRobot, name, geometric::resource_dir());
    srdf.replace_extension(".srdf");
    const std::vector<std::string> groups = std::filesystem::exists(srdf)
                                                ? geometric::srdf_group_names(srdf)
                                                : std::vector<std::string>();
    const bool has_hand = std::ranges::count(groups, "hand") > 0;
    robots.push_back({name, std::ranges::count(groups, "arm") > 0 || !has_hand, has_hand});
  }
  return robots;
}

NewSceneDialog::NewSceneDialog(QWidget* parent)
    : QDialog(parent),
      robots_(library_robots()),
      arms_(new QButtonGroup(this)),
      hands_(new QButtonGroup(this)),
      note_(named("new_scene_note", new QLabel)),
      create_(named("new_scene_create", new QPushButton(tr("Create")))) {
  setObjectName(QStringLiteral("new_scene_dialog"));
  setWindowTitle(tr("New scene"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(within_window(*this, {scaled(970), scaled(480)}));
  note_->setWordWrap(true);
  create_->setProperty("role", "primary");
  create_->setDefault(true);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  buttons->addButton(create_, QDialogButtonBox::AcceptRole);
  connect(create_, &QPushButton::clicked, this, &NewSceneDialog::create);
  auto* file = named("new_scene_file", new QPushButton(tr("Robot file…")));
  file->setToolTip(tr("Begin with a robot of your own: URDF, xacro, SDF, MJCF"));
  buttons->addButton(file, QDialogButtonBox::ActionRole);
  connect(file, &QPushButton::clicked, this, [this] {
    reject();
    emit file_wanted();
  });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  lay_out(*this, in_column({{make_choice(), 1}, in_row({{note_, 1}, buttons})}),
          {kDialogEdge, kDialogEdge, kDialogEdge, kDialogEdge});
  for (QButtonGroup* group : {arms_, hands_}) {
    connect(group, qOverload<QAbstractButton*, bool>(&QButtonGroup::buttonToggled), this,
            &NewSceneDialog::follow_choice);
  }
  choose({});
}

QWidget* NewSceneDialog::make_choice() {
  std::vector<std::string> arms, hands;
  for (const LibraryRobot& robot : robots_) {
    (robot.has_arm ? arms : hands).push_back(robot.name);
  }
  auto* page = new QWidget;
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(kCardGap);
  add_cards(*layout, tr("Arm"), *arms_, arms, tr("No arm"));
  layout->addSpacing(kCardGap);
  add_cards(*layout, tr("Hand"), *hands_, hands, tr("No hand"));
  layout->addStretch(1);
  auto* area = new QScrollArea;
  area->setFrameShape(QFrame::NoFrame);
  area->setWidgetResizable(true);
  area->setProperty("role", "start");
  area->setWidget(page);
  return area;
}

void NewSceneDialog::add_cards(QVBoxLayout& layout, const QString& title, QButtonGroup& group,
                               const std::vector<std::string>& names, const QString& none) {
  layout.addWidget(heading(title));
  auto* grid = new QGridLayout;
  grid->setSpacing(kCardGap);
  const int card_width = scaled(kCardWidth);
  const int columns = std::max(1, (width() - 2 * kDialogEdge) / (card_width + kCardGap));
  const auto add = [&](const QString& words, const QString& name, const QString& picture) {
    auto* card = new PictureCard(words, picture, card_width);
    card->setCheckable(true);
    card->setObjectName(QStringLiteral("choose ") + (name.isEmpty() ? words.toLower() : name));
    card->setProperty("robot", name);
    const auto index = static_cast<int>(group.buttons().size());
    group.addButton(card);
    grid->addWidget(card, index / columns, index % columns, Qt::AlignLeft);
  };
  for (const std::string& name : names) {
    add(QString::fromStdString(name), QString::fromStdString(name), robot_picture(name));
  }
  add(none, QString(), QString());
  grid->setColumnStretch(columns, 1);
  layout.addLayout(grid);
}

std::string NewSceneDialog::name_in(const QButtonGroup& group) {
  const QAbstractButton* button = group.checkedButton();
  return button ? button->property("robot").toString().toStdString() : std::string();
}

bool NewSceneDialog::arm_has_hand() const {
  const auto arm = std::ranges::find(robots_, name_in(*arms_), &LibraryRobot::name);
  return arm != robots_.end() && arm->has_hand;
}

void NewSceneDialog::choose(const std::vector<std::string>& robots) {
  for (const QButtonGroup* group : {arms_, hands_}) {
    const QList<QAbstractButton*> cards = group->buttons();
    const auto named = std::ranges::find_if(cards, [&](const QAbstractButton* card) {
      return std::ranges::count(robots, card->property("robot").toString().toStdString()) > 0;
    });
    QAbstractButton* other = group == arms_ && robots.empty() ? cards.front() : cards.back();
    (named == cards.end() ? other : *named)->setChecked(true);
  }
}

void NewSceneDialog::follow_choice() {
  const bool has_hand = arm_has_hand();
  for (QAbstractButton* card : hands_->buttons()) {
    card->setEnabled(!has_hand);
  }
  if (has_hand) {
    hands_->buttons().back()->setChecked(true);
  }
  const QString arm = QString::fromStdString(name_in(*arms_));
  const QString hand = QString::fromStdString(name_in(*hands_));
  note_->setText(has_hand ? tr("%1 has a hand.").arg(arm)
                 : arm.isEmpty() && hand.isEmpty()
                     ? tr("Choose an arm, a hand, or both; or a robot file of your own.")
                 : arm.isEmpty()  ? tr("%1 alone, without an arm.").arg(hand)
                 : hand.isEmpty() ? tr("Add > Robot… mounts a hand or a tool of your own.")
                                  : tr("%1 is mounted on the end of %2.").arg(hand, arm));
  create_->setEnabled(!arm.isEmpty() || !hand.isEmpty());
}

void NewSceneDialog::create() {
  const std::string arm = name_in(*arms_);
  const std::string hand = name_in(*hands_);
  accept();
  if (arm.empty()) {
    emit chosen(hand, {});
  } else {
    emit chosen(arm, hand);
  }
}

}  // namespace handway::gui
