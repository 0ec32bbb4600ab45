import unittest

import numpy as np

import handway
from cells import can_on_table


def beside(scene, q):
    """Where the palm is in q, 5 cm to the side."""
    X = scene.link_pose("palm", q)
    X[1, 3] += 0.05
    return X


class InverseKinematics(unittest.TestCase):
    def test_brings_the_palm_to_a_pose(self):
        scene = can_on_table()
        X = beside(scene, scene.start)
        q = scene.inverse_kinematics("palm", X, near=scene.start, most=4)
        self.assertGreaterEqual(len(q), 1)
        np.testing.assert_allclose(scene.link_pose("palm", q), [X] * len(q), atol=1e-5)
        self.assertTrue(scene.within_limits(q).all())
        self.assertFalse(scene.collides(q).any())
        hand = [scene.variables.index(name) for name in scene.hand]
        np.testing.assert_array_equal(q[:, hand], [scene.start[hand]] * len(q))
        distances = np.linalg.norm(q - scene.start, axis=1)
        self.assertTrue((np.diff(distances) >= 0).all())

    def test_gives_nothing_out_of_reach(self):
        scene = can_on_table()
        X = np.eye(4)
        X[0, 3] = 5.0
        self.assertEqual(scene.inverse_kinematics("palm", X).shape, (0, len(scene.variables)))

    def test_names_what_is_wrong(self):
        scene = can_on_table()
        with self.assertRaisesRegex(handway.InputError, "Did you mean"):
            scene.inverse_kinematics("plm", np.eye(4))
        with self.assertRaisesRegex(handway.InputError, "rigid"):
            scene.inverse_kinematics("palm", 2 * np.eye(4))
        with self.assertRaisesRegex(handway.InputError, r"\[4, 4\]"):
            scene.inverse_kinematics("palm", np.eye(3))


class Jacobian(unittest.TestCase):
    def test_is_the_derivative_of_the_position(self):
        scene = can_on_table()
        q = np.array(scene.start)
        J = scene.jacobian("palm", q)
        self.assertEqual(J.shape, (6, len(q)))
        step = 1e-6 * np.eye(len(q))
        ahead = scene.link_pose("palm", q + step)[:, :3, 3]
        behind = scene.link_pose("palm", q - step)[:, :3, 3]
        np.testing.assert_allclose(J[:3].T, (ahead - behind) / 2e-6, atol=1e-8)

    def test_gives_the_manipulability(self):
        scene = can_on_table()
        q = np.vstack([scene.start, scene.goal])
        values = scene.manipulability("palm", q)
        self.assertEqual(values.shape, (2,))
        J = scene.jacobian("palm", scene.goal)[:3]
        self.assertAlmostEqual(values[1], np.sqrt(np.linalg.det(J @ J.T)), 9)


class PoseGoals(unittest.TestCase):
    def test_are_planned_to(self):
        scene = can_on_table()
        goals = [
            handway.PoseGoal("palm", beside(scene, scene.start) + 5.0 * np.eye(4, k=3)),
            handway.PoseGoal("palm", beside(scene, scene.start), position_tolerance=1e-3),
        ]
        result = scene.planner().plan(scene, goal_pose=goals)
        self.assertTrue(result.solved, result.reason)
        self.assertEqual(result.goal_pose, 1)
        end = scene.link_pose("palm", result.path[-1])
        np.testing.assert_allclose(end, goals[1].X_WG, atol=1e-5)
        self.assertTrue(scene.check(result.path, goal_pose=goals).valid)
        self.assertFalse(scene.check(result.path).valid)

    def test_that_can_not_be_reached_are_said_to_be(self):
        scene = can_on_table()
        X = np.eye(4)
        X[0, 3] = 5.0
        result = scene.planner().plan(scene, goal_pose=handway.PoseGoal("palm", X))
        self.assertFalse(result.solved)
        self.assertIn("The goal is out of reach", result.reason)
        self.assertIsNone(result.goal_pose)

    def test_keep_what_they_are_made_of(self):
        goal = handway.PoseGoal("palm", np.eye(4), rotation_tolerance=[0, 0, np.pi])
        self.assertEqual(goal.link, "palm")
        np.testing.assert_array_equal(goal.X_LT, np.eye(4))
        np.testing.assert_array_equal(goal.rotation_tolerance, [0, 0, np.pi])
        self.assertEqual(can_on_table().goal_poses, [])
        for bad in (-1.0, [1.0, 2.0]):
            with self.assertRaises(handway.InputError):
                handway.PoseGoal("palm", np.eye(4), position_tolerance=bad)


if __name__ == "__main__":
    unittest.main()
