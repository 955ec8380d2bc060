// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { page_module } from "./page_modules.mjs";

const { next_step, why_not } = await page_module("permissions.js");
const { Store } = await page_module("store.js");

const status = (more = {}) => ({ ok: true, state: "idle", not_ready: [], thrust: { state: "armed", cause: "order", against_arming: [] }, ...more });
const now = (more = {}) => ({ scope: "command", link: true, recording: false, commander: null, mine: false, draft: false, status: status(), ...more });

test("stops: given by whoever may, with or without a link, whoever commands, whatever the state", () => {
  for (const word of ["abort", "estop"]) {
    for (const link of [true, false]) {
      for (const one of [undefined, { ok: false, error: "gone" }, status({ state: "reached" })]) {
        assert.equal(why_not(word, now({ link, status: one, scope: "abort", commander: { name: "Ann" } })), null);
      }
    }
    assert.match(why_not(word, now({ scope: "view" })), /not good for/);
    assert.match(why_not(word, now({ recording: true })), /recording/);
  }
});

test("orders: none without a link, without the scope, or beside another commander", () => {
  for (const word of ["arm", "start", "hold", "resume", "manual", "tune", "estop_release"]) {
    assert.match(why_not(word, now({ link: false })), /link is lost/);
    assert.match(why_not(word, now({ scope: "abort" })), /not good for/);
    assert.match(why_not(word, now({ commander: { name: "Ann" } })), /held by "Ann"/);
    assert.match(why_not(word, now({ status: { ok: false, error: "no boat" } })), /no boat/);
  }
  assert.equal(why_not("disarm", now({ scope: "abort", commander: { name: "Ann" } })), null);
});

test("orders: the boat's own reasons are passed on", () => {
  const lacks = status({ not_ready: ["no heading", "no sonar frame"] });
  assert.equal(why_not("start", now({ status: lacks })), "no heading; no sonar frame");
  assert.match(next_step(now({ status: lacks })), /no heading; no sonar frame/);
  const stopped = status({ thrust: { state: "stopped", cause: "order", against_arming: ["the emergency stop is latched"] } });
  assert.match(why_not("arm", now({ status: stopped })), /latched/);
  assert.match(why_not("manual", now({ status: stopped })), /latched/);
  assert.equal(why_not("estop_release", now({ status: stopped })), null);
});

test("orders: by the state of the mission", () => {
  assert.match(why_not("hold", now()), /idle/);
  assert.match(why_not("resume", now()), /idle/);
  assert.equal(why_not("hold", now({ status: status({ state: "under_way" }) })), null);
  assert.equal(why_not("resume", now({ status: status({ state: "holding" }) })), null);
  assert.match(why_not("start", now({ status: status({ state: "under_way" }) })), /already/);
  assert.equal(why_not("start", now({ status: status({ state: "under_way" }), draft: true })), null);
  assert.equal(why_not("arm", now({ status: status({ state: "aborted" }) })), null, "ends an abort for the stick");
  assert.match(why_not("arm", now()), /armed already/);
});

test("store: a boat that has said nothing for a while is old, a recording that stands still is not", () => {
  const store = new Store();
  assert.equal(store.is_old(0), true);
  store.take("/lodesman/boat", { position_m: [0, 0], time_s: 1 }, 1000);
  assert.equal(store.is_old(2400), false);
  assert.equal(store.is_old(2600), true);
  store.is_recording = true;
  store.take("/lodesman/replay", { playing: false }, 3000);
  assert.equal(store.is_old(4000), false);
  assert.equal(store.is_old(60000), true);
});

test("store: the track keeps to a bound, and begins anew with the boat's clock", () => {
  const store = new Store();
  for (let i = 0; i < 20000; i++) store.take("/lodesman/boat", { position_m: [i, 0], time_s: i / 10 }, i);
  assert.ok(store.track.length <= 4000);
  assert.equal(store.track.at(-1).x, 19999);
  store.take("/lodesman/boat", { position_m: [5, 5], time_s: 0 }, 20001);
  assert.equal(store.track.length, 1);
});

test("store: a place that the boat itself no longer knows is old though the link stands", () => {
  const store = new Store();
  assert.equal(store.silence_s(0), null);
  store.take("/lodesman/boat", { position_m: [0, 0], time_s: 9, ages_s: { attitude: 7.5, state: 8, sonar: null } }, 1000);
  assert.equal(store.is_old(1100), false);
  assert.equal(store.silence_s(1100), 7.6);
  assert.equal(store.sonar_age_s(1100), Infinity);
});

test("store: a status that was told long ago is none to go by", () => {
  const store = new Store();
  store.take("/lodesman/status", status(), 1000);
  assert.equal(store.status_now(2000).state, "idle");
  assert.match(store.status_now(9000).error, /8 s ago/);
  assert.equal(why_not("abort", now({ status: store.status_now(9000) })), null);
});
