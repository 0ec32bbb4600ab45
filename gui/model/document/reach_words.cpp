#include "model/document/reach_words.h"

#include <QObject>

namespace handway::gui {

QString reach_words(const planning::ReachFigures& figures, bool reached) {
  const QString words = QObject::tr("manipulability %1 · reach %2 %")
                            .arg(figures.manipulability, 0, 'f', 3)
                            .arg(100.0 * figures.reach, 0, 'f', 0);
  return reached ? words : QObject::tr("out of reach · %1").arg(words);
}

QString reach_explanation() {
  return QObject::tr(
      "Manipulability (Yoshikawa): how freely the arm moves the palm's place; 0 in a singular "
      "posture, which can't move it in some direction. Reach: how far the palm is from the arm's "
      "first joint, of the most that the links between allow.");
}

}  // namespace handway::gui
