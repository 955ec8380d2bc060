// SPDX-License-Identifier: Apache-2.0
// Settings that may be changed under way, with their limits; what a value was is a press away.
import { element, finite, forbid, is_forbidden, set_text } from "./dom.js";

// As in docs/wire/command_socket.md; the boat knows least_margin_m, and refuses what is below it.
const kKnown = {
  "mission.speed_limit_m_s": { label: "Speed limit", unit: "m/s", least: 0.01, most: 10, slide: 3, step: 0.01 },
  "zones.margin_m": { label: "Margin round obstacles", unit: "m", least: 0, most: 20, slide: 5, step: 0.05 },
  "pilot.side_gain_m": { label: "Pilot: cost of the other side", unit: "m", least: 0, most: 100, slide: 10, step: 0.1 },
  "pilot.manoeuvre_gain_s": { label: "Pilot: cost of a manoeuvre", unit: "s", least: 0, most: 100, slide: 10, step: 0.1 },
  "control.heading_gain_per_deg": { label: "Heading gain", unit: "/°", least: 0.01, most: 100, slide: 10, step: 0.05 },
};

export class Tuning {
  #command;
  #say_reply;
  #rows = new Map();
  #box;
  #said;
  #first = {};

  constructor(panel, store, command, say_reply) {
    this.#command = command;
    this.#say_reply = say_reply;
    this.#box = element("div", { class: "tunables" });
    this.#said = element("p", { class: "facts" }, "What is set here is lost when lodesman-high ends.");
    panel.append(this.#said, this.#box);
    store.on("status", ({ tunables }) => {
      if (tunables) this.#show(tunables);
    });
  }

  #show(tunables) {
    for (const [key, value] of Object.entries(tunables)) {
      if (key === "version" || !finite(value)) continue;
      this.#first[key] ??= value;
      const row = this.#rows.get(key) ?? this.#add(key);
      row.value = value;
      set_text(row.now, String(+value.toPrecision(6)));
      row.back.hidden = value === this.#first[key];
      row.back.textContent = `back to ${+this.#first[key].toPrecision(6)}`;
      if (!row.editing) this.#mirror(row, value);
    }
  }

  #add(key) {
    const known = kKnown[key] ?? { label: key, unit: "", least: 0, most: 100, slide: 100, step: 0.1 };
    const id = `tune_${key.replaceAll(".", "_")}`;
    const bounds = { min: String(known.least), step: String(known.step) };
    const number = element("input", { id, type: "number", ...bounds, max: String(known.most), inputmode: "decimal" });
    const slider = element("input", { type: "range", ...bounds, max: String(known.slide), "aria-label": `${known.label}, slider` });
    const set = element("button", { type: "button", class: "order", onclick: () => this.#set(key, Number(number.value)) }, "Set");
    const back = element("button", { type: "button", class: "quiet", hidden: true, onclick: () => this.#set(key, this.#first[key]) });
    const now = element("output", { for: id });
    const row = { number, slider, set, back, now, known, editing: false, value: null };
    const edit = (from, to) => () => {
      row.editing = true;
      to.value = from.value;
    };
    number.addEventListener("input", edit(number, slider));
    slider.addEventListener("input", edit(slider, number));
    slider.addEventListener("change", () => this.#set(key, Number(slider.value)));
    number.addEventListener("keydown", (event) => {
      if (event.key === "Enter") this.#set(key, Number(number.value));
    });
    this.#box.append(element("div", { class: "tunable" },
      element("label", { for: id }, known.label, element("i", {}, ` ${known.unit}`)), now, slider, number, set, back,
      element("span", { class: "limits" }, `${known.least} to ${known.most} · ${key}`)));
    this.#rows.set(key, row);
    return row;
  }

  #mirror(row, value) {
    if (document.activeElement !== row.number) row.number.value = String(+value.toPrecision(6));
    if (document.activeElement !== row.slider) row.slider.value = String(value);
  }

  async #set(key, value) {
    const row = this.#rows.get(key);
    const { known } = row;
    if (is_forbidden(row.set)) {
      this.#say_reply(known.label, { ok: false, error: row.set.title });
    } else if (!finite(value) || value < known.least || value > known.most) {
      this.#say_reply(known.label, { ok: false, error: `must be ${known.least} to ${known.most}` });
    } else {
      const reply = await this.#command.say({ command: "tune", set: { [key]: value } });
      this.#say_reply(`${known.label} ${value}`, reply);
      if (reply.tunables) this.#show(reply.tunables);
    }
    row.editing = false;
    this.#mirror(row, row.value);
  }

  refresh(link) {
    const reason = this.#command.why_not("tune", link);
    for (const { number, slider, set } of this.#rows.values()) {
      forbid(set, reason);
      number.disabled = slider.disabled = Boolean(reason);
    }
    set_text(this.#said, reason ? `Not now: ${reason}.` : "What is set here is lost when lodesman-high ends.");
  }
}
