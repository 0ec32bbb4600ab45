// Shoulder of the TX90: column that swells into the casing of joint 2.
// Frame: shoulder_link, z along joint 1; joint 2 runs along y through x = 50, z = 0.
use <../../cad/solids.scad>

axis_2 = [50, 0, 0];
bottom = -230;
face = 158;                       // towards the upper arm
cap_normal = [-0.35, -0.72, 0.45];
cap_centre = [18, 0, -4];
cap_distance = 113;

module column() drum(121, bottom + 5, -112);

module on_cap() translate(cap_centre) towards(cap_normal) children();

module casing() hull() {
  translate([0, 0, -130]) drum(121, 0, 20);
  translate(axis_2) along_y() drum(119, 30, face - 8, 0, 14);
  on_cap() drum(86, 0, cap_distance, 0, 10);
  ball_at([16, 0, 0], 112);
}

module shoulder_casing() {
  column();
  casing();
}

module neck() translate(axis_2) along_y() drum(110, face - 12, face);

module shoulder_covers() {
  drum(117, bottom, bottom + 6);
  neck();
  on_cap() drum(72, cap_distance - 6, cap_distance + 3, 0, 3);
}

module shoulder_collision() {
  drum(121, bottom, -112);
  casing();
  neck();
  on_cap() drum(72, cap_distance - 6, cap_distance + 3);
}
