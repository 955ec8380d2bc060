// SPDX-License-Identifier: Apache-2.0
// The programs' names in words, and what the drawings show in words for those who do not see them.
import { bearing_deg, distance, middle_of, wrap_180 } from "./geometry.js";
import { finite } from "./dom.js";

export const kStates = {
  idle: "Idle",
  under_way: "Under way",
  holding: "Holding",
  reached: "Reached",
  aborted: "Aborted",
};

export const kThrust = { disarmed: "Disarmed", armed: "Armed", manual: "By hand", stopped: "E-stopped" };

export const kCauses = {
  order: "by order",
  link_lost: "link lost",
  absence: "the high level was gone",
  restart: "after a restart",
  blocked: "a waypoint is blocked",
  disarmed: "thrusters were disarmed",
  power_up: "since power-up",
  remembered: "as before its restart",
  box_lost: "the thruster box was lost",
  abort: "an abort took the stick",
  latch: "from before the power was off",
};

export const kRungs = {
  on_route: "along the path",
  aside: "aside, of something close or moving",
  slow: "along the path, slower",
  stop: "stopped until it is clear",
  escape: "out of a zone",
  near_goal: "as near to the goal as there is room",
  best_point: "to the nearest point that can be reached",
  hold: "keeps its place",
  previous: "along the previous waypoints",
  nothing: "nothing to follow",
};

export const plain = (name) => (typeof name === "string" ? name.replaceAll("_", " ") : "–");

// What no word of the server says when it is not there: the state alone.
export function story_of(status) {
  if (!status) return "Waiting for the boat.";
  if (status.ok === false) return `The boat does not answer: ${status.error}.`;
  const cause = status.cause && status.cause !== "order" ? `, ${kCauses[status.cause] ?? plain(status.cause)}` : "";
  return `${kStates[status.state] ?? plain(status.state)}${cause}.`;
}

function side_of(boat, at) {
  const off = wrap_180(bearing_deg(boat.position_m, at) - (boat.heading_deg ?? 0));
  return `${Math.abs(off).toFixed(0)} degrees to ${off < 0 ? "port" : "starboard"}`;
}

export function world_words({ boat, world }) {
  if (!boat?.position_m) return "Nothing is known of the boat's place.";
  const [x, y] = boat.position_m;
  const said = [`Boat at ${x.toFixed(1)} m east, ${y.toFixed(1)} m north`];
  if (finite(boat.heading_deg)) said.push(`heading ${boat.heading_deg.toFixed(0)} degrees`);
  if (finite(boat.speed_m_s)) said.push(`${boat.speed_m_s.toFixed(2)} metres a second`);
  if (world?.goal_m) {
    said.push(`goal ${distance(boat.position_m, world.goal_m).toFixed(1)} m off, ${side_of(boat, world.goal_m)}`);
  }
  const obstacles = (world?.obstacles ?? [])
    .map((obstacle) => ({ ...obstacle, at: middle_of(obstacle.outline_m ?? []) }))
    .filter(({ at }) => at)
    .map((obstacle) => ({ ...obstacle, off: Math.min(...obstacle.outline_m.map((p) => distance(boat.position_m, p))) }))
    .sort((a, b) => a.off - b.off);
  said.push(obstacles.length === 1 ? "1 obstacle" : `${obstacles.length} obstacles`);
  for (const { id, at, off, moving } of obstacles.slice(0, 3)) {
    said.push(`number ${id}${moving ? ", moving," : ""} ${off.toFixed(1)} m off, ${side_of(boat, at)}`);
  }
  return `${said.join("; ")}.`;
}

export function sonar_words(sonar) {
  if (!sonar) return "No sonar picture.";
  const detections = sonar.detections?.length ?? 0;
  const tracks = sonar.tracks ?? [];
  const nearest = tracks
    .map(({ id, outline_m }) => ({ id, off: Math.min(...(outline_m ?? []).map(([x, y]) => Math.hypot(x, y))) }))
    .filter(({ off }) => Number.isFinite(off))
    .sort((a, b) => a.off - b.off)[0];
  const near = nearest ? `; nearest is number ${nearest.id}, ${nearest.off.toFixed(1)} m off` : "";
  return `Sonar to ${sonar.range_m} m: ${detections} detections, ${tracks.length} tracks${near}.`;
}
