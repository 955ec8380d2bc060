// SPDX-License-Identifier: Apache-2.0
// In words: what the boat does and why, and the alarms.
import { element, set_attribute, set_text } from "./dom.js";
import { story_of } from "./words.js";

const kSigns = { info: "◆", warning: "▲", critical: "■" };

export class Story {
  #now;
  #alarms;
  #store;
  #shown = "";

  constructor(now, alarms, store) {
    this.#now = now;
    this.#alarms = alarms;
    this.#store = store;
    store.on("story", () => this.#show());
    store.on("status", () => this.#show());
  }

  #show() {
    const { story, status } = this.#store.newest;
    set_text(this.#now, status?.ok === false ? story_of(status) : story?.now || story_of(status));
    const alarms = story?.alarms ?? [];
    const wanted = JSON.stringify(alarms);
    if (wanted === this.#shown) return;
    this.#shown = wanted;
    this.#alarms.replaceChildren(...alarms.map(({ severity, text }) => {
      const item = element("li", { class: "alarm" }, element("span", { "aria-hidden": "true" }, kSigns[severity] ?? "▲"), ` ${text}`);
      set_attribute(item, "data-severity", severity);
      return item;
    }));
  }
}
