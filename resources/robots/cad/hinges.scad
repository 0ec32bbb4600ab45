// Joints of arms that are built of tubes, shared by their parts. Millimetres; see solids.scad.
use <solids.scad>

// The half of a drum about z with y > 0.
module half_drum(r, z0, z1) intersection() {
  drum(r, z0, z1);
  translate([-2 * r, -$cover, z0 - 2 * $cover]) cube([4 * r, 2 * r, z1 - z0 + 4 * $cover]);
}

// One of two links that lie side by side at a joint about y: a drum of radius r at y > 0 that
// runs out into a tube down z. From `lip` downwards the tube is whole, so that the other link can
// fold against it; it ends at `bottom`.
module hinge(r, width, tube, lip, bottom, edge = 20, gap = 1) {
  hull() {
    translate([0, gap, 0]) along_y() drum(r, 0, width - gap, 0, edge);
    translate([0, gap, 0]) half_drum(tube - gap, bottom + 1, lip);
  }
  drum(tube, bottom, lip, 0, min(edge, 0.9 * (lip - bottom)));
}

// Lid on the drum of a hinge.
module hinge_lid(r, width) along_y() drum(r, width - 4, width + 3, 0, 3);

// Ring between two tubes, above z.
module ring(r, z, height) drum(r, z, z + height);

// The same link the other way up: its tube runs up z.
module upwards() mirror([0, 0, 1]) children();
module left() mirror([0, 1, 0]) children();
