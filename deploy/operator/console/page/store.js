// SPDX-License-Identifier: Apache-2.0
// What came last of each topic and when, the track that was sailed, and whether what is here may be
// taken for the present. One for the page.
import { distance } from "./geometry.js";

export const kTopics = [
  "boat", "world", "coverage", "sonar", "status", "story", "events", "clients", "replay",
].map((name) => `/lodesman/${name}`);

export const kOld_ms = 1500; // a boat that has said nothing for so long is not shown as if it had
const kOldStatus_ms = 4000; // it comes twice a second
const kTrackStep_m = 0.1;
const kMostTrack = 4000;

export class Store {
  #listeners = new Map();
  #came_ms = new Map();
  newest = {}; // by the topic's last word: boat, world, ...
  track = []; // {x, y, t_s}, the oldest first
  is_recording = false;

  on(name, act) {
    if (!this.#listeners.has(name)) this.#listeners.set(name, []);
    this.#listeners.get(name).push(act);
  }

  tell(name, value) {
    for (const act of this.#listeners.get(name) ?? []) act(value);
  }

  take(topic, message, now_ms) {
    const name = topic.slice("/lodesman/".length);
    this.#came_ms.set(name, now_ms);
    this.newest[name] = message;
    if (name === "boat") this.#take_boat(message);
    this.tell(name, message);
  }

  // Milliseconds since this topic was last heard; Infinity where it never was.
  age_ms(name, now_ms) {
    const came = this.#came_ms.get(name);
    return came === undefined ? Infinity : now_ms - came;
  }

  // A paused recording says nothing new and is not old.
  get #is_paused() {
    return this.is_recording && this.newest.replay?.playing === false;
  }

  // Whether the link brings nothing any more.
  is_old(now_ms) {
    if (this.#is_paused) return this.age_ms("replay", now_ms) > 5 * kOld_ms;
    return this.age_ms("boat", now_ms) > kOld_ms;
  }

  // Seconds since the boat itself knew where it is or looks: the link may stand while it is dead. Null
  // where it never knew.
  silence_s(now_ms) {
    const { attitude, state } = this.newest.boat?.ages_s ?? {};
    const ages = [attitude, state].filter((age) => typeof age === "number");
    if (ages.length === 0) return null;
    return Math.min(...ages) + (this.#is_paused ? 0 : this.age_ms("boat", now_ms) / 1000);
  }

  // The boat's status, or that it is too old to go by.
  status_now(now_ms) {
    const { status } = this.newest;
    const age_ms = this.age_ms("status", now_ms);
    if (!status || this.#is_paused || age_ms < kOldStatus_ms) return status;
    return { ok: false, error: `its state was last told ${(age_ms / 1000).toFixed(0)} s ago` };
  }

  // The same of its newest ping.
  sonar_age_s(now_ms) {
    const age = this.newest.boat?.ages_s?.sonar;
    const heard_s = this.#is_paused ? 0 : this.age_ms("sonar", now_ms) / 1000;
    return typeof age === "number" ? Math.max(age, heard_s) : heard_s;
  }

  #take_boat({ position_m, time_s }) {
    const last = this.track.at(-1);
    if (last && time_s < last.t_s - 0.5) this.track.length = 0;
    if (!position_m) return;
    const [x, y] = position_m;
    if (last && this.track.length > 0 && distance([last.x, last.y], position_m) < kTrackStep_m) return;
    this.track.push({ x, y, t_s: time_s });
    if (this.track.length > kMostTrack) this.track.splice(0, kMostTrack / 10);
  }
}
