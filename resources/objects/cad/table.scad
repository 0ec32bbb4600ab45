// Table with four legs and an apron. Modelled in millimetres, written in metres; origin
// at the centre of the bottom, on the floor.
top = [1200, 800, 30];
height = 740;
leg = 60;
inset = 40;          // of the legs from the top's edge
apron = [22, 90];    // thickness, height

module leg_at(x, y) translate([x * (top.x / 2 - inset - leg / 2), y * (top.y / 2 - inset - leg / 2), 0])
  hull() {
    translate([-leg / 2, -leg / 2, 300]) cube([leg, leg, height - top.z / 2 - 300]);
    translate([-leg / 3, -leg / 3, 0]) cube([2 * leg / 3, 2 * leg / 3, 1]);
  }

module plate() hull() {
  translate([-top.x / 2, -top.y / 2, height - top.z + 4]) cube([top.x, top.y, top.z - 8]);
  translate([-top.x / 2 + 4, -top.y / 2 + 4, height - top.z]) cube([top.x - 8, top.y - 8, top.z]);
}

module frame() {
  outer = [top.x - 2 * inset - 10, top.y - 2 * inset - 10];
  translate([0, 0, height - top.z - apron.y]) linear_extrude(apron.y + top.z / 2) difference() {
    square(outer, center = true);
    square(outer - 2 * [apron.x, apron.x], center = true);
  }
}

scale(0.001) union() {
  plate();
  frame();
  for (x = [-1, 1], y = [-1, 1]) leg_at(x, y);
}
