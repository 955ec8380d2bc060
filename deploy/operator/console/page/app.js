// SPDX-License-Identifier: Apache-2.0
// The page: signs in, makes its parts, and draws at most once a frame what came last.
import { Charts } from "./charts.js";
import { Command } from "./command.js";
import { Connection } from "./connection.js";
import { by_id, element, set_attribute, set_text, span_text } from "./dom.js";
import { Events } from "./events.js";
import { Health } from "./health.js";
import { Manual } from "./manual.js";
import { MissionEditor } from "./mission_editor.js";
import { Orders } from "./orders.js";
import { Lamps, Readouts } from "./readouts.js";
import { Replay } from "./replay.js";
import { ask_session, signed_in_session, sign_out, view_address } from "./session.js";
import { SonarView } from "./sonar_view.js";
import { Store, kTopics } from "./store.js";
import { Story } from "./story.js";
import { Theme } from "./theme.js";
import { Tuning } from "./tuning.js";
import { WorldView, fill_legend } from "./world_view.js";

const kFrame_ms = 60; // no frame sooner after the last
const kSilent_s = 2; // a place, or a ping, that is older is not shown as the present
const kLookAgain_ms = 250; // what is forbidden, how old things are

function make_tabs(changed) {
  const panels = [...document.querySelectorAll(".panel")];
  const bar = by_id("tabs");
  const choose = (name) => {
    for (const panel of panels) {
      const mine = panel.id === `panel_${name}`;
      panel.hidden = !mine;
      const tab = by_id(`tab_${panel.id.slice("panel_".length)}`);
      set_attribute(tab, "aria-selected", String(mine));
      tab.tabIndex = mine ? 0 : -1;
    }
    changed(name);
  };
  for (const panel of panels) {
    const name = panel.id.slice("panel_".length);
    panel.setAttribute("aria-labelledby", `tab_${name}`);
    bar.append(element("button", { type: "button", role: "tab", id: `tab_${name}`, "aria-controls": panel.id, onclick: () => choose(name) }, panel.dataset.title));
  }
  bar.addEventListener("keydown", (event) => {
    const tabs = [...bar.children];
    const way = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!way) return;
    const next = tabs[(tabs.indexOf(document.activeElement) + way + tabs.length) % tabs.length];
    next.focus();
    next.click();
  });
  return choose;
}

function make_more(session) {
  const [button, panel] = [by_id("more"), by_id("more_panel")];
  const show = (on) => {
    panel.hidden = !on;
    set_attribute(button, "aria-expanded", String(on));
  };
  button.addEventListener("click", () => show(panel.hidden));
  panel.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    show(false);
    button.focus();
  });
  set_text(by_id("session_line"), `${session.boat}: signed in to ${session.scope}. Lodesman ${session.version ?? ""}`);
  by_id("ticket").addEventListener("click", async () => {
    const address = await view_address().catch((error) => error.message);
    set_text(by_id("ticket_address"), address);
  });
  by_id("sign_out").addEventListener("click", async () => {
    await sign_out().catch(() => {});
    location.reload();
  });
}

class LinkWatch {
  #store;
  #banner = by_id("link_banner");
  #world_stamp = document.querySelector("#world_stage .age_stamp");
  #sonar = document.querySelector(".sonar");
  is_old = true; // what the link brings

  constructor(store) {
    this.#store = store;
  }

  look(now_ms) {
    const age_ms = this.#store.age_ms("boat", now_ms);
    this.is_old = this.#store.is_old(now_ms);
    const silence_s = this.#store.silence_s(now_ms);
    const is_silent = silence_s !== null && silence_s > kSilent_s;
    document.body.classList.toggle("old", this.is_old || is_silent);
    document.body.classList.toggle("cut", this.is_old);
    document.body.classList.toggle("never", age_ms === Infinity);
    this.#look_at_sonar(now_ms);
    this.#banner.hidden = !(this.is_old || is_silent);
    if (age_ms === Infinity) this.#say("No link yet", "Waiting for the first word of the boat.", "nothing yet");
    else if (this.is_old) {
      const age = span_text(age_ms / 1000);
      this.#say("LINK LOST", `What you see is ${age} old. ABORT and E-STOP are still given, and given again.`, `${age} old`);
    } else if (is_silent) {
      const age = span_text(silence_s);
      this.#say("THE BOAT IS SILENT", `The console answers, but the boat's heading and place are ${age} old.`, `${age} old`);
    }
  }

  #look_at_sonar(now_ms) {
    const age_s = this.#store.sonar_age_s(now_ms);
    const is_old = age_s > kSilent_s;
    this.#sonar.classList.toggle("old_sonar", is_old);
    if (is_old) set_text(this.#sonar.querySelector(".age_stamp"), Number.isFinite(age_s) ? `${span_text(age_s)} old` : "");
  }

  // The title is read aloud when it changes, the age is not.
  #say(title, rest, stamp) {
    if (this.#banner.dataset.title !== title) {
      this.#banner.dataset.title = title;
      this.#banner.replaceChildren(element("strong", {}, title), element("span", { "aria-live": "off" }));
    }
    set_text(this.#banner.lastElementChild, ` ${rest}`);
    set_text(this.#world_stamp, stamp);
  }
}

// A console that was started anew knows this session no more: the page begins anew, to sign in.
function ask_again_who() {
  ask_session().then(
    ({ scope }) => scope === null && location.reload(),
    () => {}, // no console: the link is tried again
  );
}

function make_parts(session) {
  const store = new Store();
  store.is_recording = Boolean(session.recording);
  const theme = new Theme(by_id("theme"));
  let command = null;
  const url = `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/`;
  const connection = new Connection(url, kTopics, {
    open() {},
    closed: () => {
      command.link_closed();
      ask_again_who();
    },
    services() {},
    message: (topic, message) => store.take(topic, message, performance.now()),
  });
  const orders_parts = { buttons: by_id("order_buttons"), urgent: by_id("urgent"), said: by_id("order_said"), next: by_id("order_next"), command: by_id("command_box") };
  let orders = null;
  command = new Command(connection, store, session, (text) => text && orders.tell(`Command: ${text}`, "warning"));
  orders = new Orders(orders_parts, command);
  const world_parts = Object.fromEntries(
    [["canvas", "world"], ["words", "world_words"], ["hint", "tool_hint"], ["follow", "follow"], ["show_all", "show_all"], ["zoom_in", "zoom_in"], ["zoom_out", "zoom_out"]]
      .map(([name, id]) => [name, by_id(id)]),
  );
  const world = new WorldView(world_parts, store, theme);
  const editor = new MissionEditor(by_id("panel_mission"), store, world);
  orders.mission = () => editor.mission;
  orders.started = () => editor.started();
  const tell = (text, severity) => orders.tell(text, severity);
  return {
    store, connection, orders, world, editor,
    sonar: new SonarView({ canvas: by_id("sonar"), words: by_id("sonar_words") }, store, theme),
    charts: new Charts(by_id("charts"), store, theme),
    lamps: new Lamps(by_id("lamps")),
    readouts: new Readouts(by_id("readouts")),
    health: new Health(by_id("panel_health"), store),
    manual: new Manual(by_id("panel_stick"), command, tell),
    tuning: new Tuning(by_id("panel_settings"), store, command, (label, reply) => orders.say_reply(label, reply)),
    story: new Story(by_id("story_now"), by_id("alarms"), store),
    events: new Events(by_id("panel_events"), store),
    replay: new Replay(by_id("replay"), store, connection),
    link: new LinkWatch(store),
  };
}

function make_loop(parts) {
  const { store, link } = parts;
  let last_ms = -Infinity;
  let looked_ms = -Infinity;
  const look = (now_ms) => {
    looked_ms = now_ms;
    link.look(now_ms);
    const linked = !link.is_old;
    parts.orders.refresh(linked, now_ms);
    parts.manual.refresh(linked);
    parts.tuning.refresh(linked);
    parts.lamps.render({ ...store.newest, status: store.status_now(now_ms) }, link.is_old, store.age_ms("boat", now_ms));
    if (!by_id("panel_health").hidden) parts.health.render();
  };
  const frame = () => {
    requestAnimationFrame(frame);
    const now_ms = performance.now();
    if (now_ms - last_ms < kFrame_ms) return;
    last_ms = now_ms;
    parts.world.render(now_ms);
    parts.sonar.render(now_ms);
    parts.charts.render(now_ms);
    parts.readouts.render(store.newest);
    if (now_ms - looked_ms >= kLookAgain_ms) look(now_ms);
  };
  // Frames stand still in a hidden page: what must not is looked at by a timer too.
  setInterval(() => {
    if (performance.now() - looked_ms > 2 * kLookAgain_ms) look(performance.now());
  }, kLookAgain_ms);
  frame();
}

async function main() {
  const session = await signed_in_session({ section: by_id("sign_in"), form: by_id("sign_in_form"), field: by_id("token"), error: by_id("sign_in_error") });
  document.body.classList.remove("starting");
  document.title = `${session.boat} – Lodesman`;
  set_text(by_id("boat_name"), session.boat || "Lodesman");
  by_id("recording_label").hidden = !session.recording;
  document.body.classList.toggle("is_recording", Boolean(session.recording));
  make_more(session);
  let parts = null;
  const choose = make_tabs((name) => {
    if (name !== "mission") parts?.editor.closed();
    if (name === "health") parts?.health.render();
  });
  parts = make_parts(session);
  choose("instruments");
  fill_legend(by_id("legend"));
  const legend_switch = by_id("legend_switch");
  legend_switch.addEventListener("click", () => {
    const legend = by_id("legend");
    legend.hidden = !legend.hidden;
    set_attribute(legend_switch, "aria-expanded", String(!legend.hidden));
  });
  parts.connection.start();
  make_loop(parts);
}

main().catch((error) => {
  const banner = by_id("link_banner");
  banner.hidden = false;
  set_text(banner, `The console does not answer: ${error.message}. Load the page again.`);
});
