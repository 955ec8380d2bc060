// SPDX-License-Identifier: Apache-2.0
// Reads recordings with the library of MCAP's makers, every CRC checked: as a stream, and, where a
// file was finished, by its indexes too. What is in a Foxglove shape is held against the viewers' own
// schema. One JSON document on standard output; ends with 1 where something is not as it must be.
//   node read.js PACKAGES FILE...      PACKAGES: where install.sh has put what it needs
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const require = createRequire(path.resolve(process.argv[2], "x"));
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const foxglove = require("@foxglove/schemas/jsonschema.js");
const Ajv = require("ajv");
const fzstd = require("fzstd");

const decompressHandlers = { zstd: (packed, size) => fzstd.decompress(packed, new Uint8Array(Number(size))) };
const ajv = new Ajv({ strict: false, validateFormats: false });
const validators = new Map();
const complaints = [];

function validatorOf(name) {
  if (!validators.has(name)) {
    const schema = foxglove[name.replace(/^foxglove\./, "")];
    validators.set(name, schema ? ajv.compile(schema) : null);
  }
  return validators.get(name);
}

class Counter {
  topics = {};
  foxglove = {};
  schemas = new Map();
  channels = new Map();
  take(record) {
    if (record.type === "Schema") this.schemas.set(record.id, record);
    if (record.type === "Channel") this.channels.set(record.id, record);
    if (record.type === "Message") this.message(record);
  }
  message(record) {
    const channel = this.channels.get(record.channelId);
    this.topics[channel.topic] = (this.topics[channel.topic] ?? 0) + 1;
    const schema = this.schemas.get(channel.schemaId);
    if (channel.messageEncoding !== "json") return;
    const value = JSON.parse(new TextDecoder().decode(record.data));
    if (!schema.name.startsWith("foxglove.")) return;
    const validate = validatorOf(schema.name);
    if (!validate) complaints.push(`${schema.name}: the viewers know no such schema`);
    else if (!validate(value)) complaints.push(`${channel.topic}: ${ajv.errorsText(validate.errors)}`);
    else this.foxglove[schema.name] = (this.foxglove[schema.name] ?? 0) + 1;
  }
}

// Also of a file that was cut off: `done` says whether it was finished.
function stream(file) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  const counter = new Counter();
  const bytes = fs.readFileSync(file);
  for (let at = 0; at < bytes.length; at += 1 << 20) {
    reader.append(bytes.subarray(at, Math.min(at + (1 << 20), bytes.length)));
    for (let record = reader.nextRecord(); record; record = reader.nextRecord()) counter.take(record);
  }
  return { counter, done: reader.done() };
}

async function indexed(file) {
  const handle = await fs.promises.open(file);
  const { size } = await handle.stat();
  const readable = {
    size: async () => BigInt(size),
    read: async (offset, length) => {
      const bytes = new Uint8Array(Number(length));
      await handle.read(bytes, 0, bytes.length, Number(offset));
      return bytes;
    },
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  let messages = 0;
  let last = -1n;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    if (message.logTime < last) complaints.push(`${file}: out of order by its index`);
    last = message.logTime;
    ++messages;
  }
  const attachments = {};
  for await (const attachment of reader.readAttachments({ validateCrcs: true })) {
    attachments[attachment.name] = attachment.data.byteLength;
  }
  const metadata = {};
  for await (const record of reader.readMetadata()) metadata[record.name] = Object.fromEntries(record.metadata);
  await handle.close();
  return { messages, attachments, metadata, statistics: Number(reader.statistics.messageCount) };
}

const files = {};
for (const file of process.argv.slice(3)) {
  try {
    const { counter, done } = stream(file);
    files[file] = { done, topics: counter.topics, foxglove: counter.foxglove };
    if (done) files[file].indexed = await indexed(file);
  } catch (error) {
    complaints.push(`${file}: ${error.message}`);
  }
}
console.log(JSON.stringify({ files, complaints: complaints.slice(0, 20) }, null, 1));
process.exitCode = complaints.length > 0 || Object.keys(files).length === 0 ? 1 : 0;
