// Forearm of the TX90: tapering body that turns about joint 4 and ends in a fork.
// Frame: forearm_link, z along joint 4; the fork carries joint 5 (along y) at z = 425.
use <../../cad/solids.scad>

bottom = 161;
axis_5 = [0, 0, 425];
slot_half = 33.5;        // half the fork's opening
slot_bottom = 370;
sweep_radius = 112;      // what the flange sweeps about joint 5 ...
sweep_half = 43;
sweep_angle = 168;       // ... from straight up towards +x

module root() drum(73, bottom, 186, 3, 0);

module body() hull() {
  translate([0, 0, bottom + 22]) drum(73, 0, 12);
  block([-68, -79, 216], [62, 79, 279], 22);
  block([-60, -77, 345], [54, 77, slot_bottom + 12], 16);
}

module cheek() hull() {
  translate(axis_5) along_y() drum(60, slot_half, 75, 3, 10);
  block([-60, slot_half, 345], [54, 77, slot_bottom + 12], 5);
}

// Room for the wrist, and for the flange at the positive limit of joint 5.
module clearance() {
  translate([-100, -slot_half + $cover, slot_bottom + $cover])
    cube([200, 2 * (slot_half - $cover), 200]);
  translate(axis_5) rotate([-90, 0, 0]) translate([0, 0, -sweep_half + $cover])
    linear_extrude(2 * (sweep_half - $cover))
      polygon(concat([[0, 0]],
                     [for (a = [90 : (sweep_angle - 90) / 6 : sweep_angle + 0.1])
                        let (r = sweep_radius / cos((sweep_angle - 90) / 12) - $cover)
                        [r * sin(a), -r * cos(a)]]));
}

module sockets() {
  translate([-62, 0, 290]) along_x() mirror([0, 0, 1]) drum(13, 0, 8, 0, 2);
  translate([-64, 0, 252]) along_x() mirror([0, 0, 1]) drum(9, 0, 14, 0, 2);
}

module lids() mirrored_y() hull() {
  translate(axis_5) along_y() drum(48, 70, 77, 0, 3);
  translate([0, 0, 366]) along_y() drum(42, 70, 80, 0, 3);
}

module forearm_casing() {
  root();
  difference() {
    body();
    clearance();
  }
  difference() {
    mirrored_y() cheek();
    clearance();
  }
}

module forearm_covers() {
  sockets();
  lids();
}

module forearm_collision() {
  root();
  difference() {
    union() {
      body();
      mirrored_y() cheek();
      lids();
    }
    clearance();
  }
  sockets();
}
