// Base of the thumb: arm that swings about the palm's side, ending in the thumb's seat.
// Frame: thumb_base_link, z along the joint and parallel to the fingers; at zero the arm
// points along y.
use <../../cad/solids.scad>
use <knuckle.scad>

hub_radius = 17;
hub = [9.5, 62];  // z

module at_thumb()
  translate([-6, 86.9, 97]) rotate(a = 102.31, v = [0.419, -0.419, 0.805]) children();

module arm() hull() {
  drum(14.5, hub[0] + 4, hub[1] - 4, 3, 3);
  block([-17, 48, 24], [12, 82, 60], 9);
}

module riser() hull() {
  block([-19, 60, 30], [8, 86, 58], 9);
  at_thumb() block([-33, -15, -24], [-22, 15, 12.5], 4);
}

module thumb_base_shell() {
  arm();
  riser();
}

module thumb_base_metal() {
  drum(hub_radius, hub[0], hub[1], 1.5, 1.5);
  drum(8, hub[1] - 1, hub[1] + 2, 0, 1);
  at_thumb() {
    knuckle_block();
    knuckle_ear();
  }
}

module thumb_base_collision() {
  drum(hub_radius, hub[0], hub[1] + 2);
  arm();
  riser();
  at_thumb() {
    knuckle_block();
    knuckle_ear_collision();
  }
}
