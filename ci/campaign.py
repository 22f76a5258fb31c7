#!/usr/bin/python3
"""What the campaigns ci/planted-regressions and ci/false-alarms compute themselves, so that the gate is not judged by
its own arithmetic.

ci/campaign.py effect BASELINE CANDIDATE NOISE_FLOOR  the largest harm, in units of its minimum effect
ci/campaign.py interval ALARMS RUNS                   the share and its Clopper-Pearson 95% interval
"""

import json
import math
import sys

VALUES = ["position_error_mm", "rotation_error_deg", "posture_rms_deg", "posture_rms_unfiltered_deg",
          "vertex_error_mm", "fingertip_error_mm", "icp_residual_mm"]
SHARES = {"uncovered_percent": lambda frame: not frame["covered"],
          "false_tracked_percent": lambda frame: frame["false_tracked"],
          "false_lost_percent": lambda frame: frame["false_lost"]}


def load(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def name_of(experiment):
    noise = experiment["noise"]
    return (f"{experiment['trajectory']}_{experiment['database']}_{experiment['truth']}_subject{experiment['subject']}"
            f"_{noise['model']}_{noise['factor']:g}")


def frames_of(results):
    """The frames of each experiment by (seed, frame)."""
    columns = results["frame_columns"]
    return {name_of(experiment): {(run["seed"], row[0]): dict(zip(columns, row))
                                  for run in experiment["runs"] for row in run["frames"]}
            for experiment in results["experiments"]}


def share(frames, is_counted):
    """Percent of the frames that the result itself has."""
    return 100 * sum(map(is_counted, frames.values())) / len(frames) if frames else 0.0


def changes(baseline, candidate):
    """(experiment, quantity) -> candidate - baseline: means over the frames that have a value in both."""
    found = {}
    after = frames_of(candidate)
    for experiment, before in frames_of(baseline).items():
        now = after.get(experiment, {})
        for key in VALUES:
            pairs = [(before[at][key], now[at][key]) for at in before.keys() & now.keys()]
            differences = [b - a for a, b in pairs if a is not None and b is not None]
            if differences:
                found[experiment, key] = math.fsum(differences) / len(differences)
        for key, is_counted in SHARES.items():
            found[experiment, key] = share(now, is_counted) - share(before, is_counted)
    return found


def effect(baseline, candidate, noise_floor):
    minimum = {(entry["experiment"], entry["quantity"]): entry["minimum_effect"]
               for entry in load(noise_floor)["entries"]}
    found = changes(load(baseline), load(candidate))
    # A share that a result states can also fall wrongly: when frames left it.
    units = {row: (abs(change) if row[1] in SHARES else change) / minimum[row]
             for row, change in found.items() if row in minimum}
    row = max(units, key=units.get)
    print(f"{units[row]:.1f} x: {row[0]} {row[1]} {found[row]:+.3f} (minimum effect {minimum[row]:.3f})")
    return 0 if units[row] >= 1 else 1


def at_most(count, trials, chance):
    """P(X <= count) of a binomial X."""
    return math.fsum(math.comb(trials, k) * chance**k * (1 - chance)**(trials - k) for k in range(count + 1))


def bisect(falling, target):
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if falling(middle) > target else (low, middle)
    return low


def clopper_pearson(count, trials, error=0.05):
    low = 0.0 if count == 0 else bisect(lambda p: at_most(count - 1, trials, p), 1 - error / 2)
    high = 1.0 if count == trials else bisect(lambda p: at_most(count, trials, p), error / 2)
    return low, high


def interval(alarms, trials):
    low, high = clopper_pearson(alarms, trials)
    print(f"{alarms} of {trials} ({100 * alarms / trials:.1f}%, 95% interval {100 * low:.1f}% to {100 * high:.1f}%)")
    return 0


def main(arguments):
    match arguments:
        case ["effect", baseline, candidate, noise_floor]:
            return effect(baseline, candidate, noise_floor)
        case ["interval", alarms, trials]:
            return interval(int(alarms), int(trials))
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
