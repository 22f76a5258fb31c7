#!/usr/bin/python3
"""A tracker as a program: glovebench run --method exec:"python3 tracker.py" ...

It is a poor one. It takes the most colorful pixels for the glove, puts the hand's origin at the middle of their depth
points, and always answers the same rotation and an open hand. See eval/guides/tracker.md for the messages.
"""
import json
import sys

import numpy as np

LEAST_COLOR = 60  # largest minus smallest of red, green and blue
FARTHEST_MM = 1000


def images_of(frame, ir, rgb):
    depth = np.frombuffer(sys.stdin.buffer.read(frame["depth_bytes"]), "<u2").reshape(ir["height_px"], ir["width_px"])
    color = np.frombuffer(sys.stdin.buffer.read(frame["rgb_bytes"]), np.uint8).reshape(rgb["height_px"], rgb["width_px"], 3)
    return depth, color


def points_of(depth_mm, camera):
    """The points of pixels that have a depth, camera frame, mm."""
    v, u = np.nonzero(depth_mm)
    z = depth_mm[v, u]
    return np.stack([(u - camera["cx_px"]) / camera["fx_px"] * z, (v - camera["cy_px"]) / camera["fy_px"] * z, z], 1)


def glove_points(depth_mm, color, calibration):
    """The points that are near and colorful, camera frame, mm."""
    points = points_of(np.where(depth_mm < FARTHEST_MM, depth_mm, 0), calibration["ir"])
    T = calibration["T_rgb_ir"]
    x, y, z = np.array(T["rotation"]) @ points.T + 1000 * np.array(T["translation_m"])[:, None]
    rgb = calibration["rgb"]
    u = np.rint(rgb["fx_px"] * x / z + rgb["cx_px"]).astype(int)
    v = np.rint(rgb["fy_px"] * y / z + rgb["cy_px"]).astype(int)
    inside = (u >= 0) & (u < rgb["width_px"]) & (v >= 0) & (v < rgb["height_px"])
    seen = color[v[inside], u[inside]].astype(int)
    return points[inside][seen.max(1) - seen.min(1) > LEAST_COLOR]


start = json.loads(sys.stdin.buffer.readline())
assert start["protocol"] == "glovebench-tracker" and start["version"] == 1
calibration = start["calibration"]
while line := sys.stdin.buffer.readline():
    frame = json.loads(line)
    depth, color = images_of(frame, calibration["ir"], calibration["rgb"])
    glove = glove_points(depth * start["depth_unit_mm"], color, calibration)
    answer = {"frame": frame["frame"], "status": "no_hand"}
    if len(glove) >= 150:
        answer = {"frame": frame["frame"], "position_mm": np.median(glove, 0).tolist(),
                  "quaternion_wxyz": [0.7071, -0.7071, 0, 0], "angles_deg": [0] * len(start["angles"])}
    print(json.dumps(answer), flush=True)
