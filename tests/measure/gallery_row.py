#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
# A row of the table of docs/gallery.md, of what `lodesman segment --json` said of a set's frames, one by one and as
# they were drawn, which may be with --track. Ends with status 1 where an obstacle was left out for want of room.
#   tests/measure/gallery_row.py NAME ALONE DRAWN
import json
import sys


def read(file):
    with open(file, encoding="utf-8") as text:
        return json.load(text)["frames"]


def main(name, alone, drawn):
    frames, last = read(alone), read(drawn)[-1]["obstacles"]
    found = [frame["obstacles"] for frame in frames]
    every = [o for obstacles in found for o in obstacles]
    polygons = sum("vertices_m" in o for o in every)
    tracks = "-"
    if any(o["id"] for o in last):
        movers = [o for o in last if "velocity_m_s" in o]
        tracks = f"{len(movers)}, {sum(o['surely_moves'] for o in movers)}"
    print(f"| `{name}` | {len(frames)} | {len(every) / len(frames):.1f}, {max(map(len, found))} | "
          f"{polygons / max(1, len(every)):.2f} | {tracks} |", flush=True)
    return 1 if any(frame.get("dropped") for frame in frames) else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:4]))
