#include "features/glove/combination_squares.h"

#include "features/glove/coverage_bars.h"
#include "features/glove/joint_label.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/human_hand.h"
#include "widgets/style/color_math.h"
#include "widgets/style/theme.h"

#include <QPainter>

#include <cstddef>

namespace handway::gui {
namespace {

using device::Finger;

constexpr int kSquare = 42;        // px, of two fingers
constexpr int kSquareGap = 10;     // px
constexpr int kFingerWidth = 62;   // px, of a finger's name
constexpr int kFingerHeight = 18;  // px

}  // namespace

CombinationSquares::CombinationSquares(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("combination_squares"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setToolTip(
      tr("A square for each pair of fingers, from straight to bent along both axes; visited "
         "combinations are filled"));
}

void CombinationSquares::show_combinations(const FingerCombinations& combinations) {
  combinations_ = combinations;
  update();
}

QSize CombinationSquares::sizeHint() const {
  const int squares = (device::kFingers - 1) * scaled(kSquare + kSquareGap);
  return {kSideMargin + scaled(kFingerWidth) + squares, scaled(kFingerHeight) + squares};
}

void CombinationSquares::paintEvent(QPaintEvent*) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  set_text_size(painter, 12);
  const int step = scaled(kSquare + kSquareGap);
  const double cell = scaled(kSquare) / static_cast<double>(FingerCombinations::kStates);
  for (int a = 0; a < device::kFingers; ++a) {
    for (int b = a + 1; b < device::kFingers; ++b) {
      const int x = kSideMargin + scaled(kFingerWidth) + a * step;
      const int y = scaled(kFingerHeight) + (b - 1) * step;
      for (int i = 0; i < FingerCombinations::kStates; ++i) {
        for (int j = 0; j < FingerCombinations::kStates; ++j) {
          const bool visited =
              combinations_.visited(static_cast<Finger>(a), i, static_cast<Finger>(b), j);
          painter.fillRect(QRectF(x + i * cell, y + j * cell, cell - 1.0, cell - 1.0),
                           visited ? faded(colors.accent, 0.85) : faded(colors.border, 0.7));
        }
      }
      painter.setPen(colors.text);
      if (b == a + 1) {
        painter.drawText(QRect(x, y - scaled(kFingerHeight), step, scaled(kFingerHeight)),
                         Qt::AlignVCenter, finger_label(static_cast<std::size_t>(a)));
      }
      if (a == 0) {
        painter.drawText(QRect(kSideMargin, y, scaled(kFingerWidth), scaled(kSquare)),
                         Qt::AlignVCenter, finger_label(static_cast<std::size_t>(b)));
      }
    }
  }
}

}  // namespace handway::gui
