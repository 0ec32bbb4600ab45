#include "widgets/forms/disclosure.h"

#include "widgets/forms/arrangement.h"

#include <QSettings>
#include <QToolButton>

namespace handway::gui {
namespace {

QString settings_key(const QString& name) { return QStringLiteral("open/") + name; }

}  // namespace

Disclosure::Disclosure(const char* name, const QString& title, QWidget* content, QWidget* parent)
    : QWidget(parent), heading_(named(name, new QToolButton)), content_(content) {
  heading_->setText(title);
  heading_->setCheckable(true);
  heading_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  heading_->setProperty("role", "disclosure");
  lay_out(*this, in_column({{heading_, 0, Qt::AlignLeft}, content_}, 6));
  connect(heading_, &QToolButton::toggled, this, [this](bool open) {
    heading_->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
    content_->setVisible(open);
    QSettings().setValue(settings_key(heading_->objectName()), open);
  });
  heading_->setArrowType(Qt::RightArrow);
  content_->hide();
  heading_->setChecked(QSettings().value(settings_key(heading_->objectName()), false).toBool());
}

}  // namespace handway::gui
