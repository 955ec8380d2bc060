// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { page_module } from "./page_modules.mjs";

const { MissionError, mission_lacks, read_mission, write_mission } = await page_module("mission_text.js");
const { Draft } = await page_module("mission_draft.js");

const whole = `# a pond
waypoints_m = [[3.0, 8.0], [4, 9.5]]       # in order
goal_m = [6.0, 16.0]
goal_radius_m = 0.5
speed_m_s = 0.42
link_lost = "hold"
link_lost_after_s = 5.0
on_restart = 'resume'
blocked = "skip"
blocked_patience_s = 1_20.0
legs = "line"
fence_m = [
  [-15.0, -5.0], [15.0, -5.0],   # the south
  [15.0, 30.0], [-15.0, 30.0],
]
keep_out_m = [[[8.0, 4.0], [12.0, 4.0], [12.0, 9.0]]]
`;

const refused = (text, pattern) =>
  assert.throws(() => read_mission(text), (error) => error instanceof MissionError && pattern.test(error.message));

test("mission: a file with every key is read", () => {
  const mission = read_mission(whole);
  assert.deepEqual(mission.waypoints_m, [[3, 8], [4, 9.5]]);
  assert.deepEqual(mission.goal_m, [6, 16]);
  assert.equal(mission.on_restart, "resume");
  assert.equal(mission.blocked_patience_s, 120);
  assert.equal(mission.fence_m.length, 4);
  assert.deepEqual(mission.keep_out_m, [[[8, 4], [12, 4], [12, 9]]]);
  assert.deepEqual(mission_lacks(mission), []);
});

test("mission: what is written reads the same", () => {
  const mission = read_mission(whole);
  const text = write_mission(mission);
  assert.deepEqual(read_mission(text), mission);
  assert.equal(write_mission(read_mission(text)), text);
});

test("mission: whole numbers are written as the fractions that the boat's reader wants", () => {
  assert.equal(write_mission({ goal_m: [5, -20], speed_m_s: 1 }), "goal_m = [5.0, -20.0]\nspeed_m_s = 1.0\n");
  assert.match(write_mission({ goal_m: [1 / 3, 2] }), /\[0\.3333333, 2\.0\]/);
});

test("mission: a table [mission] before all is left out", () => {
  assert.deepEqual(read_mission("[mission]\ngoal_m = [1, 2]\n").goal_m, [1, 2]);
  refused("goal_m = [1, 2]\n[mission]\n", /line 2/);
});

test("mission: degrees are kept as they are", () => {
  const mission = read_mission("goal_deg = [35.0001, 139.00012]\n");
  assert.deepEqual(mission.goal_deg, [35.0001, 139.00012]);
  assert.equal(write_mission(mission), "goal_deg = [35.0001, 139.00012]\n");
});

test("mission: what cannot be is refused with its line", () => {
  refused("goal_m = [1, 2]\nspeed_m_s = 0\n", /line 2: speed_m_s: must be more than 0/);
  refused("goal = [1, 2]\n", /line 1: goal: no key of a mission/);
  refused("goal_m = [1, 2]\ngoal_m = [1, 2]\n", /line 2: goal_m: stands twice/);
  refused("goal_m = [1, 2, 3]\n", /goal_m: must be two numbers/);
  refused('link_lost = "stay"\n', /link_lost: must be "go_on" or "hold"/);
  refused("fence_m = [[0,0],[1,1]]\n", /3 to 31 corners, not 2/);
  refused("goal_m = [1, 2] 3\n", /something stands behind/);
  refused("goal_m = [1 2]\n", /missing/);
  refused("goal_m = [1, 2", /missing/);
  refused("goal_m =\n", /no value/);
  refused("link_lost_after_s = 1.0\n", /at least 1.5/);
  refused('colregs = "on"\n', /colregs/);
});

test("mission: bytes of chance are read or refused, and nothing else", () => {
  let state = 12345;
  const chance = (n) => (state = (state * 1103515245 + 12345) & 0x7fffffff) % n;
  for (let i = 0; i < 4000; i++) {
    const letters = [...whole];
    for (let k = 0; k < 1 + chance(4); k++) letters.splice(chance(letters.length), chance(3), String.fromCharCode(32 + chance(95)));
    try {
      const mission = read_mission(letters.join(""));
      assert.deepEqual(read_mission(write_mission(mission)), mission);
    } catch (error) {
      if (!(error instanceof MissionError)) throw error;
    }
  }
});

test("draft: taps lay out a mission, which start takes along until it was started", () => {
  const draft = new Draft();
  assert.equal(draft.pending, false);
  draft.tap("goal", [5.004, 20], 0.5);
  draft.tap("waypoint", [1, 2], 0.5);
  draft.tap("waypoint", [3, 4], 0.5);
  assert.equal(draft.text, "waypoints_m = [[1.0, 2.0], [3.0, 4.0]]\ngoal_m = [5.0, 20.0]\n");
  assert.equal(draft.pending, true);
  assert.deepEqual(draft.lacks, []);
  assert.equal(Math.round(draft.length_m([0, 0])), 21);
});

test("draft: a point is dragged, taken away, and comes back by undo", () => {
  const draft = new Draft();
  draft.tap("goal", [5, 20], 0.5);
  draft.tap("waypoint", [1, 2], 0.5);
  assert.equal(draft.grab([1.2, 2], 0.5), true);
  draft.drag([2, 3]);
  draft.drag([2.5, 3]);
  draft.drop();
  assert.deepEqual(draft.mission.waypoints_m, [[2.5, 3]]);
  assert.equal(draft.remove([2.4, 3], 0.5), true);
  assert.deepEqual(draft.mission.waypoints_m, []);
  draft.undo();
  draft.undo();
  assert.deepEqual(draft.mission.waypoints_m, [[1, 2]]);
  assert.equal(draft.grab([9, 9], 0.5), false);
});

test("draft: a tap on a point that is there adds none", () => {
  const draft = new Draft();
  draft.tap("waypoint", [1, 2], 0.5);
  draft.tap("waypoint", [1.1, 2], 0.5);
  assert.equal(draft.mission.waypoints_m.length, 1);
});

test("draft: corners go between their neighbours, and an area needs three", () => {
  const draft = new Draft();
  for (const at of [[0, 0], [10, 0], [10, 10], [0, 10]]) draft.tap("fence", at, 0.1);
  draft.tap("fence", [11, 5], 0.1);
  assert.deepEqual(draft.mission.fence_m[2], [11, 5]);
  draft.tap("keep_out", [3, 3], 0.1);
  assert.match(draft.lacks.join(), /goal/);
  assert.match(draft.lacks.join(), /keep_out_m: must have 3 to 31/);
});

test("draft: a file that cannot be read changes nothing", () => {
  const draft = new Draft();
  draft.tap("goal", [5, 20], 0.5);
  assert.throws(() => draft.read("goal_m = 1"));
  assert.deepEqual(draft.mission.goal_m, [5, 20]);
});

test("draft: the boat's mission is taken over", () => {
  const draft = new Draft();
  draft.take_over({ mission_m: [[1, 2], [3, 4.129]], goal_m: [3, 4.129], goal_radius_m: 0.5, fence_m: null, keep_out_m: [] });
  assert.equal(draft.text, "waypoints_m = [[1.0, 2.0]]\ngoal_m = [3.0, 4.13]\ngoal_radius_m = 0.5\n");
});
