"""Pick an object and place it where it fits: on the first of several supports that works.

    python3 pick_and_place.py [SCENE OBJECT SUPPORT...]
"""

import pathlib
import sys

import handway

SCENE = pathlib.Path(__file__).resolve().parents[2] / "scenes" / "cans_on_desk.yaml"


def main(file, thing, *supports):
    scene = handway.load_scene(file)
    planner = scene.planner()
    for support in supports:  # the next one is the fallback
        steps = [{"pick": thing}, {"place": support}, {"move": "start"}]
        plan = planner.plan_task(scene, steps, grasps=4, threads=2)
        if plan.solved:
            break
        print(f"{support}: {plan.reason}")
    for stage in plan.stages:
        check = stage.scene.check(stage.path)
        print(f"{stage.kind:9} {len(stage.path):3} waypoints, valid: {check.valid}")


if __name__ == "__main__":
    main(*(sys.argv[1:] or [SCENE, "can_left_above", "can_right", "desk"]))
