// Wrist of the TX90: hub in the forearm's fork, neck out to the flange.
// Frame: wrist_link, joint 5 along y through the origin, joint 6 along z.
use <../../cad/solids.scad>

top = 90;
half_width = 32;

module hub() along_y() drum(37, -half_width, half_width, 4, 4);

module neck() hull() {
  along_y() drum(30, -half_width, half_width, 4, 4);
  translate([0, 0, 56]) drum(38, 0, 10);
}

module collar() drum(39, 62, top - 4, 2, 0);

module wrist_casing() {
  hub();
  neck();
  collar();
}

module wrist_covers() {
  drum(36, top - 8, top);
  along_y() drum(24, -half_width - 1, half_width + 1);
}

module wrist_collision() {
  along_y() drum(37, -half_width - 1, half_width + 1);
  neck();
  drum(39, 62, top);
}
