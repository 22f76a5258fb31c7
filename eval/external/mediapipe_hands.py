#!/usr/bin/python3
"""MediaPipe Hands as a tracker: glovebench run --method exec:"eval/external/mediapipe_hands.py PACKAGE" ...

PACKAGE is the unpacked npm package @mediapipe/hands, which holds its models; ci/external fetches it. It runs in a
headless Chromium on its CPU path, whose landmarks are the same in every process. It sees the color image alone. Its
shape in meters is moved so that it projects onto its landmarks, then scaled about the camera until the palm has the
measured depth. It has no bases of the four fingers' metacarpals. See eval/guides/tracker.md for the messages.
"""
import http.server
import json
import os
import queue
import shutil
import subprocess
import sys
import tempfile
import threading

import numpy as np

JOINTS = [0, 1, 2, 3, 4, 6, 7, 8, 9, 11, 12, 13, 14, 16, 17, 18, 19, 21, 22, 23, 24]  # of WebXR's 25
PALM = [0, 5, 9, 13, 17]
SKIN_MM = 10  # from the surface of the palm to its joints
PAGE = """<!DOCTYPE html><script src="/package/hands.js"></script><script>
const hands = new Hands({locateFile: file => '/package/' + file});
hands.setOptions({maxNumHands: 1, modelComplexity: 1, minDetectionConfidence: 0.5, minTrackingConfidence: 0.5,
                  useCpuInference: true});
let answer = null;
hands.onResults(results => {
  answer = results.multiHandLandmarks.length == 0 ? null :
    {image: results.multiHandLandmarks[0].map(p => [p.x, p.y]),
     world: results.multiHandWorldLandmarks[0].map(p => [p.x, p.y, p.z])};
});
async function work() {
  await hands.initialize();
  const canvas = document.createElement('canvas'), context = canvas.getContext('2d', {willReadFrequently: true});
  for (let body = null; ; body = JSON.stringify(answer)) {
    const reply = await fetch('/next', {method: 'POST', body});
    const [width, height] = reply.headers.get('size').split('x').map(Number);
    Object.assign(canvas, {width, height});
    context.putImageData(new ImageData(new Uint8ClampedArray(await reply.arrayBuffer()), width, height), 0, 0);
    answer = null;
    await hands.send({image: canvas});
  }
}
work();
</script>"""


class Browser:
    """Chromium with MediaPipe: images go in, landmarks come out."""

    def __init__(self, package):
        self.images, self.answers = queue.Queue(), queue.Queue()
        browser = self

        class Handler(http.server.BaseHTTPRequestHandler):
            def send(self, body, kind, size=""):
                self.send_response(200)
                self.send_header("Content-Type", kind)
                self.send_header("Content-Length", str(len(body)))
                self.send_header("size", size)
                self.end_headers()
                self.wfile.write(body)

            def do_GET(self):
                name = os.path.basename(self.path)
                if name == "bridge.html":
                    return self.send(PAGE.encode(), "text/html")
                path = os.path.join(package, name)
                if not os.path.isfile(path):
                    return self.send_error(404)
                with open(path, "rb") as file:
                    kind = {".js": "text/javascript", ".wasm": "application/wasm"}.get(os.path.splitext(name)[1])
                    self.send(file.read(), kind or "application/octet-stream")

            def do_POST(self):
                last = json.loads(self.rfile.read(int(self.headers.get("Content-Length") or 0)) or "0")
                if last != 0:  # 0: the page has just started
                    browser.answers.put(last)
                image = browser.images.get()
                self.send(image.tobytes(), "application/octet-stream", f"{image.shape[1]}x{image.shape[0]}")

            def log_message(self, *_):
                pass

        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)  # it may still write
        # WebGL must exist although the inference does not use it.
        self.process = subprocess.Popen(
            ["chromium", "--headless=new", "--no-sandbox", "--disable-dev-shm-usage",
             "--disable-gpu", "--enable-unsafe-swiftshader", f"--user-data-dir={self.folder.name}",
             f"http://127.0.0.1:{server.server_port}/bridge.html"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def landmarks(self, color):
        self.images.put(np.dstack([color, np.full(color.shape[:2], 255, np.uint8)]))
        return self.answers.get()

    def close(self):
        self.process.kill()
        self.process.wait()


def placed(world, image, rgb):
    """The points in the RGB camera's frame, mm, that project onto `image` with the least squared error."""
    x = (np.array(image)[:, 0] * rgb["width_px"] - 0.5 - rgb["cx_px"]) / rgb["fx_px"]
    y = (np.array(image)[:, 1] * rgb["height_px"] - 0.5 - rgb["cy_px"]) / rgb["fy_px"]
    points = 1000 * np.array(world)
    zero, one = np.zeros(len(x)), np.ones(len(x))
    A = np.concatenate([np.stack([one, zero, -x], 1), np.stack([zero, one, -y], 1)])
    b = np.concatenate([x * points[:, 2] - points[:, 0], y * points[:, 2] - points[:, 1]])
    return points + np.linalg.lstsq(A, b, rcond=None)[0]


def depth_scale(points, depth_mm, ir, T_ir_rgb):
    """Measured over estimated depth of the palm, median; 1 where the camera measured none."""
    ratios = []
    for x, y, z in (points[PALM] @ T_ir_rgb[0].T + T_ir_rgb[1]):
        u, v = round(ir["fx_px"] * x / z + ir["cx_px"]), round(ir["fy_px"] * y / z + ir["cy_px"])
        window = depth_mm[max(v - 3, 0):max(v + 4, 0), max(u - 3, 0):max(u + 4, 0)]
        if z > 0 and np.any(window > 0):
            ratios.append((np.median(window[window > 0]) + SKIN_MM) / z)
    return np.median(ratios) if ratios else 1


def main(package):
    if not os.path.isfile(os.path.join(package, "hands.js")):
        sys.exit(f"mediapipe_hands.py: {package}: found no hands.js, expected the npm package @mediapipe/hands")
    if not shutil.which("chromium"):
        sys.exit("mediapipe_hands.py: chromium: found no such program, expected the Debian package")
    start = json.loads(sys.stdin.buffer.readline())
    assert start["protocol"] == "glovebench-tracker" and start["version"] == 1
    ir, rgb, T = (start["calibration"][key] for key in ("ir", "rgb", "T_rgb_ir"))
    R, t = np.array(T["rotation"]), 1000 * np.array(T["translation_m"])
    T_ir_rgb = R.T, -R.T @ t
    browser = Browser(package)
    while line := sys.stdin.buffer.readline():
        frame = json.loads(line)
        depth = np.frombuffer(sys.stdin.buffer.read(frame["depth_bytes"]), "<u2").reshape(ir["height_px"], -1)
        color = np.frombuffer(sys.stdin.buffer.read(frame["rgb_bytes"]), np.uint8).reshape(rgb["height_px"], -1, 3)
        answer = {"frame": frame["frame"], "status": "no_hand"}
        if found := browser.landmarks(color):
            points = placed(found["world"], found["image"], rgb)
            points = points * depth_scale(points, depth * start["depth_unit_mm"], ir, T_ir_rgb)
            joints = [None] * 25
            for joint, point in zip(JOINTS, points @ T_ir_rgb[0].T + T_ir_rgb[1]):
                joints[joint] = point.tolist()
            answer = {"frame": frame["frame"], "joints_mm": joints}
        print(json.dumps(answer), flush=True)
    browser.close()


main(*sys.argv[1:])
