// SPDX-License-Identifier: Apache-2.0
// The stick: by keys or a finger, ten words a second while it is held, and neutral at once when it is
// let go, when the page loses its focus or is hidden, and when the link is lost.
import { by_id, element, forbid, set_attribute, set_text } from "./dom.js";
import { clamp } from "./geometry.js";

const kPeriod_ms = 100;
const kNeutralWords = 3; // said after it was let go, in case one is lost
const kKeys = {
  ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowLeft: [-1, 0], ArrowRight: [1, 0],
  w: [0, 1], s: [0, -1], a: [-1, 0], d: [1, 0],
};

export class Manual {
  #command;
  #tell;
  #pad;
  #knob;
  #most;
  #override;
  #said;
  #held_keys = new Set();
  #finger = null; // {id, at: [head, surge] of -1 to 1}
  #timer = null;
  #neutral_left = 0;
  #link = false;

  // `tell`(text, severity)
  constructor(panel, command, tell) {
    this.#command = command;
    this.#tell = tell;
    this.#knob = element("span", { class: "knob" });
    this.#pad = element("div", {
      id: "stick", class: "stick", tabindex: "0", role: "application", "aria-label": "Stick: arrow keys or W A S D; space is neutral", "aria-describedby": "stick_said",
    }, element("span", { class: "cross" }), element("span", { class: "stick_label ahead" }, "ahead"), element("span", { class: "stick_label astern" }, "astern"), this.#knob);
    this.#most = element("input", { id: "stick_most", type: "range", min: "10", max: "100", step: "5", value: "40" });
    this.#override = element("input", { id: "stick_override", type: "checkbox" });
    const share = element("output", { for: "stick_most" }, "40 %");
    this.#most.addEventListener("input", () => set_text(share, `${this.#most.value} %`));
    this.#said = element("p", { id: "stick_said", class: "facts", role: "status" });
    panel.append(
      element("p", { class: "about" }, "Thrust by hand, while the thrusters are armed. A mission under way is held, until Resume or Start. Let go, and thrust is neutral."),
      this.#pad, this.#said,
      element("div", { class: "fields" },
        element("label", { for: "stick_most" }, "Full stick is ", share), this.#most,
        element("label", { for: "stick_override" }, "Closer in than the guard lets it"), this.#override),
    );
    this.#listen();
  }

  #listen() {
    const pad = this.#pad;
    pad.addEventListener("keydown", (event) => this.#key(event, true));
    pad.addEventListener("keyup", (event) => this.#key(event, false));
    pad.addEventListener("pointerdown", (event) => this.#touch(event));
    pad.addEventListener("pointermove", (event) => this.#slide(event));
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) {
      pad.addEventListener(end, (event) => {
        if (this.#finger?.id === event.pointerId) this.#let_go();
      });
    }
    pad.addEventListener("blur", () => this.#let_go());
    window.addEventListener("blur", () => this.#let_go());
    window.addEventListener("pagehide", () => this.#let_go());
    document.addEventListener("visibilitychange", () => {
      if (document.hidden) this.#let_go();
    });
  }

  #key(event, down) {
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (event.ctrlKey || event.altKey || event.metaKey || (down && event.shiftKey)) return;
    if (key === " ") this.#let_go();
    else if (!(key in kKeys)) return;
    else if (!down) this.#held_keys.delete(key);
    else if (!event.repeat) this.#held_keys.add(key);
    event.preventDefault();
    this.#held_changed();
  }

  #touch(event) {
    if (event.button !== 0 || this.#finger) return;
    this.#pad.focus();
    this.#pad.setPointerCapture(event.pointerId);
    this.#finger = { id: event.pointerId, at: [0, 0] };
    this.#slide(event);
    this.#held_changed();
    event.preventDefault();
  }

  #slide(event) {
    if (this.#finger?.id !== event.pointerId) return;
    const box = this.#pad.getBoundingClientRect();
    const half = Math.min(box.width, box.height) / 2 - 26;
    const dead = (x) => (Math.abs(x) < 0.08 ? 0 : x);
    const head = clamp((event.clientX - box.left - box.width / 2) / half, -1, 1);
    const surge = clamp(-(event.clientY - box.top - box.height / 2) / half, -1, 1);
    this.#finger.at = [dead(head), dead(surge)];
  }

  get #is_held() {
    return this.#finger !== null || this.#held_keys.size > 0;
  }

  #word() {
    let [head, surge] = this.#finger?.at ?? [0, 0];
    for (const key of this.#held_keys) {
      head += kKeys[key][0];
      surge += kKeys[key][1];
    }
    const most = Number(this.#most.value);
    return { head: Math.round(clamp(head, -1, 1) * most), surge: Math.round(clamp(surge, -1, 1) * most) };
  }

  #held_changed() {
    if (this.#is_held) {
      const reason = this.#command.why_not("manual", this.#link);
      if (reason) {
        this.#held_keys.clear();
        this.#finger = null;
        this.#tell(`Stick: ${reason}`, "warning");
        this.#show({ head: 0, surge: 0 });
        return;
      }
      this.#neutral_left = kNeutralWords;
      if (this.#timer) return;
      this.#timer = setInterval(() => this.#say(), kPeriod_ms);
      this.#say();
    } else if (this.#timer) {
      this.#say();
    }
  }

  #let_go() {
    this.#held_keys.clear();
    this.#finger = null;
    this.#override.checked = false;
    if (this.#timer) this.#say();
  }

  #say() {
    const word = this.#word();
    if (!this.#is_held && this.#neutral_left-- <= 0) {
      clearInterval(this.#timer);
      this.#timer = null;
      return;
    }
    this.#show(word);
    const request = { command: "manual", ...word, ...(this.#is_held && this.#override.checked ? { override: true } : {}) };
    this.#command.say_if_clear(request).then((reply) => {
      if (reply.ok || !this.#is_held) return;
      this.#let_go();
      this.#tell(`Stick: ${reply.lost ? "no answer" : "refused"}: ${reply.error}`, "warning");
    });
  }

  #show({ head, surge }) {
    this.#knob.style.transform = `translate(${head * 0.8}px, ${-surge * 0.8}px)`;
    set_attribute(this.#pad, "data-held", this.#is_held ? "" : null);
    const turn = head === 0 ? "" : head > 0 ? `, ${head} % to starboard` : `, ${-head} % to port`;
    set_text(this.#said, surge === 0 && head === 0 ? "Neutral" : `${Math.abs(surge)} % ${surge < 0 ? "astern" : "ahead"}${turn}`);
  }

  refresh(link) {
    if (this.#link && !link) this.#let_go();
    this.#link = link;
    const reason = this.#command.why_not("manual", link);
    forbid(this.#pad, reason);
    if (!this.#timer) set_text(by_id("stick_said"), reason ? `Not now: ${reason}` : "Neutral. Click or tab to the stick, then keys; or drag it.");
  }
}
