"""Mount a hand on an arm, plan a reach to a can past a bar, check it, and write files for a robot.

    python3 arm_with_hand.py [FOLDER]
"""

import pathlib
import sys

import numpy as np

import handway


def main(folder):
    scene = handway.new_scene("tx90", "arm")
    scene = scene.with_robot("sah_right", "hand", mount="arm", link="flange_link")
    scene = scene.with_objects(
        [
            {
                "name": "table",
                "box": {"size": [0.4, 1.2, 0.05]},
                "pose": {"xyz": [1.2, 0, 0.385]},
            },
            {
                "name": "can",
                "cylinder": {"radius": 0.033, "length": 0.24},
                "pose": {"xyz": [1.11, 0, 0.53]},
            },
        ]
    )
    start = scene.configuration({})
    goal = scene.configuration(
        {"joint_2": 0.7, "joint_3": 1.57, "joint_5": -0.7, "thumb_base": -0.4}
    )
    scene = scene.with_query(start, goal)
    scene.save(folder / "reach.yaml")

    result = scene.planner().plan(scene, seed=1)
    assert result.solved, result.reason
    assert scene.check(result.path).valid

    motion = scene.time(result.path, name="reach", speed=0.5)
    assert motion.cleared, motion.faults
    print(f"{len(result.path)} waypoints, {motion.duration:.2f} s")
    for file in motion.export("ros", folder) + scene.export("gltf", folder):
        print(file)

    # The same reach as a pose of the palm: any configuration will do.
    pose = handway.PoseGoal("palm", scene.link_pose("palm", goal))
    other = scene.planner().plan(scene, goal_pose=pose)
    assert other.solved, other.reason
    print(np.round(other.path[-1][:6], 3))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "."))
