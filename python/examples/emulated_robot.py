"""Plan, time and run a motion on an emulated arm and hand, and measure how well they follow.

    python3 emulated_robot.py [SCENE]
"""

import pathlib
import sys

import numpy as np

import handway

SCENE = pathlib.Path(__file__).resolve().parents[2] / "scenes" / "can_on_table.yaml"


def main(file):
    scene = handway.load_scene(file)
    result = scene.planner().plan(scene, seed=1)
    assert result.solved, result.reason
    motion = scene.time(result.path, speed=0.5)
    assert motion.cleared, motion.faults

    arm, hand = scene.emulate("arm"), scene.emulate("hand")
    with scene.connect(f"{arm.address},{hand.address}") as robot:
        how = robot.run(motion)
        assert how["done"], how["fault"]
        joint = max(how["largest_errors"], key=how["largest_errors"].get)
        print(f"{how['time']:.2f} s, up to {how['largest_errors'][joint]:.4f} rad off ({joint})")
        print("at the goal:", np.allclose(robot.measured, scene.goal, atol=0.01))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else SCENE)
