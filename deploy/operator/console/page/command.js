// SPDX-License-Identifier: Apache-2.0
// Words to the boat over the console's service, and who commands: whoever took the command here says so
// once a second for as long as the page lives and is linked. Nobody else says it in its stead.
import { why_not } from "./permissions.js";

const kService = "/lodesman/command";
const kHeartbeat_ms = 1000;

export class Command {
  #connection;
  #store;
  #session;
  #heart = null;
  #told;
  mine = false;
  was_mine = false; // until the link broke
  draft = false; // a mission has been drawn that was not started

  // `told`: called after each change of who commands.
  constructor(connection, store, session, told) {
    this.#connection = connection;
    this.#store = store;
    this.#session = session;
    this.#told = told;
  }

  // What permissions are judged by. `link`: whether what is shown is the present.
  situation(link) {
    const { clients } = this.#store.newest;
    const status = this.#store.status_now(performance.now());
    return {
      recording: this.#session.recording,
      scope: clients?.you?.scope ?? this.#session.scope,
      link: link && this.#connection.has_service(kService),
      status,
      commander: status?.commander ?? clients?.commander ?? null,
      mine: this.mine,
      draft: this.draft,
    };
  }

  why_not(word, link) {
    return why_not(word, this.situation(link));
  }

  // Resolves with the boat's reply, or with one of the same form where there is none.
  async say(request, patience_ms = 4000) {
    try {
      return await this.#connection.call(kService, request, patience_ms);
    } catch (error) {
      return { ok: false, error: error.message, lost: true };
    }
  }

  // For words that come ten times a second: not given where earlier ones have not even left.
  say_if_clear(request) {
    if (this.#connection.waiting_bytes > 2048) return Promise.resolve({ ok: false, error: "the link is slow", lost: true });
    return this.say(request, 1500);
  }

  async take(name, force) {
    const reply = await this.say({ command: "take", name, ...(force ? { force: true } : {}) });
    if (reply.ok) {
      this.mine = true;
      this.was_mine = false;
      this.#heart ??= setInterval(() => this.#beat(), kHeartbeat_ms);
    }
    this.#told();
    return reply;
  }

  async release() {
    this.#give_up();
    const reply = await this.say({ command: "release" });
    this.#told();
    return reply;
  }

  async #beat() {
    const reply = await this.say({ command: "heartbeat" }, 2500);
    if (reply.ok || reply.lost || !this.mine) return;
    this.#give_up();
    this.#told(reply.error);
  }

  #give_up() {
    clearInterval(this.#heart);
    this.#heart = null;
    this.mine = false;
  }

  // The console ends the session's connection to the boat with the link, and the command with it.
  link_closed() {
    this.was_mine ||= this.mine;
    this.#give_up();
    this.#told();
  }
}
