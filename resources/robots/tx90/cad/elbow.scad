// Elbow of the TX90: round casing between upper arm (at +y) and forearm (above).
// Frame: elbow_link, joint 3 along y through the origin, joint 4 along z.
use <../../cad/solids.scad>

face = 109;    // towards the upper arm
top = 158;     // towards the forearm
cap_normal = [0, -0.78, -0.5];
cap_centre = [0, 14, -40];
cap_distance = 91;

module on_cap() translate(cap_centre) towards(cap_normal) children();

module casing() hull() {
  along_y() drum(97, 50, face - 8, 0, 12);
  ball_at([0, 22, -42], 98);
  on_cap() drum(70, 0, cap_distance, 0, 8);
  drum(73, 0, 128);
}

module elbow_casing() {
  casing();
  drum(73, 100, top - 6);
}

module neck() along_y() drum(88, face - 12, face);

module elbow_covers() {
  neck();
  drum(69, top - 10, top);
  on_cap() drum(58, cap_distance - 6, cap_distance + 3, 0, 3);
}

module elbow_collision() {
  casing();
  drum(73, 100, top);
  neck();
  on_cap() drum(58, cap_distance - 6, cap_distance + 3);
}
