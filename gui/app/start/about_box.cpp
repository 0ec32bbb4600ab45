#include "app/start/about_box.h"

#include <Inventor/SoDB.h>
#include <QApplication>
#include <QMessageBox>

namespace handway::gui {

void show_about(QWidget& window) {
  auto* box = new QMessageBox(
      QMessageBox::NoIcon, QObject::tr("About Handway"),
      QObject::tr("<h3>Handway %1</h3><p>Simulator and planning workbench for hand-arm "
                  "robots.</p><p>Qt %2, Coin %3</p>")
          .arg(QApplication::applicationVersion(), QLatin1String(qVersion()),
               QString::fromLatin1(SoDB::getVersion()).section('-', -1)),
      QMessageBox::Close, &window);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->open();
}

}  // namespace handway::gui
