"""Tasks: pick, place and move, planned as stages with scenes of their own."""

import unittest

import numpy as np

import handway
import cells


class Tasks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = cells.can_on_table()
        steps = [{"pick": "can"}, {"place": "table", "retreat": 0.08}, {"move": "start"}]
        cls.plan = cls.scene.planner().plan_task(cls.scene, steps, threads=2)

    def test_have_a_valid_path_for_each_stage(self):
        self.assertTrue(self.plan.solved, self.plan.reason)
        self.assertEqual(
            [stage.kind for stage in self.plan.stages],
            ["approach", "reach", "close", "lift", "carry", "lower", "open", "retreat", "move"],
        )
        for stage in self.plan.stages:
            self.assertTrue(stage.scene.check(stage.path).valid, stage.kind)
            self.assertLessEqual(stage.deviation, 1e-3)
        np.testing.assert_allclose(self.plan.stages[0].path[0], self.scene.start)
        np.testing.assert_allclose(self.plan.stages[-1].path[-1], self.scene.start)

    def test_carry_the_object_between_close_and_open(self):
        carried = [stage.kind for stage in self.plan.stages if stage.carried == "can"]
        self.assertEqual(carried, ["lift", "carry", "lower"])
        self.assertEqual(self.plan.stages[2].squeezed.shape, self.scene.start.shape)
        self.assertIsNone(self.plan.stages[0].squeezed)

    def test_end_with_the_object_somewhere_else(self):
        moved = self.plan.stages[-1].scene.object_pose("can") - self.scene.object_pose("can")
        self.assertGreater(np.linalg.norm(moved[:2, 3]), 0.01)
        self.assertLess(abs(moved[2, 3]), 1e-3)

    def test_move_along_lines_to_poses_and_to_alternatives(self):
        far = np.eye(4)
        far[0, 3] = 50.0
        steps = [
            {"line": [0, 0, 0.02]},
            {"first_of": [
                [{"move": handway.PoseGoal("palm", far), "in": "can"}],
                [{"line": [0, 0, 0.03], "in": "table"}],
            ]},
        ]
        plan = self.scene.planner().plan_task(self.scene, steps)
        self.assertTrue(plan.solved, plan.reason)
        self.assertEqual([(stage.kind, stage.step) for stage in plan.stages], [("line", 0), ("line", 3)])
        self.assertIn("out of reach", plan.trials[1]["reason"])
        for wrong in ([{"line": [0, 0]}], [{"line": [0, 0, 0]}], [{"first_of": [steps]}]):
            with self.assertRaises(handway.InputError, msg=str(wrong)):
                self.scene.planner().plan_task(self.scene, wrong)

    def test_wait_and_set_outputs(self):
        steps = [
            {"output": "do3", "value": True},
            {"wait": 2.5},
            {"pick": "can", "disabled": True},
            {"first_of": [[{"wait": 1, "disabled": True}], [{"output": "level", "value": 0.5}]]},
        ]
        plan = self.scene.planner().plan_task(self.scene, steps)
        self.assertTrue(plan.solved, plan.reason)
        self.assertEqual([stage.kind for stage in plan.stages], ["output", "wait", "output"])
        self.assertEqual([stage.rest for stage in plan.stages], [0.0, 2.5, 0.0])
        np.testing.assert_allclose(plan.stages[1].path, [self.scene.start, self.scene.start])
        for wrong in (
            {"wait": 0},
            {"wait": 1e6},
            {"wait": float("nan")},
            {"output": "do3"},
            {"output": "", "value": True},
            {"output": "do3", "value": float("inf")},
            {"wait": 1, "in": "table"},
            {"grab": "can", "disabled": True},
        ):
            with self.assertRaises(handway.InputError, msg=str(wrong)):
                self.scene.planner().plan_task(self.scene, [wrong])

    def test_place_in_frames(self):
        place = np.eye(4)
        place[2, 3] = 0.5
        scene = self.scene.with_frame("place", place, on="table")
        parent, pose = scene.frames["place"]
        self.assertEqual(parent, "table")
        np.testing.assert_allclose(pose, place)
        with self.assertRaises(handway.InputError):
            scene.with_frame("can", place)

    def test_say_what_failed(self):
        far = np.eye(4)
        far[0, 3] = 5.0
        plan = self.scene.planner().plan_task(
            self.scene, [{"pick": "can"}, {"place": far}], grasps=1
        )
        self.assertFalse(plan.solved)
        self.assertIn("does not reach", plan.reason)
        self.assertEqual(plan.trials[-1]["kind"], "lower")

    def test_refuse_wrong_steps(self):
        planner = self.scene.planner()
        for steps in (
            [],
            [{}],
            [{"grab": "can"}],
            [{"pick": "cam"}],
            [{"pick": "can", "lower": 1.0}],
            [{"pick": "can", "lift": -1.0}],
            [{"place": "table"}],
            [{"pick": "can"}, {"pick": "can"}],
            [{"move": "nowhere"}],
            [{"move": [1.0, 2.0]}],
        ):
            with self.assertRaises(handway.InputError, msg=steps):
                planner.plan_task(self.scene, steps)
        with self.assertRaises(handway.InputError):
            planner.plan_task(self.scene, [{"pick": "can"}], grasps=0)


if __name__ == "__main__":
    unittest.main()
