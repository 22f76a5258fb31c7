"""soak_judge.py FOLDER SECONDS: judges what ci/soak has recorded (estimates.jsonl of the tracker, robot.jsonl
of the server) and prints one line. Exit code 4 if a command was missed, or if more commands of a topic than those of a
second were spent on starts, which says something about the program; 3 if none was but 1% of them took 10 ms or more or
were stale, which may say something about what else the machine did."""
import json
import os
import sys

MISSED, LATE = 4, 3
LIMIT_MS = 10
MOST_STARTING = 30  # of a topic: a start takes 0.2 s (core/robot/dds/README.md)

work, seconds = sys.argv[1], int(sys.argv[2])
frames = [json.loads(line) for line in open(f"{work}/estimates.jsonl")]
# A lost frame sends nothing.
expected = {frame["timestamp_us"] for frame in frames if frame["status"] == "tracked"}
latencies, missed, stale, starting, counts = [], 0, 0, 0, []
# A command that came is not missed, though at a start, or too late, it moves nothing (core/robot/dds/README.md).
CAME = ("accepted", "starting", "stale")
received = [json.loads(line) for line in open(f"{work}/robot.jsonl") if '"received"' in line]
for topic in ("fingers", "wrist", "pose"):
    lines = [line for line in received if line["topic"] == topic and line["receipt"] in CAME]
    missed += len(expected - {line["stamp_ns"] // 1000 for line in lines})
    counts.append(f"{topic} {len(lines)}")
    stale += sum(line["receipt"] == "stale" for line in lines)
    starting = max(starting, sum(line["receipt"] == "starting" for line in lines))
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
if not expected or missed > 0 or starting > MOST_STARTING:
    sys.exit(MISSED)
sys.exit(0 if at(0.99) < LIMIT_MS and stale <= 0.01 * len(latencies) else LATE)
