// SPDX-License-Identifier: Apache-2.0
// Small words for making and changing elements. Text goes in as text, never as HTML.

export const by_id = (id) => document.getElementById(id);

// element("button", {type: "button", class: "quiet", onclick: f}, "text", child...)
export function element(name, given = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(given)) {
    if (value === undefined || value === null || value === false) continue;
    if (typeof value === "function") made[key] = value;
    else made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

export function set_text(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

export function set_attribute(node, name, value) {
  if (value === null) node.removeAttribute(name);
  else if (node.getAttribute(name) !== value) node.setAttribute(name, value);
}

// A button that cannot be pressed stays in reach of focus and pointer, so that its reason can be read.
export function forbid(button, reason) {
  set_attribute(button, "aria-disabled", reason ? "true" : null);
  set_attribute(button, "title", reason ?? button.dataset.title ?? null);
  set_attribute(button, "aria-description", reason ?? null);
}

export const is_forbidden = (button) => button.getAttribute("aria-disabled") === "true";

// A drawing surface as sharp as the screen, whose size follows its box.
export function fitted_canvas(canvas, resized) {
  const context = canvas.getContext("2d");
  const surface = { context, width: 0, height: 0 };
  const measure = () => {
    const { width, height } = canvas.parentElement.getBoundingClientRect();
    if (width < 1 || height < 1) return;
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    surface.width = width;
    surface.height = height;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    resized();
  };
  new ResizeObserver(measure).observe(canvas.parentElement);
  measure();
  return surface;
}

export const finite = (value) => typeof value === "number" && Number.isFinite(value);
export const number_text = (value, digits = 1, unit = "") =>
  finite(value) ? `${value.toFixed(digits).replace(/^-(0(\.0*)?)$/, "$1")}${unit}` : "–";

export function span_text(seconds) {
  if (!finite(seconds)) return "–";
  if (seconds < 10) return `${seconds.toFixed(1)} s`;
  if (seconds < 100) return `${Math.round(seconds)} s`;
  const minutes = Math.floor(seconds / 60);
  return minutes < 100 ? `${minutes} min ${Math.round(seconds % 60)} s` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}
