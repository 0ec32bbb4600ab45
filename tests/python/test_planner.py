import pathlib
import tempfile
import threading
import unittest

import numpy as np

import handway
from cells import can_on_table


class Planners(unittest.TestCase):
    def test_are_listed_with_those_of_plugins(self):
        names = handway.planners()
        self.assertEqual(names[0], handway.planner().name)
        self.assertIn("pmd-prm", names)
        self.assertTrue(any(name.startswith("ompl") for name in names), names)

    def test_that_are_not_there_are_input_errors(self):
        with self.assertRaisesRegex(handway.InputError, "pmd-prm"):
            handway.planner("pmd-pmr")

    def test_say_what_they_can_do(self):
        planner = handway.planner("pmd-prm")
        self.assertTrue(planner.uses_pmds)
        self.assertTrue(planner.deterministic)
        self.assertTrue(planner.description)


class RobotsWithTwoArms(unittest.TestCase):
    def test_move_the_arm_that_an_argument_moves(self):
        text = """handway: 1
robots:
  - {name: left, model: ur5e_class}
  - {name: right, model: ur5e_class, mount: {robot: left, link: base_link, pose: {xyz: [0, -2, 0]}}}
objects:
  - {name: post, cylinder: {radius: 0.04, length: 0.6}, pose: {xyz: [0.45, -1.7, 0.3]}}
  - {name: other post, cylinder: {radius: 0.04, length: 0.6}, pose: {xyz: [-0.45, -2.3, 0.3]}}
start: {joint_2: -1.5, right/joint_2: -0.2}
goal: {joint_1: 0.5}
"""
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "two.yaml"
            file.write_text(text)
            scene = handway.load_scene(file)
        goal = scene.configuration({"right/joint_1": 1.2}, others=scene.start)
        path = handway.planner("rrt-connect").plan(scene, goal=goal, time_limit=60).path
        self.assertGreater(len(path), 2)
        left = [i for i, name in enumerate(scene.variables) if not name.startswith("right/")]
        np.testing.assert_array_equal(path[:, left], np.tile(scene.start[left], (len(path), 1)))


class Parameters(unittest.TestCase):
    def test_describe_themselves(self):
        for name in handway.planners():
            for key, parameter in handway.planner(name).parameters.items():
                self.assertEqual(key, parameter.key)
                self.assertTrue(parameter.help, key)
                if isinstance(parameter.value, str):
                    self.assertIn(parameter.value, parameter.options)
                elif not isinstance(parameter.value, bool):
                    self.assertLessEqual(parameter.lower, parameter.value)
                    self.assertLessEqual(parameter.value, parameter.upper)

    def test_are_set_one_by_one_and_together(self):
        planner = handway.planner("pmd-prm")
        planner["rho_a"] = 0.0123
        self.assertEqual(planner["rho_a"], 0.0123)
        planner.set(rho_a=np.float64(0.1) + 0.2, corridor="cartesian", n_a=7)
        self.assertEqual(planner["rho_a"], 0.1 + 0.2)
        self.assertEqual(planner["corridor"], "cartesian")
        self.assertEqual(planner["n_a"], 7)
        self.assertNotEqual(handway.planner("pmd-prm")["rho_a"], planner["rho_a"])

    def test_may_be_truths(self):
        planner = handway.planner("auto")
        planner["cartesian"] = False
        self.assertIs(planner["cartesian"], False)
        with self.assertRaisesRegex(handway.InputError, "true or false"):
            planner["cartesian"] = 1

    def test_refuse_other_keys_and_values(self):
        planner = handway.planner("pmd-prm")
        with self.assertRaisesRegex(handway.InputError, "rho_b"):
            planner["rho_b"] = 1.0
        before = planner["rho_a"]
        for value in (-1.0, "wide", True, float("nan")):
            with self.assertRaisesRegex(handway.InputError, "rho_a"):
                planner["rho_a"] = value
        self.assertEqual(planner["rho_a"], before)


class Planning(unittest.TestCase):
    def test_finds_a_certified_path_that_a_check_confirms(self):
        scene = can_on_table()
        result = scene.planner().plan(scene, seed=3, time_limit=120)
        self.assertTrue(result.solved, result.reason)
        self.assertEqual(result.status, "solved")
        self.assertEqual(result.seed, 3)
        self.assertEqual(result.path.shape[1], len(scene.variables))
        np.testing.assert_array_equal(result.path[0], scene.start)
        np.testing.assert_array_equal(result.path[-1], scene.goal)
        self.assertGreaterEqual(result.certificate.min_clearance_mm, 0.05)
        self.assertGreater(result.statistics["samples"], 0)
        self.assertGreater(result.statistics["checks"]["edges"], 0)
        self.assertTrue(np.all(scene.within_limits(result.path)))
        check = scene.check(result.path, resolution=0.005)
        self.assertTrue(check.valid, check.faults)
        self.assertGreaterEqual(check.min_clearance_mm, result.certificate.min_clearance_mm)

    def test_gives_the_same_bits_for_any_number_of_threads(self):
        scene = can_on_table()
        one = scene.planner().plan(scene, seed=2, time_limit=120)
        two = scene.planner().plan(scene, seed=2, threads=2, time_limit=120)
        self.assertTrue(one.solved, one.reason)
        np.testing.assert_array_equal(one.path, two.path)

    def test_lets_other_threads_go_on(self):
        scene = can_on_table()
        started = threading.Event()
        results = []

        def plan():
            started.set()
            results.append(scene.planner().plan(scene, time_limit=120))

        thread = threading.Thread(target=plan)
        thread.start()
        started.wait()
        answers = 0
        while thread.is_alive():
            self.assertFalse(scene.collides(scene.start))
            answers += 1
        thread.join()
        self.assertTrue(results[0].solved)
        self.assertGreater(answers, 0)

    def test_tells_a_start_in_collision_from_wrong_input(self):
        scene = can_on_table()
        planner = scene.planner()
        hit = scene.configuration({"joint_2": 2.0})
        result = planner.plan(scene, start=hit)
        self.assertFalse(result.solved)
        self.assertEqual(result.status, "start invalid")
        self.assertEqual(result.path.shape, (0, len(scene.variables)))
        wrongs = ({"goal": np.zeros(3)}, {"threads": 0}, {"time_limit": -1.0}, {"margin": -0.001})
        for wrong in wrongs:
            with self.assertRaisesRegex(handway.InputError, next(iter(wrong))):
                planner.plan(scene, **wrong)

    def test_takes_the_settings_of_a_request_in_si_units(self):
        scene = can_on_table()
        planner = scene.planner()
        hit = scene.configuration({"joint_2": 2.0})
        for good in ({"time_limit": float("inf")}, {"margin": 1.0}, {"resolution": 1e-7}):
            self.assertEqual(planner.plan(scene, start=hit, **good).status, "start invalid")
        with self.assertRaisesRegex(handway.InputError, "from 0 to 1"):
            planner.plan(scene, margin=1.5)
        with self.assertRaisesRegex(TypeError, "threads, time_limit, margin, resolution"):
            planner.plan(scene, patience=60)
        self.assertRegex(planner.plan.__doc__, r"\nmargin: [^(]*\(0\s+to\s+1\s+m;\s+default\s+0\)")


class Paths(unittest.TestCase):
    def test_through_obstacles_are_not_valid(self):
        scene = can_on_table()
        hit = scene.configuration({"joint_2": 2.0})
        check = scene.check([scene.start, hit, scene.goal], resolution=0.05)
        self.assertFalse(check.valid)
        self.assertGreater(check.collisions, 0)
        self.assertTrue(check.faults)

    def test_are_checked_against_the_ends_that_were_asked_for(self):
        scene = can_on_table()
        still = [scene.start, scene.start]
        self.assertFalse(scene.check(still, resolution=0.05).valid)
        self.assertTrue(scene.check(still, resolution=0.05, goal=scene.start).valid)
        with self.assertRaisesRegex(handway.InputError, "path"):
            scene.check(scene.start)

    def test_are_written_and_read_again(self):
        scene = can_on_table()
        path = np.linspace(scene.start, scene.goal, 4)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "path.csv"
            scene.write_path(path, file)
            np.testing.assert_array_equal(scene.read_path(file), path)

    def test_of_some_joints_leave_the_others_at_the_start(self):
        scene = can_on_table()
        moved = scene.variables.index(scene.arm[0])
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "arm.csv"
            file.write_text(f"time,{scene.arm[0]}\n0,0.1\n1,0.2\n")
            with self.assertWarnsRegex(UserWarning, scene.arm[1]):
                path = scene.read_path(file)
        expected = np.tile(scene.start, (2, 1))
        expected[:, moved] = [0.1, 0.2]
        np.testing.assert_array_equal(path, expected)


if __name__ == "__main__":
    unittest.main()
