"""soak_judge.py FOLDER SECONDS: judges what ci/soak has recorded (estimates.jsonl of the tracker, robot.jsonl
of the server) and prints one line. Exit code 4 if a command was missed, if frames of a stream of 30 Hz are missing or
half of them were lost, or if more commands of a topic than those of a second were spent on starts: that says something
about the program. 3 if none of these, but 1% of the commands took 10 ms or more or one less than nothing, or on a topic
1% were stale or not half of the stream was followed: that may say something about what else the machine did."""
import json
import os
import sys

MISSED, LATE = 4, 3
LIMIT_MS = 10
FRAME_RATE, RATE_TOLERANCE = 30, 0.02
MOST_STARTING = 30  # of a topic: a start takes 0.2 s (core/adapters/dds/README.md)

work, seconds = sys.argv[1], int(sys.argv[2])
frames = [json.loads(line) for line in open(f"{work}/estimates.jsonl")]
played = seconds * FRAME_RATE
# A lost frame sends nothing.
expected = {frame["timestamp_us"] for frame in frames if frame["status"] == "tracked"}
latencies, missed, stale, starting, counts, late = [], 0, 0, 0, [], False
# A command that came is not missed, though at a start, or too late, it moves nothing (core/adapters/dds/README.md).
CAME = ("accepted", "starting", "stale")
received = [json.loads(line) for line in open(f"{work}/robot.jsonl") if '"received"' in line]
for topic in ("fingers", "wrist", "pose"):
    lines = [line for line in received if line["topic"] == topic and line["receipt"] in CAME]
    stamps = {receipt: [line["stamp_ns"] // 1000 for line in lines if line["receipt"] == receipt] for receipt in CAME}
    missed += len(expected - {line["stamp_ns"] // 1000 for line in lines})
    counts.append(f"{topic} {len(lines)}")
    stale += len(stamps["stale"])
    starting = max(starting, len(stamps["starting"]))
    late |= len(stamps["stale"]) > 0.01 * len(lines) or len(expected & set(stamps["accepted"])) < played / 2
    latencies += [(line["time_us"] - line["source_us"]) / 1000 for line in lines]
latencies.sort()


def at(share):
    return latencies[min(len(latencies) - 1, int(share * len(latencies)))] if latencies else float("inf")


elapsed_us = frames[-1]["timestamp_us"] - frames[0]["timestamp_us"] if frames else 0
frame_rate = (len(frames) - 1) / elapsed_us * 1e6 if elapsed_us > 0 else 0
print(f"soak: {seconds} s, {len(frames)} frames at {frame_rate:.1f} Hz, {len(expected)} tracked; commands expected "
      f"{len(expected)}, received {', '.join(counts)}, missed {missed}, stale {stale}, starting {starting}; frame to command {at(0.5):.2f} ms median, "
      f"{at(0.99):.2f} ms p99, {at(1):.2f} ms at most (system clock, frame whole at the device to reception by the "
      f"server); {os.cpu_count()} processors, load {os.getloadavg()[0]:.1f}")
is_stream = len(frames) >= played and abs(frame_rate / FRAME_RATE - 1) < RATE_TOLERANCE
if not is_stream or len(expected) < played / 2 or missed > 0 or starting > MOST_STARTING:
    sys.exit(MISSED)
sys.exit(0 if not late and at(0) >= 0 and at(0.99) < LIMIT_MS else LATE)
