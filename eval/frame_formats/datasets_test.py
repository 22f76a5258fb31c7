#!/usr/bin/python3
"""Readers that share no code with the writers read every dataset: datasets_test.py PROGRAM TRAJECTORY.json

They follow the documents of the TUM RGB-D benchmark, of BOP (https://github.com/thodan/bop_toolkit) and those that
dataset_readers.py names. All datasets show the same frames as a recording of fakenect. Only Python's standard library.
"""

import csv
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # beside the sources
from dataset_readers import HEIGHT, WIDTH, Mcap, read_png

FRAMES = 3
TOPICS = {
    "/tf_static": "tf2_msgs/msg/TFMessage",
    "/camera/color/image_raw": "sensor_msgs/msg/Image",
    "/camera/color/camera_info": "sensor_msgs/msg/CameraInfo",
    "/camera/depth/image_rect_raw": "sensor_msgs/msg/Image",
    "/camera/depth/camera_info": "sensor_msgs/msg/CameraInfo",
    "/hand/truth": "geometry_msgs/msg/PoseStamped",
    "/hand/truth/joints": "sensor_msgs/msg/JointState",
    "/hand/truth/markers": "visualization_msgs/msg/MarkerArray",
    "/hand/estimate": "geometry_msgs/msg/PoseStamped",
    "/hand/estimate/joints": "sensor_msgs/msg/JointState",
    "/hand/estimate/markers": "visualization_msgs/msg/MarkerArray",
}


def rotation_of(w, x, y, z):
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def moved(rotation, translation, point):
    return [sum(rotation[i][k] * point[k] for k in range(3)) + translation[i] for i in range(3)]


def pixel_of(camera, point):
    u = math.floor(camera["fx_px"] * point[0] / point[2] + camera["cx_px"] + 0.5)
    v = math.floor(camera["fy_px"] * point[1] / point[2] + camera["cy_px"] + 0.5)
    return v * WIDTH + u if 0 <= u < WIDTH and 0 <= v < HEIGHT else None


class DatasetsTest(unittest.TestCase):
    program = trajectory = None

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        movement = json.loads(pathlib.Path(cls.trajectory).read_text())
        movement["frames"] = movement["frames"][40:40 + FRAMES]
        movement["name"] = "three"
        cls.frames, cls.names = movement["frames"], movement["joint_order"]
        cls.file = cls.folder / "three.json"
        cls.file.write_text(json.dumps(movement))
        for form in ("fakenect", "tum", "bop", "mcap"):
            cls.run_program("render", "--format", form, "-o", cls.folder / form)
        cls.run_program("run", "--database", "DB_open_power", "--mcap", "-o", cls.folder / "run")
        recording = cls.folder / "fakenect"
        cls.calibration = json.loads((recording / "calibration.json").read_text())
        images = (recording / "INDEX.txt").read_text().split()
        cls.colors = [(recording / name).read_bytes()[-3 * WIDTH * HEIGHT:] for name in images if name[0] == "r"]
        raws = [struct.unpack(f"<{WIDTH * HEIGHT}H", (recording / name).read_bytes()[-2 * WIDTH * HEIGHT:])
                for name in images if name[0] == "d"]
        cls.depths = [[345.489 / (1089.41 - raw) if raw <= 1083 else 0 for raw in frame] for frame in raws]

    @classmethod
    def run_program(cls, command, *arguments):
        subprocess.run([cls.program, command, "--trajectory", cls.file, "-q", *arguments], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def pose_in_color_camera(self, frame):
        """Rotation and translation (mm) of the trajectory's pose."""
        T = self.calibration["T_rgb_ir"]
        offset = [1000 * x for x in T["translation_m"]]
        return (times(T["rotation"], rotation_of(*frame["quaternion_wxyz"])),
                moved(T["rotation"], offset, frame["position_mm"]))

    def registered(self, depth):
        T, ir, nearest = self.calibration["T_rgb_ir"], self.calibration["ir"], [0] * (WIDTH * HEIGHT)
        for i, z in enumerate(depth):
            if z == 0:
                continue
            x, y = (i % WIDTH - ir["cx_px"]) / ir["fx_px"], (i // WIDTH - ir["cy_px"]) / ir["fy_px"]
            point = moved(T["rotation"], T["translation_m"], (x * z, y * z, z))
            place = pixel_of(self.calibration["rgb"], point)
            if place is not None and (nearest[place] == 0 or point[2] < nearest[place]):
                nearest[place] = point[2]
        return nearest

    def check_depth(self, steps, steps_per_m, frame):
        """A sample on the border of two pixels may fall into the other one."""
        expected = self.registered(self.depths[frame])
        apart = sum(abs(step - z * steps_per_m) > 0.51 for step, z in zip(steps, expected))
        self.assertLess(apart, WIDTH * HEIGHT / 1000)
        self.assertGreater(sum(step > 0 for step in steps), WIDTH * HEIGHT / 2)

    def check_near(self, found, expected, tolerance):
        self.assertEqual(len(found), len(expected))
        for a, b in zip(found, expected):
            self.assertAlmostEqual(a, b, delta=tolerance)

    def check_hand(self, hand, frame, mask):
        truth = self.frames[frame]
        rotation, translation_mm = self.pose_in_color_camera(truth)
        self.assertEqual((hand["frame"], hand["timestamp_us"]), (frame, truth["timestamp_us"]))
        self.check_near(hand["pose"]["translation_mm"], translation_mm, 1e-3)
        self.check_near(hand["pose"]["rotation"], sum(rotation, []), 1e-5)
        self.check_near([hand["angles_deg"][name] for name in self.names], truth["angles_deg"], 1e-5)
        own = [0, 1, 2, 3, 4] + [base + i for base in (5, 10, 15, 20) for i in range(1, 5)]
        for what in ("mm", "visible"):
            self.assertEqual(len(hand[f"joints_25_{what}"]), 25)
            self.assertEqual(hand[f"joints_21_{what}"], [hand[f"joints_25_{what}"][joint] for joint in own])
        seen = [mask[pixel_of(self.calibration["rgb"], point)]
                for point, visible in zip(hand["joints_25_mm"], hand["joints_25_visible"]) if visible]
        self.assertEqual(set(seen), {255}, "a visible joint lies behind the glove")
        # The origin is midway between wrist and middle MCP (core/README.md).
        middle = [(a + b) / 2 for a, b in zip(hand["joints_25_mm"][0], hand["joints_25_mm"][11])]
        self.check_near(middle, translation_mm, 0.1)

    def check_manifest(self, folder):
        files = json.loads((folder / "manifest.json").read_text())["files"]
        sizes = {str(path.relative_to(folder)): path.stat().st_size for path in folder.rglob("*") if path.is_file()}
        del sizes["manifest.json"]
        self.assertEqual({file["name"]: file["bytes"] for file in files}, sizes)
        readme = (folder / "README.txt").read_text()
        self.assertIn("License:", readme)
        self.assertLessEqual(max(map(len, readme.splitlines())), 80)

    def test_tum(self):
        folder = self.folder / "tum"
        self.check_manifest(folder)
        lines = (folder / "associations.txt").read_text().splitlines()
        poses = [line.split() for line in (folder / "groundtruth.txt").read_text().splitlines() if line[0] != "#"]
        self.assertEqual((len(lines), len(poses)), (FRAMES, FRAMES))
        for f, (line, pose) in enumerate(zip(lines, poses)):
            time, rgb, same, depth = line.split()
            self.assertEqual({time, same, pose[0], pathlib.Path(rgb).stem}, {time})
            self.assertEqual(round(float(time) * 1e6), self.frames[f]["timestamp_us"])
            for name, file in (("rgb", rgb), ("depth", depth)):
                self.assertIn(f"{time} {file}", (folder / f"{name}.txt").read_text().splitlines())
            rotation, translation_mm = self.pose_in_color_camera(self.frames[f])
            self.check_near([1000 * float(x) for x in pose[1:4]], translation_mm, 1e-3)
            x, y, z, w = map(float, pose[4:])
            self.check_near(sum(rotation_of(w, x, y, z), []), sum(rotation, []), 1e-5)
            self.assertEqual(read_png(folder / rgb), self.colors[f])
            self.check_depth(read_png(folder / depth), 5000, f)
            mask, parts = read_png(folder / f"mask/{time}.png"), read_png(folder / f"parts/{time}.png")
            self.assertEqual([value == 255 for value in mask], [0 < value <= 20 for value in parts])
            self.check_hand(json.loads((folder / f"hand/{time}.json").read_text()), f, mask)

    def test_bop(self):
        self.check_manifest(self.folder / "bop")
        scene = self.folder / "bop/test/000000"
        cameras, poses, infos = (json.loads((scene / f"scene_{name}.json").read_text())
                                 for name in ("camera", "gt", "gt_info"))
        self.assertEqual({len(cameras), len(poses), len(infos)}, {FRAMES})
        rgb = self.calibration["rgb"]
        for f in range(FRAMES):
            self.check_near(cameras[str(f)]["cam_K"],
                            [rgb["fx_px"], 0, rgb["cx_px"], 0, rgb["fy_px"], rgb["cy_px"], 0, 0, 1], 1e-5)
            (pose,), (info,) = poses[str(f)], infos[str(f)]
            rotation, translation_mm = self.pose_in_color_camera(self.frames[f])
            self.assertEqual(pose["obj_id"], 1)
            self.check_near(pose["cam_t_m2c"], translation_mm, 1e-3)
            self.check_near(pose["cam_R_m2c"], sum(rotation, []), 1e-5)
            self.assertEqual(read_png(scene / f"rgb/{f:06}.png"), self.colors[f])
            depth = read_png(scene / f"depth/{f:06}.png")
            self.check_depth(depth, 1000 / cameras[str(f)]["depth_scale"], f)
            whole, seen = (read_png(scene / f"{name}/{f:06}_000000.png") for name in ("mask", "mask_visib"))
            self.check_info(info, depth, whole, seen)
            self.check_hand(json.loads((scene / f"hand/{f:06}.json").read_text()), f, seen)

    def check_info(self, info, depth, whole, seen):
        self.assertFalse(any(s and not w for s, w in zip(seen, whole)))
        counts = (sum(w > 0 for w in whole), sum(w > 0 and z > 0 for w, z in zip(whole, depth)), sum(s > 0 for s in seen))
        self.assertEqual((info["px_count_all"], info["px_count_valid"], info["px_count_visib"]), counts)
        self.assertAlmostEqual(info["visib_fract"], counts[2] / counts[0], delta=1e-5)
        for name, mask in (("bbox_obj", whole), ("bbox_visib", seen)):
            places = [i for i, value in enumerate(mask) if value]
            left, right = min(i % WIDTH for i in places), max(i % WIDTH for i in places)
            top, bottom = places[0] // WIDTH, places[-1] // WIDTH
            self.assertEqual(info[name], [left, top, right - left + 1, bottom - top + 1])

    def check_frames(self, mcap):
        self.assertEqual({topic: mcap.schemas[schema][0] for topic, schema, _ in mcap.channels.values()}, TOPICS)
        self.assertIn("License:", mcap.metadata["glovebench"][1]["README"])
        colors, depths = mcap.on("/camera/color/image_raw"), mcap.on("/camera/depth/image_rect_raw")
        self.assertEqual((len(colors), len(depths)), (FRAMES, FRAMES))
        for f, (color, depth) in enumerate(zip(colors, depths)):
            self.assertEqual((color["width"], color["height"], color["encoding"], color["step"]),
                             (WIDTH, HEIGHT, "rgb8", 3 * WIDTH))
            self.assertEqual(bytes(color["data"]), self.colors[f])
            self.assertEqual((depth["encoding"], depth["is_bigendian"], depth["step"]), ("16UC1", 0, 2 * WIDTH))
            steps = struct.unpack(f"<{WIDTH * HEIGHT}H", bytes(depth["data"]))
            self.assertLessEqual(max(abs(step - 1000 * z) for step, z in zip(steps, self.depths[f])), 0.501)
            stamp = depth["header"]["stamp"]
            self.assertEqual(stamp["sec"] * 1_000_000 + stamp["nanosec"] // 1000, self.frames[f]["timestamp_us"])
        for name, key in (("color", "rgb"), ("depth", "ir")):
            camera, info = self.calibration[key], mcap.on(f"/camera/{name}/camera_info")[-1]
            K = [camera["fx_px"], 0, camera["cx_px"], 0, camera["fy_px"], camera["cy_px"], 0, 0, 1]
            self.check_near(info["k"], K, 1e-9)
            self.check_near(info["p"], K[:3] + [0] + K[3:6] + [0] + K[6:] + [0], 1e-9)
        self.check_truth(mcap)

    def check_truth(self, mcap):
        ((transform,),) = [message["transforms"] for message in mcap.on("/tf_static")]
        q, t = transform["transform"]["rotation"], transform["transform"]["translation"]
        T = self.calibration["T_rgb_ir"]
        back = moved(rotation_of(q["w"], q["x"], q["y"], q["z"]), (t["x"], t["y"], t["z"]),
                     moved(T["rotation"], T["translation_m"], (0.1, 0.2, 0.7)))
        self.check_near(back, (0.1, 0.2, 0.7), 1e-9)
        joints, markers = mcap.on("/hand/truth/joints"), mcap.on("/hand/truth/markers")
        for f, pose in enumerate(mcap.on("/hand/truth")):
            p, truth = pose["pose"]["position"], self.frames[f]
            self.check_near([1000 * p[axis] for axis in "xyz"], truth["position_mm"], 1e-3)
            self.assertEqual(joints[f]["name"], self.names)
            self.check_near([math.degrees(angle) for angle in joints[f]["position"]], truth["angles_deg"], 1e-5)
            spheres, bones = markers[f]["markers"]
            self.assertEqual((spheres["type"], len(spheres["points"])), (7, 25))
            self.assertEqual((bones["type"], len(bones["points"])), (5, 48))
            self.assertTrue(all(point in spheres["points"] for point in bones["points"]))
            labels = json.loads((self.folder / f"bop/test/000000/hand/{f:06}.json").read_text())
            for point, expected in zip(spheres["points"], labels["joints_25_mm"]):
                moved_mm = [1000 * x for x in moved(T["rotation"], T["translation_m"], [point[axis] for axis in "xyz"])]
                self.check_near(moved_mm, expected, 1e-3)

    def test_mcap(self):
        mcap = Mcap(self.folder / "mcap/three.mcap")
        self.check_frames(mcap)
        self.assertEqual(mcap.on("/hand/estimate"), [])

    def test_mcap_of_a_run(self):
        (path,) = (self.folder / "run").glob("*.mcap")
        mcap = Mcap(path)
        self.check_frames(mcap)
        with (self.folder / "run/estimates" / (path.stem + ".csv")).open(newline="") as file:
            rows = [row for row in csv.DictReader(file) if row["status"] == "tracked"]
        poses, joints = mcap.on("/hand/estimate"), mcap.on("/hand/estimate/joints")
        self.assertEqual((len(poses), len(joints), len(rows)), (FRAMES, FRAMES, FRAMES))
        for row, pose, state in zip(rows, poses, joints):
            p, q = pose["pose"]["position"], pose["pose"]["orientation"]
            self.check_near([1000 * p[axis] for axis in "xyz"], [float(row[f"position_{axis}_mm"]) for axis in "xyz"],
                            1e-5)
            self.check_near(sum(rotation_of(*(q[axis] for axis in "wxyz")), []),
                            sum(rotation_of(*(float(row[f"quaternion_{axis}"]) for axis in "wxyz")), []), 1e-5)
            self.check_near([math.degrees(angle) for angle in state["position"]],
                            [float(row[f"{name}_deg"]) for name in self.names], 1e-5)


if __name__ == "__main__":
    DatasetsTest.trajectory = sys.argv.pop(2)
    DatasetsTest.program = sys.argv.pop(1)
    unittest.main()
