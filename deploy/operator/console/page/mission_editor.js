// SPDX-License-Identifier: Apache-2.0
// The panel in which a mission is drawn on the world, set, read, saved and loaded.
import { by_id, element, set_attribute, set_text } from "./dom.js";
import { Draft } from "./mission_draft.js";
import { diamond } from "./pen.js";
import { draw_goal } from "./world_draw.js";

const kTools = [
  ["look", "Look", ""],
  ["goal", "Goal", "Tap where the goal is"],
  ["waypoint", "Waypoint", "Tap the waypoints in their order"],
  ["fence", "Fence", "Tap the corners of the fence"],
  ["keep_out", "Keep-out", "Tap the corners of an area to keep out of"],
];
const kHint = " · drag to move · right click or Delete takes away";

const kFields = [
  { key: "speed_m_s", label: "Speed", unit: "m/s", step: 0.01 },
  { key: "goal_radius_m", label: "Goal radius", unit: "m", step: 0.1 },
  { key: "legs", label: "Legs", choices: [["free", "any clear way"], ["line", "along the lines"]] },
  { key: "link_lost", label: "If the link is lost", choices: [["go_on", "go on"], ["hold", "hold"], ["return", "return to the start"], ["abort", "abort"]] },
  { key: "link_lost_after_s", label: "… for more than", unit: "s", step: 0.5 },
  { key: "blocked", label: "If a waypoint is blocked", choices: [["hold", "hold"], ["skip", "skip it"]] },
  { key: "blocked_patience_s", label: "… for more than", unit: "s", step: 1 },
  { key: "on_restart", label: "After a restart", choices: [["hold", "hold"], ["resume", "sail on"]] },
];

export class MissionEditor {
  #panel;
  #store;
  #view;
  #tools = new Map();
  #fields = new Map();
  #tool = "look";
  draft = new Draft();

  constructor(panel, store, view) {
    this.#panel = panel;
    this.#store = store;
    this.#view = view;
    this.draft.changed = () => this.#show();
    panel.append(this.#build_tools(), this.#build_facts(), this.#build_fields(), this.#build_points(), this.#build_text());
    view.overlay = (pen) => this.#draw(pen);
    this.#show();
  }

  // For the order "start": what it takes along, or null for the mission at hand.
  get mission() {
    return this.draft.pending ? { text: this.draft.text, lacks: this.draft.lacks } : null;
  }
  started() {
    this.draft.pending = false;
    this.choose("look");
    this.#show();
  }

  // ---- Building

  #build_tools() {
    const row = element("div", { class: "row tools_row", role: "radiogroup", "aria-label": "Tool in hand" });
    for (const [tool, label] of kTools) {
      const button = element("button", { type: "button", id: `tool_${tool}`, role: "radio", "aria-checked": "false", onclick: () => this.choose(tool) }, label);
      this.#tools.set(tool, button);
      row.append(button);
    }
    return row;
  }

  #build_facts() {
    const act = (id, label, does, about) => element("button", { type: "button", id, class: "quiet", title: about, onclick: does }, label);
    this.undo = act("mission_undo", "Undo", () => this.draft.undo());
    const file = element("input", { type: "file", id: "mission_file", accept: ".toml,text/plain", hidden: true, onchange: () => this.#load(file) });
    return element(
      "div", {},
      element("p", { id: "mission_facts", class: "facts", "aria-live": "polite" }),
      element("div", { class: "row" },
        this.undo,
        act("mission_clear", "Clear", () => this.draft.clear()),
        act("mission_from_boat", "From the boat", () => this.#take_over(), "The mission that the boat has"),
        act("mission_load", "Load …", () => file.click(), "From a .toml file"),
        act("mission_save", "Save", () => this.#save(), "As a .toml file"), file),
    );
  }

  #build_fields() {
    const box = element("div", { class: "fields" });
    for (const field of kFields) {
      const id = `mission_${field.key}`;
      const control = field.choices
        ? element("select", { id }, element("option", { value: "" }, "as configured"), ...field.choices.map(([value, text]) => element("option", { value }, text)))
        : element("input", { id, type: "number", step: String(field.step), min: "0", placeholder: "as configured", inputmode: "decimal" });
      control.addEventListener("change", () => this.#set(field, control.value));
      this.#fields.set(field.key, control);
      box.append(element("label", { for: id }, field.label, field.unit ? element("i", {}, ` ${field.unit}`) : null), control);
    }
    return box;
  }

  #build_points() {
    this.points = element("ol", { class: "points", "aria-label": "Points of the mission" });
    return this.points;
  }

  #build_text() {
    this.text = element("textarea", { id: "mission_text", rows: "9", spellcheck: "false", "aria-label": "The mission as a file", "aria-describedby": "mission_text_said" });
    this.text.addEventListener("change", () => this.#read(this.text.value));
    this.text_said = element("p", { id: "mission_text_said", role: "status", class: "wrong" });
    return element("details", { class: "text_view", id: "mission_text_view" }, element("summary", {}, "As a file"), this.text, this.text_said);
  }

  // ---- Acting

  choose(tool) {
    this.#tool = tool;
    const hint = kTools.find(([name]) => name === tool)[2];
    if (tool === "keep_out") this.draft.new_area();
    this.#view.take_tool(tool === "look" ? null : {
      hint: hint + kHint,
      grab: (at, reach) => this.draft.grab(at, reach),
      drag: (at) => this.draft.drag(at),
      drop: () => this.draft.drop(),
      tap: (at, reach) => this.draft.tap(tool, at, reach),
      remove: (at, reach) => this.draft.remove(at, reach),
    });
    for (const [name, button] of this.#tools) set_attribute(button, "aria-checked", String(name === tool));
  }

  #set({ key, choices }, value) {
    this.draft.set(key, value === "" ? undefined : choices ? value : Number(value));
  }

  #take_over() {
    const { world } = this.#store.newest;
    if (world) this.draft.take_over(world);
  }

  #read(text) {
    try {
      this.draft.read(text);
      set_text(this.text_said, "");
    } catch (error) {
      set_text(this.text_said, error.message);
    }
  }

  async #load(file) {
    const [chosen] = file.files;
    if (!chosen) return;
    const text = await chosen.text();
    file.value = "";
    this.#read(text);
    if (this.text_said.textContent) {
      this.text.value = text;
      by_id("mission_text_view").open = true;
    }
  }

  #save() {
    const address = URL.createObjectURL(new Blob([this.draft.text], { type: "application/toml" }));
    element("a", { href: address, download: "mission.toml" }).click();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
  }

  // ---- Showing

  #show() {
    const { mission } = this.draft;
    for (const { key } of kFields) {
      const control = this.#fields.get(key);
      if (document.activeElement !== control) control.value = mission[key] ?? "";
    }
    if (document.activeElement !== this.text) this.text.value = this.draft.text;
    this.undo.disabled = !this.draft.can_undo;
    set_text(by_id("mission_facts"), this.#facts());
    this.#show_points();
    this.#view.dirty = true;
  }

  #facts() {
    if (this.draft.is_empty) return "No mission is drawn. Choose Goal, and tap the water; or take the boat's, or load one.";
    const { lacks } = this.draft;
    if (lacks.length > 0) return `Not whole: ${lacks.join("; ")}.`;
    const { boat, status } = this.#store.newest;
    const long = this.draft.length_m(boat?.position_m, status?.origin?.deg);
    const { waypoints } = this.draft.way(status?.origin?.deg);
    const way = `${waypoints.length} waypoints and the goal, ${long.toFixed(1)} m from here along the lines`;
    const time = this.draft.mission.speed_m_s ? `, ${(long / this.draft.mission.speed_m_s / 60).toFixed(1)} min` : "";
    return `${way}${time}. ${this.draft.pending ? "Start takes it along." : "It was started."}`;
  }

  #show_points() {
    const named = { goal: "Goal", waypoint: "Waypoint", fence: "Fence", keep_out: "Keep-out" };
    const items = this.draft.handles().map((handle) => {
      const place = handle.kind === "goal" ? "" : ` ${handle.area === undefined ? "" : `${handle.area + 1}.`}${handle.i + 1}`;
      const input = (axis) => element("input", {
        type: "number", step: "0.1", value: String(handle.at[axis]), "aria-label": `${named[handle.kind]}${place} ${axis === 0 ? "x east" : "y north"} in metres`,
        onchange: (event) => this.#move(handle, axis, Number(event.target.value)),
      });
      return element("li", { "data-kind": handle.kind }, element("span", {}, `${named[handle.kind]}${place}`), input(0), input(1),
        element("button", { type: "button", class: "quiet", "aria-label": `Take ${named[handle.kind]}${place} away`, onclick: () => this.draft.remove(handle.at, 0) }, "×"));
    });
    if (!this.points.contains(document.activeElement)) this.points.replaceChildren(...items);
  }

  #move(handle, axis, value) {
    if (!Number.isFinite(value)) return;
    document.activeElement?.blur();
    const to = [...handle.at];
    to[axis] = value;
    if (this.draft.grab(handle.at, 0)) this.draft.drag(to);
    this.draft.drop();
  }

  #draw(pen) {
    const { c, view, colours } = pen;
    const { mission } = this.draft;
    if (this.draft.is_empty || (!this.draft.pending && this.#tool === "look")) return;
    const line = (points, closed, dash, width) => {
      if (points.length === 0) return;
      c.beginPath();
      points.forEach((at, i) => (i === 0 ? c.moveTo(...view.to_screen(at)) : c.lineTo(...view.to_screen(at))));
      if (closed) c.closePath();
      c.setLineDash(dash);
      c.lineWidth = width;
      c.strokeStyle = colours.draft;
      c.stroke();
      c.setLineDash([]);
    };
    const { boat, status } = this.#store.newest;
    const { waypoints, goal } = this.draft.way(status?.origin?.deg);
    line([boat?.position_m, ...waypoints, goal].filter(Boolean), false, [9, 5], 2);
    line(mission.fence_m ?? [], true, [14, 4, 2, 4], 2.5);
    for (const corners of mission.keep_out_m ?? []) line(corners, true, [6, 3], 2);
    waypoints.forEach((at, i) => diamond(pen, at, 8, colours.draft, String(i + 1)));
    if (goal) draw_goal(pen, goal, mission.goal_radius_m, colours.draft, "new goal");
    for (const { at, kind } of this.draft.handles()) {
      if (kind !== "fence" && kind !== "keep_out") continue;
      const [x, y] = view.to_screen(at);
      c.fillStyle = colours.halo;
      c.fillRect(x - 5, y - 5, 10, 10);
      c.lineWidth = 1.75;
      c.strokeStyle = colours.draft;
      c.strokeRect(x - 5, y - 5, 10, 10);
    }
  }

  closed() {
    this.choose("look");
  }
}
