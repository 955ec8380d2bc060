// SPDX-License-Identifier: Apache-2.0
// Strip charts of the last minute, drawn by dygraphs, which the console serves from where its package
// installs it (libjs-dygraphs). Where it is not, the page says so and goes on.
import { element, finite, set_text } from "./dom.js";
import { unwrapped } from "./geometry.js";

const kLibrary = "/lib/dygraph.min.js";
const kStyle = "/lib/dygraph.css";
const kWindow_s = 60;
const kDraw_ms = 400;
const kAges = ["attitude", "position_fix", "sonar", "plan"];

// `values` takes one row's numbers from a boat message; null breaks the line.
const kCharts = [
  { title: "Heading", unit: "°", labels: ["heading", "reference"], dashes: [null, [5, 3]], heading: true,
    values: (boat) => [boat.heading_deg, boat.heading_ref_deg] },
  { title: "Thrust", unit: "%", labels: ["left", "right"], dashes: [null, [5, 3]], range: [-105, 105],
    values: (boat) => [percent(boat.thrust_left), percent(boat.thrust_right)] },
  { title: "Clear of obstacles", unit: "m", labels: ["distance"], dashes: [null], zero: true,
    values: (boat) => [boat.inoffensive_distance_m] },
  { title: "Off the line", unit: "m", labels: ["starboard +"], dashes: [null],
    values: (boat) => [boat.cross_track_m] },
  { title: "Plan time", unit: "ms", labels: ["plan"], dashes: [null], zero: true,
    values: (boat) => [boat.plan_time_ms] },
  { title: "Ages", unit: "s", labels: ["head", "fix", "sonar", "plan"], dashes: [null, [6, 3], [2, 2], [8, 2, 2, 2]], zero: true,
    values: (boat) => kAges.map((name) => boat.ages_s?.[name]) },
];

const percent = (share) => (finite(share) ? 100 * share : null);
const shown = (value) => (finite(value) ? value : null);

function load_library() {
  document.head.append(element("link", { rel: "stylesheet", href: kStyle }));
  return new Promise((resolve, reject) => {
    const script = element("script", { src: kLibrary });
    script.onload = () => resolve(window.Dygraph);
    script.onerror = () => reject(new Error("not served"));
    document.head.append(script);
  });
}

export class Charts {
  #box;
  #theme;
  #strips = [];
  #drawn_ms = -Infinity;
  #dirty = false;
  #now_s = 0;
  ready;

  constructor(box, store, theme) {
    this.#box = box;
    this.#theme = theme;
    for (const chart of kCharts) this.#add(chart);
    store.on("boat", (boat) => this.#take(boat));
    this.ready = load_library().then(
      (Dygraph) => this.#draw_first(Dygraph),
      () => this.#say_missing(),
    );
    theme.on_change(() => this.#recolour());
  }

  #add(chart) {
    const figures = chart.labels.map((label, i) => {
      const value = element("b", {}, "–");
      return { value, node: element("span", { class: `line line_${i + 1}` }, `${label} `, value) };
    });
    const plot = element("div", { class: "plot", role: "img", "aria-label": `${chart.title}, the last minute` });
    const strip = element(
      "figure", { class: "strip" },
      element("figcaption", {}, element("span", { class: "title" }, `${chart.title} `, element("i", {}, chart.unit)), ...figures.map(({ node }) => node)),
      plot,
    );
    this.#box.append(strip);
    this.#strips.push({ chart, figures, plot, rows: [], graph: null, before: null });
  }

  #say_missing() {
    this.#box.prepend(element("p", { class: "missing", role: "status" },
      "No charts: the console's machine has no dygraphs (Debian's libjs-dygraphs). The figures go on without."));
    this.#box.classList.add("without_library");
  }

  #take(boat) {
    const at_s = boat.time_s;
    if (at_s < this.#now_s - 0.5 || at_s > this.#now_s + 2 * kWindow_s) {
      for (const strip of this.#strips) {
        strip.rows.length = 0;
        strip.before = null;
      }
    }
    this.#now_s = at_s;
    for (const strip of this.#strips) {
      const values = strip.chart.values(boat).map(shown);
      if (strip.chart.heading) this.#unwrap(strip, values);
      strip.rows.push([at_s, ...values]);
      while (strip.rows[0][0] < at_s - kWindow_s) strip.rows.shift();
    }
    this.#dirty = true;
  }

  // Neither line jumps where it passes north.
  #unwrap(strip, values) {
    if (values[0] !== null) strip.before = values[0] = unwrapped(strip.before, values[0]);
    if (values[1] !== null) values[1] = unwrapped(strip.before, values[1]);
  }

  #colours(chart) {
    const style = getComputedStyle(document.documentElement);
    return chart.labels.map((_, i) => style.getPropertyValue(`--chart-${i + 1}`).trim());
  }

  #draw_first(Dygraph) {
    for (const strip of this.#strips) {
      const { chart, plot } = strip;
      const labels = ["s", ...chart.labels];
      const series = Object.fromEntries(
        chart.labels.map((label, i) => [label, { strokePattern: chart.dashes[i], strokeWidth: i === 0 ? 1.75 : 1.5 }]),
      );
      strip.graph = new Dygraph(plot, [[0, ...chart.labels.map(() => null)]], {
        labels, series, colors: this.#colours(chart), legend: "never", interactionModel: {},
        showLabelsOnHighlight: false, highlightCircleSize: 0, connectSeparatedPoints: false,
        includeZero: Boolean(chart.zero), valueRange: chart.range ?? null, rightGap: 4, xRangePad: 0,
        gridLineWidth: 1, gridLineColor: this.#theme.colours.grid_strong, axisLineColor: this.#theme.colours.grid_strong,
        axes: {
          x: { drawAxis: false, drawGrid: false },
          y: {
            axisLabelWidth: 34, pixelsPerLabel: 15, axisLabelFontSize: 10,
            axisLabelFormatter: chart.heading ? (v) => String(Math.round(((v % 360) + 360) % 360)) : (v) => String(+v.toPrecision(3)),
          },
        },
      });
      new ResizeObserver(() => strip.graph.resize()).observe(plot);
    }
    this.#dirty = true;
  }

  #recolour() {
    for (const { graph, chart } of this.#strips) {
      graph?.updateOptions({ colors: this.#colours(chart), gridLineColor: this.#theme.colours.grid_strong, axisLineColor: this.#theme.colours.grid_strong });
    }
  }

  render(now_ms) {
    if (!this.#dirty || now_ms - this.#drawn_ms < kDraw_ms || this.#box.offsetParent === null) return;
    this.#dirty = false;
    this.#drawn_ms = now_ms;
    for (const { chart, rows, figures, graph } of this.#strips) {
      const last = rows.at(-1);
      figures.forEach(({ value }, i) => set_text(value, figure_text(last?.[i + 1], chart)));
      if (!graph || rows.length === 0) continue;
      graph.updateOptions({ file: rows, dateWindow: [this.#now_s - kWindow_s, this.#now_s], ...range_of(chart, rows) });
    }
  }
}

function figure_text(value, chart) {
  if (!finite(value)) return "–";
  if (chart.heading) return String(Math.round(((value % 360) + 360) % 360)).padStart(3, "0");
  return Math.abs(value) >= 100 || chart.unit === "%" ? value.toFixed(0) : value.toFixed(chart.unit === "ms" && value >= 1 ? 1 : 2);
}

// Not narrower than means something, so that noise does not fill the strip.
function range_of(chart, rows) {
  if (chart.range) return {};
  let least = Infinity;
  let most = -Infinity;
  for (const row of rows) {
    for (let i = 1; i < row.length; i++) {
      if (row[i] === null) continue;
      least = Math.min(least, row[i]);
      most = Math.max(most, row[i]);
    }
  }
  const narrowest = { "°": 20, m: 1, ms: 5, s: 0.5 }[chart.unit] ?? 1;
  if (least > most) return { valueRange: chart.zero ? [0, narrowest] : [-narrowest / 2, narrowest / 2] };
  if (chart.zero) return { valueRange: [0, Math.max(narrowest, most * 1.1)] };
  const middle = (least + most) / 2;
  const half = Math.max(narrowest, (most - least) * 1.15) / 2;
  return { valueRange: [middle - half, middle + half] };
}
