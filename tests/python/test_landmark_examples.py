"""The senders of hand landmarks in docs/examples, against fakes of the libraries that they need."""

import importlib.util
import json
import pathlib
import socket
import sys
import types
import unittest
from unittest import mock

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "docs" / "examples"


def point(x, y, z):
    return types.SimpleNamespace(x=x, y=y, z=z)


def run(name, modules, arguments):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    with mock.patch.dict(sys.modules, modules), mock.patch.object(sys, "argv", [name, *arguments]):
        spec.loader.exec_module(module)
    return module


def receiver():
    listener = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    listener.bind(("localhost", 0))
    listener.settimeout(5.0)
    return listener


def line_of(listener):
    return json.loads(listener.recv(65536))


class FakeLandmarker:
    """Sees a right hand, then none."""

    def __init__(self):
        self.results = [
            types.SimpleNamespace(
                hand_world_landmarks=[[point(0.01 * i, 0.0, 0.02) for i in range(21)]],
                handedness=[[types.SimpleNamespace(category_name="Right")]],
            ),
            types.SimpleNamespace(hand_world_landmarks=[], handedness=[]),
        ]

    def __enter__(self):
        return self

    def __exit__(self, *ignored):
        pass

    def detect_for_video(self, image, milliseconds):
        assert isinstance(milliseconds, int)
        return self.results.pop(0)


def fake_mediapipe():
    vision = types.SimpleNamespace(
        RunningMode=types.SimpleNamespace(VIDEO="video"),
        HandLandmarkerOptions=lambda **options: options,
        HandLandmarker=types.SimpleNamespace(
            create_from_options=lambda options: FakeLandmarker()
        ),
    )
    tasks = types.SimpleNamespace(vision=vision, BaseOptions=lambda **options: options)
    formats = types.SimpleNamespace(SRGB="srgb")
    return types.SimpleNamespace(tasks=tasks, Image=lambda *of: of, ImageFormat=formats)


def fake_camera():
    frames = [(True, "frame"), (True, "frame"), (False, None)]
    camera = types.SimpleNamespace(isOpened=lambda: True, read=lambda: frames.pop(0))
    return types.SimpleNamespace(
        VideoCapture=lambda number: camera, cvtColor=lambda frame, code: frame, COLOR_BGR2RGB=4
    )


class LandmarkExamples(unittest.TestCase):
    def test_mediapipe_sends_what_the_camera_sees(self):
        for swap, hand in ([], "right"), (["--swap"], "left"):
            with receiver() as listener:
                port = str(listener.getsockname()[1])
                modules = {"mediapipe": fake_mediapipe(), "cv2": fake_camera()}
                run("landmarks_from_mediapipe", modules, [port, *swap])
                first, second = line_of(listener), line_of(listener)
            self.assertEqual(first["hand"], hand)
            self.assertEqual(first["landmarks"], [[0.01 * i, 0.0, 0.02] for i in range(21)])
            self.assertLessEqual(first["time"], second["time"])
            self.assertEqual(second["landmarks"], [])

    def test_openxr_sends_21_of_26_joints(self):
        example = run("landmarks_from_openxr", {}, [])
        joints = [
            types.SimpleNamespace(
                pose=types.SimpleNamespace(position=point(i, 0.0, 0.0)), location_flags=3
            )
            for i in range(26)
        ]
        points = example.landmarks(joints)
        self.assertEqual(
            [p[0] for p in points],
            [1, 2, 3, 4, 5, 7, 8, 9, 10, 12, 13, 14, 15, 17, 18, 19, 20, 22, 23, 24, 25],
        )
        with receiver() as listener:
            example.send(points, "left", listener.getsockname())
            line = line_of(listener)
        self.assertEqual((line["hand"], len(line["landmarks"])), ("left", 21))
        joints[10].location_flags = 0
        self.assertEqual(example.landmarks(joints), [])

    def test_openxr_sends_all_joints_with_the_wrist(self):
        example = run("hand_from_openxr", {}, [])
        turned = types.SimpleNamespace(x=0.0, y=0.6, z=0.0, w=0.8)
        locations = [
            types.SimpleNamespace(
                pose=types.SimpleNamespace(position=point(i, 0.0, 0.0), orientation=turned),
                location_flags=15,
            )
            for i in range(26)
        ]
        with receiver() as listener:
            example.send(example.joints(locations), True, "left", listener.getsockname())
            line = line_of(listener)
        self.assertEqual((line["hand"], line["isActive"], len(line["joints"])), ("left", True, 26))
        self.assertEqual(
            line["joints"][1],
            {"position": [1, 0.0, 0.0], "orientation": [0.0, 0.6, 0.0, 0.8], "flags": 15},
        )


if __name__ == "__main__":
    unittest.main()
