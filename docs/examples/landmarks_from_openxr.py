#!/usr/bin/env python3
"""Sends a headset's hand to Handway: OpenXR's 26 hand joints as 21 landmarks.

landmarks() takes the joints of XR_EXT_hand_tracking in their order, as xrLocateHandJointsEXT gives
them in any language (each with .pose.position.x, .y, .z and .location_flags); send() sends a line.
With pyopenxr, once a frame:

    joints = locate_hand_joints_ext(tracker, locate_info).joint_locations
    send(landmarks(joints), "right")
"""
import json, socket, time

# The wrist, then of each finger its joints; of the four fingers without the metacarpal's base.
ORDER = [1] + [2, 3, 4, 5] + [first + i for first in (7, 12, 17, 22) for i in range(4)]
POSITION_VALID = 2  # XR_SPACE_LOCATION_POSITION_VALID_BIT

out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)


def landmarks(joints):
    """21 points in m, or none if the headset does not see all of the hand."""
    points = [joints[i] for i in ORDER]
    if not all(int(p.location_flags) & POSITION_VALID for p in points):
        return []
    return [[p.pose.position.x, p.pose.position.y, p.pose.position.z] for p in points]


def send(points, hand, address=("localhost", 5006)):
    line = {"time": time.monotonic(), "hand": hand, "landmarks": points}
    out.sendto(json.dumps(line).encode(), address)
