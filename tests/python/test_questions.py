import pathlib
import tempfile
import threading
import unittest

import numpy as np

import handway
from cells import ROOT, can_on_table


def motion(scene, count):
    """From start to goal in a straight line, [count, variables]."""
    return np.linspace(scene.start, scene.goal, count)


class Collisions(unittest.TestCase):
    def test_of_a_batch_are_those_of_its_rows(self):
        scene = can_on_table()
        q = np.vstack([motion(scene, 20), scene.configuration({"joint_2": 2.0})])
        answers = scene.collides(q)
        self.assertEqual(answers.shape, (21,))
        self.assertEqual(answers.dtype, np.bool_)
        self.assertEqual(list(answers), [scene.collides(row) for row in q])
        self.assertIs(scene.collides(scene.start), False)
        self.assertTrue(answers[-1])

    def test_name_the_pairs_that_touch(self):
        scene = can_on_table()
        q = scene.configuration({"joint_2": 2.0})
        pairs = scene.collisions(q)
        self.assertTrue(any("table" in pair for pair in pairs), pairs)
        self.assertEqual(scene.clearance(q), 0.0)
        self.assertEqual(scene.collisions(scene.start), [])

    def test_know_constraints(self):
        text = (ROOT / "scenes" / "can_on_table.yaml").read_text()
        text += "constraints:\n  - {name: level, body: palm, upright: {angle_deg: 1}}\n"
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "level.yaml"
            file.write_text(text)
            scene = handway.load_scene(file)
        self.assertIs(scene.collides(scene.start), True)
        self.assertEqual(scene.collisions(scene.start), [])
        (violated,) = scene.violations(scene.start)
        self.assertIn("constraint level: the axis of palm is ", violated)
        self.assertEqual(can_on_table().violations(scene.start), [])

    def test_are_asked_by_threads_at_once(self):
        scene = can_on_table()
        q = motion(scene, 100)
        expected = scene.clearance(q)
        answers = [None] * 3

        def ask(i):
            answers[i] = scene.clearance(q)

        threads = [threading.Thread(target=ask, args=(i,)) for i in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for answer in answers:
            np.testing.assert_array_equal(answer, expected)


class Clearance(unittest.TestCase):
    def test_is_that_of_the_closest_pair(self):
        scene = can_on_table()
        a, b, distance = scene.closest_pair(scene.goal)
        self.assertNotEqual(a, b)
        self.assertGreater(distance, 0.0)
        self.assertEqual(distance, scene.clearance(scene.goal))

    def test_is_cut_at_what_is_enough(self):
        scene = can_on_table()
        q = motion(scene, 10)
        full = scene.clearance(q)
        self.assertEqual(full.shape, (10,))
        enough = float(np.median(full))
        np.testing.assert_allclose(scene.clearance(q, enough=enough), np.minimum(full, enough))

    def test_of_no_configurations_is_empty(self):
        scene = can_on_table()
        self.assertEqual(scene.clearance(np.empty((0, 19))).shape, (0,))
        self.assertEqual(scene.collides(np.empty((0, 19))).shape, (0,))


class LinkPoses(unittest.TestCase):
    def test_are_rigid_and_in_the_world(self):
        scene = can_on_table()
        base = scene.link_pose(scene.links[0], scene.start)
        np.testing.assert_allclose(base[:3, 3], [0, 0, 0.4])
        X_WL = scene.link_pose(scene.links[-1], motion(scene, 5))
        self.assertEqual(X_WL.shape, (5, 4, 4))
        for X in X_WL:
            np.testing.assert_allclose(X[:3, :3] @ X[:3, :3].T, np.eye(3), atol=1e-12)
            np.testing.assert_array_equal(X[3], [0, 0, 0, 1])

    def test_turn_with_the_first_joint(self):
        scene = can_on_table()
        link = scene.links[-1]
        turned = scene.configuration({"joint_1": scene.start[0] + 0.3}, others=scene.start)
        c, s = np.cos(0.3), np.sin(0.3)
        R = np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        np.testing.assert_allclose(
            scene.link_pose(link, turned), R @ scene.link_pose(link, scene.start), atol=1e-12
        )

    def test_of_unknown_links_are_input_errors(self):
        scene = can_on_table()
        with self.assertRaisesRegex(handway.InputError, "elbow_of_mine"):
            scene.link_pose("elbow_of_mine", scene.start)


class WrongConfigurations(unittest.TestCase):
    def test_name_shapes(self):
        scene = can_on_table()
        for q in (np.zeros(18), np.zeros((2, 20)), np.zeros((1, 1, 19)), 3.0):
            with self.assertRaisesRegex(handway.InputError, r"q: found shape \["):
                scene.collides(q)

    def test_name_the_entry_that_is_no_number(self):
        scene = can_on_table()
        q = motion(scene, 3)
        q[1, 4] = np.nan
        with self.assertRaisesRegex(handway.InputError, r"q\[1\]: entry 4: found nan"):
            scene.clearance(q)

    def test_may_be_out_of_limits(self):
        scene = can_on_table()
        q = np.vstack([scene.start, scene.upper + 0.1])
        self.assertEqual(list(scene.within_limits(q)), [True, False])
        self.assertIs(scene.within_limits(scene.goal), True)


if __name__ == "__main__":
    unittest.main()
