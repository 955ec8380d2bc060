// SPDX-License-Identifier: Apache-2.0
// The bar of orders: who commands, the boat's words, and the stops.
import { element, forbid, is_forbidden, set_attribute, set_text } from "./dom.js";
import { next_step } from "./permissions.js";
import { UrgentOrder } from "./urgent.js";

const kSure_ms = 4000; // within which a word that asks for it is pressed again
const kTold_ms = 12000; // then what to do next stands in its place
const kName = "lodesman.name";

const kWords = [
  { word: "arm", label: "Arm", about: "The thrusters may turn" },
  { word: "disarm", label: "Disarm", about: "Thrusters neutral until armed; a mission is aborted" },
  { word: "start", label: "Start", about: "Sails the mission from its first goal on" },
  { word: "hold", label: "Hold", about: "Keeps its place: propellers turn" },
  { word: "resume", label: "Resume", about: "Goes on with what was held" },
  {
    word: "estop_release", label: "Release stop", about: "Ends the emergency stop; disarmed then",
    request: { command: "estop", release: true }, ask: "Release the emergency stop? Press again",
  },
];
const kStops = [
  { word: "abort", label: "ABORT", about: "neutral, mission over", keys: "Shift+A" },
  { word: "estop", label: "E-STOP", about: "disarmed and latched", keys: "Shift+E" },
];

export class Orders {
  #command;
  #parts;
  #buttons = new Map();
  #urgent = new Map();
  #asked = null; // {word, until_ms}
  #link = false;
  #told_ms = -Infinity;
  mission = () => null; // {text, lacks} of a drawn mission that start takes along, or null
  started = () => {};

  constructor(parts, command) {
    this.#parts = parts;
    this.#command = command;
    for (const entry of kWords) this.#add(entry);
    for (const entry of kStops) {
      const order = new UrgentOrder(entry, command, (text, severity) => this.tell(text, severity));
      this.#urgent.set(entry.word, order);
      parts.urgent.append(order.node);
    }
    this.#build_command();
    document.addEventListener("keydown", (event) => this.#key(event));
  }

  #add(entry) {
    const label = element("span", { class: "label" }, entry.label);
    const under = element("span", { class: "under" });
    const button = element(
      "button",
      { type: "button", id: `order_${entry.word}`, class: "order", "data-title": entry.about, onclick: () => this.#press(entry) },
      label, under,
    );
    this.#buttons.set(entry.word, { button, label, under, entry });
    this.#parts.buttons.append(button);
  }

  // What was said to an order, for eyes and for readers of the screen.
  tell(text, severity = "info") {
    this.#told_ms = performance.now();
    set_text(this.#parts.said, text);
    set_attribute(this.#parts.said, "data-severity", severity);
  }

  // ---- Words

  async #press(entry) {
    const { button } = this.#buttons.get(entry.word);
    if (is_forbidden(button)) {
      this.tell(`${entry.label}: ${button.title}`, "warning");
      return;
    }
    if (entry.ask && !this.#is_sure(entry)) return;
    const request = { ...(entry.request ?? { command: entry.word }) };
    const drawn = entry.word === "start" ? this.mission() : null;
    if (drawn) {
      if (drawn.lacks.length > 0) {
        this.tell(`Start: the drawn mission is not whole: ${drawn.lacks.join("; ")}`, "warning");
        return;
      }
      request.mission = drawn.text;
    }
    this.tell(`${entry.label} …`);
    set_attribute(button, "aria-busy", "true");
    const reply = await this.#command.say(request);
    set_attribute(button, "aria-busy", null);
    this.say_reply(entry.label, reply);
    if (drawn && reply.ok) this.started();
  }

  say_reply(label, reply) {
    if (reply.ok) {
      const warnings = reply.warnings?.length ? `. Beware: ${reply.warnings.join("; ")}` : "";
      this.tell(`${label}: done${reply.state ? `, ${reply.state.replaceAll("_", " ")}` : ""}${warnings}`, warnings ? "warning" : "info");
    } else {
      this.tell(`${label}: ${reply.lost ? "no answer" : "refused"}: ${reply.error}`, "warning");
    }
  }

  #is_sure({ word, ask }) {
    const now = performance.now();
    if (this.#asked?.word === word && now < this.#asked.until_ms) {
      this.#asked = null;
      return true;
    }
    this.#asked = { word, until_ms: now + kSure_ms };
    this.tell(ask, "warning");
    return false;
  }

  // ---- Who commands

  #build_command() {
    const name = element("input", {
      id: "command_name", type: "text", maxlength: "60", value: localStorage.getItem(kName) ?? "", placeholder: "your name", "aria-label": "Your name, for others to read",
      autocomplete: "off", onchange: () => localStorage.setItem(kName, name.value),
    });
    const take = element("button", { type: "button", id: "take", class: "order", onclick: () => this.#take_or_release() });
    const who = element("p", { id: "commander", "aria-live": "polite" });
    this.#parts.command.append(who, element("div", { class: "row" }, name, take));
    this.command_parts = { name, take, who };
  }

  async #take_or_release() {
    const { take, name } = this.command_parts;
    if (is_forbidden(take)) {
      this.tell(`Command: ${take.title}`, "warning");
    } else if (this.#command.mine) {
      this.say_reply("Release command", await this.#command.release());
    } else {
      const held = Boolean(this.#command.situation(this.#link).commander);
      if (held && !this.#is_sure({ word: "take", ask: "Somebody else commands. Press again to take it by force" })) return;
      this.say_reply("Take command", await this.#command.take(name.value.trim() || "console", held));
    }
    this.refresh(this.#link, performance.now());
  }

  #refresh_command() {
    const { take, who, name } = this.command_parts;
    const { commander, mine } = this.#command.situation(this.#link);
    forbid(take, this.#command.why_not(mine ? "release" : "take", this.#link) ?? this.#no_scope_to_take());
    set_text(take, mine ? "Release" : commander ? "Take by force" : "Take");
    name.hidden = mine;
    const held = commander ? `Held by ${commander.name || "another session"}` : "Nobody commands";
    set_text(who, mine ? "You command" : this.#command.was_mine ? `The link took the command from you. ${held}` : held);
    set_attribute(this.#parts.command, "data-who", mine ? "mine" : commander ? "other" : null);
  }

  #no_scope_to_take() {
    return this.#command.situation(true).scope === "command" ? null : "the token that you signed in with is not good for it";
  }

  // ---- Keys and looks

  #key(event) {
    if (!event.shiftKey || event.ctrlKey || event.altKey || event.metaKey || event.repeat) return;
    if (event.target.closest?.("input, textarea, select, [contenteditable]")) return;
    const word = { A: "abort", E: "estop" }[event.key.toUpperCase()];
    if (!word) return;
    event.preventDefault();
    this.#urgent.get(word).give();
  }

  refresh(link, now_ms) {
    this.#link = link;
    const drawn = this.mission();
    this.#command.draft = Boolean(drawn);
    for (const [word, { button, under }] of this.#buttons) {
      forbid(button, this.#command.why_not(word, link));
      if (word === "start") set_text(under, drawn ? "drawn mission" : "mission at hand");
    }
    const stopped = this.#command.situation(link).status?.thrust?.state === "stopped";
    set_attribute(this.#buttons.get("estop_release").button, "data-due", stopped ? "" : null);
    for (const order of this.#urgent.values()) order.refresh(now_ms);
    if (now_ms - this.#told_ms > kTold_ms) {
      set_text(this.#parts.next, next_step(this.#command.situation(link)));
      set_text(this.#parts.said, "");
    } else {
      set_text(this.#parts.next, "");
    }
    this.#refresh_command();
  }
}
