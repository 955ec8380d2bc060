// SPDX-License-Identifier: Apache-2.0
// A mission file (docs/configuration.md) as an object, and back. Reads the part of TOML that such a
// file can have; the boat reads it again and is the judge. Knows no page.

const kWords = {
  link_lost: ["go_on", "hold", "return", "abort"],
  on_restart: ["hold", "resume"],
  blocked: ["hold", "skip"],
  legs: ["free", "line"],
  colregs: ["off"],
};
const kNumbers = {
  goal_radius_m: [0, 100],
  speed_m_s: [0, 10],
  link_lost_after_s: [1.5, 3600],
  blocked_patience_s: [0, 86400],
};
export const kMostWaypoints = 127;
export const kLeastCorners = 3;
export const kMostCorners = 31;
export const kMostAreas = 15;
export const kMostBytes = 32768;
const kOrder = [
  "waypoints_m", "waypoints_deg", "goal_m", "goal_deg", "goal_radius_m", "speed_m_s", "legs", "link_lost",
  "link_lost_after_s", "on_restart", "blocked", "blocked_patience_s", "fence_m", "keep_out_m", "colregs",
];

export class MissionError extends Error {
  constructor(line, text) {
    super(line ? `line ${line}: ${text}` : text);
    this.line = line;
  }
}

export function empty_mission() {
  return { waypoints_m: [], fence_m: [], keep_out_m: [] };
}

// ---- Reading

class Text {
  constructor(text) {
    this.text = text;
    this.at = 0;
  }
  get line() {
    return this.text.slice(0, this.at).split("\n").length;
  }
  get here() {
    return this.text[this.at];
  }
  fail(reason) {
    throw new MissionError(this.line, reason);
  }
  // Blanks and, with `lines`, newlines and comments too.
  skip(lines) {
    for (;;) {
      const c = this.here;
      if (c === " " || c === "\t" || c === "\r" || (lines && c === "\n")) this.at++;
      else if (c === "#" && lines) while (this.at < this.text.length && this.here !== "\n") this.at++;
      else return;
    }
  }
  take(pattern) {
    pattern.lastIndex = this.at;
    const found = pattern.exec(this.text);
    if (!found) return null;
    this.at = pattern.lastIndex;
    return found;
  }
}

const kNumber = /[+-]?(?:\d(?:_?\d)*)(?:\.\d(?:_?\d)*)?(?:[eE][+-]?\d+)?/y;

function read_value(text, depth = 0) {
  if (text.here === "[") return read_list(text, depth);
  const basic = text.take(/"([^"\\\n]*)"/y) ?? text.take(/'([^'\n]*)'/y);
  if (basic) return basic[1];
  const word = text.take(/true|false/y);
  if (word) return word[0] === "true";
  const number = text.take(kNumber);
  if (number) return Number(number[0].replaceAll("_", ""));
  return text.fail("no value that a mission could have");
}

function read_list(text, depth) {
  if (depth > 2) text.fail("lists in lists in lists in lists");
  text.at++;
  const list = [];
  for (;;) {
    text.skip(true);
    if (text.here === "]") break;
    list.push(read_value(text, depth + 1));
    text.skip(true);
    if (text.here === ",") text.at++;
    else if (text.here !== "]") text.fail('"," or "]" is missing');
  }
  text.at++;
  return list;
}

function end_line(text) {
  text.skip(false);
  text.take(/#[^\n]*/y);
  if (text.at < text.text.length && !text.take(/\r?\n/y)) text.fail("something stands behind the value");
}

// Throws MissionError.
export function read_mission(source) {
  const text = new Text(source);
  const mission = empty_mission();
  const seen = new Set();
  let tables = 0;
  for (text.skip(true); text.at < source.length; text.skip(true)) {
    if (text.take(/\[[ \t]*mission[ \t]*\]/y)) {
      if (tables++ > 0 || seen.size > 0) text.fail("the table [mission] comes first, and once");
      end_line(text);
      continue;
    }
    const key = text.take(/([A-Za-z0-9_-]+)[ \t]*=[ \t]*/y)?.[1];
    if (!key) text.fail("no key = value");
    if (!kOrder.includes(key)) text.fail(`${key}: no key of a mission`);
    if (seen.has(key)) text.fail(`${key}: stands twice`);
    seen.add(key);
    const line = text.line;
    mission[key] = read_value(text);
    const wrong = wrong_with(key, mission[key]);
    if (wrong) throw new MissionError(line, `${key}: ${wrong}`);
    end_line(text);
  }
  return mission;
}

// ---- What can be wrong

function is_point(value) {
  return Array.isArray(value) && value.length === 2 && value.every((x) => typeof x === "number" && Number.isFinite(x));
}

function wrong_area(corners) {
  if (!Array.isArray(corners) || !corners.every(is_point)) return "must be a list of corners [x, y]";
  return corners.length >= kLeastCorners && corners.length <= kMostCorners
    ? null
    : `must have ${kLeastCorners} to ${kMostCorners} corners, not ${corners.length}`;
}

export function wrong_with(key, value) {
  if (key in kWords) return kWords[key].includes(value) ? null : `must be ${kWords[key].map((w) => `"${w}"`).join(" or ")}`;
  if (key in kNumbers) return wrong_number(value, kNumbers[key], key);
  if (key === "goal_m" || key === "goal_deg") return is_point(value) ? null : "must be two numbers";
  if (key === "waypoints_m" || key === "waypoints_deg") {
    if (!Array.isArray(value) || !value.every(is_point)) return "must be a list of points [x, y]";
    return value.length <= kMostWaypoints ? null : `no more than ${kMostWaypoints}`;
  }
  if (key === "fence_m") return wrong_area(value);
  if (!Array.isArray(value)) return "must be a list of areas";
  if (value.length > kMostAreas) return `no more than ${kMostAreas} areas`;
  return value.map(wrong_area).find(Boolean) ?? null;
}

function wrong_number(value, [least, most], key) {
  const open = key === "goal_radius_m" || key === "speed_m_s";
  if (typeof value !== "number" || !Number.isFinite(value)) return "must be a number";
  return (open ? value > least : value >= least) && value <= most
    ? null
    : `must be ${open ? "more than" : "at least"} ${least}, and at most ${most}`;
}

// What keeps the mission from being sailed, in words; empty where nothing is known to.
export function mission_lacks(mission) {
  const lacks = [];
  if (!mission.goal_m && !mission.goal_deg) lacks.push("it has no goal: choose Goal, and tap the water");
  if (mission.goal_m && mission.goal_deg) lacks.push("goal_m and goal_deg are both given");
  for (const key of kOrder) {
    const value = mission[key];
    if (value === undefined || (Array.isArray(value) && value.length === 0)) continue;
    const wrong = wrong_with(key, value);
    if (wrong) lacks.push(`${key}: ${wrong}`);
  }
  if (lacks.length === 0 && new TextEncoder().encode(write_mission(mission)).length > kMostBytes) {
    lacks.push(`it is longer than ${kMostBytes} bytes`);
  }
  return lacks;
}

// ---- Writing

function number_text(value) {
  const rounded = Math.abs(value) < 1e7 ? String(+value.toFixed(7)) : String(value);
  return /[.e]/.test(rounded) ? rounded : `${rounded}.0`;
}

function value_text(value) {
  if (typeof value === "string") return `"${value}"`;
  if (typeof value === "number") return number_text(value);
  if (is_point(value)) return `[${value.map(number_text).join(", ")}]`;
  return `[${value.map(value_text).join(", ")}]`;
}

export function write_mission(mission) {
  const lines = [];
  for (const key of kOrder) {
    const value = mission[key];
    if (value === undefined || value === null || (Array.isArray(value) && value.length === 0)) continue;
    lines.push(`${key} = ${value_text(value)}`);
  }
  return lines.map((line) => `${line}\n`).join("");
}

export function with_position(point) {
  return point.map((x) => Math.round(x * 100) / 100);
}
