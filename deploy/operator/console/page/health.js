// SPDX-License-Identifier: Apache-2.0
// Devices, guard, battery, ages and the state of the thrusters, with what a name means beside it.
import { element, finite, number_text, set_attribute, set_text, span_text } from "./dom.js";
import { kCauses, kRungs, kStates, kThrust, plain } from "./words.js";

const kDevices = ["heading", "sonar", "position", "thrusters"];
const kAgeLimits_s = { attitude: 0.3, position_fix: 3, state: 0.4, sonar: 2, tracks: 2, plan: 1, helm: 0.3, thrust: 0.5 };
const kSigns = { good: "●", idle: "○", warning: "▲", alarm: "■" };

const kind_of_device = ({ status, fault }) =>
  status === "working" ? (fault && fault !== "none" ? "warning" : "good") : status === "absent" ? "idle" : status === "awaited" ? "warning" : "alarm";

export class Health {
  #parts = {};
  #store;

  constructor(panel, store) {
    this.#store = store;
    for (const [name, title] of [["devices", "Devices"], ["mission", "Mission"], ["thrust", "Thrusters, guard, battery"], ["ages", "Ages"], ["warnings", "Warnings"]]) {
      const list = element("dl", { class: "facts_list" });
      panel.append(element("h3", {}, title), list);
      this.#parts[name] = { list, rows: new Map() };
    }
  }

  render() {
    const { status, boat } = this.#store.newest;
    if (status?.ok === false) {
      this.#fill("warnings", [["Boat", "alarm", `does not answer: ${status.error}`]]);
      return;
    }
    if (status) {
      this.#fill("devices", kDevices.map((name) => device_row(name, status.devices?.[name])));
      this.#fill("mission", mission_rows(status));
      this.#fill("thrust", thrust_rows(status));
      const warnings = [...(status.warnings ?? []).map((text) => ["Beware", "warning", text]), ...(status.not_ready ?? []).map((text) => ["Not ready", "warning", text])];
      this.#fill("warnings", warnings.length > 0 ? warnings : [["None", "good", ""]]);
    }
    if (boat?.ages_s) this.#fill("ages", Object.entries(boat.ages_s).map(age_row));
  }

  // Rows are kept and changed, so that neither focus nor a reader loses its place.
  #fill(part, rows) {
    const { list, rows: kept } = this.#parts[part];
    const wanted = new Set();
    for (const [i, [label, kind, text]] of rows.entries()) {
      const key = `${label} ${label === "Beware" || label === "Not ready" ? i : ""}`;
      wanted.add(key);
      let row = kept.get(key);
      if (!row) {
        const sign = element("span", { class: "lamp_sign", "aria-hidden": "true" });
        const value = element("span", { class: "value" });
        const node = element("div", {}, element("dt", {}, sign, ` ${label}`), element("dd", {}, value));
        row = { sign, value, node };
        kept.set(key, row);
        list.append(node);
      }
      set_attribute(row.node, "data-kind", kind);
      set_text(row.sign, kSigns[kind] ?? "·");
      set_text(row.value, text);
    }
    for (const [key, { node }] of kept) {
      if (wanted.has(key)) continue;
      node.remove();
      kept.delete(key);
    }
  }
}

function device_row(name, device) {
  if (!device) return [name, "idle", "not told"];
  const counts = ["corrupt", "refused", "disconnections"].filter((count) => device[count] > 0).map((count) => `${device[count]} ${count}`);
  const ails = device.fault && device.fault !== "none" ? `: ${device.means ?? plain(device.fault)}` : "";
  const rest = [span_text(device.for_s), ...counts].join(", ");
  return [name, kind_of_device(device), `${device.status}${ails} (${rest})`];
}

function mission_rows(status) {
  const rows = [["State", "good", `${kStates[status.state] ?? status.state}${status.cause ? `, ${kCauses[status.cause] ?? plain(status.cause)}` : ""}`]];
  rows.push(["Mission", "good", status.mission ? `number ${status.mission}, ${number_text(status.speed_m_s, 2)} m/s` : "none yet"]);
  if (status.helm) rows.push(["Helm", status.helm.startsWith("stale") ? "alarm" : "good", plain(status.helm)]);
  const { plan } = status;
  if (plan) {
    const kind = plan.reason === "found" ? "good" : "warning";
    rows.push(["Plan", kind, `${plain(plan.reason)}, ${kRungs[plan.rung] ?? plain(plan.rung)}, ${span_text(plan.age_s)} old`]);
  }
  if (status.no_way?.cause && status.no_way.cause !== "none") rows.push(["No way", "alarm", `${plain(status.no_way.cause)} for ${span_text(status.no_way.for_s)}`]);
  if (status.blocked) rows.push(["Blocked", "warning", `for ${span_text(status.blocked.for_s)}`]);
  rows.push(["Position", status.position_trust === "tracked" ? "good" : "warning", `${plain(status.position_trust)}, σ ${number_text(status.position_sigma_m, 2)} m`]);
  rows.push(["Aborts", "idle", String(status.aborts ?? 0)]);
  return rows;
}

function thrust_rows({ thrust, guard, battery, commander }) {
  const rows = [];
  if (thrust) {
    const kind = { armed: "good", stopped: "alarm", manual: "warning" }[thrust.state] ?? "idle";
    rows.push(["Thrusters", kind, `${kThrust[thrust.state] ?? thrust.state}, ${kCauses[thrust.cause] ?? plain(thrust.cause)}, for ${span_text(thrust.for_s)}`]);
    if (thrust.against_arming?.length) rows.push(["Against arming", "warning", thrust.against_arming.join("; ")]);
  }
  if (guard) {
    const kind = { watching: "good", idle: "idle" }[guard.state] ?? "warning";
    rows.push(["Guard", kind, `${plain(guard.state)} for ${span_text(guard.for_s)}, ${guard.trips} trips`]);
    const trip = guard.last_trip;
    if (trip) rows.push(["Last trip", "warning", `${trip.reason}, ${span_text(trip.ago_s)} ago, ${number_text(trip.distance_m, 2)} m off at ${number_text(trip.speed_m_s, 2)} m/s`]);
  }
  if (battery) {
    const rest = finite(battery.rest_volts) ? `, ${battery.rest_volts.toFixed(1)} V at rest` : "";
    rows.push(["Battery", { good: "good", low: "warning", critical: "alarm" }[battery.level] ?? "idle", `${battery.level}, ${number_text(battery.volts, 1)} V${rest}`]);
  }
  rows.push(["Command", "idle", commander ? `${commander.name || "another session"} for ${span_text(commander.for_s)}` : "nobody's"]);
  return rows;
}

function age_row([name, age]) {
  const limit = kAgeLimits_s[name] ?? 2;
  const kind = !finite(age) ? "idle" : age > limit ? "alarm" : age > limit / 2 ? "warning" : "good";
  return [plain(name), kind, finite(age) ? `${age.toFixed(2)} s, old from ${limit} s` : "never"];
}
