// Open shelf of three compartments: boards on four posts, without walls. Modelled in
// millimetres, written in metres; origin at the centre of the bottom.
width = 950;
depth = 380;
post = 30;
board = 40;
compartments = 3;
clear = 425;

pitch = clear + board;
height = compartments * pitch + board;

module boards()
  for (i = [0 : compartments]) translate([0, 0, i * pitch]) cube([width, depth, board]);

module posts()
  for (x = [0, width - post], y = [0, depth - post]) translate([x, y, 0]) cube([post, post, height]);

scale(0.001) translate([-width / 2, -depth / 2, 0]) union() {
  boards();
  posts();
}
