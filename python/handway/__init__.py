"""Planning for hand-arm robots: scenes, planners, collision questions and hand bases.

Everything is in metres and radians. A configuration is an array [variables] in the order of
``Scene.variables``; where a function takes a batch, an array [n, variables]. Poses are arrays
[4, 4]: ``X_WL`` takes points of the link L to the world W.

    >>> import handway
    >>> scene = handway.load_scene("scenes/can_on_table.yaml")
    >>> result = scene.planner().plan(scene, seed=1)
    >>> result.path.shape
"""

from ._core import (
    Basis,
    Certificate,
    Connection,
    Emulator,
    FreeJoint,
    InputError,
    Motion,
    Parameter,
    PathCheck,
    Planner,
    PoseGoal,
    Result,
    Scene,
    TaskPlan,
    TaskStage,
    __version__,
    calibrate_camera,
    calibrate_camera_by_points,
    find_pmds,
    load_scene,
    map_recording,
    motion_distance,
    movement_smoothness,
    new_scene,
    planner,
    planners,
    plugins,
    read_basis,
    refused_plugins,
)

__all__ = [
    "Basis",
    "Certificate",
    "Connection",
    "Emulator",
    "FreeJoint",
    "InputError",
    "Motion",
    "Parameter",
    "PathCheck",
    "Planner",
    "PoseGoal",
    "Result",
    "Scene",
    "TaskPlan",
    "TaskStage",
    "__version__",
    "calibrate_camera",
    "calibrate_camera_by_points",
    "find_pmds",
    "load_scene",
    "map_recording",
    "motion_distance",
    "movement_smoothness",
    "new_scene",
    "planner",
    "planners",
    "plugins",
    "read_basis",
    "refused_plugins",
]
