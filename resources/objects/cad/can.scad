// Drinks can of 330 ml with rims and a drawn-in bottom. Modelled in millimetres,
// written in metres; origin at the centre of the bottom.
radius = 33;
height = 115;

rim = 27;          // radius of the top rim
stand = 24;        // radius of the ring that it stands on

scale(0.001) rotate_extrude($fn = 64) polygon([
  [0, 9], [12, 7], [20, 3], [stand - 1, 0.4], [stand, 0], [stand + 1.5, 0.4],   // bottom
  [28, 4], [31.5, 8], [radius, 13], [radius, 99], [31.5, 104.5], [28.5, 109],   // wall and neck
  [26.4, 112], [rim - 0.4, 112.4], [rim, 113.2], [rim, height - 0.6], [rim - 0.6, height],  // rim
  [rim - 1.6, height], [rim - 2, height - 0.6], [rim - 2.6, 109.5], [rim - 4, 109], [0, 109]]);
