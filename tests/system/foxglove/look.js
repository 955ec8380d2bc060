// SPDX-License-Identifier: Apache-2.0
// Looks at a console by the protocol's own client, and says what it saw as JSON:
//   node look.js PACKAGES PORT TOKEN [SUBPROTOCOL...]
// Signs in, subscribes to all topics, waits until each of those that always speak has spoken three
// times, asks the boat for its status by the service, and ends.
import { createRequire } from "node:module";

const [packages, port, token, ...subprotocols] = process.argv.slice(2);
const require = createRequire(`${packages}/`);
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const WebSocket = require("ws");

const always = ["/tf", "/lodesman/boat", "/lodesman/world", "/lodesman/status"];
const seen = { counts: {}, errors: [], subprotocol: "", services: [], reply: null, wrong: [] };

const finish = (status) => {
  process.stdout.write(JSON.stringify(seen) + "\n");
  process.exit(status);
};
setTimeout(() => finish(1), 60000);

const signedIn = await fetch(`http://127.0.0.1:${port}/session`, {
  method: "POST",
  headers: { "Content-Type": "application/json" },
  body: JSON.stringify({ token }),
});
if (signedIn.status !== 204) {
  seen.errors.push(`sign-in: ${signedIn.status}`);
  finish(1);
}
const cookie = signedIn.headers.get("set-cookie").split(";")[0];

const offered = subprotocols.length > 0 ? subprotocols : ["foxglove.sdk.v1", "foxglove.websocket.v1"];
const socket = new WebSocket(`ws://127.0.0.1:${port}/`, offered, { headers: { Cookie: cookie } });
const client = new FoxgloveClient({ ws: socket });
const topics = new Map();

const mayEnd = () => {
  if (always.every((topic) => (seen.counts[topic] ?? 0) >= 3) && seen.reply !== null) {
    client.close();
    finish(0);
  }
};

client.on("error", (error) => {
  seen.errors.push(String(error));
  finish(1);
});
client.on("serverInfo", (info) => {
  seen.subprotocol = socket.protocol;
  seen.name = info.name;
  seen.capabilities = info.capabilities;
});
client.on("status", (status) => seen.errors.push(status.message));
client.on("advertise", (channels) => {
  for (const channel of channels) {
    const schema = JSON.parse(channel.schema);
    if (channel.encoding !== "json" || channel.schemaEncoding !== "jsonschema" || schema.type !== "object") {
      seen.wrong.push(channel.topic);
    }
    topics.set(client.subscribe(channel.id), channel.topic);
  }
});
client.on("advertiseServices", (services) => {
  seen.services = services.map((service) => service.name);
  client.sendServiceCallRequest({
    serviceId: services[0].id,
    callId: 7,
    encoding: "json",
    data: new DataView(new TextEncoder().encode('{"command":"status"}').buffer),
  });
});
client.on("serviceCallResponse", (response) => {
  seen.reply = JSON.parse(new TextDecoder().decode(response.data));
  mayEnd();
});
client.on("message", ({ subscriptionId, data }) => {
  const topic = topics.get(subscriptionId);
  JSON.parse(new TextDecoder().decode(data));
  seen.counts[topic] = (seen.counts[topic] ?? 0) + 1;
  mayEnd();
});
