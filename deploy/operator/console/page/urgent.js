// SPDX-License-Identifier: Apache-2.0
// ABORT and E-STOP: given at the touch, and again until the boat says that it is done, for 5 s; also
// where the link has just gone, and whoever commands.
import { element, forbid, set_attribute, set_text } from "./dom.js";

const kGiven_ms = 5000;
const kAgain_ms = 400;
const kShown_ms = 8000;

export class UrgentOrder {
  #command;
  #word;
  #label;
  #button;
  #said;
  #ends_ms = 0;
  #given_ms = 0;
  #times = 0;
  #timer = null;
  #touched_ms = -Infinity;
  #outcome_ms = -Infinity;
  #told;

  // `told`(text, severity): what came of it, to be heard.
  constructor({ word, label, about, keys }, command, told) {
    this.#word = word;
    this.#label = label;
    this.#command = command;
    this.#told = told;
    this.#said = element("span", { class: "urgent_said" }, about);
    this.#said.dataset.about = about;
    this.#button = element(
      "button",
      { type: "button", class: `stop ${word}`, id: word, "aria-keyshortcuts": keys, "data-title": `${about} (${keys})` },
      element("span", { class: "urgent_label" }, label),
      this.#said,
    );
    // At the touch, not when it ends; a click that follows is the same.
    this.#button.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      this.#touched_ms = event.timeStamp;
      this.give();
    });
    this.#button.addEventListener("click", (event) => {
      if (event.detail === 0 || event.timeStamp - this.#touched_ms > 1000) this.give();
    });
  }

  get node() {
    return this.#button;
  }

  refresh(now_ms) {
    forbid(this.#button, this.#command.why_not(this.#word, true));
    if (!this.#timer && now_ms - this.#outcome_ms > kShown_ms) this.#show("", this.#said.dataset.about);
  }

  give() {
    const reason = this.#command.why_not(this.#word, true);
    if (reason) {
      this.#told(`${this.#label}: ${reason}`, "warning");
      return;
    }
    const now = performance.now();
    this.#ends_ms = now + kGiven_ms;
    if (this.#timer) return;
    this.#given_ms = now;
    this.#times = 0;
    this.#timer = setInterval(() => this.#once(), kAgain_ms);
    this.#once();
  }

  #once() {
    const now = performance.now();
    if (now > this.#ends_ms) {
      this.#end("failed", `NOT CONFIRMED in ${kGiven_ms / 1000} s`, "critical");
      return;
    }
    this.#times++;
    this.#show("giving", `given ${this.#times} ×, not confirmed yet`);
    this.#command.say({ command: this.#word }, 2500).then((reply) => this.#answered(reply));
  }

  #answered(reply) {
    if (!this.#timer) return;
    if (reply.ok) {
      const after_s = (performance.now() - this.#given_ms) / 1000;
      this.#end("done", `confirmed in ${after_s.toFixed(2)} s`, "info");
    } else if (!reply.lost && reply.confirmed === undefined) {
      this.#end("failed", `refused: ${reply.error}`, "critical");
    }
  }

  #end(kind, text, severity) {
    clearInterval(this.#timer);
    this.#timer = null;
    this.#outcome_ms = performance.now();
    this.#show(kind, text);
    this.#told(`${this.#label}: ${text}`, severity);
  }

  #show(kind, text) {
    set_attribute(this.#button, "data-outcome", kind || null);
    set_text(this.#said, text);
  }
}
