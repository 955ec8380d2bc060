#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
# The processor time that `lodesman segment` takes to find the obstacles of a frame, by each method, as a
# table: the least of so many runs a frame, then the median, p99 and worst over the frames of a set. Ends with
# status 1 where the contrast method left an obstacle out for want of room.
#   tests/measure/perception_times.py BINARY DATA REPEATS
# DATA: where the shared real frames lie.
import glob
import json
import math
import statistics
import subprocess
import sys

FAN = ("--layout", "fan", "--apex", "top")
# Folder, range setting [m], sector [deg], further options. Where the range is not known it is assigned.
SETS = {
    "fls_oculus_m1200d, 120 x 500": ("fls_oculus_m1200d/polar_120x500", 30, 120, ()),
    "fls_oculus_known_range, 120 x 500, at 10 m": ("fls_oculus_known_range/polar_120x500", 10, 120, ()),
    "fls_moving_auv, 120 x 500": ("fls_moving_auv/sonar4", 30, 120, ()),
    "sonar_raw_oculus_pings, 256 x 703": ("sonar_raw_oculus_pings/polar", 2, 60, ()),
    "fls_oculus_m1200d, fan pictures, 512 beams": ("fls_oculus_m1200d/fan", 30, 120, FAN),
}


def segmented(binary, files, range_m, sector_deg, method, options):
    command = [binary, "segment", *files, "--range-m", str(range_m), "--sector-deg", str(sector_deg), "--json",
               "--quiet", "--set", f"segmentation.method={method}", *options]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr[-400:])
    return json.loads(done.stdout)["frames"]


def main(binary, data, repeats):
    full = []
    print("| us a frame | frames | threshold: median | p99 | worst |"
          " contrast: median | p99 | worst |\n|---|---|---|---|---|---|---|---|")
    for name, (folder, range_m, sector_deg, options) in SETS.items():
        files = sorted(glob.glob(f"{data}/{folder}/*.*"))
        if not files:
            sys.exit(f"no frames in {data}/{folder}")
        row = f"| {name} | {len(files)} |"
        for method in "threshold", "contrast":
            runs = [segmented(binary, files, range_m, sector_deg, method, options) for _ in range(repeats)]
            least = sorted(min(run[i]["us"] for run in runs) for i in range(len(files)))
            p99 = least[math.ceil(0.99 * len(least)) - 1]
            row += f" {statistics.median(least):.0f} | {p99:.0f} | {least[-1]:.0f} |"
            if method == "contrast":
                full += [frame["file"] for frame in runs[0] if frame.get("dropped")]
        print(row, flush=True)
    for file in full:
        print(f"broken: {file}: an obstacle was left out", file=sys.stderr)
    return 1 if full else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], int(sys.argv[3])))
