// SPDX-License-Identifier: Apache-2.0
// The sonar's fan, ahead up: echoes, detections, tracks, the path, range rings.
import { fitted_canvas, set_text } from "./dom.js";
import { bar_length_m, length_text } from "./geometry.js";
import { sonar_words } from "./words.js";

const kRad = Math.PI / 180;
const kWords_ms = 3000;

export class SonarView {
  #surface;
  #store;
  #theme;
  #parts;
  #bitmap = null;
  #decoding = false;
  #words_ms = -Infinity;
  dirty = true;

  constructor(parts, store, theme) {
    this.#parts = parts;
    this.#store = store;
    this.#theme = theme;
    this.#surface = fitted_canvas(parts.canvas, () => (this.dirty = true));
    theme.on_change(() => (this.dirty = true));
    store.on("sonar", (sonar) => this.#take(sonar));
  }

  async #take(sonar) {
    this.dirty = true;
    if (!sonar.image || this.#decoding || this.#parts.canvas.offsetParent === null) return;
    this.#decoding = true;
    try {
      const letters = atob(sonar.image);
      const bytes = new Uint8Array(letters.length);
      for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
      const bitmap = await createImageBitmap(new Blob([bytes]));
      this.#bitmap?.close();
      this.#bitmap = bitmap;
    } catch {
      this.#bitmap?.close();
      this.#bitmap = null; // no picture: rings, detections and tracks alone
    } finally {
      this.#decoding = false;
      this.dirty = true;
    }
  }

  render(now_ms) {
    const { sonar } = this.#store.newest;
    if (now_ms - this.#words_ms > kWords_ms) {
      this.#words_ms = now_ms;
      set_text(this.#parts.words, sonar_words(sonar));
    }
    if (!this.dirty || !this.#surface) return;
    this.dirty = false;
    const { context: c, width, height } = this.#surface;
    c.clearRect(0, 0, width, height);
    if (!sonar) return this.#say_nothing(c, width, height);
    const range = sonar.range_m;
    const half = ((sonar.sector_deg ?? 120) / 2) * kRad;
    const wide = 2 * Math.sin(Math.min(half, Math.PI / 2));
    const scale = Math.min((height - 34) / range, (width - 16) / (wide * range));
    const pen = { c, scale, x: width / 2, y: (height + scale * range) / 2 + 1, range, half };
    this.#draw_echoes(pen, wide);
    this.#draw_rings(pen);
    this.#draw_shapes(pen, sonar);
    return undefined;
  }

  #say_nothing(c, width, height) {
    c.fillStyle = "#9fb2c0";
    c.font = `13px ${this.#theme.colours.font}`;
    c.textAlign = "center";
    c.fillText("No sonar picture has come", width / 2, height / 2);
  }

  #fan(c, { x, y, scale, range, half }) {
    c.beginPath();
    c.moveTo(x, y);
    c.arc(x, y, scale * range, -Math.PI / 2 - half, -Math.PI / 2 + half);
    c.closePath();
  }

  #draw_echoes(pen, wide) {
    const { c, x, y, scale, range } = pen;
    c.save();
    this.#fan(c, pen);
    c.fillStyle = "#04090d";
    c.fill();
    if (this.#bitmap) {
      c.clip();
      c.imageSmoothingEnabled = true;
      c.drawImage(this.#bitmap, x - (wide / 2) * range * scale, y - range * scale, wide * range * scale, range * scale);
    }
    c.restore();
    this.#fan(c, pen);
    c.strokeStyle = "rgba(150, 190, 215, 0.55)";
    c.lineWidth = 1;
    c.stroke();
  }

  #draw_rings({ c, x, y, scale, range, half }) {
    const step = bar_length_m(1, range / 2.4);
    c.strokeStyle = "rgba(150, 190, 215, 0.35)";
    c.fillStyle = "#c4d5e1";
    c.font = `10.5px ${this.#theme.colours.font}`;
    c.textAlign = "center";
    c.lineWidth = 1;
    for (let ring = step; ring <= range + 1e-6; ring += step) {
      c.beginPath();
      c.arc(x, y, ring * scale, -Math.PI / 2 - half, -Math.PI / 2 + half);
      c.stroke();
      c.fillText(length_text(ring), x, y - ring * scale - 4);
    }
    c.setLineDash([2, 5]);
    for (let deg = -30; deg <= 30; deg += 30) {
      if (Math.abs(deg) * kRad > half) continue;
      c.beginPath();
      c.moveTo(x, y);
      c.lineTo(x + range * scale * Math.sin(deg * kRad), y - range * scale * Math.cos(deg * kRad));
      c.stroke();
    }
    c.setLineDash([]);
  }

  #draw_shapes(pen, sonar) {
    const { c, x, y, scale } = pen;
    const on_screen = ([right, ahead]) => [x + right * scale, y - ahead * scale];
    const outline = (points, closed, colour, width, dash = []) => {
      if (!points || points.length === 0) return;
      c.beginPath();
      points.forEach((point, i) => (i === 0 ? c.moveTo(...on_screen(point)) : c.lineTo(...on_screen(point))));
      if (closed) c.closePath();
      c.setLineDash(dash);
      c.lineWidth = width;
      c.strokeStyle = colour;
      c.stroke();
      c.setLineDash([]);
    };
    c.save();
    this.#fan(c, pen);
    c.clip();
    for (const { outline_m } of sonar.detections ?? []) outline(outline_m, true, "#7fe3ff", 1.25, [3, 2]);
    for (const { outline_m } of sonar.tracks ?? []) outline(outline_m, true, "#ff5a4a", 2);
    outline(sonar.path_m, false, "rgba(0, 0, 0, 0.8)", 4.5);
    outline(sonar.path_m, false, "#ffe14a", 2.5);
    c.restore();
    c.font = `600 11px ${this.#theme.colours.font}`;
    c.textAlign = "center";
    for (const { id, outline_m } of sonar.tracks ?? []) {
      const top = (outline_m ?? []).reduce((best, point) => (best && best[1] > point[1] ? best : point), null);
      if (!top || top[1] < 0 || Math.hypot(...top) > pen.range) continue;
      const [px, py] = on_screen(top);
      c.lineWidth = 3;
      c.strokeStyle = "#04090d";
      c.strokeText(String(id), px, py - 6);
      c.fillStyle = "#ffb3aa";
      c.fillText(String(id), px, py - 6);
    }
    c.fillStyle = "#f2f7fa";
    c.beginPath();
    c.moveTo(x, y - 11);
    c.lineTo(x + 5, y + 3);
    c.lineTo(x - 5, y + 3);
    c.fill();
  }
}
