// SPDX-License-Identifier: Apache-2.0
// The world's canvas: what is shown of it, followed, moved and zoomed by mouse, fingers and keys. A tool
// in hand (the mission's) is asked first what a press means.
import { fitted_canvas, set_attribute, set_text } from "./dom.js";
import { View, distance } from "./geometry.js";
import { world_words } from "./words.js";
import { hatch } from "./pen.js";
import * as draw from "./world_draw.js";

const kTap_px = 7;
const kReach_px = 18; // how near to a point of the mission a press means it
const kZoomKey = 1.25;
const kWords_ms = 2000;

export class WorldView {
  #canvas;
  #store;
  #theme;
  #surface;
  #view = new View();
  #picture = null;
  #patterns = null;
  #fingers = new Map(); // pointer id -> [x, y] now
  #press = null; // {from, moved, grabbed}
  #cross = null; // where keys would place, in pixels
  #pointed_at = null; // where the mouse is
  #words_ms = -Infinity;
  #fitted = false;
  following = true;
  tool = null; // {hint, grab(at, reach), drag(at), drop(), tap(at), remove(at, reach)}
  overlay = null; // draws above all, with the same pen
  dirty = true;

  constructor(parts, store, theme) {
    this.#canvas = parts.canvas;
    this.parts = parts;
    this.#store = store;
    this.#theme = theme;
    this.#surface = fitted_canvas(this.#canvas, () => {
      if (this.#surface) this.#view.resize(this.#surface.width, this.#surface.height);
      this.dirty = true;
    });
    this.#view.resize(this.#surface.width, this.#surface.height);
    this.#view.scale = 26;
    theme.on_change(() => this.#recolour());
    this.#recolour();
    store.on("coverage", () => this.#repaint_coverage());
    for (const name of ["boat", "world"]) store.on(name, () => (this.dirty = true));
    store.on("sonar", () => (this.dirty = true));
    this.#listen();
    this.#listen_buttons();
  }

  get view() {
    return this.#view;
  }

  take_tool(tool) {
    this.tool = tool;
    this.#cross = null;
    this.parts.hint.hidden = !tool;
    set_text(this.parts.hint, tool?.hint ?? "");
    this.#canvas.classList.toggle("placing", Boolean(tool));
    this.dirty = true;
  }

  // ---- Drawing

  #recolour() {
    const { context } = this.#surface;
    const { colours } = this.#theme;
    this.#patterns = {
      unknown: hatch(context, colours.unknown_line, 9, 1),
      keep_out: hatch(context, colours.keep_out, 7, 2.5),
      unsure: hatch(context, colours.obstacle, 5, 2),
    };
    this.#repaint_coverage();
  }

  #repaint_coverage() {
    const { coverage } = this.#store.newest;
    this.#picture = coverage ? draw.coverage_picture(coverage, this.#theme.colours) : null;
    this.dirty = true;
  }

  render(now_ms) {
    const { world, boat, coverage, sonar } = this.#store.newest;
    if (now_ms - this.#words_ms > kWords_ms) {
      this.#words_ms = now_ms;
      set_text(this.parts.words, world_words(this.#store.newest));
    }
    if (!this.dirty) return;
    this.dirty = false;
    if (!this.#fitted && world) this.show_all();
    if (this.following && boat?.position_m && !this.#press) this.#view.hold(boat.position_m, this.#middle());
    const pen = { c: this.#surface.context, view: this.#view, colours: this.#theme.colours, patterns: this.#patterns };
    draw.draw_water(pen, coverage, this.#picture);
    draw.draw_grid(pen);
    if (world) {
      draw.draw_areas(pen, world.fence_m, world.keep_out_m);
      draw.draw_zones(pen, world.obstacles ?? []);
      draw.draw_line(pen, world.line);
    }
    draw.draw_fan(pen, boat, sonar);
    draw.draw_track(pen, this.#store.track);
    if (world) {
      draw.draw_obstacles(pen, world.obstacles ?? []);
      draw.draw_waypoints(pen, world, boat);
      draw.draw_mission(pen, world);
    }
    draw.draw_boat(pen, boat, world?.hull_m);
    this.overlay?.(pen);
    if (this.#cross) this.#draw_cross(pen);
    draw.draw_margins(pen, this.#cross ?? this.#pointed_at);
  }

  #middle() {
    return [this.#view.width / 2, this.#view.height / 2];
  }

  #draw_cross({ c, colours }) {
    const [x, y] = this.#cross;
    c.strokeStyle = colours.draft;
    c.lineWidth = 1.5;
    c.beginPath();
    c.moveTo(x - 16, y);
    c.lineTo(x + 16, y);
    c.moveTo(x, y - 16);
    c.lineTo(x, y + 16);
    c.stroke();
  }

  // ---- What is shown

  show_all() {
    const { world, boat } = this.#store.newest;
    const points = [...(world?.mission_m ?? []), ...(world?.fence_m ?? [])];
    for (const at of [world?.start_m, world?.goal_m, boat?.position_m]) if (at) points.push(at);
    for (const obstacle of world?.obstacles ?? []) {
      const near = boat?.position_m && distance(obstacle.outline_m[0] ?? [1e9, 0], boat.position_m) < 100;
      if (near) points.push(...obstacle.outline_m);
    }
    if (points.length === 0) return;
    if (points.length === 1) points.push([points[0][0] - 6, points[0][1] - 6], [points[0][0] + 6, points[0][1] + 6]);
    this.#fitted = true;
    this.set_following(false);
    this.#view.fit(points, { top: 56, right: 40, bottom: 40, left: 30 });
    this.dirty = true;
  }

  set_following(on) {
    this.following = on;
    set_attribute(this.parts.follow, "aria-pressed", String(on));
    this.dirty = true;
  }

  zoom(factor) {
    this.#view.zoom_at(this.#middle(), factor);
    this.dirty = true;
  }

  #listen_buttons() {
    const { follow, show_all, zoom_in, zoom_out } = this.parts;
    follow.addEventListener("click", () => this.set_following(!this.following));
    show_all.addEventListener("click", () => this.show_all());
    zoom_in.addEventListener("click", () => this.zoom(kZoomKey ** 2));
    zoom_out.addEventListener("click", () => this.zoom(kZoomKey ** -2));
  }

  // ---- Mouse and fingers

  #listen() {
    const canvas = this.#canvas;
    canvas.addEventListener("pointerdown", (event) => this.#down(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => this.#up(event));
    canvas.addEventListener("pointerleave", () => {
      this.#pointed_at = null;
      this.dirty = true;
    });
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener("contextmenu", (event) => this.#remove_under(event));
    canvas.addEventListener("keydown", (event) => this.#key(event));
    canvas.addEventListener("blur", () => {
      this.#cross = null;
      this.dirty = true;
    });
  }

  #place(event) {
    const box = this.#canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  get #reach_m() {
    return kReach_px / this.#view.scale;
  }

  #down(event) {
    if (event.pointerType === "mouse" && event.button !== 0) return;
    this.#canvas.setPointerCapture(event.pointerId);
    const at = this.#place(event);
    this.#fingers.set(event.pointerId, at);
    if (this.#fingers.size === 1) {
      const grabbed = this.tool?.grab(this.#view.to_world(at), this.#reach_m) ?? false;
      this.#press = { from: at, moved: false, grabbed };
    } else if (this.#press) {
      if (this.#press.grabbed) this.tool?.drop();
      this.#press = { ...this.#press, moved: true, grabbed: false };
    }
  }

  #move(event) {
    const before = this.#fingers.get(event.pointerId);
    const at = this.#place(event);
    if (event.pointerType === "mouse") {
      this.#pointed_at = at;
      this.dirty = true;
    }
    if (!before || !this.#press) return;
    if (this.#fingers.size === 2) {
      const pair = [...this.#fingers.values()];
      this.#fingers.set(event.pointerId, at);
      this.#view.pinch(pair, [...this.#fingers.values()]);
    } else if (this.#fingers.size === 1) {
      this.#fingers.set(event.pointerId, at);
      if (!this.#press.moved && distance(at, this.#press.from) < kTap_px) return;
      this.#press.moved = true;
      if (this.#press.grabbed) {
        this.tool?.drag(this.#view.to_world(at));
      } else {
        this.set_following(false);
        this.#view.pan(at[0] - before[0], at[1] - before[1]);
      }
    }
    this.dirty = true;
  }

  #up(event) {
    if (!this.#fingers.delete(event.pointerId) || !this.#press) return;
    if (this.#fingers.size > 0) return;
    const { moved, grabbed, from } = this.#press;
    this.#press = null;
    if (grabbed) this.tool?.drop();
    if (!moved && event.type === "pointerup" && this.tool) this.tool.tap(this.#view.to_world(from), this.#reach_m);
    this.dirty = true;
  }

  #wheel(event) {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
    const at = this.following ? this.#middle() : this.#place(event);
    this.#view.zoom_at(at, Math.exp(-event.deltaY * lines * 0.0015));
    this.dirty = true;
  }

  #remove_under(event) {
    if (!this.tool) return;
    event.preventDefault();
    this.tool.remove(this.#view.to_world(this.#place(event)), this.#reach_m);
    this.dirty = true;
  }

  // ---- Keys

  #key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || event.shiftKey) return;
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (way) this.#step(way);
    else if (event.key === "+" || event.key === "=") this.zoom(kZoomKey);
    else if (event.key === "-") this.zoom(1 / kZoomKey);
    else if (event.key === "f") this.set_following(!this.following);
    else if (event.key === "a") this.show_all();
    else if (this.tool && event.key === "Enter") this.tool.tap(this.#view.to_world(this.#cross ?? this.#middle()), this.#reach_m);
    else if (this.tool && (event.key === "Delete" || event.key === "Backspace")) {
      this.tool.remove(this.#view.to_world(this.#cross ?? this.#middle()), this.#reach_m);
    } else return;
    event.preventDefault();
    this.dirty = true;
  }

  #step([dx, dy]) {
    if (!this.tool) {
      this.set_following(false);
      this.#view.pan(-dx * 60, -dy * 60);
      return;
    }
    const [x, y] = this.#cross ?? this.#middle();
    const { width, height } = this.#view;
    this.#cross = [Math.min(width, Math.max(0, x + dx * 12)), Math.min(height, Math.max(0, y + dy * 12))];
  }
}

const kLegend = [
  ["vehicle", "vehicle to scale; dashed: course that is steered"],
  ["track", "track, pale: earlier"],
  ["goal", "goal and its radius"],
  ["start", "start"],
  ["current", "current waypoints on their path"],
  ["previous", "waypoints before"],
  ["obstacle", "obstacle, with its number"],
  ["unsure", "not yet confirmed"],
  ["zone", "protection zone"],
  ["motion", "velocity; where it will be in 5 to 30 s"],
  ["doubt", "doubt of a position (sigma)"],
  ["line", "line that is kept to"],
  ["fence", "fence: stays inside"],
  ["keep_out", "keep-out area"],
  ["unknown", "water not seen yet"],
  ["wall", "occupied by what was seen"],
  ["draft", "mission being drawn"],
];

export function fill_legend(list) {
  for (const [kind, text] of kLegend) {
    const item = document.createElement("li");
    const sign = document.createElement("span");
    sign.className = `sign sign_${kind}`;
    sign.setAttribute("aria-hidden", "true");
    item.append(sign, text);
    list.append(item);
  }
}
