// Proximal phalanx: fork over the knuckle, body with dorsal cover and palmar pad, tongue
// for the medial joint.
// Frame: <finger>_proximal_link, x along the finger, z along the proximal joint, flexing
// turns towards -y; the medial joint lies at x = 67.8.
use <../../cad/solids.scad>

medial_joint = [67.8, 0, 0];
inner = 11.8;  // half the fork's opening
outer = 15.5;  // half width
body = [20, 55];

module cheek() hull() {
  drum(12, inner, outer, 0, 1.5);
  block([body[0], -12, inner], [body[0] + 8, 13, outer], 1.5);
}

module cheeks() {
  cheek();
  mirror([0, 0, 1]) cheek();
}

module trunk() hull() {
  block([body[0], -13, -outer], [body[0] + 16, 14.5, outer], 5);
  block([body[1] - 12, -11.5, -13], [body[1], 12.5, 13], 4);
}

module tongue() hull() {
  block([body[1] - 6, -9, -9.5], [body[1] + 2, 10, 9.5], 3);
  translate(medial_joint) drum(9.5, -9.8, 9.8, 1, 1);
}

module cover() hull() {
  block([body[0] + 4, 8, -10.5], [body[1] - 5, 16.5, 10.5], 3.5);
  block([body[0] + 8, 8, -7], [body[1] - 10, 18.5, 7], 4);
}

module pad() hull() {
  block([body[0] + 2, -16, -12], [body[1] - 3, -8, 12], 3.5);
  block([body[0] + 6, -17.5, -8], [body[1] - 8, -8, 8], 3.5);
}

module proximal_metal() {
  cheeks();
  trunk();
  tongue();
}

module proximal_shell() cover();

module proximal_pads() pad();

module proximal_collision() {
  cheeks();
  tongue();
  hull() {
    trunk();
    block([body[0] + 3, -17, -12], [body[1] - 4, 18, 12], 4);
  }
}
