"""Nothing that is handed to the package ends the interpreter."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import handway
import numpy as np
from cells import can_on_table

SECONDS = float(os.environ.get("HANDWAY_FUZZ_SECONDS", "30"))


class OddValues(unittest.TestCase):
    def test_are_answered_or_refused_by_everything(self):
        program = Path(__file__).with_name("odd_values.py")
        for seed in (1, 2):
            with tempfile.NamedTemporaryFile("r", errors="replace") as log:
                run = subprocess.run(
                    [sys.executable, program, str(seed), str(SECONDS / 2), log.name],
                    capture_output=True,
                    text=True,
                    timeout=SECONDS + 120,
                )
                self.assertEqual(run.returncode, 0, f"{log.read()}\n{run.stdout}{run.stderr}")

    def test_instances_without_init_are_refused(self):
        for name in handway.__all__:
            cls = getattr(handway, name)
            if not isinstance(cls, type) or issubclass(cls, Exception):
                continue
            blank = cls.__new__(cls)
            for member in dir(cls):
                if isinstance(vars(cls).get(member), property):
                    with self.assertRaises(TypeError, msg=f"{name}.{member}"):
                        getattr(blank, member)

    def test_complex_numbers_are_refused(self):
        scene = can_on_table()
        q = np.zeros(len(scene.variables), dtype=complex) + 1j
        with self.assertRaises(TypeError):
            scene.collides(q)

    def test_names_with_a_nul_are_refused(self):
        scene = can_on_table()
        path = np.zeros((2, len(scene.variables)))
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(ValueError, "NUL"):
                scene.write_path(path, os.path.join(folder, "a\0b.csv"))
            self.assertEqual(os.listdir(folder), [])

    def test_grasps_are_counted_from_one(self):
        with self.assertRaisesRegex(handway.InputError, "most"):
            can_on_table().grasps("can", most=-1)

    def test_friction_of_grasps_is_above_zero(self):
        for friction in (0.0, -1.0, float("nan"), float("inf")):
            with self.assertRaisesRegex(handway.InputError, "friction"):
                can_on_table().grasps("can", friction=friction)


if __name__ == "__main__":
    unittest.main()
