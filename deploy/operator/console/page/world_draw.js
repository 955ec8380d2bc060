// SPDX-License-Identifier: Apache-2.0
// The world around the boat on a canvas, layer by layer from the water up. `pen` is {c: context,
// view, colours}; the messages are those of /lodesman/world, /boat and /coverage. Each kind has a
// shape or a stroke of its own beside its colour.
import { bar_length_m, distance, length_text, middle_of } from "./geometry.js";
import { diamond, ring, stroke, trace, write } from "./pen.js";

const kRad = Math.PI / 180;
const kLeastHull_px = 26;

// ---- The water: what of it was seen

// One pixel a cell, north up: free water, something there; what is unknown stays clear.
export function coverage_picture(coverage, colours) {
  const { columns, rows, cells } = coverage;
  const canvas = new OffscreenCanvas(Math.max(1, columns), Math.max(1, rows));
  const c = canvas.getContext("2d");
  const bytes = atob(cells);
  for (const [kind, colour] of [[1, colours.water], [2, colours.wall]]) {
    c.fillStyle = colour;
    for (let row = 0; row < rows; row++) {
      for (let from = 0; from < columns; from++) {
        if (bytes.charCodeAt(row * columns + from) !== kind) continue;
        let to = from + 1;
        while (to < columns && bytes.charCodeAt(row * columns + to) === kind) to++;
        c.fillRect(from, rows - 1 - row, to - from, 1);
        from = to;
      }
    }
  }
  return canvas;
}

export function draw_water(pen, coverage, picture) {
  const { c, view, colours, patterns } = pen;
  c.fillStyle = coverage ? colours.unknown : colours.water;
  c.fillRect(0, 0, view.width, view.height);
  if (!coverage) return;
  c.fillStyle = patterns.unknown;
  c.fillRect(0, 0, view.width, view.height);
  const { origin_m, cell_m, columns, rows } = coverage;
  const [x, y] = view.to_screen([origin_m[0], origin_m[1] + rows * cell_m]);
  c.imageSmoothingEnabled = false;
  c.drawImage(picture, x, y, columns * cell_m * view.scale, rows * cell_m * view.scale);
}

export function draw_grid(pen) {
  const { c, view, colours } = pen;
  const step = bar_length_m(view.scale, 110);
  const [west, north] = view.to_world([0, 0]);
  const [east, south] = view.to_world([view.width, view.height]);
  c.beginPath();
  for (let x = Math.ceil(west / step) * step; x <= east; x += step) {
    const [px] = view.to_screen([x, 0]);
    c.moveTo(Math.round(px) + 0.5, 0);
    c.lineTo(Math.round(px) + 0.5, view.height);
  }
  for (let y = Math.ceil(south / step) * step; y <= north; y += step) {
    const [, py] = view.to_screen([0, y]);
    c.moveTo(0, Math.round(py) + 0.5);
    c.lineTo(view.width, Math.round(py) + 0.5);
  }
  stroke(pen, colours.grid, 1);
}

// ---- What bounds it

export function draw_areas(pen, fence_m, keep_out_m) {
  const { c, colours, patterns } = pen;
  for (const corners of keep_out_m ?? []) {
    trace(pen, corners, true);
    c.fillStyle = patterns.keep_out;
    c.fill();
    stroke(pen, colours.keep_out_edge, 1.5, [8, 3]);
  }
  if (fence_m?.length > 1) {
    trace(pen, fence_m, true);
    stroke(pen, colours.fence, 2.5, [14, 4, 2, 4]);
  }
}

// ---- What the boat means to do

export function draw_line(pen, line) {
  if (!line) return;
  trace(pen, [line.begins_m, line.ends_m], false);
  stroke(pen, pen.colours.line, 1.25, [2, 5]);
}

// The points but those that would lie on the one before; the last is always there.
function apart({ view }, points, least_px) {
  const shown = [];
  for (const at of points) {
    const is_last = at === points.at(-1);
    if (shown.length > 0 && distance(at, shown.at(-1)) * view.scale < least_px) {
      if (!is_last) continue;
      shown.pop();
    }
    shown.push(at);
  }
  return shown;
}

export function draw_waypoints(pen, world, boat) {
  const { view, colours } = pen;
  const radius = Math.min(8, Math.max(3.5, 0.3 * view.scale));
  for (const at of apart(pen, world.previous_m ?? [], 2.4 * radius)) ring(pen, at, radius, colours.previous, 1.6, [2, 2.5]);
  const ahead = world.waypoints_m ?? [];
  if (ahead.length === 0) return;
  trace(pen, boat?.position_m ? [boat.position_m, ...ahead] : ahead, false);
  stroke(pen, colours.path_edge, 4);
  stroke(pen, colours.path, 2.4);
  for (const at of apart(pen, ahead, 2.4 * radius)) ring(pen, at, radius, colours.current, 2, []);
}

export function draw_mission(pen, world) {
  const { c, view, colours } = pen;
  if (world.start_m) {
    const [x, y] = view.to_screen(world.start_m);
    c.fillStyle = colours.halo;
    c.fillRect(x - 7, y - 7, 14, 14);
    c.fillStyle = colours.goal;
    c.fillRect(x - 5, y - 5, 10, 10);
    write(pen, "start", x + 11, y, { colour: colours.muted });
  }
  (world.mission_m ?? []).forEach((at, i, all) => {
    const is_goal = world.goal_m && distance(at, world.goal_m) < 1e-6 && i === all.length - 1;
    if (!is_goal) diamond(pen, at, 7, colours.goal, String(i + 1));
  });
  if (world.goal_m) draw_goal(pen, world.goal_m, world.goal_radius_m, colours.goal, "goal");
}

export function draw_goal(pen, at, radius_m, colour, label) {
  const { c, view } = pen;
  const [x, y] = view.to_screen(at);
  ring(pen, at, Math.max(9, (radius_m ?? 0.5) * view.scale), colour, 1.75, [3, 2]);
  c.beginPath();
  for (const [dx, dy] of [[5, 5], [5, -5]]) {
    c.moveTo(x - dx, y - dy);
    c.lineTo(x + dx, y + dy);
  }
  stroke(pen, colour, 2.5);
  const off = Math.max(13, (radius_m ?? 0.5) * view.scale + 5);
  if (label) write(pen, label, x + off, y, { colour, weight: 600 });
}

// ---- What lies and moves there

export function draw_zones(pen, obstacles) {
  const { c, colours } = pen;
  for (const { zone_m } of obstacles) {
    if (!zone_m) continue;
    trace(pen, zone_m, true);
    c.fillStyle = colours.zone;
    c.fill();
    stroke(pen, colours.zone_edge, 1.25, [7, 3, 1.5, 3]);
  }
}

export function draw_obstacles(pen, obstacles) {
  for (const obstacle of obstacles) {
    if (obstacle.moving) draw_motion(pen, obstacle);
    draw_body(pen, obstacle);
    draw_doubt(pen, obstacle);
  }
}

function draw_body(pen, { outline_m, confirmed, id, moving }) {
  const { c, view, colours, patterns } = pen;
  trace(pen, outline_m, true);
  c.fillStyle = confirmed ? colours.obstacle : patterns.unsure;
  c.fill();
  stroke(pen, colours.obstacle_edge, confirmed ? 1.5 : 1.75, confirmed ? [] : [4, 3]);
  const middle = middle_of(outline_m);
  if (!middle || view.scale < 6 || id === null || id === undefined) return;
  const [x, y] = view.to_screen(middle);
  const name = `${id}${moving ? " ▸" : ""}`;
  write(pen, name, x, y, { align: "center", size: 10.5, weight: 600 });
}

function draw_doubt(pen, { outline_m, sigma_m }) {
  const middle = middle_of(outline_m);
  if (!(sigma_m > 0) || !middle) return;
  const reach = Math.max(...outline_m.map((corner) => distance(corner, middle)));
  const radius = (reach + sigma_m) * pen.view.scale;
  if (reach > 3 || radius < 4) return; // a wall's outline has no one middle to doubt
  ring(pen, middle, radius, pen.colours.doubt, 1.2, [1.5, 3]);
}

function draw_motion(pen, { outline_m, velocity_m_s, predicted_m }) {
  const { c, view, colours } = pen;
  const middle = middle_of(outline_m);
  if (!middle) return;
  const foreseen = predicted_m ?? [];
  trace(pen, [middle, ...foreseen], false);
  stroke(pen, colours.obstacle_edge, 1.25, [5, 4]);
  foreseen.forEach((at, i) => {
    const [dx, dy] = [at[0] - middle[0], at[1] - middle[1]];
    trace(pen, outline_m.map(([x, y]) => [x + dx, y + dy]), true);
    c.globalAlpha = 0.75 - 0.5 * (i / Math.max(1, foreseen.length));
    stroke(pen, colours.obstacle_edge, 1.25, [3, 3]);
    c.globalAlpha = 1;
    if (i === 1 || i === foreseen.length - 1) {
      const [x, y] = view.to_screen(at);
      write(pen, `${(i + 1) * 5} s`, x, y, { align: "center", size: 10, colour: colours.obstacle_edge });
    }
  });
  if (velocity_m_s) arrow(pen, middle, [middle[0] + velocity_m_s[0] * 5, middle[1] + velocity_m_s[1] * 5]);
}

function arrow(pen, from, to) {
  const { c, view, colours } = pen;
  const [x0, y0] = view.to_screen(from);
  const [x1, y1] = view.to_screen(to);
  if (Math.hypot(x1 - x0, y1 - y0) < 8) return;
  const along = Math.atan2(y1 - y0, x1 - x0);
  c.beginPath();
  c.moveTo(x0, y0);
  c.lineTo(x1, y1);
  for (const side of [2.6, -2.6]) {
    c.moveTo(x1, y1);
    c.lineTo(x1 + 9 * Math.cos(along + side), y1 + 9 * Math.sin(along + side));
  }
  stroke(pen, colours.halo, 5);
  stroke(pen, colours.obstacle_edge, 2.25);
}

// ---- The boat and where it was

// Where nothing was heard for a while no line is made up.
function is_gap(before, now) {
  return now.t_s - before.t_s > 1 && Math.hypot(now.x - before.x, now.y - before.y) > 1;
}

export function draw_track(pen, track) {
  const { c, view, colours } = pen;
  if (track.length < 2) return;
  const parts = 16;
  c.lineJoin = c.lineCap = "round";
  for (let part = 0; part < parts; part++) {
    const from = Math.floor((part * (track.length - 1)) / parts);
    const to = Math.floor(((part + 1) * (track.length - 1)) / parts);
    if (to <= from) continue;
    c.beginPath();
    for (let i = from; i <= to; i++) {
      const x = view.width / 2 + (track[i].x - view.centre[0]) * view.scale;
      const y = view.height / 2 - (track[i].y - view.centre[1]) * view.scale;
      if (i === from || is_gap(track[i - 1], track[i])) c.moveTo(x, y);
      else c.lineTo(x, y);
    }
    const share = Math.round((100 * part) / (parts - 1));
    stroke(pen, `color-mix(in srgb, ${colours.track_new} ${share}%, ${colours.track_old})`, 2.5);
  }
  c.lineCap = "butt";
}

export function draw_fan(pen, boat, sonar) {
  if (!boat?.position_m || boat.heading_deg === null || !sonar?.range_m) return;
  const { c, view, colours } = pen;
  const [x, y] = view.to_screen(boat.position_m);
  const half = ((sonar.sector_deg ?? 120) / 2) * kRad;
  const ahead = (boat.heading_deg - 90) * kRad;
  c.beginPath();
  c.moveTo(x, y);
  c.arc(x, y, sonar.range_m * view.scale, ahead - half, ahead + half);
  c.closePath();
  stroke(pen, colours.ring, 1, [1, 4]);
}

export function draw_boat(pen, boat, hull) {
  if (!boat?.position_m) return;
  const { c, view, colours } = pen;
  const [x, y] = view.to_screen(boat.position_m);
  if (boat.sigma_m > 0) ring(pen, boat.position_m, boat.sigma_m * view.scale, colours.vehicle, 1.2, [1.5, 3]);
  if (boat.heading_deg === null || boat.heading_deg === undefined) {
    ring(pen, boat.position_m, 7, colours.vehicle, 3, []);
    return;
  }
  const length = Math.max(kLeastHull_px, (hull?.length ?? 1.2) * view.scale);
  const width = Math.max(kLeastHull_px * 0.5, (hull?.width ?? 0.6) * view.scale);
  if (Number.isFinite(boat.heading_ref_deg)) needle(pen, [x, y], boat.heading_ref_deg, length * 1.7);
  c.save();
  c.translate(x, y);
  c.rotate(boat.heading_deg * kRad);
  c.beginPath();
  c.moveTo(0, -length / 2);
  c.quadraticCurveTo(width * 0.55, -length * 0.22, width / 2, length * 0.12);
  c.lineTo(width * 0.42, length / 2);
  c.lineTo(-width * 0.42, length / 2);
  c.lineTo(-width / 2, length * 0.12);
  c.quadraticCurveTo(-width * 0.55, -length * 0.22, 0, -length / 2);
  c.closePath();
  c.fillStyle = colours.vehicle;
  c.fill();
  stroke(pen, colours.vehicle_edge, 1.75);
  c.beginPath();
  c.moveTo(0, -length / 2);
  c.lineTo(0, -length / 2 - Math.max(14, length * 0.45));
  stroke(pen, colours.vehicle, 2.25);
  c.restore();
}

function needle(pen, [x, y], deg, length) {
  const { c, colours } = pen;
  c.beginPath();
  c.moveTo(x, y);
  c.lineTo(x + length * Math.sin(deg * kRad), y - length * Math.cos(deg * kRad));
  stroke(pen, colours.vehicle, 1.5, [4, 3]);
}

// ---- North and scale

export function draw_margins(pen, pointed_at) {
  const { c, view, colours } = pen;
  const [x, y] = [view.width - 30, 78];
  c.beginPath();
  c.moveTo(x, y - 20);
  c.lineTo(x + 8, y + 8);
  c.lineTo(x, y + 2);
  c.lineTo(x - 8, y + 8);
  c.closePath();
  c.fillStyle = colours.ink;
  c.fill();
  stroke(pen, colours.halo, 1);
  write(pen, "N", x, y - 29, { align: "center", weight: 700, size: 12 });
  const metres = bar_length_m(view.scale, 140);
  const [left, low, wide] = [16, view.height - 18, metres * view.scale];
  c.beginPath();
  c.moveTo(left, low - 5);
  c.lineTo(left, low);
  c.lineTo(left + wide, low);
  c.lineTo(left + wide, low - 5);
  stroke(pen, colours.halo, 5);
  stroke(pen, colours.ink, 2);
  write(pen, length_text(metres), left + wide + 8, low - 2);
  if (!pointed_at) return;
  const [east, north] = view.to_world(pointed_at);
  write(pen, `x ${east.toFixed(1)}  y ${north.toFixed(1)} m`, view.width - 14, low - 2, { align: "right" });
}
