#include "features/microscope/listing_view.h"

#include "features/microscope/algorithm_listing.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/theme.h"

#include <QColor>
#include <QFont>
#include <QFontDatabase>
#include <QLabel>
#include <QPlainTextEdit>
#include <QString>
#include <QTextBlock>
#include <QTextCursor>
#include <QTextEdit>

#include <string_view>

namespace handway::gui {
namespace {

constexpr double kMark = 0.28;  // opacity
constexpr double kCallMark = 0.12;
constexpr int kLinesAround = 3;  // lines seen above and below the marked one

// Indented by half as much as the listings are, so that more of the lines is seen.
QString listing_text(const AlgorithmListing& listing) {
  QString text;
  int number = 0;
  for (const std::string_view line : listing.lines) {
    const std::string_view seen = line.substr(line.find_first_not_of(' ') / 2);
    text += QStringLiteral("%1%2  %3")
                .arg(number == 0 ? QString() : QStringLiteral("\n"))
                .arg(number + 1, 2)
                .arg(QString::fromUtf8(seen.data(), static_cast<int>(seen.size())));
    ++number;
  }
  return text;
}

}  // namespace

ListingView::ListingView(QWidget* parent)
    : QWidget(parent), title_(heading()), text_(new QPlainTextEdit) {
  title_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);  // panels keep their widths
  text_->setReadOnly(true);
  text_->setLineWrapMode(QPlainTextEdit::NoWrap);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  QFont font = QFontDatabase::systemFont(QFontDatabase::FixedFont);
  font.setPixelSize(scaled(12));
  text_->setFont(font);
  lay_out(*this, in_column({title_, {text_, 1}}, 2));
  follow_theme(*this, [this] { mark(); });
}

void ListingView::show_line(int algorithm, int line, bool calls) {
  if (algorithm != algorithm_) {
    const AlgorithmListing& listing = algorithm_listing(algorithm);
    text_->setPlainText(listing_text(listing));
  }
  algorithm_ = algorithm;
  show_title();
  line_ = line;
  calls_ = calls;
  mark();
}

// Shows as much of the title as fits.
void ListingView::show_title() {
  if (algorithm_ > 0) {
    const QString title = tr("Algorithm %1: %2")
                              .arg(algorithm_)
                              .arg(QString::fromUtf8(algorithm_listing(algorithm_).title));
    title_->setText(title_->fontMetrics().elidedText(title, Qt::ElideRight, title_->width()));
    title_->setToolTip(title);
  }
}

void ListingView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  layout()->activate();
  show_title();
}

void ListingView::clear() {
  algorithm_ = 0;
  line_ = 0;
  title_->clear();
  text_->clear();
}

void ListingView::mark() {
  if (algorithm_ == 0) {
    return;
  }
  QTextEdit::ExtraSelection marked;
  marked.cursor = QTextCursor(text_->document()->findBlockByNumber(line_ - 1));
  QColor color = colors_of(current_theme()).accent;
  color.setAlphaF(calls_ ? kCallMark : kMark);
  marked.format.setBackground(color);
  marked.format.setProperty(QTextFormat::FullWidthSelection, true);
  text_->setExtraSelections({marked});
  const int last = text_->document()->blockCount() - 1;
  for (const int line :
       {qMin(line_ - 1 + kLinesAround, last), qMax(line_ - 1 - kLinesAround, 0), line_ - 1}) {
    text_->setTextCursor(QTextCursor(text_->document()->findBlockByNumber(line)));
    text_->ensureCursorVisible();
  }
}

}  // namespace handway::gui
