// Desk: a top on a side panel (-x) and a pedestal of three drawers (+x), with a modesty
// panel behind (+y). Modelled in millimetres, written in metres; origin at the centre of
// the bottom, on the floor.
top = [1600, 800, 28];
height = 730;
panel = 25;
pedestal = [420, 700];
drawers = 3;
gap = 6;             // around the drawer fronts
overlap = 10;        // of joined parts

under = height - top.z;

module plate() translate([-top.x / 2, -top.y / 2, under]) cube(top);

module side_panel() translate([-top.x / 2 + 40, -350, 0]) cube([panel, 700, under + overlap]);

module modesty_panel() translate([-top.x / 2 + 40 + panel / 2, 300, 250])
  cube([top.x - 200, 18, under - 250 + overlap]);

module cabinet() {
  front = -pedestal.y / 2;
  pitch = (under - 60) / drawers;
  translate([top.x / 2 - 40 - pedestal.x, 0, 0]) {
    translate([0, front, 50]) cube([pedestal.x, pedestal.y, under - 50 + overlap]);
    translate([20, front + 40, 0]) cube([pedestal.x - 40, pedestal.y - 80, 50 + overlap]);
    for (i = [0 : drawers - 1]) translate([0, front, 50 + i * pitch]) {
      translate([gap, -16, gap]) cube([pedestal.x - 2 * gap, 16 + overlap, pitch - 2 * gap]);
      translate([pedestal.x / 2 - 70, -34, pitch - 50]) grip();
    }
  }
}

module grip() {
  for (x = [0, 128]) translate([x, 0, 0]) cube([12, 34, 12]);
  cube([140, 10, 12]);
}

scale(0.001) union() {
  plate();
  side_panel();
  modesty_panel();
  cabinet();
}
