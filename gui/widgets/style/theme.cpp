#include "widgets/style/theme.h"

#include "widgets/style/desktop_theme.h"
#include "widgets/style/rich_text.h"

#include <QApplication>
#include <QEvent>
#include <QFile>
#include <QFont>
#include <QLabel>
#include <QPainter>
#include <QPalette>
#include <QRegularExpression>
#include <QStyle>
#include <QStyleFactory>
#include <QVariant>
#include <QWidget>

#include <cmath>
#include <utility>

// Takes the drawings in; a macro of Qt that must stand outside all namespaces.
static void take_resources() { Q_INIT_RESOURCE(workbench); }

namespace handway::gui {
namespace {

constexpr int kTextSize = 13;  // px

Theme applied = Theme::kLight;
double applied_scale = 1.0;

QPalette palette_of(const ThemeColors& colors) {
  QPalette palette;
  palette.setColor(QPalette::Window, colors.window);
  palette.setColor(QPalette::WindowText, colors.text);
  palette.setColor(QPalette::Base, colors.surface);
  palette.setColor(QPalette::AlternateBase, colors.window);
  palette.setColor(QPalette::Text, colors.text);
  palette.setColor(QPalette::Button, colors.surface);
  palette.setColor(QPalette::ButtonText, colors.text);
  palette.setColor(QPalette::BrightText, colors.on_accent);
  palette.setColor(QPalette::Highlight, colors.accent);
  palette.setColor(QPalette::HighlightedText, colors.on_accent);
  palette.setColor(QPalette::ToolTipBase, colors.surface);
  palette.setColor(QPalette::ToolTipText, colors.text);
  palette.setColor(QPalette::PlaceholderText, colors.muted);
  palette.setColor(QPalette::Link, colors.accent);
  palette.setColor(QPalette::Mid, colors.border);
  palette.setColor(QPalette::Midlight, colors.border);
  palette.setColor(QPalette::Dark, colors.border.darker(115));
  for (const QPalette::ColorRole role :
       {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    QColor faint = colors.muted;
    faint.setAlphaF(0.6);
    palette.setColor(QPalette::Disabled, role, faint);
  }
  return palette;
}

// Returns the sheet with scaled sizes of what is as large as the text beside it: fonts, and the
// boxes and arrows of controls.
QString with_scaled_text(const QString& sheet) {
  static const QRegularExpression kSize(QStringLiteral("(?<=@size )(\\d+)(?=px)"));
  QString scaled_sheet;
  int done = 0;
  for (auto sizes = kSize.globalMatch(sheet); sizes.hasNext();) {
    const QRegularExpressionMatch size = sizes.next();
    scaled_sheet += sheet.mid(done, size.capturedStart() - done);
    scaled_sheet += QString::number(scaled(size.captured().toInt()));
    done = size.capturedEnd();
  }
  scaled_sheet += sheet.mid(done);
  return scaled_sheet.remove(QLatin1String("@size "));
}

// The sheet names colours as @name, and sizes that grow with the text as @size.
QString style_sheet(const ThemeColors& colors, Theme theme) {
  QFile file(QStringLiteral(":/themes/workbench.qss"));
  if (!file.open(QIODevice::ReadOnly | QIODevice::Text)) {
    return {};
  }
  QString sheet = QString::fromUtf8(file.readAll());
  const std::pair<const char*, QColor> names[] = {
      {"@window", colors.window},       {"@surface", colors.surface},
      {"@border", colors.border},       {"@text", colors.text},
      {"@muted", colors.muted},         {"@accent", colors.accent},
      {"@on-accent", colors.on_accent}, {"@bad", colors.bad},
      {"@good", colors.good},           {"@stop", colors.stop}};
  for (const auto& [name, color] : names) {
    sheet.replace(QLatin1String(name) + QLatin1Char(';'), color.name() + QLatin1Char(';'));
    sheet.replace(QLatin1String(name) + QLatin1Char(' '), color.name() + QLatin1Char(' '));
  }
  sheet.replace(QLatin1String("@variant"),
                theme == Theme::kDark ? QLatin1String("dark") : QLatin1String("light"));
  return with_scaled_text(sheet);
}

// Recolours texts that were written in the colours of the theme before.
void recolor_texts(const ThemeColors& before, const ThemeColors& now) {
  for (QWidget* widget : QApplication::allWidgets()) {
    if (auto* label = qobject_cast<QLabel*>(widget)) {
      QString text = label->text();
      for (const auto color : {&ThemeColors::text, &ThemeColors::muted, &ThemeColors::accent,
                               &ThemeColors::good, &ThemeColors::bad}) {
        text.replace(html(before.*color), html(now.*color));
      }
      if (text != label->text()) {
        label->setText(text);
      }
    }
  }
}

class ThemeFollower : public QObject {
 public:
  ThemeFollower(QWidget& widget, std::function<void()> take)
      : QObject(&widget), take_(std::move(take)) {
    widget.installEventFilter(this);
    take_();
  }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::PaletteChange) {
      take_();
    }
    return QObject::eventFilter(watched, event);
  }

 private:
  std::function<void()> take_;
};

}  // namespace

ThemeColors colors_of(Theme theme) {
  if (theme == Theme::kDark) {
    ThemeColors dark{QColor(0x1d, 0x22, 0x29),
                     QColor(0x26, 0x2c, 0x35),
                     QColor(0x3a, 0x43, 0x4f),
                     QColor(0xe4, 0xe8, 0xee),
                     QColor(0xa3, 0xae, 0xbd),
                     QColor(0x5b, 0x9b, 0xf2),
                     QColor(0x0b, 0x16, 0x26),
                     QColor(0x4c, 0xb9, 0x86),
                     QColor(0xf2, 0x7d, 0x73),
                     QColor(0xd2, 0x30, 0x28),
                     {}};
    dark.view.sky = {0.20F, 0.235F, 0.28F, 1.0F};
    dark.view.ground = {0.37F, 0.41F, 0.46F, 1.0F};
    dark.view.grid = {0.72F, 0.77F, 0.84F, 1.0F};
    dark.view.text = {0.92F, 0.94F, 0.96F, 1.0F};
    return dark;
  }
  return {QColor(0xf1, 0xf3, 0xf6),
          QColor(0xff, 0xff, 0xff),
          QColor(0xd5, 0xdb, 0xe3),
          QColor(0x22, 0x2b, 0x37),
          QColor(0x5a, 0x66, 0x77),
          QColor(0x1a, 0x62, 0xc2),
          QColor(0xff, 0xff, 0xff),
          QColor(0x14, 0x74, 0x4a),
          QColor(0xc9, 0x2f, 0x28),
          QColor(0xc9, 0x2f, 0x28),
          {}};
}

void apply_theme(QApplication& application, Theme theme) {
  apply_theme(application, theme, applied_scale);
}

void apply_theme(QApplication& application, Theme theme, double text_scale) {
  take_resources();
  desktop_palette();  // is replaced
  const ThemeColors before = colors_of(std::exchange(applied, theme));
  applied_scale = text_scale;
  QApplication::setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
  QFont font(QStringLiteral("Noto Sans"));
  font.setStyleHint(QFont::SansSerif);
  QFont::insertSubstitutions(QStringLiteral("Noto Sans"), {QStringLiteral("DejaVu Sans")});
  font.setPixelSize(scaled(kTextSize));
  QApplication::setFont(font);
  const ThemeColors colors = colors_of(theme);
  QApplication::setPalette(palette_of(colors));
  application.setStyleSheet(style_sheet(colors, theme));
  recolor_texts(before, colors);
}

Theme current_theme() { return applied; }

int scaled(int pixels) { return static_cast<int>(std::lround(applied_scale * pixels)); }

void set_text_size(QPainter& painter, int pixels) {
  QFont font = painter.font();
  font.setPixelSize(scaled(pixels));
  painter.setFont(font);
}

void follow_theme(QWidget& widget, std::function<void()> take) {
  new ThemeFollower(widget, std::move(take));
}

void set_role(QWidget& widget, const QString& role) {
  widget.setProperty("role", role);
  widget.style()->unpolish(&widget);
  widget.style()->polish(&widget);
}

}  // namespace handway::gui
