"""Calibration of cameras."""

import unittest

import handway
import numpy as np


def turn(axis, angle):
    x, y, z = np.asarray(axis) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def pose(axis, angle, xyz):
    X = np.eye(4)
    X[:3, :3] = turn(axis, angle)
    X[:3, 3] = xyz
    return X


CAMERA = pose([1, 2, 3], 0.8, [0.05, 0.01, 0.1])
TARGET = pose([3, -1, 1], 2.0, [0.6, 0.1, 0.0])
AXES = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [0, 1, 1], [1, 0, 1]]
HANDS = np.array([pose(axis, 0.5, [0.5, 0.1 * i, 0.4]) for i, axis in enumerate(AXES)])


class CameraCalibration(unittest.TestCase):
    def test_finds_a_camera_on_the_hand_and_a_fixed_one(self):
        inverse = np.linalg.inv
        seen = {
            "hand": [inverse(CAMERA) @ inverse(hand) @ TARGET for hand in HANDS],
            "fixed": [inverse(CAMERA) @ hand @ TARGET for hand in HANDS],
        }
        for mount, targets in seen.items():
            found = handway.calibrate_camera(HANDS, np.array(targets), mount=mount)
            np.testing.assert_allclose(found["pose"], CAMERA, atol=1e-8)
            np.testing.assert_allclose(found["target"], TARGET, atol=1e-8)
            self.assertLess(found["position_residuals"].max(), 1e-8)
            self.assertEqual(found["angle_residuals"].shape, (6,))
            self.assertEqual(found["outliers"], [])

    def test_finds_a_camera_by_points_and_names_the_wrong_one(self):
        robot = np.array([[0.3, 0, 0], [0.6, 0, 0.1], [0.6, 0.4, 0], [0.3, 0.4, 0.2],
                          [0.4, 0.2, 0.3], [0.5, 0.1, 0.2], [0.5, 0.3, 0.05]])
        camera = (robot - CAMERA[:3, 3]) @ CAMERA[:3, :3]
        camera[4, 0] += 0.05
        found = handway.calibrate_camera_by_points(robot, camera)
        np.testing.assert_allclose(found["pose"], CAMERA, atol=1e-8)
        self.assertEqual(found["outliers"], [4])
        self.assertAlmostEqual(found["position_residuals"][4], 0.05)

    def test_refuses_what_determines_no_camera(self):
        with self.assertRaisesRegex(handway.InputError, "3 or more"):
            handway.calibrate_camera(HANDS[:2], HANDS[:2])
        with self.assertRaisesRegex(handway.InputError, "one for each"):
            handway.calibrate_camera(HANDS, HANDS[:3])
        with self.assertRaisesRegex(handway.InputError, "hand or fixed"):
            handway.calibrate_camera(HANDS, HANDS, mount="head")
        line = np.outer(np.arange(5.0), [0.1, 0.0, 0.0])
        with self.assertRaisesRegex(handway.InputError, "on a line"):
            handway.calibrate_camera_by_points(line, line)


if __name__ == "__main__":
    unittest.main()
