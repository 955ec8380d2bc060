// SPDX-License-Identifier: Apache-2.0
// Light, dark, or sunlight (light with more contrast): by the system or by the switch, which the
// browser remembers. Drawings take their colours from the style sheet, too.

const kPlace = "lodesman.theme";
const kNames = [
  "water", "unknown", "unknown-line", "wall", "grid", "grid-strong", "ink", "muted", "panel", "halo",
  "vehicle", "vehicle-edge", "track-old", "track-new", "obstacle", "obstacle-edge", "zone", "zone-edge",
  "current", "previous", "path", "path-edge", "goal", "line", "fence", "keep-out", "keep-out-edge",
  "draft", "doubt", "left", "right", "sonar-path", "ring",
];

export class Theme {
  #listeners = [];
  colours = {};

  constructor(select) {
    const dark = matchMedia("(prefers-color-scheme: dark)");
    const chosen = () => localStorage.getItem(kPlace) ?? "auto";
    const apply = () => {
      const name = chosen() === "auto" ? (dark.matches ? "dark" : "light") : chosen();
      document.documentElement.dataset.theme = name;
      this.#read();
      for (const act of this.#listeners) act();
    };
    select.value = chosen();
    select.addEventListener("change", () => {
      localStorage.setItem(kPlace, select.value);
      apply();
    });
    dark.addEventListener("change", apply);
    apply();
  }

  on_change(act) {
    this.#listeners.push(act);
  }

  #read() {
    const style = getComputedStyle(document.documentElement);
    for (const name of kNames) {
      this.colours[name.replaceAll("-", "_")] = style.getPropertyValue(`--${name}`).trim();
    }
    this.colours.is_sun = document.documentElement.dataset.theme === "sun";
    this.colours.font = getComputedStyle(document.body).fontFamily;
  }
}
