// SPDX-License-Identifier: Apache-2.0
// Strokes, rings, words and patterns on a canvas. `pen` is {c: context, view, colours}; points are the
// world's, in metres.

const kTau = 2 * Math.PI;

export function trace(pen, points, closed) {
  const { c, view } = pen;
  c.beginPath();
  points.forEach((point, i) => {
    const [x, y] = view.to_screen(point);
    if (i === 0) c.moveTo(x, y);
    else c.lineTo(x, y);
  });
  if (closed) c.closePath();
}

export function stroke(pen, colour, width, dash = []) {
  const { c } = pen;
  c.setLineDash(dash);
  c.lineWidth = width;
  c.strokeStyle = colour;
  c.stroke();
  c.setLineDash([]);
}

export function write(pen, text, x, y, { colour, size = 11, align = "left", weight = 500 } = {}) {
  const { c, colours } = pen;
  c.font = `${weight} ${size}px ${colours.font}`;
  c.textAlign = align;
  c.textBaseline = "middle";
  c.lineJoin = "round";
  c.lineWidth = 3;
  c.strokeStyle = colours.halo;
  c.strokeText(text, x, y);
  c.fillStyle = colour ?? colours.ink;
  c.fillText(text, x, y);
}

export function ring(pen, at, radius_px, colour, width, dash) {
  const [x, y] = pen.view.to_screen(at);
  pen.c.beginPath();
  pen.c.arc(x, y, radius_px, 0, kTau);
  stroke(pen, colour, width, dash);
}

export function diamond(pen, at, size, colour, label) {
  const { c, view, colours } = pen;
  const [x, y] = view.to_screen(at);
  c.beginPath();
  c.moveTo(x, y - size);
  c.lineTo(x + size, y);
  c.lineTo(x, y + size);
  c.lineTo(x - size, y);
  c.closePath();
  c.fillStyle = colours.halo;
  c.fill();
  stroke(pen, colour, 1.75);
  if (label) write(pen, label, x + size + 5, y, { colour });
}

export function hatch(c, colour, gap, width) {
  const tile = new OffscreenCanvas(gap, gap);
  const t = tile.getContext("2d");
  t.strokeStyle = colour;
  t.lineWidth = width;
  t.beginPath();
  for (const shift of [-gap, 0, gap]) {
    t.moveTo(shift, gap);
    t.lineTo(shift + gap, 0);
  }
  t.stroke();
  return c.createPattern(tile, "repeat");
}
