import unittest

import numpy as np

import handway
from cells import can_on_table


class Bases(unittest.TestCase):
    def setUp(self):
        self.basis = handway.read_basis("sah_auro")
        self.joints = len(self.basis.joints)

    def test_are_those_of_their_scenes(self):
        basis = can_on_table().basis
        self.assertEqual(basis.source, self.basis.source)
        np.testing.assert_array_equal(basis.mean, self.basis.mean)
        self.assertEqual(basis.joints, can_on_table().hand)

    def test_have_unit_directions(self):
        count = len(self.basis.names)
        self.assertEqual(self.basis.mean.shape, (self.joints,))
        self.assertEqual(self.basis.directions.shape, (count, self.joints))
        self.assertEqual(self.basis.half_sides.shape, (count,))
        self.assertEqual(self.basis.variances.shape, (count,))
        self.assertEqual(self.basis.dimension, count + len(self.basis.free_joints))
        np.testing.assert_allclose(np.linalg.norm(self.basis.directions, axis=1), 1, atol=0.01)
        self.assertTrue(np.all(self.basis.half_sides > 0))

    def test_map_their_middle_to_the_mean(self):
        middle = self.basis.posture(np.full(self.basis.dimension, 0.5))
        expected = self.basis.mean.copy()
        for free in self.basis.free_joints:
            expected[free.joint] = free.centre
        np.testing.assert_allclose(middle, expected, atol=1e-12)

    def test_map_batches_row_by_row(self):
        u = np.random.default_rng(1).random((7, self.basis.dimension))
        postures = self.basis.posture(u)
        self.assertEqual(postures.shape, (7, self.joints))
        self.assertTrue(np.all((postures >= 0) & (postures <= 1)))
        for row, posture in zip(u, postures):
            np.testing.assert_array_equal(self.basis.posture(row), posture)

    def test_find_the_coordinates_again(self):
        step = 0.1 * self.basis.half_sides[0]
        posture = self.basis.mean + step * self.basis.directions[0]
        coordinates = self.basis.coordinates(posture)
        first = len(self.basis.free_joints)
        self.assertAlmostEqual(coordinates[first], step, delta=0.02 * step)
        self.assertAlmostEqual(self.basis.distance(posture), 0.0, places=9)
        self.assertEqual(self.basis.distance(np.zeros((3, self.joints))).shape, (3,))

    def test_that_are_not_there_are_input_errors(self):
        with self.assertRaisesRegex(handway.InputError, "sah_aura"):
            handway.read_basis("sah_aura")
        with self.assertRaisesRegex(handway.InputError, "shape"):
            self.basis.posture(np.zeros(self.basis.dimension + 1))


if __name__ == "__main__":
    unittest.main()
