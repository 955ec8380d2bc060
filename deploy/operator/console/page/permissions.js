// SPDX-License-Identifier: Apache-2.0
// Which word may be given now, and why not, as the boat would say it (docs/wire/command_socket.md). The
// boat is the judge: this only saves the asking. Knows no page.

const kScopes = { view: 0, abort: 1, command: 2 };
const kScopeOf = { status: 0, abort: 1, disarm: 1, estop: 1 };
const kFree = new Set(["status", "abort", "disarm", "estop", "take", "heartbeat", "release"]);
export const kStops = new Set(["abort", "estop"]);

// `now`: {recording, scope, link, status, commander, mine}. Null where it may be given, else the reason.
export function why_not(word, now) {
  if (now.recording) return "this is a recording: nothing can be ordered";
  if ((kScopes[now.scope] ?? -1) < (kScopeOf[word] ?? 2)) {
    return `the token that you signed in with is not good for ${plain(word)}`;
  }
  if (kStops.has(word)) return null;
  if (!now.link) return "the link is lost";
  const { status } = now;
  if (!status) return "the boat has not told its state yet";
  if (status.ok === false) return `the boat does not answer: ${status.error}`;
  if (!kFree.has(word) && now.commander && !now.mine) {
    return `command is held by "${now.commander.name || "another session"}"; take it first`;
  }
  return by_state[word]?.(status, now) ?? null;
}

// What somebody who means to sail would do next, in a sentence.
export function next_step(now) {
  const { status } = now;
  if (now.recording) return "This is a recording: look, but nothing can be ordered.";
  if (!now.link) return "Nothing but the stops is given while the link is lost.";
  if (!status || status.ok === false) return "";
  if (status.thrust?.state === "stopped") return "Stopped: find out why, then Release stop, Arm, Start.";
  if (status.state === "under_way") return "Hold keeps its place; ABORT ends the mission with neutral thrust.";
  if (status.state === "holding") return "It holds: propellers turn. Resume goes on.";
  const lacks = status.not_ready ?? [];
  if (lacks.length > 0) return `Not ready: ${lacks.join("; ")}.`;
  return now.draft ? "Ready. Start sails the drawn mission." : "Ready. Start sails the mission at hand; draw another under Mission.";
}

function plain(word) {
  return { estop: "E-STOP", estop_release: "releasing the stop" }[word] ?? word;
}

const list = (reasons) => (reasons?.length ? reasons.join("; ") : null);
const no_mission = "no mission is";
const kState = { idle: "idle", under_way: "under way", holding: "holding", reached: "at its goal", aborted: "aborted" };

const by_state = {
  arm({ thrust, state }) {
    if (!thrust) return "the thrusters have not told their state";
    if (thrust.state !== "disarmed" && thrust.state !== "stopped" && state !== "aborted") return `they are ${thrust.state} already`;
    return list(thrust.against_arming);
  },
  disarm({ thrust }) {
    if (thrust?.state === "disarmed") return "they are disarmed already";
    return thrust?.state === "stopped" ? "they are stopped, which is stronger" : null;
  },
  start({ not_ready, state }, now) {
    if (state === "under_way" && !now.draft) return "it is under way already";
    return list(not_ready);
  },
  hold({ state }) {
    return state === "under_way" ? null : `${no_mission} under way: it is ${kState[state] ?? state}`;
  },
  resume({ state }) {
    return state === "holding" ? null : `${no_mission} held: it is ${kState[state] ?? state}`;
  },
  estop_release({ thrust }) {
    return thrust?.state === "stopped" ? null : "nothing is stopped";
  },
  manual({ thrust, state }) {
    if (thrust?.state === "stopped") return "the emergency stop is latched: release it, then arm";
    if (thrust?.state === "disarmed") return "the thrusters are disarmed: arm first";
    return state === "aborted" && thrust?.state === "armed" && thrust.cause === "abort" ? "an abort stands: arm again first" : null;
  },
  take(_, { mine }) {
    return mine ? "you have it" : null;
  },
  release(_, { mine }) {
    return mine ? null : "you do not have it";
  },
};
