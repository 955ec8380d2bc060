// SPDX-License-Identifier: Apache-2.0
// The readings below the world, and the lamps above it: state in a word, a sign and a colour each.
import { element, finite, number_text, set_attribute, set_text, span_text } from "./dom.js";
import { distance } from "./geometry.js";
import { kCauses, kStates, kThrust, plain } from "./words.js";

const kReadings = [
  ["heading", "Heading", "°", ({ boat }) => heading_text(boat?.heading_deg)],
  ["reference", "Course", "°", ({ boat }) => heading_text(boat?.heading_ref_deg)],
  ["speed", "Speed", "m/s", ({ boat }) => number_text(boat?.speed_m_s, 2)],
  ["goal", "To goal", "m", ({ boat, world }) => goal_text(boat, world)],
  ["clear", "Clear", "m", ({ boat }) => number_text(boat?.inoffensive_distance_m, 1)],
  ["off", "Off line", "m", ({ boat }) => number_text(boat?.cross_track_m, 2)],
  ["sigma", "Doubt σ", "m", ({ boat }) => number_text(boat?.sigma_m, 2)],
  ["time", "Mission", "", ({ status }) => (finite(status?.time_s) && status.mission ? clock_text(status.time_s) : "–")],
];

const heading_text = (deg) => (finite(deg) ? String(Math.round(deg) % 360).padStart(3, "0") : "–");
const goal_text = (boat, world) =>
  boat?.position_m && world?.goal_m ? number_text(distance(boat.position_m, world.goal_m), 1) : "–";
const clock_text = (s) => `${Math.floor(s / 60)}:${String(Math.floor(s % 60)).padStart(2, "0")}`;

export class Readouts {
  #values = [];
  #bars = {};

  constructor(list) {
    for (const [name, label, unit, read] of kReadings) {
      const value = element("b", {}, "–");
      list.append(element("div", { class: `reading reading_${name}` }, element("dt", {}, label), element("dd", {}, value, element("i", {}, unit))));
      this.#values.push({ value, read });
    }
    list.append(this.#thrust());
  }

  #thrust() {
    const side = (name, label) => {
      const fill = element("span", { class: "fill" });
      const value = element("b", {}, "–");
      this.#bars[name] = { fill, value };
      return element("div", { class: `bar bar_${name}` }, element("abbr", { title: `${name} thruster` }, label), element("span", { class: "tube" }, fill), value);
    };
    return element("div", { class: "reading thrust" }, element("dt", {}, "Thrust %"), element("dd", {}, side("left", "L"), side("right", "R")));
  }

  render(newest) {
    for (const { value, read } of this.#values) set_text(value, read(newest));
    for (const name of ["left", "right"]) {
      const share = newest.boat?.[`thrust_${name}`];
      const { fill, value } = this.#bars[name];
      const known = finite(share) ? Math.max(-1, Math.min(1, share)) : 0;
      set_attribute(fill, "style", `left: ${(50 + Math.min(0, known) * 50).toFixed(1)}%; width: ${(Math.abs(known) * 50).toFixed(1)}%`);
      set_text(value, finite(share) ? (share * 100).toFixed(0).replace("-0", "0") : "–");
    }
  }
}

// ---- Lamps. Kinds: good, idle, note, warning, alarm; unknown where nothing is known.

const kSigns = { good: "●", idle: "○", note: "◆", warning: "▲", alarm: "■", unknown: "?" };

function mission_lamp({ status }) {
  if (!status || status.ok === false) return ["unknown", "–"];
  const kind = { idle: "idle", under_way: "good", holding: "note", reached: "good", aborted: "warning" }[status.state];
  const cause = status.cause && status.cause !== "order" && status.cause !== "none" ? ` (${kCauses[status.cause] ?? plain(status.cause)})` : "";
  return [kind ?? "unknown", `${kStates[status.state] ?? plain(status.state)}${cause}`];
}

function thrust_lamp({ status }) {
  const state = status?.thrust?.state;
  if (!state) return ["unknown", "–"];
  const kind = { disarmed: "idle", armed: "note", manual: "note", stopped: "alarm" }[state];
  return [kind ?? "unknown", kThrust[state] ?? plain(state)];
}

function guard_lamp({ status }) {
  const state = status?.guard?.state;
  if (!state) return ["unknown", "–"];
  const kind = { off: "warning", overridden: "warning", idle: "idle", blind: "alarm", watching: "good", braking: "alarm", holding: "warning" }[state];
  return [kind ?? "unknown", plain(state)];
}

function place_lamp({ status }) {
  const trust = status?.position_trust;
  if (!trust) return ["unknown", "–"];
  const kind = { tracked: "good", reckoned: "note", bridged: "note", approaching: "warning", frozen: "warning", lost: "alarm" }[trust];
  return [kind ?? "unknown", plain(trust)];
}

function battery_lamp({ status }) {
  const battery = status?.battery;
  if (!battery) return ["idle", "not told"];
  const kind = { good: "good", low: "warning", critical: "alarm", unknown: "unknown" }[battery.level];
  return [kind ?? "unknown", finite(battery.volts) ? `${battery.volts.toFixed(1)} V` : plain(battery.level)];
}

const kLamps = [
  ["Mission", mission_lamp], ["Thrusters", thrust_lamp], ["Guard", guard_lamp],
  ["Position", place_lamp], ["Battery", battery_lamp],
];

export class Lamps {
  #lamps = [];
  #link;

  constructor(list) {
    for (const [label, read] of kLamps) this.#lamps.push({ ...lamp(list, label), read });
    this.#link = lamp(list, "Link");
    this.#link.item.classList.add("link");
  }

  render(newest, is_old, age_ms) {
    for (const { item, sign, value, read } of this.#lamps) {
      const [kind, text] = read(newest);
      light(item, sign, value, is_old ? "unknown" : kind, is_old && text !== "–" ? `was ${text}` : text);
    }
    const { item, sign, value } = this.#link;
    const age = Number.isFinite(age_ms) ? span_text(age_ms / 1000) : "none";
    light(item, sign, value, is_old ? "alarm" : "good", is_old ? `LOST ${age}` : age_ms < 1000 ? "live" : age);
  }
}

function lamp(list, label) {
  const sign = element("span", { class: "lamp_sign", "aria-hidden": "true" });
  const value = element("b", {}, "–");
  const item = element("li", { class: "lamp" }, sign, element("span", { class: "lamp_label" }, label), value);
  list.append(item);
  return { item, sign, value };
}

function light(item, sign, value, kind, text) {
  set_attribute(item, "data-kind", kind);
  set_text(sign, kSigns[kind]);
  set_text(value, text);
}
