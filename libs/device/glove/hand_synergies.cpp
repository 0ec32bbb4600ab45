#include "hand_synergies.h"

namespace handway::device {

// In four lines: thumb; index and middle; ring with the abduction of the index before it; little
// with that of the ring before it, its own abduction, palm arch, wrist.
// clang-format off
const SensorDegrees kMiddlePosture{
    40.0, 22.0, 26.0, 18.0,
    35.0, 38.0, 0.0, 35.0, 38.0, 0.0,
    2.0, 35.0, 38.0, 0.0,
    2.0, 33.0, 36.0, 0.0, 4.0, 10.0, -5.0, 5.0};

const std::array<SensorDegrees, kSynergies> kHandSynergies{{
    // Flat fist: proximal joints bent, the others straight; the fingers close up.
    {0.0, -7.0, -9.0, 0.0,
     22.0, -11.0, 0.0, 24.0, -11.5, 0.0,
     -3.0, 23.0, -10.0, 0.0,
     -3.0, 21.0, -10.0, 0.0, -3.0, 2.0, 3.0, 0.0},
    // Closed: everything bent together.
    {0.0, 6.0, 9.0, -3.0,
     11.0, 22.0, 0.0, 13.0, 22.0, 0.0,
     -2.0, 13.0, 21.0, 0.0,
     -1.5, 12.0, 20.0, 0.0, -2.0, 4.0, -4.0, 0.0},
    // Opposition.
    {18.0, 5.0, 0.0, 8.0,
     0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
     0.0, 0.0, 0.0, 0.0,
     0.0, 0.0, 0.0, 0.0, 0.0, 5.0, 0.0, 0.0},
    // Spread.
    {0.0, 0.0, 0.0, 4.0,
     0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
     3.0, 0.0, 0.0, 0.0,
     3.0, 0.0, 0.0, 0.0, 5.0, -2.0, 0.0, 0.0},
}};

const std::array<std::array<double, kFingers>, kFingers> kEnslaving{{
    {1.00, 0.20, 0.11, 0.05},
    {0.13, 1.00, 0.35, 0.06},
    {0.05, 0.10, 1.00, 0.14},
    {0.05, 0.05, 0.38, 1.00}}};

const std::array<SmallMove, kSmallMoves> kSmallHandMoves{{
    {0, 3.6}, {1, 6.0}, {2, 14.0}, {3, 4.0}, {10, 2.5}, {14, 2.5}, {19, 5.0}, {20, 12.0}, {21, 6.0}}};

const std::array<double, 2> kFingerMove{13.5, 15.5};

const std::array<SensorRange, kGloveSensors> kAnatomicRanges{{
    {-15.0, 70.0}, {-20.0, 60.0}, {-10.0, 80.0}, {0.0, 50.0},
    {-20.0, 90.0}, {0.0, 110.0}, {0.0, 80.0}, {-20.0, 90.0}, {0.0, 110.0}, {0.0, 80.0},
    {-15.0, 20.0}, {-20.0, 90.0}, {0.0, 110.0}, {0.0, 80.0},
    {-15.0, 20.0}, {-25.0, 90.0}, {0.0, 100.0}, {0.0, 80.0},
    {-15.0, 29.0}, {0.0, 35.0}, {-70.0, 80.0}, {-20.0, 30.0}}};
// clang-format on

}  // namespace handway::device
