// Distal phalanx: fork over the medial phalanx's tongue, round fingertip with a soft pad.
// Frame: <finger>_distal_link, y along the finger, z along the distal joint, x towards the
// pad's side; the fingertip ends at y = 39.5.
use <../../cad/solids.scad>

inner = 8.8;
outer = 12;
tip = 39.5;
tip_radius = 11;

module cheek() hull() {
  drum(9, inner, outer, 0, 1.5);
  block([-9, 11, inner], [8, 17, outer], 1.5);
}

module cheeks() {
  cheek();
  mirror([0, 0, 1]) cheek();
}

module phalanx() hull() {
  block([-11, 10.5, -outer], [7, 20, outer], 4);
  ball_at([-1.5, tip - tip_radius, 0], tip_radius - 1);
}

module pad() hull() {
  ball_at([1.8, tip - 9.8, 0], 9.8);
  translate([2.2, 21, -3.5]) ball(8);
  translate([2.2, 21, 3.5]) ball(8);
}

module distal_shell() {
  cheeks();
  phalanx();
  drum(4, -outer - 0.8, outer + 0.8, 0.7, 0.7);
}

module distal_pads() pad();

module distal_collision() {
  cheeks();
  drum(4, -outer - 0.8, outer + 0.8);
  hull() {
    phalanx();
    pad();
  }
}
