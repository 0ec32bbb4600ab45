import unittest
from pathlib import Path

import numpy as np

import handway
from cells import can_on_table

PROJECT = Path(__file__).parents[2]


class Smoothness(unittest.TestCase):
    def test_of_a_minimum_jerk_movement_is_known(self):
        t = np.linspace(0, 1, 1001)
        speed = 30 * t**2 * (1 - t) ** 2
        smoothness = handway.movement_smoothness(speed, t[1])
        self.assertAlmostEqual(smoothness["log_dimensionless_jerk"], -np.log(204.8), places=2)
        self.assertAlmostEqual(smoothness["spectral_arc_length"], -1.4, delta=0.05)

    def test_is_none_without_movement(self):
        self.assertIsNone(handway.movement_smoothness(np.zeros(100), 0.01))

    def test_needs_a_period(self):
        with self.assertRaisesRegex(handway.InputError, "period: found 0, expected"):
            handway.movement_smoothness(np.ones(10), 0)


class Distance(unittest.TestCase):
    def test_ignores_pauses(self):
        motion = np.linspace([0, 0], [1, 2], 50)
        self.assertEqual(handway.motion_distance(motion, np.repeat(motion, 2, axis=0)), 0)
        beside = motion + [2, -1]  # perpendicular to the motion
        self.assertAlmostEqual(handway.motion_distance(motion, beside), np.sqrt(5))

    def test_needs_the_same_joints(self):
        with self.assertRaisesRegex(handway.InputError, "b: found 3 joints, expected 2 joints"):
            handway.motion_distance(np.zeros((5, 2)), np.zeros((5, 3)))


class Anthropomorphism(unittest.TestCase):
    def test_is_of_the_hand_of_a_scene(self):
        overlap = can_on_table().anthropomorphism()
        fingers = overlap["fingers"]
        self.assertEqual(
            [f["finger"] for f in fingers], ["thumb", "index", "middle", "ring"]
        )
        mean = sum(f["coverage"] for f in fingers) / 5  # there is no little finger
        self.assertAlmostEqual(overlap["coverage"], mean)
        self.assertTrue(all(0 < f["human_share"] <= 1 for f in fingers))


class Motions(unittest.TestCase):
    def test_are_measured(self):
        scene = can_on_table()
        path = scene.planner().plan(scene, seed=1).path
        measures = scene.measure_motion(path)
        self.assertEqual(measures["motion"].shape, (50, len(scene.variables)))
        self.assertLess(measures["hand"]["spectral_arc_length"], -1)
        self.assertLess(measures["palm"]["log_dimensionless_jerk"], -5.3)
        self.assertGreater(measures["deviation"]["palm_mm"], 0)
        self.assertIsNone(measures["components"], "the basis names no recording")
        self.assertEqual(
            measures["no_components"], "There are no recorded postures of the hand."
        )

    def test_are_compared_with_a_recording(self):
        scene = can_on_table()
        path = scene.planner().plan(scene, seed=1).path
        postures = PROJECT / "resources" / "bases" / "sah_free_hand_postures.csv"
        components = scene.measure_motion(path, postures=postures)["components"]
        self.assertGreater(components["motions"], 100)
        self.assertGreater(components["error_rad"], 0)
        self.assertGreater(components["recorded_95_rad"], components["recorded_median_rad"])
        self.assertIn("synthetic", components["recordings"])

    def test_at_rest_have_no_smoothness(self):
        scene = can_on_table()
        measures = scene.measure_motion([scene.start, scene.start])
        self.assertIsNone(measures["hand"])
        self.assertIsNone(measures["palm"])
        self.assertEqual(measures["deviation"], {"arm": 0, "palm_mm": 0})


if __name__ == "__main__":
    unittest.main()
