"""The metrics of coverage and of aligned points, computed again from points, poses and cameras.

Usage: recomputed_test.py EXAMPLE_PROGRAM. Shares nothing with the program: the rotation of Procrustes comes from Horn's
quaternion (1987), the program's from a singular value decomposition.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOLERANCE = 1e-6
WRIST, MIDDLE_MCP = 0, 11


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def centroid(points):
    return [mean(axis) for axis in zip(*points)]


def mean_distance_mm(points, others):
    return 1000 * mean(math.dist(p, q) for p, q in zip(points, others))


def transformed(points, rotation, translation, scale=1.0):
    return [[scale * dot(row, p) + t for row, t in zip(rotation, translation)] for p in points]


def moved(points, root, new_root, scale=1.0):
    return [[scale * (x - r) + n for x, r, n in zip(p, root, new_root)] for p in points]


def largest_eigenvector(matrix):
    """Of a symmetric matrix, by Jacobi's rotations."""
    size = len(matrix)
    a = [row[:] for row in matrix]
    v = [[float(i == j) for j in range(size)] for i in range(size)]
    for _ in range(100):
        p, q = max(((i, j) for i in range(size) for j in range(i)), key=lambda ij: abs(a[ij[0]][ij[1]]))
        if abs(a[p][q]) < 1e-18:
            break
        angle = 0.5 * math.atan2(2 * a[p][q], a[q][q] - a[p][p])
        c, s = math.cos(angle), math.sin(angle)
        for k in range(size):
            a[k][p], a[k][q] = c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]
        for k in range(size):
            a[p][k], a[q][k] = c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]
        for k in range(size):
            v[k][p], v[k][q] = c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q]
    best = max(range(size), key=lambda i: a[i][i])
    return [row[best] for row in v]


def rotation_of(q):
    w, x, y, z = q
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def procrustes(points, targets):
    """The points after the similarity transform that brings them nearest to the targets."""
    a, b = centroid(points), centroid(targets)
    source, target = [minus(p, a) for p in points], [minus(p, b) for p in targets]
    s = [[sum(p[i] * q[j] for p, q in zip(source, target)) for j in range(3)] for i in range(3)]
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = s
    n = [[xx + yy + zz, yz - zy, zx - xz, xy - yx],
         [yz - zy, xx - yy - zz, xy + yx, zx + xz],
         [zx - xz, xy + yx, yy - xx - zz, yz + zy],
         [xy - yx, zx + xz, yz + zy, zz - xx - yy]]
    rotation = rotation_of(largest_eigenvector(n))
    turned = transformed(source, rotation, [0, 0, 0])
    scale = sum(dot(p, q) for p, q in zip(turned, target)) / sum(dot(p, p) for p in source)
    return transformed(source, rotation, b, scale)


def area_under_curve(errors, count):
    """Of the share of errors within 0, 1, ... 50 mm, by the trapezoidal rule, as a share of 50 mm."""
    shares = [sum(error <= threshold for error in errors) / count for threshold in range(51)]
    return (sum(shares) - (shares[0] + shares[-1]) / 2) / 50


def is_in_image(camera, p):
    if p[2] <= 0:
        return False
    u, v = (camera["f" + a] * p[i] / p[2] + camera["c" + a] for i, a in enumerate("xy"))
    return -0.5 <= u < camera["width"] - 0.5 and -0.5 <= v < camera["height"] - 0.5


class RecomputedTest(unittest.TestCase):
    program = None

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "measured.json")
            subprocess.run([cls.program, "--measured", file], check=True)
            cls.measured = json.loads(file.read_text())
        cls.frames = cls.measured["frames"]
        cls.tracked = [frame for frame in cls.frames if frame["tracked"]]

    def expect(self, metric, compute):
        for number, frame in enumerate(self.frames):
            with self.subTest(metric, frame=number):
                if not frame["tracked"]:
                    self.assertIsNone(frame["metrics"][metric])
                else:
                    expected = compute(frame["estimated"], frame["true"])
                    self.assertAlmostEqual(frame["metrics"][metric], expected, delta=TOLERANCE)

    @staticmethod
    def position_mm(estimated, true):
        return 1000 * math.dist(estimated["pose"]["translation"], true["pose"]["translation"])

    @staticmethod
    def rotation_deg(estimated, true):
        a, b = estimated["pose"]["rotation"], true["pose"]["rotation"]
        # |A - B| in the Frobenius norm is sqrt(8) times the sine of half the angle.
        distance = math.sqrt(sum((x - y) ** 2 for r, s in zip(a, b) for x, y in zip(r, s)))
        return math.degrees(2 * math.asin(distance / math.sqrt(8)))

    def fingertips_mm(self, estimated, true):
        tips = self.measured["fingertips"]
        return mean_distance_mm([estimated["joints"][t] for t in tips], [true["joints"][t] for t in tips])

    def test_joints(self):
        def at_root(e, t, scale=1.0):
            return mean_distance_mm(moved(e["joints"], e["joints"][WRIST], t["joints"][WRIST], scale), t["joints"])

        def bone(hand):
            return math.dist(hand["joints"][MIDDLE_MCP], hand["joints"][WRIST])

        self.expect("position_error_mm", self.position_mm)
        self.expect("rotation_error_deg", self.rotation_deg)
        self.expect("fingertip_error_mm", self.fingertips_mm)
        self.expect("joint_error_mm", lambda e, t: mean_distance_mm(e["joints"], t["joints"]))
        self.expect("mpjpe_root_mm", at_root)
        self.expect("mpjpe_scaled_mm", lambda e, t: at_root(e, t, bone(t) / bone(e)))
        self.expect("mpjpe_procrustes_mm",
                    lambda e, t: mean_distance_mm(procrustes(e["joints"], t["joints"]), t["joints"]))

    def test_vertices(self):
        # The true vertices are those of the tracker's hand, so their wrist is not the person's: it lies where the
        # pose of the hand puts the tracker's wrist.
        def wrist(hand, of_hand):
            return transformed([of_hand], hand["pose"]["rotation"], hand["pose"]["translation"])[0]

        def tracker_wrist(frame):
            pose = frame["estimated"]["pose"]
            p = minus(frame["estimated"]["joints"][WRIST], pose["translation"])
            return [dot(column, p) for column in zip(*pose["rotation"])]

        of_hand = tracker_wrist(self.frames[0])
        self.expect("vertex_error_mm", lambda e, t: mean_distance_mm(e["vertices"], t["vertices"]))
        self.expect("mpvpe_root_mm", lambda e, t: mean_distance_mm(
            moved(e["vertices"], wrist(e, of_hand), wrist(t, of_hand)), t["vertices"]))
        self.expect("mpvpe_procrustes_mm",
                    lambda e, t: mean_distance_mm(procrustes(e["vertices"], t["vertices"]), t["vertices"]))

    def visible_percent(self, surface):
        facing = visible = 0.0
        to_rgb = self.measured["T_rgb_ir"]
        for triangle in self.measured["triangles"]:
            a, b, c = (surface[i] for i in triangle)
            normal, middle = cross(minus(b, a), minus(c, a)), centroid([a, b, c])
            if dot(normal, middle) >= 0:
                continue
            area = math.hypot(*normal)
            facing += area
            in_rgb = transformed([middle], to_rgb["rotation"], to_rgb["translation"])[0]
            if 0.4 <= middle[2] <= 0.95 and is_in_image(self.measured["ir"], middle) and \
                    is_in_image(self.measured["rgb"], in_rgb):
                visible += area
        return 100 * visible / facing

    def test_visibility(self):
        shares = [self.visible_percent(frame["surface"]) for frame in self.frames]
        for frame, share in zip(self.frames, shares):
            self.assertAlmostEqual(frame["metrics"]["visible_percent"], share, delta=TOLERANCE)
        self.assertTrue(any(0 < share < 30 for share in shares) and any(30 < share < 100 for share in shares), shares)

    def test_coverage(self):
        visible = [frame for frame in self.frames if self.visible_percent(frame["surface"]) >= 30]
        answered = [(frame["estimated"], frame["true"]) for frame in visible if frame["tracked"]]
        found = [(e, t) for e, t in answered if self.position_mm(e, t) < 50 and self.rotation_deg(e, t) < 30]
        usable = [(e, t) for e, t in found if self.position_mm(e, t) < 10 and self.rotation_deg(e, t) < 10
                  and self.fingertips_mm(e, t) < 20]
        self.assertEqual(self.measured["visible"], len(visible))
        self.assertAlmostEqual(self.measured["found_share"], len(found) / len(visible), delta=TOLERANCE)
        self.assertAlmostEqual(self.measured["usable_share"], len(usable) / len(visible), delta=TOLERANCE)
        self.assertTrue(0 < len(usable) < len(found) < len(answered) < len(visible) < len(self.frames))

    def test_fingertip_auc(self):
        errors = [1000 * math.dist(frame["estimated"]["joints"][tip], frame["true"]["joints"][tip])
                  for frame in self.tracked for tip in self.measured["fingertips"]]
        expected = area_under_curve(errors, 5 * len(self.frames))
        self.assertAlmostEqual(self.measured["fingertip_auc"], expected, delta=TOLERANCE)


if __name__ == "__main__":
    RecomputedTest.program = sys.argv.pop(1)
    unittest.main()
