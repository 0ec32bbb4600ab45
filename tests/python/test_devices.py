"""Devices from Python, against emulated ones, and recordings."""

import pathlib
import tempfile
import threading
import unittest

import numpy as np

import handway
from cells import ROOT


def cell():
    scene = handway.new_scene("tx90", "arm")
    start = scene.configuration({})
    return scene.with_query(start, scene.configuration({"joint_1": 0.4}))


class Devices(unittest.TestCase):
    def test_run_a_motion_to_its_end(self):
        scene = cell()
        emulator = scene.emulate("arm")
        motion = scene.time(scene.planner().plan(scene).path)
        self.assertTrue(motion.cleared, motion.faults)
        with scene.connect(emulator.address) as robot:
            np.testing.assert_allclose(robot.measured, scene.start, atol=1e-3)
            how = robot.run(motion)
            self.assertTrue(how["done"], how)
            self.assertEqual(how["fault"], "")
            self.assertEqual(sorted(how["largest_errors"]), sorted(scene.variables))
            np.testing.assert_allclose(robot.measured, scene.goal, atol=1e-2)
        with self.assertRaisesRegex(handway.InputError, "closed"):
            robot.run(motion)

    def test_stop_from_another_thread(self):
        scene = cell()
        emulator = scene.emulate("arm")
        motion = scene.time(scene.planner().plan(scene).path, speed=0.02)
        with scene.connect(emulator.address) as robot:
            outcome = {}
            runner = threading.Thread(target=lambda: outcome.update(robot.run(motion)))
            runner.start()
            while not emulator.moving:
                self.assertTrue(runner.is_alive(), outcome)
            robot.stop()
            runner.join()
        self.assertFalse(outcome["done"])
        self.assertTrue(outcome["started"])
        self.assertGreaterEqual(emulator.stops, 1)
        self.assertLess(np.abs(emulator.position - scene.goal).min(), 10.0)
        self.assertFalse(np.allclose(emulator.position, scene.goal, atol=1e-3))

    def test_do_not_move_for_what_is_not_cleared_or_elsewhere(self):
        scene = cell()
        emulator = scene.emulate("arm")
        with scene.connect(emulator.address) as robot:
            back = scene.time(np.array([scene.goal, scene.start]))
            with self.assertRaises(handway.InputError):  # the arm stands at the start
                robot.run(back)
            box = {"name": "box", "box": {"size": [5, 5, 0.1]}, "pose": {"xyz": [0, 0, 1.0]}}
            bad = scene.with_objects([box]).time(np.array([scene.start, scene.goal]))
            with self.assertRaisesRegex(handway.InputError, "not cleared"):
                robot.run(bad)
        self.assertFalse(emulator.moving)
        np.testing.assert_allclose(emulator.position, scene.start, atol=1e-9)

    def test_are_refused_by_name(self):
        scene = cell()
        with self.assertRaises(handway.InputError):
            scene.connect("leg://localhost")
        with self.assertRaisesRegex(handway.InputError, "arm or hand"):
            scene.emulate("leg")
        with self.assertRaises(handway.InputError):
            scene.connect("arm://localhost:1")


class Constraints(unittest.TestCase):
    def test_hold_along_paths(self):
        scene = cell()
        upright = {"name": "level", "body": "flange_link", "upright": {"angle_deg": 5}}
        kept = scene.with_constraints([upright])
        self.assertEqual(kept.constraints, ["level"])
        self.assertEqual(scene.constraints, [])
        tilted = scene.configuration({"joint_5": 0.5})
        self.assertTrue(kept.violations(tilted))
        self.assertFalse(scene.violations(tilted))
        self.assertEqual(kept.without_constraint("level").constraints, [])
        with self.assertRaisesRegex(handway.InputError, "flange"):
            scene.with_constraints([{"name": "a", "body": "flange", "upright": {"angle_deg": 5}}])
        with self.assertRaisesRegex(handway.InputError, "level"):
            kept.without_constraint("lever")


class Recordings(unittest.TestCase):
    def test_become_principal_motion_directions(self):
        recording = ROOT / "resources" / "recordings" / "free_hand.csv"
        mapped = handway.map_recording(recording)
        count, joints = mapped["postures"].shape
        self.assertGreater(count, 100)
        self.assertEqual(joints, len(mapped["joints"]))
        self.assertGreaterEqual(mapped["normalised"].min(), 0.0)
        self.assertLessEqual(mapped["normalised"].max(), 1.0)
        basis = handway.find_pmds(
            mapped["normalised"], mapped["joints"], free=["thumb_base"], hand=mapped["hand"]
        )
        self.assertEqual(basis.dimension, 5)
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaises(handway.InputError):
                handway.map_recording(pathlib.Path(folder) / "none.csv")


if __name__ == "__main__":
    unittest.main()
