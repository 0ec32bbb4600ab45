#!/usr/bin/env python3
"""Sends a headset's hand to Handway: OpenXR's 26 hand joints, with the pose of the wrist.

joints() takes the joints of XR_EXT_hand_tracking in their order, as xrLocateHandJointsEXT gives
them in any language; send() sends a line. With pyopenxr, once a frame:

    located = locate_hand_joints_ext(tracker, locate_info)
    send(joints(located.joint_locations), bool(located.is_active), "right")
"""
import json, socket, time

out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)


def joints(locations):
    """Positions in m, orientations, and the bits that tell which of them are valid."""
    return [
        {
            "position": [p.pose.position.x, p.pose.position.y, p.pose.position.z],
            "orientation": [getattr(p.pose.orientation, axis) for axis in "xyzw"],
            "flags": int(p.location_flags),
        }
        for p in locations
    ]


def send(hand_joints, is_active, hand, address=("localhost", 5006)):
    line = {"time": time.monotonic(), "hand": hand, "isActive": is_active, "joints": hand_joints}
    out.sendto(json.dumps(line).encode(), address)
