// Palm of the SAH: adapter plate, rounded shell, seats of three fingers; open at one
// side for the arm of the thumb's base.
// Frame: palm, z along the fingers, x out of the palm, y towards the thumb; the arm's
// flange ends at z = 0.
use <../../cad/solids.scad>
use <knuckle.scad>

adapter_radius = 39;
adapter_top = 8;
waist = 64;            // above it the palm is whole, below it leaves room for the thumb
shoulder = 124;
thumb_axis = [-3, 27.1, 0];

// Places a child at each finger's abduction joint (figures of the hand's kinematics).
module at_fingers() {
  translate([-4.3, 40.165, 145.43]) rotate(a = 178.5623, v = [0.707, 0.0125, 0.707]) children();
  translate([-4.3, 0, 150.143]) rotate(a = 180, v = [0.707, 0, 0.707]) children();
  translate([-4.3, -40.165, 145.43]) rotate(a = 181.3898, v = [0.707, -0.0121, 0.707]) children();
}

module heel() hull() {
  block([-34, -36, adapter_top - 1], [18, 5, adapter_top + 40], 9);
  block([-38, -55, waist - 20], [20, 6, waist + 8], 11);
}

module back() hull() {
  block([-36, -36, adapter_top - 1], [-24, 36, adapter_top + 40], 5);
  block([-38, -54, waist - 20], [-24, 54, waist + 8], 6);
}

module upper() hull() {
  block([-38, -57, waist + 2], [18, 57, shoulder - 18], 13);
  block([-35, -55, shoulder - 20], [12, 55, shoulder + 2], 8);
}

// Dorsal hump over the drives.
module hump() hull() {
  block([-45, -34, 34], [-30, 34, 104], 7);
  block([-40, -46, 22], [-30, 46, 116], 4);
}

module palm_shell() {
  heel();
  back();
  upper();
  hump();
}

module screw(at) translate(at) along_x() mirror([0, 0, 1]) drum(3.2, 0, 2, 0, 1);

module palm_metal() {
  drum(adapter_radius, 0, adapter_top, 1, 1.5);
  translate(thumb_axis) drum(17, 1, adapter_top + 1, 0, 1);
  at_fingers() {
    knuckle_block();
    knuckle_ear();
  }
  for (y = [-26, 26], z = [42, 96]) screw([-43.2, y, z]);
}

// Soft cushion of the palm's front, tapering towards its rim.
module cushion(low, high) {
  if ($cover > 0) block(low, high);
  else hull() {
    block(low, [high.x - 3, high.y, high.z], 5);
    block(low + [0, 5, 5], high - [0, 5, 5], 5);
  }
}

module upper_pad() cushion([6, -47, 74], [23, 47, 108]);
module heel_pad() cushion([9, -46, 24], [26, 1, 62]);

module palm_pads() {
  upper_pad();
  heel_pad();
}

module palm_collision() {
  drum(adapter_radius, 0, adapter_top);
  heel();
  back();
  upper();
  hump();
  at_fingers() {
    knuckle_block();
    knuckle_ear_collision();
  }
  upper_pad();
  heel_pad();
}
