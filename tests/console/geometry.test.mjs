// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { page_module } from "./page_modules.mjs";

const { View, bar_length_m, bearing_deg, drawn_from_degrees, length_text, nearest_within, place_beside, unwrapped, wrap_180 } =
  await page_module("geometry.js");

const near = (a, b, within = 1e-9) => a.forEach((x, i) => assert.ok(Math.abs(x - b[i]) < within, `${a} is not ${b}`));

test("view: north is up, east is right, the centre in the middle", () => {
  const view = new View(400, 300, 10, [5, 20]);
  near(view.to_screen([5, 20]), [200, 150]);
  near(view.to_screen([6, 20]), [210, 150]);
  near(view.to_screen([5, 21]), [200, 140]);
});

test("view: what goes to the screen comes back", () => {
  const view = new View(411, 303, 17.5, [-3.2, 8.1]);
  for (const point of [[0, 0], [-12.5, 44], [1e4, -1e4]]) near(view.to_world(view.to_screen(point)), point, 1e-6);
});

test("view: zooming leaves what lies under the pointer there", () => {
  const view = new View(400, 300, 10, [5, 20]);
  const before = view.to_world([320, 40]);
  view.zoom_at([320, 40], 3.7);
  assert.equal(view.scale, 37);
  near(view.to_world([320, 40]), before);
});

test("view: neither closer nor farther than the limits", () => {
  const view = new View(400, 300, 10, [0, 0]);
  view.zoom_at([200, 150], 1e9);
  assert.equal(view.scale, 400);
  view.zoom_at([200, 150], 1e-9);
  assert.equal(view.scale, 0.05);
});

test("view: two fingers keep what lies between them, and their distance is the zoom", () => {
  const view = new View(400, 300, 10, [0, 0]);
  const between = view.to_world([150, 100]);
  view.pinch([[100, 100], [200, 100]], [[50, 120], [250, 120]]);
  assert.equal(view.scale, 20);
  near(view.to_world([150, 120]), between);
});

test("view: panning moves the water with the hand", () => {
  const view = new View(400, 300, 10, [0, 0]);
  const held = view.to_world([100, 100]);
  view.pan(30, -20);
  near(view.to_world([130, 80]), held);
});

test("view: all points fit into what is not covered", () => {
  const view = new View(800, 600, 1, [0, 0]);
  const points = [[-3, 0], [12, 40], [0, 20]];
  view.fit(points, { top: 50, left: 20, right: 100, bottom: 60 }, 400);
  for (const [x, y] of points.map((point) => view.to_screen(point))) {
    assert.ok(x >= 20 && x <= 700 && y >= 50 && y <= 540, `${x}, ${y}`);
  }
});

test("view: nothing to show changes nothing, one point keeps the scale", () => {
  const view = new View(800, 600, 7, [1, 2]);
  view.fit([]);
  view.fit([[NaN, 1]]);
  assert.deepEqual([view.scale, ...view.centre], [7, 1, 2]);
  view.fit([[5, 5]]);
  assert.equal(view.scale, 7);
  near(view.to_screen([5, 5]), [400, 300]);
});

test("scale bar: 1, 2 or 5 of a power of ten, and no longer than there is room", () => {
  for (let scale = 0.05; scale < 400; scale *= 1.31) {
    const metres = bar_length_m(scale, 140);
    assert.ok(metres * scale <= 140 + 1e-9 && metres * scale > 140 / 2.6, `${metres} m at ${scale}`);
    assert.match((metres / 10 ** Math.floor(Math.log10(metres) + 1e-9)).toFixed(3), /^[125]\.000$/);
  }
  assert.equal(length_text(2000), "2 km");
  assert.equal(length_text(0.5), "50 cm");
});

test("angles: bearings go clockwise from north, and headings do not jump there", () => {
  assert.equal(bearing_deg([0, 0], [1, 0]), 90);
  assert.equal(bearing_deg([0, 0], [-1, 0]), 270);
  assert.equal(wrap_180(350), -10);
  assert.equal(unwrapped(359, 2), 362);
  assert.equal(unwrapped(-1, 358), -2);
  assert.equal(unwrapped(null, 358), 358);
});

test("points: the nearest within reach, and the place of a new corner", () => {
  assert.equal(nearest_within([[0, 0], [2, 0]], [1.6, 0], 1), 1);
  assert.equal(nearest_within([[0, 0], [2, 0]], [9, 0], 1), -1);
  const square = [[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]];
  assert.equal(place_beside(square, [9.5, 5]), 2);
  assert.equal(place_beside(square, [0.2, 5]), 4);
});

test("degrees are drawn near the origin to some centimetres", () => {
  near(drawn_from_degrees([35.001, 139], [35, 139]), [0, 111.32], 0.5);
  near(drawn_from_degrees([35, 139.001], [35, 139]), [91.19, 0], 0.5);
});
