#!/usr/bin/env python3
"""Sends the hand that a webcam sees to Handway: python3 landmarks_from_mediapipe.py [PORT] [--swap]

Needs: pip install mediapipe opencv-python, and MediaPipe's model hand_landmarker.task in this folder.
"""
import json, socket, sys, time
import cv2, mediapipe as mp

port = int(next((a for a in sys.argv[1:] if a.isdigit()), 5006))
hand_names = {"Left": "right", "Right": "left"} if "--swap" in sys.argv else {}
vision = mp.tasks.vision
options = vision.HandLandmarkerOptions(
    base_options=mp.tasks.BaseOptions(model_asset_path="hand_landmarker.task"),
    running_mode=vision.RunningMode.VIDEO, num_hands=1)
out, camera = socket.socket(socket.AF_INET, socket.SOCK_DGRAM), cv2.VideoCapture(0)
with vision.HandLandmarker.create_from_options(options) as landmarker:
    while camera.isOpened() and (frame := camera.read())[0]:
        now = time.monotonic()
        image = mp.Image(mp.ImageFormat.SRGB, cv2.cvtColor(frame[1], cv2.COLOR_BGR2RGB))
        seen = landmarker.detect_for_video(image, int(1000 * now))
        line = {"time": now, "landmarks": []}  # none: no hand is seen
        if seen.hand_world_landmarks:  # in m; the frame must not be mirrored
            name = seen.handedness[0][0].category_name
            line["hand"] = hand_names.get(name, name.lower())
            line["landmarks"] = [[p.x, p.y, p.z] for p in seen.hand_world_landmarks[0]]
        out.sendto(json.dumps(line).encode(), ("localhost", port))
