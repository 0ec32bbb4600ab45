import pathlib
import tempfile
import unittest

import numpy as np

import handway
from cells import ROOT, can_on_table


class Scenes(unittest.TestCase):
    def test_say_what_they_hold(self):
        scene = can_on_table()
        self.assertEqual(scene.name, "Can on a table")
        self.assertEqual(scene.robot, "tx90_sah")
        self.assertEqual(len(scene.variables), 19)
        self.assertEqual(scene.variables[0], "joint_1")
        self.assertEqual(scene.objects, ["pedestal", "table", "can"])
        self.assertEqual(len(scene.arm), 6)
        self.assertEqual(len(scene.hand), 13)
        self.assertEqual(scene.start.shape, (19,))
        self.assertAlmostEqual(scene.goal[0], 0.2366)
        self.assertTrue(np.all(scene.lower < scene.upper))

    def test_make_configurations_from_names(self):
        scene = can_on_table()
        q = scene.configuration({"joint_2": 0.5}, others=scene.goal)
        self.assertEqual(q[1], 0.5)
        np.testing.assert_array_equal(np.delete(q, 1), np.delete(scene.goal, 1))
        with self.assertRaisesRegex(handway.InputError, "joint_77"):
            scene.configuration({"joint_77": 0.5})

    def test_take_another_basis(self):
        scene = handway.load_scene(ROOT / "scenes" / "can_on_table.yaml", basis="sah_free_hand")
        self.assertNotEqual(scene.basis.source, can_on_table().basis.source)

    def test_without_start_or_goal_answer_questions(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "bare.yaml"
            file.write_text("handway: 1\nrobots:\n  - {name: arm, model: tx90}\n")
            scene = handway.load_scene(file)
        self.assertIsNone(scene.start)
        self.assertIsNone(scene.basis)
        stretched = np.zeros(6)
        self.assertFalse(scene.collides(stretched))
        planner = handway.planner("rrt-connect")
        with self.assertRaisesRegex(handway.InputError, "goal"):
            planner.plan(scene)
        result = planner.plan(scene, start=stretched, goal=scene.configuration({"joint_1": 0.5}))
        self.assertTrue(result.solved, result.reason)

    def test_that_can_not_be_read_are_input_errors(self):
        with self.assertRaises(handway.InputError) as caught:
            handway.load_scene(ROOT / "scenes" / "none.yaml")
        self.assertIn("none.yaml", str(caught.exception))
        self.assertIn("none.yaml", caught.exception.source)
        self.assertIsInstance(caught.exception, ValueError)

    def test_name_the_line_that_is_wrong(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "wrong.yaml"
            file.write_text("handway: 1\nrobots:\n  - {name: arm, modle: tx90}\n")
            with self.assertRaisesRegex(handway.InputError, r"wrong\.yaml:3"):
                handway.load_scene(file)


class Plugins(unittest.TestCase):
    def test_are_found_beside_the_libraries(self):
        self.assertIn("import_kautham", handway.plugins())
        self.assertEqual(handway.refused_plugins(), {})


if __name__ == "__main__":
    unittest.main()
