import os
import signal
import threading
import time
import unittest

import handway
from cells import can_on_table


def endless_planner():
    """Samples a corridor that is too thin for a way around anything."""
    planner = handway.planner("full-prm")
    planner.set(rho_a=1e-5, rho_max=1e-5, max_samples=100_000_000)
    return planner


class Interruption(unittest.TestCase):
    def test_ends_planning_soon(self):
        scene = can_on_table()
        planner = endless_planner()
        begin = []

        def interrupt():
            time.sleep(0.3)
            begin.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            planner.plan(scene)
        took = time.monotonic() - begin[0]
        thread.join()
        self.assertLess(took, 5.0)

    def test_leaves_a_planner_that_plans_again(self):
        scene = can_on_table()
        planner = endless_planner()
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            planner.plan(scene)
        result = planner.plan(scene, time_limit=0.2)
        self.assertEqual(result.status, "time limit")

    def test_is_not_needed_to_refuse_a_second_run(self):
        scene = can_on_table()
        planner = endless_planner()
        thread = threading.Thread(target=planner.plan, args=(scene,), kwargs={"time_limit": 2.0})
        thread.start()
        time.sleep(0.5)
        with self.assertRaisesRegex(RuntimeError, "running"):
            planner.plan(scene)
        with self.assertRaisesRegex(RuntimeError, "running"):
            planner["n_a"] = 7
        thread.join()


if __name__ == "__main__":
    unittest.main()
