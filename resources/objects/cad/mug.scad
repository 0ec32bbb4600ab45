// Mug with a handle towards +x. Modelled in millimetres, written in metres; origin at
// the centre of the bottom.
radius = 41;
height = 95;
wall = 4;
floor = 6;

handle_height = 50;   // centre of the handle
handle_radius = 26;   // of the handle's middle line
handle_section = 5.5; // half its thickness

module body() rotate_extrude($fn = 72) polygon([
  [0, 1.5], [30, 1.5], [32, 0], [35, 0], [39, 2], [radius, 6], [radius, height - 1.5],
  [radius - 1, height - 0.3], [radius - wall / 2, height], [radius - wall + 1, height - 0.3],
  [radius - wall, height - 1.5], [radius - wall, floor + 8], [radius - wall - 3, floor + 2],
  [radius - wall - 9, floor], [0, floor]]);

module handle() translate([radius - 5, 0, handle_height]) rotate([90, 0, 0])
  rotate_extrude($fn = 48) translate([handle_radius, 0]) scale([0.8, 1.25])
    circle(handle_section, $fn = 20);

module outside() difference() {
  translate([0, -50, -10]) cube([100, 100, 120]);
  translate([0, 0, -20]) cylinder(r = radius - wall / 2, h = 140, $fn = 72);
}

scale(0.001) union() {
  body();
  intersection() {
    handle();
    outside();
  }
}
