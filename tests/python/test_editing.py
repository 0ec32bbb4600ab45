"""Scenes made from others, timed motions, grasps."""

import os
import pathlib
import tempfile
import unittest
import unittest.mock

import numpy as np

import handway
from cells import ROOT, can_on_table


class Editing(unittest.TestCase):
    def test_leaves_the_scene_that_it_starts_from(self):
        scene = can_on_table()
        box = {"name": "box", "box": {"size": [0.1, 0.1, 0.1]}, "pose": {"xyz": [3, 0, 0]}}
        more = scene.with_objects([box])
        self.assertEqual(more.objects, scene.objects + ["box"])
        self.assertEqual(scene.objects, ["pedestal", "table", "can"])
        self.assertEqual(more.without_object("box").objects, scene.objects)

    def test_gives_xacro_files_arguments(self):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder) / "xacro"
            program.write_text('#!/bin/sh\nsed "s|<xacro[^>]*>||; s|SIDE|${2#side:=}|g" "$1"\n')
            program.chmod(0o700)
            file = pathlib.Path(folder) / "r.xacro"
            file.write_text(
                '<robot name="SIDE_r" xmlns:xacro="http://ros.org/wiki/xacro">\n'
                '<xacro:arg name="side" default="left"/><link name="SIDE_base"/></robot>\n'
            )
            path = {"PATH": f"{folder}:{os.environ['PATH']}"}
            with unittest.mock.patch.dict(os.environ, path):
                scene = handway.load_scene(file, xacro={"side": "right"})
                self.assertEqual(scene.robot, "right_r")
                more = scene.with_robot(file, "other", xacro={"side": True})
                more.save(pathlib.Path(folder) / "scene.yaml")
                again = handway.load_scene(pathlib.Path(folder) / "scene.yaml")
                self.assertEqual(again.robot, "right_r")
                self.assertIn("side: true", (pathlib.Path(folder) / "scene.yaml").read_text())
                self.assertEqual(handway.new_scene(file, xacro={"side": "up"}).robot, "up_r")
                with self.assertRaisesRegex(handway.InputError, "no declaration"):
                    handway.new_scene(file, xacro={"sides": 1})
            with self.assertRaisesRegex(handway.InputError, "no xacro file"):
                handway.load_scene(ROOT / "scenes" / "can_on_table.yaml", xacro={"side": 1})

    def test_adds_points_of_a_camera(self):
        scene = can_on_table()
        x, y = np.meshgrid(np.linspace(2, 3, 200), np.linspace(-0.5, 0.5, 200))
        points = np.stack([x, y, np.full_like(x, 0.3)], axis=-1).reshape(-1, 3)
        seen = scene.with_cloud("scan", points, cell=0.02, radius=0.01)
        self.assertEqual(seen.objects, scene.objects + ["scan"])
        self.assertFalse(seen.collides(scene.start))
        X = np.eye(4)
        X[:3, 3] = scene.link_pose("palm", scene.start)[:3, 3] - [2.5, 0, 0.3]
        self.assertTrue(scene.with_cloud("scan", points, X, robots=True).collides(scene.start))
        self.assertFalse(scene.with_cloud("scan", points, X).collides(scene.start))
        found = scene.with_cloud("scan", points, find_objects=True)
        self.assertEqual(found.objects, scene.objects + ["surface"])
        with self.assertRaisesRegex(handway.InputError, "cell.*0.001 to 1"):
            scene.with_cloud("scan", points, cell=0)
        with self.assertRaisesRegex(handway.InputError, "five times the cell"):
            scene.with_cloud("scan", points, radius=0.06)
        with self.assertRaisesRegex(handway.InputError, "pixels"):
            scene.with_cloud("scan", points, hidden_from=(0, 1, 1, 1))
        with self.assertRaisesRegex(handway.InputError, "taken"):
            scene.with_cloud("can", points)
        with self.assertRaisesRegex(handway.InputError, "no points"):
            scene.with_cloud("scan", np.zeros((0, 3)))

    def test_makes_what_points_hide_solid(self):
        scene = can_on_table()
        u, v = np.meshgrid(np.arange(41), np.arange(41))
        depth = np.where(u > 30, 1.3, 1.0)  # m: a plate, and the floor beside it
        points = np.stack([(u - 20) / 100 * depth, (v - 20) / 100 * depth, depth], axis=-1)
        X = np.diag([1.0, -1.0, -1.0, 1.0])  # a camera that looks down
        X[:3, 3] = [2.5, 0, 1.3]
        seen = scene.with_cloud(
            "scan", points.reshape(-1, 3), X, cell=0.02, hidden_from=(100, 100, 20, 20)
        )
        self.assertEqual(seen.objects, scene.objects + ["scan", "scan hidden"])

    def test_changes_what_collides(self):
        scene = can_on_table()
        self.assertFalse(scene.collides(scene.start))
        X = scene.link_pose("palm", scene.start)
        there = scene.with_object_at("can", X)
        self.assertTrue(there.collides(scene.start))

    def test_keeps_grasps_for_an_object(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "grasps.json"
            file.write_text('[{"pose": [9, 0, 0, 0, 0, 0, 1], "joints": {}}]')
            scene = can_on_table().with_grasps("can", file)
            with self.assertWarnsRegex(UserWarning, "the arm does not get there"):
                self.assertEqual(scene.grasps("can", given=file), [])
            with self.assertRaisesRegex(handway.InputError, "no_such_file"):
                scene.with_grasps("can", "no_such_file.yaml")

    def test_arranges_objects(self):
        scene = can_on_table()
        bricks = [
            {"name": name, "box": {"size": [0.1, 0.1, 0.1]}, "pose": {"xyz": [3, y, 1]}}
            for name, y in (("a", 0), ("b", 0.3), ("c", 1))
        ]
        scene = scene.with_objects(bricks)

        def place(s, name):
            return s.object_pose(name)[:3, 3]

        even = scene.distributed(["a", "b", "c"], axis="y")
        np.testing.assert_allclose(place(even, "b"), [3, 0.5, 1], atol=1e-9)
        level = scene.dropped(["a"])
        np.testing.assert_allclose(place(level, "a")[2], 0.05, atol=1e-9)
        np.testing.assert_allclose(place(level.aligned(["b", "a"], axis="z"), "b")[2], 0.05)
        rows = scene.with_rows(["a"], count=(2, 1, 2), spacing=(0.2, 0, 0.3))
        self.assertEqual(rows.objects[-3:], ["a 2", "a 3", "a 4"])
        np.testing.assert_allclose(place(rows, "a 4"), [3.2, 0, 1.3], atol=1e-9)
        ring = scene.with_circle(["a"], copies=4, centre=(2, 0, 0))
        np.testing.assert_allclose(place(ring, "a 3"), [1, 0, 1], atol=1e-9)
        with self.assertRaisesRegex(handway.InputError, "x, y or z"):
            scene.aligned(["a", "b"], axis="w")
        with self.assertRaisesRegex(handway.InputError, "object"):
            scene.dropped(["d"])

    def test_attaches_where_the_object_is(self):
        scene = can_on_table()
        held = scene.attached(["can"], "palm")
        np.testing.assert_allclose(
            held.object_pose("can")[:2, 3], scene.object_pose("can")[:2, 3], atol=1e-9
        )
        with self.assertRaisesRegex(handway.InputError, "attached"):
            held.dropped(["can"])
        free = held.detached(["can"])
        np.testing.assert_allclose(free.object_pose("can"), held.object_pose("can"), atol=1e-9)
        with self.assertRaisesRegex(handway.InputError, "plam"):
            scene.attached(["can"], "plam")

    def test_refuses_in_words(self):
        scene = can_on_table()
        with self.assertRaisesRegex(handway.InputError, "can"):
            scene.without_object("cam")
        with self.assertRaisesRegex(handway.InputError, "sise"):
            scene.with_objects([{"name": "box", "box": {"sise": [1, 1, 1]}}])
        with self.assertRaisesRegex(handway.InputError, "taken"):
            scene.with_robot("tx90", "can")

    def test_mounts_robots(self):
        scene = handway.new_scene("tx90", "arm")
        whole = scene.with_robot("sah_right", "hand", mount="arm", link="flange_link")
        self.assertEqual(len(whole.variables), 19)
        self.assertEqual(len(whole.hand), 13)
        with self.assertRaisesRegex(handway.InputError, "flange"):
            scene.with_robot("sah_right", "hand", mount="arm", link="flange")

    def test_takes_a_hand_off_and_on(self):
        whole = handway.new_scene("tx90", "arm").with_robot(
            "sah_right", "hand", mount="arm", link="flange_link"
        )
        apart = whole.unmounted("hand")
        self.assertEqual(len(apart.variables), 6)
        again = apart.mounted("hand", mount="arm", link="flange_link")
        self.assertEqual(len(again.variables), 19)

    def test_moves_by_groups_and_robots(self):
        scene = handway.new_scene("ur5e_class", "left")
        X = np.eye(4)
        X[1, 3] = 1.0
        both = scene.with_robot("ur5e_class", "right", X=X)
        self.assertEqual(both.moving, scene.variables)
        alone = both.with_group("right")
        self.assertEqual(len(alone.variables), 12)
        self.assertEqual(alone.moving, [f"right/joint_{i}" for i in range(1, 7)])
        self.assertEqual(len(alone.with_group("left", "right/joint_1").moving), 7)
        goal = alone.configuration({"right/joint_1": 0.4})
        result = alone.planner().plan(alone, start=alone.configuration({}), goal=goal)
        self.assertTrue(result.solved, result.reason)
        with self.assertRaisesRegex(handway.InputError, "moves: arm, left, right"):
            both.with_group("rihgt")

    def test_is_saved_and_read_back(self):
        scene = can_on_table().with_query(goal=can_on_table().start)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "again.yaml"
            scene.save(file)
            again = handway.load_scene(file)
        np.testing.assert_array_equal(again.goal, scene.start)


class Motions(unittest.TestCase):
    def test_are_timed_and_exported(self):
        scene = can_on_table()
        result = scene.planner().plan(scene, seed=1)
        motion = scene.time(result.path, speed=0.5, name="can")
        self.assertTrue(motion.cleared, motion.faults)
        self.assertEqual(motion.positions.shape, (len(motion.times), 19))
        self.assertAlmostEqual(motion.times[-1], motion.duration)
        np.testing.assert_allclose(motion.velocities[-1], 0.0, atol=1e-9)
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(len(motion.export("csv", folder)), 1)
            with self.assertRaises(handway.InputError):
                motion.export("cvs", folder)

    def test_are_timed_by_the_settings_of_the_command_line(self):
        scene = can_on_table()
        path = scene.planner().plan(scene, seed=1).path
        motion = scene.time(path, period=0.02, blend=False)
        self.assertAlmostEqual(motion.times[1] - motion.times[0], 0.02)
        with self.assertRaisesRegex(handway.InputError, "period.*from 0.0001 to 1"):
            scene.time(path, period=2.0)
        with self.assertRaisesRegex(TypeError, "arc_clearance"):
            scene.time(path, velocity=2.0)

    def test_that_hit_something_are_not(self):
        scene = can_on_table()
        motion = scene.time(np.array([scene.start, scene.goal]))
        self.assertFalse(motion.cleared)
        self.assertTrue(motion.faults)
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaises(handway.InputError):
                motion.export("csv", folder)


class Grasps(unittest.TestCase):
    def test_are_free_and_ranked(self):
        scene = can_on_table()
        grasps = scene.grasps("can", most=2, samples=4000)
        self.assertTrue(grasps)
        self.assertFalse(scene.collides(grasps[0]["q"]))
        self.assertGreaterEqual(grasps[0]["fingers"], 2)
        self.assertFalse(scene.collides(grasps[0]["closed"]))
        self.assertGreater(grasps[0]["epsilon"], 0.0)
        self.assertEqual(grasps[0]["doubt"], "")
        self.assertGreater(grasps[0]["holding_force"], 0.0)
        self.assertGreaterEqual(len({contact["finger"] for contact in grasps[0]["contacts"]}), 2)
        self.assertAlmostEqual(float(np.linalg.norm(grasps[0]["contacts"][0]["normal"])), 1.0)
        self.assertEqual(grasps[0]["source"], "")
        self.assertIsNone(scene.grasps("can", most=1, samples=1000, test=0)[0]["hold"])
        try:
            hold = scene.grasps("can", most=1, samples=4000, test=1)[0]["hold"]
        except handway.InputError as error:
            self.assertIn("no plugin that simulates grasps", str(error))  # built without MuJoCo
        else:
            self.assertTrue(hold["held"])
            self.assertEqual(len(hold["directions"]), 6)
            self.assertLess(hold["lift"]["shift"], 0.005)
        slippery = scene.grasps("can", most=1, samples=1000, test=0, friction=0.02)
        self.assertTrue(all(grasp["doubt"] for grasp in slippery))
        with self.assertRaisesRegex(handway.InputError, "cam"):
            scene.grasps("cam")

    def test_are_measured_from_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "grasps.json"
            file.write_text('[{"pose": [9, 0, 0, 0, 0, 0, 1], "joints": {}}]')
            self.assertEqual(can_on_table().grasps("can", given=file), [])
            with self.assertRaisesRegex(handway.InputError, "missing.json"):
                can_on_table().grasps("can", given="missing.json")


if __name__ == "__main__":
    unittest.main()
