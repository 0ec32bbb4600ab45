// Shelf of four compartments, open in front (-y), with a back panel. Modelled in
// millimetres, written in metres; origin at the centre of the bottom.
width = 1050;
depth = 380;
height = 1900;
side = 40;
board = 40;
back = 12;
compartments = 4;

clear = (height - (compartments + 1) * board) / compartments;

scale(0.001) translate([-width / 2, -depth / 2, 0]) difference() {
  cube([width, depth, height]);
  for (i = [0 : compartments - 1])
    translate([side, -1, board + i * (clear + board)])
      cube([width - 2 * side, depth - back + 1, clear]);
}
