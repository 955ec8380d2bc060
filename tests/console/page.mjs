// SPDX-License-Identifier: Apache-2.0
// The operator's page in a browser without a screen, on a boat: signed in, armed, started, held, aborted,
// sent to a goal that is tapped, steered by keys, cut off, and looked at for a minute. Ends with 1 at the
// first thing that is not as it must be, an error of the page or a request off this machine.
//   node page.mjs PACKAGES --bin DIR [--console FILE] [--page DIR] [--scenario NAME] [--shots DIR] [--seconds 60]
//   node page.mjs PACKAGES --url URL --token TOKEN [--pid N] [--shots DIR] [--seconds 60]
// PACKAGES: where install_node_packages.sh has put what it needs. DIR of --bin: the boat's programs. --pid: of the
// console, which is stopped and let go again; without it that step is left out. --hz: how many messages of
// the boat a second have to come in that minute, which sends 10; 2 without it, for a busy machine.
import assert from "node:assert/strict";
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { parseArgs } from "node:util";
import { pause, start_boat, until } from "./boat.mjs";

const kSizes = [["desktop", 1440, 900], ["tablet", 1024, 768], ["portrait", 820, 1180]];
const kMostGrowth_bytes = 1500000;
const kHeapLooks = 12;

const { positionals, values: given } = parseArgs({
  allowPositionals: true,
  options: {
    bin: { type: "string" }, page: { type: "string" }, url: { type: "string" }, token: { type: "string" },
    console: { type: "string" }, scenario: { type: "string" }, pid: { type: "string" }, shots: { type: "string" }, seconds: { type: "string", default: "60" },
    hz: { type: "string", default: "2" },
  },
});
const { chromium } = createRequire(path.resolve(positionals[0] ?? ".", "x"))("playwright-core");

// ---- A browser that keeps book of what went wrong

const wrong = [];
let cut = false; // while the console is stopped a failed connection is no fault

function watch(page) {
  page.on("pageerror", (error) => wrong.push(`error of the page: ${error.stack ?? error.message}`));
  page.on("console", (message) => {
    const excused = cut && /WebSocket connection|ERR_/.test(message.text());
    if (["error", "warning"].includes(message.type()) && !excused) wrong.push(`console: ${message.text()}`);
  });
  page.on("request", (request) => {
    const { protocol, hostname } = new URL(request.url());
    if (protocol !== "data:" && protocol !== "blob:" && hostname !== "127.0.0.1") wrong.push(`request off this machine: ${request.url()}`);
  });
  page.on("response", (response) => {
    if (response.status() >= 400) wrong.push(`${response.status()} ${response.url()}`);
  });
}

// Counts what comes by the WebSocket, by subscription.
function count_messages() {
  window.came = {};
  const Plain = window.WebSocket;
  window.WebSocket = class extends Plain {
    constructor(...args) {
      super(...args);
      this.addEventListener("message", ({ data }) => {
        if (typeof data === "string") return;
        const view = new DataView(data);
        const subscription = view.getUint32(1, true);
        if (view.getUint8(0) === 1) window.came[subscription] = (window.came[subscription] ?? 0) + 1;
      });
    }
  };
}

async function opened(browser, url, token, size = kSizes[0], scheme = "light") {
  const context = await browser.newContext({ viewport: { width: size[1], height: size[2] }, colorScheme: scheme });
  const page = await context.newPage();
  watch(page);
  await page.addInitScript(count_messages);
  await page.goto(`${url}/#token=${token}`);
  await until("the boat's first word", () => page.evaluate(() => !document.body.matches(".starting, .old")));
  return page;
}

const lamp = (page, name) => page.locator("#lamps li", { hasText: name }).locator("b").innerText();
const shows = (page, name, pattern, patience) => until(`${name}: ${pattern}`, async () => pattern.test(await lamp(page, name)), patience);
const said = (page) => page.locator("#order_said").innerText();
const may = (page, id) => page.locator(`#${id}:not([aria-disabled])`).waitFor({ timeout: 10000 });
const thrust = (page) => page.locator(".thrust .bar b").allInnerTexts();

async function press(page, word) {
  await may(page, `order_${word}`);
  await page.click(`#order_${word}`);
}

// ---- The steps

async function signs_in(browser, { url, tokens }) {
  const context = await browser.newContext();
  const page = await context.newPage();
  watch(page);
  await page.goto(url);
  await page.locator("#sign_in").waitFor();
  await page.fill("#token", tokens.command);
  await page.click("#sign_in_form button");
  await page.locator("#sign_in").waitFor({ state: "hidden" });
  await context.close();
}

async function sails(page) {
  assert.equal(new URL(page.url()).hash, "", "the token is taken out of the address");
  if (/Disarmed/.test(await lamp(page, "Thrusters"))) await press(page, "arm");
  await shows(page, "Thrusters", /Armed/);
  await press(page, "start");
  await shows(page, "Mission", /Under way/);
  await until("way is made", async () => Number(await page.locator(".reading_speed b").innerText()) > 0.05, 20000);
  await press(page, "hold");
  await shows(page, "Mission", /Holding/);
  await press(page, "resume");
  await shows(page, "Mission", /Under way/);
}

async function aborts(page) {
  await page.click("#abort");
  await until("the abort is confirmed", async () => /confirmed in/.test(await page.locator("#abort").innerText()));
  await shows(page, "Mission", /Aborted/);
  await until("thrust is neutral", async () => (await thrust(page)).every((value) => Number(value) === 0));
}

async function taps_a_goal(page) {
  await page.click("#tab_mission");
  await page.click("#tool_goal");
  const box = await page.locator("#world").boundingBox();
  await page.mouse.click(box.x + box.width * 0.36, box.y + box.height * 0.42);
  await page.click("#tool_waypoint");
  await page.mouse.click(box.x + box.width * 0.4, box.y + box.height * 0.6);
  const text = await page.locator("#mission_text").inputValue();
  const [, east, north] = /^goal_m = \[(-?[\d.]+), (-?[\d.]+)\]$/m.exec(text).map(Number);
  assert.match(text, /^waypoints_m = \[\[/m);
  await press(page, "start");
  await shows(page, "Mission", /Under way/);
  await until("the boat makes for what was tapped", async () => {
    const words = await page.locator("#world_words").textContent();
    const [, x, y, off] = /at (-?[\d.]+) m east, (-?[\d.]+) m north.*?goal ([\d.]+) m off/.exec(words)?.map(Number) ?? [];
    return Math.abs(Math.hypot(east - x, north - y) - off) < 0.5;
  });
  await page.click("#tab_instruments");
}

async function steers_by_keys(page) {
  await aborts(page);
  await press(page, "arm");
  await page.click("#tab_stick");
  await page.locator("#stick:not([aria-disabled])").waitFor();
  await page.focus("#stick");
  await page.keyboard.down("w");
  await shows(page, "Thrusters", /By hand/);
  await until("it thrusts ahead", async () => (await thrust(page)).every((value) => Number(value) > 5));
  await page.keyboard.down("d");
  await until("it turns to starboard", async () => {
    const [left, right] = (await thrust(page)).map(Number);
    return left > right + 5;
  });
  await page.keyboard.up("d");
  await page.keyboard.up("w");
  await until("let go, it is neutral", async () => (await thrust(page)).every((value) => Number(value) === 0), 3000);
  await page.keyboard.down("w");
  await until("again ahead", async () => (await thrust(page)).every((value) => Number(value) > 5));
  await page.focus("#order_disarm");
  await until("without the focus it is neutral", async () => (await thrust(page)).every((value) => Number(value) === 0), 3000);
  await page.keyboard.up("w");
  await page.click("#tab_instruments");
}

async function stops(page) {
  await page.keyboard.press("Shift+E");
  await until("the stop is confirmed", async () => /confirmed in/.test(await page.locator("#estop").innerText()));
  await shows(page, "Thrusters", /E-stopped/);
  await page.click("#order_arm", { force: true });
  assert.match(await said(page), /latched/, "the reason is in reach");
  await press(page, "estop_release");
  assert.match(await said(page), /Press again/, "not by one touch");
  await press(page, "estop_release");
  await shows(page, "Thrusters", /Disarmed/);
}

async function is_tuned(page) {
  await page.click("#tab_settings");
  const row = page.locator(".tunable", { hasText: "zones.margin_m" });
  await row.locator("input[type=number]").fill("1.05");
  await row.locator("button", { hasText: "Set" }).click();
  await until("the setting is taken", async () => (await row.locator("output").innerText()) === "1.05");
  await row.locator("input[type=number]").fill("99");
  await row.locator("button", { hasText: "Set" }).click();
  assert.match(await said(page), /must be 0 to 20/);
  await row.locator("button", { hasText: "back to" }).click();
  await until("the setting is as before", async () => (await row.locator("output").innerText()) !== "1.05");
  await page.click("#tab_instruments");
}

async function commands(browser, page, { url, tokens }) {
  const other = await opened(browser, url, tokens.command);
  await other.fill("#command_name", "Bridge");
  await may(other, "take");
  await other.click("#take");
  await until("the command is taken", async () => /You command/.test(await other.locator("#commander").innerText()));
  await until("the other page says whose it is", async () => /Bridge/.test(await page.locator("#commander").innerText()));
  await page.click("#order_start", { force: true });
  assert.match(await said(page), /held by "Bridge"/, "the reason is in reach");
  await aborts(page);
  await other.click("#take");
  await until("the command is given back", async () => /Nobody/.test(await page.locator("#commander").innerText()));
  await other.context().close();
}

async function is_cut_off(page, pid) {
  cut = true;
  process.kill(pid, "SIGSTOP");
  try {
    await page.locator("#link_banner strong", { hasText: "LINK LOST" }).waitFor({ timeout: 6000 });
    assert.match(await page.locator("#link_banner").innerText(), /[\d.]+ s old/);
    assert.match(await lamp(page, "Link"), /LOST/);
    assert.ok(await page.locator("#order_start[aria-disabled]").count(), "no start without a link");
    assert.ok(await page.locator("#abort:not([aria-disabled])").count(), "an abort without a link");
    await shot(page, "link_lost");
    await page.click("#abort");
    await until("the abort is given again", async () => /given [2-9] ×/.test(await page.locator("#abort").innerText()));
  } finally {
    process.kill(pid, "SIGCONT");
  }
  await until("the abort is confirmed", async () => /confirmed in/.test(await page.locator("#abort").innerText()), 6000);
  await page.locator("#link_banner").waitFor({ state: "hidden", timeout: 15000 });
  cut = false;
}

async function lasts(page, seconds) {
  const cdp = await page.context().newCDPSession(page);
  // The least of several: between the sweeping and the looking the page goes on.
  const heap = async () => {
    const sizes = [];
    for (let i = 0; i < kHeapLooks; i++) {
      await cdp.send("HeapProfiler.collectGarbage");
      sizes.push((await cdp.send("Runtime.getHeapUsage")).usedSize);
    }
    return Math.min(...sizes);
  };
  const busy = async () => {
    const { metrics } = await cdp.send("Performance.getMetrics");
    return metrics.find(({ name }) => name === "TaskDuration").value;
  };
  await cdp.send("Performance.enable");
  await page.waitForFunction(() => performance.now() > 65000, null, { timeout: 70000 }); // the charts are full
  const [before, busy_before] = [await heap(), await busy()];
  await page.evaluate(() => (window.came = {}));
  const began = Date.now();
  await pause(seconds * 1000);
  const long_s = (Date.now() - began) / 1000;
  const rate_Hz = Math.max(...Object.values(await page.evaluate(() => window.came))) / long_s;
  const share = ((await busy()) - busy_before) / long_s;
  const growth = (await heap()) - before;
  console.log(`${seconds} s: ${rate_Hz.toFixed(2)} messages a second, heap ${before} + ${growth} bytes, ${(100 * share).toFixed(1)} % of a core in the page`);
  assert.ok(rate_Hz > Number(given.hz), `${rate_Hz} messages a second of the boat`);
  assert.ok(growth < kMostGrowth_bytes, `the heap grew by ${growth} bytes`);
}

// ---- Pictures

async function shot(page, name) {
  if (!given.shots) return;
  fs.mkdirSync(given.shots, { recursive: true });
  await page.screenshot({ path: path.join(given.shots, `${name}.png`) });
}

async function sizes(page) {
  for (const [name, width, height] of kSizes) {
    await page.setViewportSize({ width, height });
    await pause(700);
    await page.click("#show_all");
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= width, `${name} scrolls across: ${wide} of ${width} pixels`);
    for (const id of ["abort", "estop"]) {
      const box = await page.locator(`#${id}`).boundingBox();
      assert.ok(box.x >= 0 && box.y >= 0 && box.x + box.width <= width && box.y + box.height <= height, `${id} is in sight at ${name}`);
    }
    for (const theme of ["light", "dark", "sun"]) {
      await page.selectOption("#theme", theme);
      await pause(400);
      await shot(page, `${name}_${theme}`);
    }
  }
  await page.selectOption("#theme", "auto");
  await page.setViewportSize({ width: kSizes[0][1], height: kSizes[0][2] });
}

async function step(name, does) {
  const began = Date.now();
  await does();
  assert.deepEqual(wrong, [], name);
  console.log(`${name}: ${((Date.now() - began) / 1000).toFixed(1)} s`);
}

async function look(browser, boat) {
  await step("signs in by the form", () => signs_in(browser, boat));
  const page = await opened(browser, boat.url, boat.tokens.command);
  try {
    await step("arms, starts, holds, resumes", () => sails(page));
    await step("looks right at all sizes", () => sizes(page));
    await step("aborts", () => aborts(page));
    await step("is sent to a goal that is tapped", () => taps_a_goal(page));
    await step("is steered by keys", () => steers_by_keys(page));
    await step("is commanded by one, aborted by all", () => commands(browser, page, boat));
    await step("is stopped by keys, and released", () => stops(page));
    await step("is tuned within limits", () => is_tuned(page));
    if (boat.pid) await step("is cut off, and says so", () => is_cut_off(page, boat.pid));
    await press(page, "arm");
    await press(page, "start");
    await step("lasts", () => lasts(page, Number(given.seconds)));
  } catch (error) {
    await shot(page, "failed");
    throw error;
  }
}

const boat = given.bin
  ? await start_boat(path.resolve(given.bin), { served_by: given.console, page: given.page && path.resolve(given.page), scenario: given.scenario })
  : { url: given.url, tokens: { command: given.token }, pid: given.pid ? Number(given.pid) : null, stop: async () => {}, texts: () => "" };
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
try {
  await look(browser, boat);
} catch (error) {
  console.error(error.stack ?? error.message, "\n", wrong.join("\n"), "\n", boat.texts());
  process.exitCode = 1;
} finally {
  await browser.close();
  await boat.stop();
}
