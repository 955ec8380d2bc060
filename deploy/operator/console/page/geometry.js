// SPDX-License-Identifier: Apache-2.0
// How metres of the world (x east, y north) lie on a canvas (x right, y down, CSS pixels), and what
// is reckoned with points and outlines. Knows no page.

export const kLeastScale = 0.05; // pixels a metre
export const kGreatestScale = 400;

export function clamp(value, least, most) {
  return Math.min(most, Math.max(least, value));
}

// `centre` is the world's point in the middle of the canvas, `scale` pixels a metre. North is up.
export class View {
  constructor(width = 100, height = 100, scale = 20, centre = [0, 0]) {
    this.width = width;
    this.height = height;
    this.scale = scale;
    this.centre = centre;
  }

  resize(width, height) {
    this.width = width;
    this.height = height;
  }

  to_screen([x, y]) {
    return [
      this.width / 2 + (x - this.centre[0]) * this.scale,
      this.height / 2 - (y - this.centre[1]) * this.scale,
    ];
  }

  to_world([px, py]) {
    return [
      this.centre[0] + (px - this.width / 2) / this.scale,
      this.centre[1] - (py - this.height / 2) / this.scale,
    ];
  }

  pan(dx_px, dy_px) {
    this.centre = [this.centre[0] - dx_px / this.scale, this.centre[1] + dy_px / this.scale];
  }

  // The point of the world under `at` stays under it.
  zoom_at(at, factor) {
    const held = this.to_world(at);
    this.scale = clamp(this.scale * factor, kLeastScale, kGreatestScale);
    this.hold(held, at);
  }

  hold(world, at) {
    this.centre = [
      world[0] - (at[0] - this.width / 2) / this.scale,
      world[1] + (at[1] - this.height / 2) / this.scale,
    ];
  }

  // Two fingers: what lay between them before lies between them now.
  pinch(before, now) {
    const apart = (pair) => Math.hypot(pair[0][0] - pair[1][0], pair[0][1] - pair[1][1]);
    const middle = (pair) => [(pair[0][0] + pair[1][0]) / 2, (pair[0][1] + pair[1][1]) / 2];
    const held = this.to_world(middle(before));
    const factor = apart(now) / Math.max(1, apart(before));
    this.scale = clamp(this.scale * factor, kLeastScale, kGreatestScale);
    this.hold(held, middle(now));
  }

  // Shows all of `points`, with a margin; one point alone keeps the scale. `inset` is what of each
  // side is covered: {top, right, bottom, left} in pixels.
  fit(points, inset = {}, most_scale = 40) {
    const box = bounds(points);
    if (!box) return;
    const { top = 0, right = 0, bottom = 0, left = 0 } = inset;
    const wide = Math.max(60, this.width - left - right);
    const high = Math.max(60, this.height - top - bottom);
    const [across, along] = [box.east - box.west, box.north - box.south];
    if (across > 0 || along > 0) {
      const scale = 0.9 * Math.min(wide / Math.max(across, 1e-6), high / Math.max(along, 1e-6));
      this.scale = clamp(scale, kLeastScale, most_scale);
    }
    this.hold(
      [(box.west + box.east) / 2, (box.south + box.north) / 2],
      [left + wide / 2, top + high / 2],
    );
  }
}

export function bounds(points) {
  let box = null;
  for (const [x, y] of points) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
    box ??= { west: x, east: x, south: y, north: y };
    box.west = Math.min(box.west, x);
    box.east = Math.max(box.east, x);
    box.south = Math.min(box.south, y);
    box.north = Math.max(box.north, y);
  }
  return box;
}

export function distance(a, b) {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}

// Degrees clockwise from north, 0 to 360.
export function bearing_deg(from, to) {
  return wrap_360(Math.atan2(to[0] - from[0], to[1] - from[1]) * (180 / Math.PI));
}

export function wrap_360(deg) {
  return ((deg % 360) + 360) % 360;
}

export function wrap_180(deg) {
  return wrap_360(deg + 180) - 180;
}

// The next of a row of headings that does not jump at north: as near as can be to the one before.
export function unwrapped(before, deg) {
  return before === null || before === undefined ? deg : before + wrap_180(deg - before);
}

export function middle_of(outline) {
  const box = bounds(outline);
  return box ? [(box.west + box.east) / 2, (box.south + box.north) / 2] : null;
}

// How long a scale bar is, in metres: 1, 2 or 5 of a power of ten, at most `most_px` pixels.
export function bar_length_m(scale, most_px) {
  const most = most_px / scale;
  const power = 10 ** Math.floor(Math.log10(most));
  for (const digit of [5, 2, 1]) if (digit * power <= most) return digit * power;
  return power;
}

export function length_text(metres) {
  if (metres >= 1000) return `${+(metres / 1000).toPrecision(3)} km`;
  if (metres < 1) return `${+(metres * 100).toPrecision(3)} cm`;
  return `${+metres.toPrecision(3)} m`;
}

// Latitude and longitude as metres east and north of the origin: good for a drawing within some
// kilometres, and for nothing else. The boat reckons for itself.
export function drawn_from_degrees([latitude, longitude], origin_deg) {
  const metres_a_degree = 111320;
  const shrink = Math.cos((origin_deg[0] * Math.PI) / 180);
  return [
    (longitude - origin_deg[1]) * metres_a_degree * shrink,
    (latitude - origin_deg[0]) * metres_a_degree,
  ];
}

// The place in `points` that is nearest to `at` and no farther than `within`, or -1.
export function nearest_within(points, at, within) {
  let best = -1;
  let least = within;
  points.forEach((point, i) => {
    const off = distance(point, at);
    if (off <= least) {
      least = off;
      best = i;
    }
  });
  return best;
}

// Where in the row `points` a new one goes that lies beside one of its stretches: the place it takes.
export function place_beside(points, at) {
  let best = points.length;
  let least = Infinity;
  for (let i = 1; i < points.length; i++) {
    const off = distance_to_stretch(points[i - 1], points[i], at);
    if (off < least) {
      least = off;
      best = i;
    }
  }
  return best;
}

export function distance_to_stretch(a, b, at) {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const long = dx * dx + dy * dy;
  const share = long === 0 ? 0 : clamp(((at[0] - a[0]) * dx + (at[1] - a[1]) * dy) / long, 0, 1);
  return distance([a[0] + share * dx, a[1] + share * dy], at);
}
