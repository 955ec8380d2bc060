// SPDX-License-Identifier: Apache-2.0
// What happened: words given, by whom, and what came of them; changes of state; the newest above.
import { element, finite } from "./dom.js";

const kMost = 200;
const kSigns = { info: "·", warning: "▲", critical: "■" };

export class Events {
  #list;
  #seen = new Set();

  constructor(panel, store) {
    this.#list = element("ol", { class: "events", "aria-label": "Events, the newest first" });
    panel.append(this.#list);
    store.on("events", (event) => this.#take(event));
  }

  // A new subscription brings the last ones again.
  #take({ time_s, wall_time, text, severity, who }) {
    const key = `${time_s} ${text}`;
    if (this.#seen.has(key)) return;
    this.#seen.add(key);
    const at = wall_time ? new Date(wall_time).toLocaleTimeString([], { hour12: false }) : finite(time_s) ? `${time_s.toFixed(1)} s` : "";
    this.#list.prepend(element("li", { "data-severity": severity },
      element("time", {}, at), element("span", { "aria-hidden": "true" }, kSigns[severity] ?? "·"),
      element("span", { class: "event_text" }, text, who ? element("i", {}, ` by ${who}`) : null)));
    while (this.#list.childElementCount > kMost) this.#list.lastElementChild.remove();
    if (this.#seen.size > 2 * kMost) this.#seen = new Set([...this.#seen].slice(-kMost));
  }
}
