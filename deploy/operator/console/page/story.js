// SPDX-License-Identifier: Apache-2.0
// In words: what the boat does and why, and the alarms.
import { element, set_attribute, set_text } from "./dom.js";
import { story_of } from "./words.js";

const kSigns = { info: "◆", warning: "▲", critical: "■" };

const key_of = ({ severity, text }) => `${severity} ${text}`;

function item_of(alarm) {
  const item = element("li", { class: "alarm" }, element("span", { "aria-hidden": "true" }, kSigns[alarm.severity] ?? "▲"), ` ${alarm.text}`);
  set_attribute(item, "data-severity", alarm.severity);
  item.dataset.key = key_of(alarm);
  return item;
}

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
    // What stays is left alone, so that only what is new is read aloud.
    const kept = new Map([...this.#alarms.children].map((item) => [item.dataset.key, item]));
    const items = alarms.map((alarm) => kept.get(key_of(alarm)) ?? item_of(alarm));
    for (const item of kept.values()) if (!items.includes(item)) item.remove();
    items.forEach((item, i) => {
      if (this.#alarms.children[i] !== item) this.#alarms.insertBefore(item, this.#alarms.children[i] ?? null);
    });
  }
}
