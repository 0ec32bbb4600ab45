// Knuckle of a finger: turns sideways in its seat and carries the proximal phalanx.
// Frame: <finger>_abduction_link, z along the abduction joint, y along the proximal joint.
use <../../cad/solids.scad>

barrel_radius = 14.5;
barrel_half = 11;
trunnion_radius = 9;

module barrel() along_y() drum(barrel_radius, -barrel_half, barrel_half, 2.5, 2.5);

module trunnion() drum(trunnion_radius, -17, 16, 0, 2);

module abduction_metal() {
  barrel();
  trunnion();
  along_y() drum(6, -16.5, 16.5, 1, 1);
}

module abduction_collision() {
  barrel();
  trunnion();
  along_y() drum(6, -16.5, 16.5);
}
