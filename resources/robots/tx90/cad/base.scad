// Base of the TX90: conical pedestal on a four-lugged foot, connector panel behind.
// Frame: base_link, z up along joint 1, floor at z = 0.
use <../../cad/solids.scad>

top = 246.5;           // the shoulder turns above
foot_bolt = [96, 96];  // lug centres
lug_radius = 32;

module pedestal() revolve([[0, 0 - $cover], [127 + $cover, 0 - $cover], [128 + $cover, 30],
                           [121 + $cover, top - 6], [117 + $cover, top], [0, top]]);

module lug(side_x, side_y) {
  at = [side_x * foot_bolt.x, side_y * foot_bolt.y, 0];
  hull() {
    translate(at) drum(lug_radius, 0, 26, 0, 6);
    translate(0.55 * at) drum(40, 0, 78, 0, 8);
  }
}

module bolt_head(side_x, side_y)
  translate([side_x * foot_bolt.x, side_y * foot_bolt.y, 25]) drum(10, 0, 9, 0, 2);

module base_casing() {
  pedestal();
  for (x = [-1, 1], y = [-1, 1]) lug(x, y);
}

module panel() block([-131, -62, 66], [-100, 62, 226], 5);

module cable_block() block([-178, -30, 26], [-105, 30, 74], 6);

module base_covers() {
  panel();
  cable_block();
  for (x = [-1, 1], y = [-1, 1]) bolt_head(x, y);
  for (y = [-36 : 24 : 36]) translate([-130, y, 110]) along_x() mirror([0, 0, 1]) drum(9, 0, 12, 0, 2);
  for (y = [-20, 20]) translate([-130, y, 180]) along_x() mirror([0, 0, 1]) drum(12, 0, 8, 0, 2);
}

module base_collision() {
  pedestal();
  for (x = [-1, 1], y = [-1, 1]) {
    lug(x, y);
    bolt_head(x, y);
  }
  block([-142, -62, 66], [-100, 62, 226], 5);
  cable_block();
}
