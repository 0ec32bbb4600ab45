// Where a finger sits: one seat in the palm for each of three, one in the thumb's base.
// Frame: <finger>_abduction_link, z along the abduction joint (out of the palm), x along
// the finger.
use <../../cad/solids.scad>

ear_radius = 10;
ear = [-22, -17.5];  // z of the ear behind the knuckle
seat_top = -20;      // x; the knuckle's cheeks turn above

// Bearing plate behind the knuckle, with its pin.
module knuckle_ear() {
  hull() {
    drum(ear_radius, ear[0], ear[1], 1, 0);
    block([-29, -12, ear[0]], [seat_top - 1, 12, ear[1]], 1);
  }
  drum(5, ear[0] - 1.5, ear[0] + 1, 1, 0);
}

module knuckle_block() block([-31, -12.5, -22.5], [seat_top, 12.5, 11], 3);

module knuckle_ear_collision() hull() {
  drum(ear_radius, ear[0] - 1.5, ear[1]);
  block([-29, -12, ear[0] - 1.5], [seat_top - 1, 12, ear[1]], 1);
}
