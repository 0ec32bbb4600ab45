// Medial phalanx: fork over the proximal phalanx's tongue, short body with palmar pad,
// tongue for the distal joint.
// Frame: <finger>_medial_link, x along the finger, z along the medial joint, flexing turns
// towards -y; the distal joint lies at x = 30.
use <../../cad/solids.scad>

distal_joint = [30, 0, 0];
inner = 10.4;
outer = 13.5;
body = [12, 21];

module cheek() hull() {
  drum(10.5, inner, outer, 0, 1.5);
  block([body[0], -10, inner], [body[0] + 5, 11, outer], 1.5);
}

module cheeks() {
  cheek();
  mirror([0, 0, 1]) cheek();
}

module trunk() block([body[0], -11, -outer], [body[1], 12.5, outer], 3);

module tongue() hull() {
  block([body[1] - 4, -8, -8], [body[1] + 1, 8.5, 8], 2);
  translate(distal_joint) drum(8, -8.2, 8.2, 1, 1);
}

module pad() block([body[0] + 0.5, -14, -10.5], [body[1] - 0.5, -8, 10.5], 2.5);

module pin() drum(4.5, -outer - 0.8, outer + 0.8, 0.7, 0.7);

module medial_metal() {
  cheeks();
  trunk();
  tongue();
  pin();
}

module medial_pads() pad();

module medial_collision() {
  cheeks();
  tongue();
  pin();
  hull() {
    trunk();
    pad();
  }
}
