#include "features/postures/kept_postures.h"

#include "features/postures/keep_posture_dialog.h"
#include "features/postures/posture_bar.h"
#include "model/document/document.h"
#include "model/document/scene_editor.h"

#include <QAction>

namespace handway::gui {

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
