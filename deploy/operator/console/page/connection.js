// SPDX-License-Identifier: Apache-2.0
// A client of the Foxglove WebSocket protocol: subscribes to topics by name, calls services, and is
// back by itself when the link breaks. What it tells: "open", "closed", "message".

const kProtocols = ["foxglove.sdk.v1", "foxglove.websocket.v1"];
const kSilence_ms = 6000; // nothing heard for so long: the link is made anew
const kConnect_ms = 4000;
const kRetry_ms = [250, 500, 1000, 2000];

export class CallFailure extends Error {}

export class Connection {
  #url;
  #topics;
  #on;
  #socket = null;
  #channels = new Map(); // topic -> channel id
  #subscribed = new Map(); // subscription id -> topic
  #services = new Map(); // name -> id
  #calls = new Map(); // call id -> {resolve, reject, timer}
  #next_id = 1;
  #retries = 0;
  #retry_timer = null;
  #watch_timer = null;
  #text = new TextDecoder();
  #bytes = new TextEncoder();
  #wanted = false;
  heard_ms = null; // performance.now() of the last bytes

  // `on`: {open(), closed(), message(topic, object), services()}
  constructor(url, topics, on) {
    this.#url = url;
    this.#topics = new Set(topics);
    this.#on = on;
  }

  get is_open() {
    return this.#socket?.readyState === WebSocket.OPEN;
  }

  has_service(name) {
    return this.is_open && this.#services.has(name);
  }

  // What was given to be sent and has not left this machine. A word of a stick must not wait there.
  get waiting_bytes() {
    return this.#socket?.bufferedAmount ?? 0;
  }

  start() {
    this.#wanted = true;
    this.#connect();
    this.#watch_timer ??= setInterval(() => this.#watch(), 500);
  }

  stop() {
    this.#wanted = false;
    clearInterval(this.#watch_timer);
    clearTimeout(this.#retry_timer);
    this.#watch_timer = this.#retry_timer = null;
    this.#drop();
  }

  #connect() {
    const socket = new WebSocket(this.#url, kProtocols);
    socket.binaryType = "arraybuffer";
    this.#socket = socket;
    this.heard_ms = performance.now();
    const mine = (act) => (event) => {
      if (this.#socket === socket) act(event);
    };
    socket.addEventListener("open", mine(() => this.#on.open()));
    socket.addEventListener("message", mine((event) => this.#take(event.data)));
    socket.addEventListener("close", mine(() => this.#lost()));
    socket.addEventListener("error", () => {});
  }

  #watch() {
    if (!this.#socket) return;
    const silent = performance.now() - this.heard_ms;
    const patience = this.is_open ? kSilence_ms : kConnect_ms;
    if (silent > patience) this.#lost();
  }

  #drop() {
    const socket = this.#socket;
    this.#socket = null;
    this.#channels.clear();
    this.#subscribed.clear();
    this.#services.clear();
    for (const { reject, timer } of this.#calls.values()) {
      clearTimeout(timer);
      reject(new CallFailure("the link broke before an answer came"));
    }
    this.#calls.clear();
    socket?.close();
  }

  #lost() {
    this.#drop();
    this.#on.closed();
    if (!this.#wanted) return;
    const wait = kRetry_ms[Math.min(this.#retries++, kRetry_ms.length - 1)];
    clearTimeout(this.#retry_timer);
    this.#retry_timer = setTimeout(() => this.#connect(), wait);
  }

  #take(data) {
    this.heard_ms = performance.now();
    if (typeof data === "string") this.#take_text(JSON.parse(data));
    else this.#take_bytes(new DataView(data));
  }

  #take_text(message) {
    switch (message.op) {
      case "serverInfo":
        this.#retries = 0;
        break;
      case "advertise":
        this.#subscribe(message.channels);
        break;
      case "unadvertise":
        for (const [topic, id] of this.#channels) if (message.channelIds.includes(id)) this.#channels.delete(topic);
        break;
      case "advertiseServices":
        for (const { id, name } of message.services) this.#services.set(name, id);
        this.#on.services();
        break;
      case "unadvertiseServices":
        for (const [name, id] of this.#services) if (message.serviceIds.includes(id)) this.#services.delete(name);
        this.#on.services();
        break;
      case "serviceCallFailure":
        this.#answer(message.callId, new CallFailure(message.message));
        break;
      default: // status and what this page has no use for
    }
  }

  #subscribe(channels) {
    const subscriptions = [];
    for (const { id, topic, encoding } of channels) {
      if (!this.#topics.has(topic) || encoding !== "json" || this.#channels.has(topic)) continue;
      this.#channels.set(topic, id);
      const subscription = this.#next_id++;
      this.#subscribed.set(subscription, topic);
      subscriptions.push({ id: subscription, channelId: id });
    }
    if (subscriptions.length > 0) this.#socket.send(JSON.stringify({ op: "subscribe", subscriptions }));
  }

  #take_bytes(view) {
    const opcode = view.getUint8(0);
    if (opcode === 1) {
      const topic = this.#subscribed.get(view.getUint32(1, true));
      if (topic) this.#on.message(topic, this.#json(view, 13));
    } else if (opcode === 3) {
      const encoding_bytes = view.getUint32(9, true);
      this.#answer(view.getUint32(5, true), this.#json(view, 13 + encoding_bytes));
    }
  }

  #json(view, from) {
    return JSON.parse(this.#text.decode(new Uint8Array(view.buffer, from)));
  }

  #answer(id, result) {
    const call = this.#calls.get(id);
    if (!call) return;
    this.#calls.delete(id);
    clearTimeout(call.timer);
    if (result instanceof Error) call.reject(result);
    else call.resolve(result);
  }

  // Resolves with the service's answer; rejects with CallFailure, also when none came in time.
  call(service, request, patience_ms = 4000) {
    const id = this.#services.get(service);
    if (id === undefined || !this.is_open) return Promise.reject(new CallFailure("there is no link"));
    const call_id = this.#next_id++;
    const encoding = this.#bytes.encode("json");
    const body = this.#bytes.encode(JSON.stringify(request));
    const packet = new Uint8Array(13 + encoding.length + body.length);
    const view = new DataView(packet.buffer);
    view.setUint8(0, 2);
    view.setUint32(1, id, true);
    view.setUint32(5, call_id, true);
    view.setUint32(9, encoding.length, true);
    packet.set(encoding, 13);
    packet.set(body, 13 + encoding.length);
    return new Promise((resolve, reject) => {
      const late = () => this.#answer(call_id, new CallFailure(`no answer within ${patience_ms / 1000} s`));
      this.#calls.set(call_id, { resolve, reject, timer: setTimeout(late, patience_ms) });
      this.#socket.send(packet);
    });
  }
}
