// SPDX-License-Identifier: Apache-2.0
// A mission that is being drawn: its points as handles that can be found, moved and taken away, its
// tools, and what was before. Knows no page.
import { distance, drawn_from_degrees, nearest_within, place_beside } from "./geometry.js";
import { empty_mission, kMostAreas, kMostCorners, kMostWaypoints, mission_lacks, read_mission, with_position, write_mission } from "./mission_text.js";

const kMostUndo = 60;

export class Draft {
  mission = empty_mission();
  pending = false; // was drawn, and not started since
  changed = () => {};
  #undo = [];
  #held = null; // the handle that is dragged

  // ---- As a whole

  get is_empty() {
    return write_mission(this.mission) === "";
  }
  get text() {
    return write_mission(this.mission);
  }
  get lacks() {
    return mission_lacks(this.mission);
  }
  get can_undo() {
    return this.#undo.length > 0;
  }

  // Throws MissionError, and changes nothing then.
  read(text) {
    const mission = read_mission(text);
    this.#keep();
    this.mission = mission;
    this.#tell();
  }

  clear() {
    this.#keep();
    this.mission = empty_mission();
    this.pending = false;
    this.changed();
  }

  undo() {
    const before = this.#undo.pop();
    if (before === undefined) return;
    this.mission = JSON.parse(before);
    this.pending = !this.is_empty;
    this.changed();
  }

  set(key, value) {
    this.#keep();
    if (value === undefined) delete this.mission[key];
    else this.mission[key] = value;
    this.#tell();
  }

  // What the boat sails or sailed last, as /lodesman/world has it.
  take_over(world) {
    this.#keep();
    const { mission_m = [], goal_m, goal_radius_m, fence_m, keep_out_m } = world;
    const points = mission_m.map(with_position);
    this.mission = { ...empty_mission(), waypoints_m: points.slice(0, -1), fence_m: fence_m ?? [], keep_out_m: keep_out_m ?? [] };
    const goal = points.at(-1) ?? (goal_m ? with_position(goal_m) : undefined);
    if (goal) this.mission.goal_m = goal;
    if (goal_radius_m) this.mission.goal_radius_m = goal_radius_m;
    this.#tell();
  }

  #keep() {
    this.#undo.push(JSON.stringify(this.mission));
    if (this.#undo.length > kMostUndo) this.#undo.shift();
  }

  #tell() {
    this.pending = !this.is_empty;
    this.changed();
  }

  // ---- Handles

  handles() {
    const { goal_m, waypoints_m = [], fence_m = [], keep_out_m = [] } = this.mission;
    const list = [];
    const row = (points, kind, area) => points.forEach((at, i) => list.push({ at, kind, points, i, area }));
    if (goal_m) list.push({ at: goal_m, kind: "goal" });
    row(waypoints_m, "waypoint");
    row(fence_m, "fence");
    keep_out_m.forEach((corners, area) => row(corners, "keep_out", area));
    return list;
  }

  find(at, reach) {
    const handles = this.handles();
    return handles[nearest_within(handles.map((handle) => handle.at), at, reach)] ?? null;
  }

  grab(at, reach) {
    this.#held = this.find(at, reach);
    if (this.#held) this.#keep();
    return Boolean(this.#held);
  }

  drag(at) {
    const { kind, points, i } = this.#held ?? {};
    if (!kind) return;
    if (kind === "goal") this.mission.goal_m = this.#held.at = with_position(at);
    else points[i] = with_position(at);
    this.#tell();
  }

  drop() {
    this.#held = null;
    if (this.#undo.at(-1) === JSON.stringify(this.mission)) this.#undo.pop();
  }

  remove(at, reach) {
    const found = this.find(at, reach);
    if (!found) return false;
    this.#keep();
    if (found.kind === "goal") delete this.mission.goal_m;
    else found.points.splice(found.i, 1);
    this.mission.keep_out_m = this.mission.keep_out_m.filter((corners) => corners.length > 0);
    this.#tell();
    return true;
  }

  // ---- What a tap with a tool in hand does. False where there is no room for more.

  tap(tool, at, reach) {
    if (this.find(at, reach)) return true;
    return this.#add[tool]?.(with_position(at)) ?? false;
  }

  #add = {
    goal: (at) => {
      this.#keep();
      this.mission.goal_m = at;
      delete this.mission.goal_deg;
      this.#tell();
      return true;
    },
    waypoint: (at) => {
      if (this.mission.waypoints_m.length >= kMostWaypoints) return false;
      this.#keep();
      this.mission.waypoints_m.push(at);
      delete this.mission.waypoints_deg;
      this.#tell();
      return true;
    },
    fence: (at) => this.#add_corner(this.mission.fence_m, at),
    keep_out: (at) => {
      const areas = this.mission.keep_out_m;
      if (areas.length === 0) areas.push([]);
      return this.#add_corner(areas.at(-1), at);
    },
  };

  #add_corner(corners, at) {
    if (corners.length >= kMostCorners) return false;
    this.#keep();
    const place = corners.length < 3 ? corners.length : place_beside([...corners, corners[0]], at);
    corners.splice(place, 0, at);
    this.#tell();
    return true;
  }

  new_area() {
    const areas = this.mission.keep_out_m;
    if (areas.length >= kMostAreas || areas.at(-1)?.length === 0) return;
    areas.push([]);
  }

  // ---- For a drawing

  // The way from `start` on, in metres; what is given in degrees as well as it can be drawn.
  way(origin_deg) {
    const drawn = (points) => (origin_deg ? points.map((at) => drawn_from_degrees(at, origin_deg)) : []);
    const { waypoints_m, waypoints_deg = [], goal_m, goal_deg } = this.mission;
    return {
      waypoints: [...waypoints_m, ...drawn(waypoints_deg)],
      goal: goal_m ?? (goal_deg ? drawn([goal_deg])[0] : null) ?? null,
    };
  }

  length_m(start, origin_deg) {
    const { waypoints, goal } = this.way(origin_deg);
    const points = [start, ...waypoints, goal].filter(Boolean);
    return points.slice(1).reduce((sum, at, i) => sum + distance(points[i], at), 0);
  }
}
