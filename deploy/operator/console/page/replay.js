// SPDX-License-Identifier: Apache-2.0
// The bar of a recording: play, step, seek, speed. Shown only where the console plays one.
import { element, set_attribute, set_text, span_text } from "./dom.js";

const kService = "/lodesman/replay";
const kSpeeds = [0.1, 0.5, 1, 2, 5, 10, 30];

export class Replay {
  #connection;
  #box;
  #parts;
  #seeking = false;

  constructor(box, store, connection) {
    this.#box = box;
    this.#connection = connection;
    store.on("replay", (replay) => this.#show(replay));
  }

  #do(request) {
    this.#connection.call(kService, request).catch(() => {});
  }

  #build() {
    const play = element("button", { type: "button", id: "replay_play", class: "order", onclick: () => this.#do({ do: play.dataset.does }) });
    const step = element("button", { type: "button", id: "replay_step", class: "quiet", onclick: () => this.#do({ do: "step" }) }, "Step");
    const slider = element("input", { type: "range", id: "replay_seek", step: "0.1", "aria-label": "Time in the recording" });
    slider.addEventListener("input", () => (this.#seeking = true));
    slider.addEventListener("change", () => {
      this.#do({ do: "seek", time_s: Number(slider.value) });
      this.#seeking = false;
    });
    const speed = element("select", { "aria-label": "Speed" }, ...kSpeeds.map((times) => element("option", { value: String(times) }, `${times} ×`)));
    speed.addEventListener("change", () => this.#do({ do: "speed", speed: Number(speed.value) }));
    const time = element("output", { for: "replay_seek" });
    const file = element("span", { class: "file" });
    this.#parts = { play, slider, speed, time, file };
    this.#box.append(element("strong", { class: "recording" }, "RECORDING"), play, step, slider, time, speed, file);
    this.#box.hidden = false;
  }

  #show({ file, time_s, from_s, to_s, playing, speed }) {
    if (!this.#parts) this.#build();
    const parts = this.#parts;
    set_text(parts.play, playing ? "Pause" : "Play");
    parts.play.dataset.does = playing ? "pause" : "play";
    set_attribute(parts.slider, "min", String(from_s));
    set_attribute(parts.slider, "max", String(to_s));
    if (!this.#seeking) parts.slider.value = String(time_s);
    set_text(parts.time, `${span_text(time_s - from_s)} of ${span_text(to_s - from_s)}`);
    if (document.activeElement !== parts.speed) parts.speed.value = String(speed);
    set_text(parts.file, file ?? "");
  }
}
