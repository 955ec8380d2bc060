// SPDX-License-Identifier: Apache-2.0
// A simulated boat with its console, of the programs in a directory: started here, ended here.
import { spawn } from "node:child_process";
import fs from "node:fs";
import net from "node:net";
import os from "node:os";
import path from "node:path";

const kPatience_ms = 30000;

export const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

export async function until(what, holds, patience_ms = 10000) {
  const ends = Date.now() + patience_ms;
  for (;;) {
    const value = await holds();
    if (value) return value;
    if (Date.now() > ends) throw new Error(`${what}: not within ${patience_ms / 1000} s`);
    await pause(50);
  }
}

function free_port() {
  return new Promise((resolve, reject) => {
    const server = net.createServer();
    server.once("error", reject);
    server.listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

class Program {
  text = "";
  constructor(file, args, env) {
    this.child = spawn(file, args, { env, stdio: ["ignore", "pipe", "pipe"] });
    for (const stream of [this.child.stdout, this.child.stderr]) stream.on("data", (bytes) => (this.text += bytes));
    this.ended = new Promise((resolve) => this.child.once("exit", resolve));
  }
  signal(name) {
    this.child.kill(name);
  }
  async stop() {
    if (this.child.exitCode !== null || this.child.signalCode !== null) return;
    this.signal("SIGCONT");
    this.signal("SIGTERM");
    const late = setTimeout(() => this.signal("SIGKILL"), 8000);
    await this.ended;
    clearTimeout(late);
  }
}

// `bin`: where the programs lie; `served_by`: the console, where it is another's; `page`: the page's files, or
// null for those that the console finds.
export async function start_boat(bin, { served_by, page, scenario = "paper-static" }) {
  const scratch = fs.mkdtempSync(path.join(os.tmpdir(), "lodesman-console-"));
  const port = await free_port();
  const console_port = await free_port();
  const env = { ...process.env, RUNTIME_DIRECTORY: scratch, STATE_DIRECTORY: scratch };
  const config = path.join(scratch, "boat.toml");
  fs.writeFileSync(config, `[boat]
name = "page-boat"
segment = "lodesman-page-${process.pid}"
[command_socket]
port = ${port}
[simulation]
scenario = "${scenario}"
`);
  // Not "lodesman sim": that ends with its mission, and an abort ends it.
  const boat = new Program(path.join(bin, "lodesman"), ["run", "--config", config], env);
  const token_file = path.join(scratch, `command-${port}.token`);
  const programs = [boat];
  const stop = async () => {
    for (const program of [...programs].reverse()) await program.stop();
    fs.rmSync(scratch, { recursive: true, force: true });
  };
  try {
    await until(`a boat; ${boat.text}`, () => fs.existsSync(token_file), kPatience_ms);
    const served = new Program(served_by ?? path.join(bin, "lodesman-console"), ["--config", config, "--set", `console.port=${console_port}`, ...(page ? ["--page", page] : [])], env);
    programs.push(served);
    const url = `http://127.0.0.1:${console_port}`;
    await until("the console", () => fetch(`${url}/session`).then((answer) => answer.ok, () => false), kPatience_ms);
    const [command, abort, view] = fs.readFileSync(token_file, "utf8").split("\n");
    return { url, tokens: { command, abort, view }, pid: served.child.pid, stop, texts: () => programs.map(({ text }) => text).join("\n") };
  } catch (error) {
    await stop();
    throw new Error(`${error.message}\n${programs.map(({ text }) => text).join("\n")}`);
  }
}
