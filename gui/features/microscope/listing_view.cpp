#include "features/microscope/listing_view.h"

#include "widgets/style/theme.h"

#include <QEvent>
#include <QFontDatabase>
#include <QLabel>
#include <QPlainTextEdit>
#include <QTextBlock>
#include <QVBoxLayout>

#include <array>

namespace handway::gui {
namespace {

constexpr auto kSampleArm = std::to_array<std::string_view>({
    "i ← 0",
    "while i < most draws",
    "  cₐ ← point at step of the arm segment + random offset in ±ρₐ",
    "  if the arm at cₐ is free of itself",
    "    return cₐ",
    "  end",
    "  i ← i + 1",
    "end",
    "return nothing",
});

constexpr auto kSampleHand = std::to_array<std::string_view>({
    "i ← 0",
    "while i < most draws",
    "  u ← random point of the unit cube, one axis for each of SCʰ",
    "  cₕ ← posture of the hand at u (Eq. 1)",
    "  c ← (cₐ, cₕ)",
    "  if c is free of itself",
    "    if c is free of the objects",
    "      return c",
    "    end",
    "  end",
    "  i ← i + 1",
    "end",
    "return nothing",
});

constexpr auto kConnectSample = std::to_array<std::string_view>({
    "add s to the roadmap G",
    "neighbours ← the K nodes of G nearest to s",
    "for each neighbour g",
    "  if g and s are not joined yet",
    "    if the straight way from g to s is free",
    "      add the edge (g, s) to G",
    "      update the components of G",
    "    end",
    "  end",
    "end",
    "return G",
});

constexpr auto kRoadmap = std::to_array<std::string_view>({
    "G ← empty",
    "add the start to G",
    "add the goal to G",
    "samples ← 2",
    "k ← 1",
    "repeat",
    "  ρₐ ← k · ρₐ",
    "  k ← k + 1",
    "  n ← number of hypercubes along the arm segment",
    "  range ← [0, 1]",
    "  for i from 1 to n",
    "    step ← i-th point of the Van der Corput sequence of n",
    "    if step is in the range",
    "      for j from 1 to nA",
    "        if cₐ ← SampleArm(step, ρₐ)",
    "          axes of SCʰ ← thumb base and one PMD",
    "          for h from 1 to nH",
    "            if c ← SampleHand(cₐ, axes)",
    "              ConnectSample(c, G)",
    "              if start and goal are joined",
    "                return the path between them",
    "              end",
    "              range ← what lies between the two components",
    "              leave the loop of j",
    "            else",
    "              one PMD more",
    "            end",
    "            samples ← samples + 1",
    "          end",
    "        end",
    "      end",
    "    end",
    "  end",
    "until samples > N",
    "return failure",
});

constexpr std::array<AlgorithmListing, 4> kListings{{
    {1, "SampleArm(step, ρₐ)", kSampleArm},
    {2, "SampleHand(cₐ, axes)", kSampleHand},
    {3, "ConnectSample(s, G)", kConnectSample},
    {4, "Roadmap(start, goal)", kRoadmap},
}};

}  // namespace

const AlgorithmListing& algorithm_listing(int algorithm) {
  return kListings[static_cast<std::size_t>(algorithm - 1)];
}

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
    : QWidget(parent), title_(new QLabel), text_(new QPlainTextEdit) {
  title_->setProperty("role", "heading");
  title_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);  // panels keep their widths
  text_->setReadOnly(true);
  text_->setLineWrapMode(QPlainTextEdit::NoWrap);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  QFont font = QFontDatabase::systemFont(QFontDatabase::FixedFont);
  font.setPixelSize(12);
  text_->setFont(font);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(2);
  layout->addWidget(title_);
  layout->addWidget(text_, 1);
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

// As much of it as there is room for.
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

void ListingView::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) {
    mark();
  }
}

}  // namespace handway::gui
