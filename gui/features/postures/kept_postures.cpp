#include "features/postures/kept_postures.h"

#include "features/postures/posture_panels.h"
#include "model/document/document.h"
#include "model/document/scene_editor.h"

#include <QAction>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include <utility>

namespace handway::gui {
namespace {

constexpr int kLeastWidth = 340;

}  // namespace

KeepPostureDialog::KeepPostureDialog(const JointGroups& groups, const QStringList& taken,
                                     QWidget* parent)
    : QDialog(parent),
      taken_(taken),
      name_(new QLineEdit),
      part_(new QComboBox),
      note_(new QLabel),
      keep_(nullptr) {
  setWindowTitle(tr("Keep this posture"));
  setMinimumWidth(kLeastWidth);
  name_->setObjectName(QStringLiteral("posture_name"));
  name_->setPlaceholderText(tr("for example: above the table"));
  part_->setObjectName(QStringLiteral("posture_part"));
  std::vector<int> all = groups.arm;
  all.insert(all.end(), groups.hand.begin(), groups.hand.end());
  all.insert(all.end(), groups.other.begin(), groups.other.end());
  add_part(tr("The whole robot"), std::move(all));
  if (!groups.arm.empty() && !groups.hand.empty()) {
    add_part(tr("The arm"), groups.arm);
    add_part(tr("The hand"), groups.hand);
  }
  auto* form = new QFormLayout;
  form->addRow(tr("Name"), name_);
  form->addRow(tr("Of"), part_);
  note_->setProperty("role", "note");
  note_->setWordWrap(true);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  keep_ = buttons->addButton(tr("Keep"), QDialogButtonBox::AcceptRole);
  keep_->setObjectName(QStringLiteral("posture_keep"));
  keep_->setProperty("role", "primary");
  keep_->setDefault(true);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(16, 16, 16, 12);
  layout->setSpacing(10);
  layout->addLayout(form);
  layout->addWidget(note_);
  layout->addWidget(buttons);
  connect(name_, &QLineEdit::textChanged, this, &KeepPostureDialog::look_at_name);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  look_at_name();
}

void KeepPostureDialog::add_part(const QString& text, std::vector<int> variables) {
  part_->addItem(text);
  parts_.push_back(std::move(variables));
}

void KeepPostureDialog::look_at_name() {
  keep_->setEnabled(!name().isEmpty());
  note_->setText(
      taken_.contains(name())
          ? tr("It takes the place of the posture of that name.")
          : tr("Postures are saved with the scene. Joints of other parts stay where they "
               "are when the robot goes to it."));
}

QString KeepPostureDialog::name() const { return name_->text().trimmed(); }

const std::vector<int>& KeepPostureDialog::variables() const {
  return parts_[static_cast<std::size_t>(part_->currentIndex())];
}

KeptPostures::KeptPostures(const Document& document, SceneEditor& editor, PostureBar& bar,
                           QAction& keep, QObject* parent)
    : QObject(parent), document_(document), editor_(editor), bar_(bar) {
  connect(&keep, &QAction::triggered, this, &KeptPostures::keep_this);
  connect(&bar, &PostureBar::keep_requested, this, &KeptPostures::keep_this);
  connect(&bar, &PostureBar::forget_requested, this,
          [this](const QString& name) { editor_.forget_posture(name.toStdString()); });
}

void KeptPostures::keep_this() {
  const geometric::RobotInstance* robot = document_.robot();
  if (!robot) {
    return;
  }
  QStringList taken;
  for (const geometric::NamedPosture& posture : document_.scene()->postures) {
    taken.push_back(QString::fromStdString(posture.name));
  }
  KeepPostureDialog dialog(document_.groups(), taken, bar_.window());
  if (dialog.exec() != QDialog::Accepted) {
    return;
  }
  geometric::NamedPosture posture;
  posture.name = dialog.name().toStdString();
  for (const int variable : dialog.variables()) {
    posture.values[robot->model->variable(variable).name] = document_.configuration()[variable];
  }
  editor_.keep_posture(posture);
}

}  // namespace handway::gui
