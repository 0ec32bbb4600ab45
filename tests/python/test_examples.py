"""The examples run to their ends."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

from cells import ROOT

EXAMPLES = ROOT / "python" / "examples"


class Examples(unittest.TestCase):
    def run_example(self, name, *arguments):
        done = subprocess.run(
            [sys.executable, EXAMPLES / name, *arguments], capture_output=True, text=True
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_mount_plan_and_export(self):
        with tempfile.TemporaryDirectory() as folder:
            output = self.run_example("arm_with_hand.py", folder)
            self.assertIn("reach_ros2.yaml", output)
            self.assertTrue((pathlib.Path(folder) / "reach.yaml").is_file())
            self.assertTrue(list(pathlib.Path(folder).glob("*.glb")))

    def test_run_a_motion_on_emulated_devices(self):
        self.assertIn("at the goal: True", self.run_example("emulated_robot.py"))

    def test_pick_and_place_with_a_fallback(self):
        output = self.run_example("pick_and_place.py")
        self.assertIn("can_right: Step 2, place on can_right", output)
        self.assertEqual(output.count("valid: True"), 9)

    def test_find_the_directions_of_postures(self):
        self.run_example("hand_postures.py")


if __name__ == "__main__":
    unittest.main()
