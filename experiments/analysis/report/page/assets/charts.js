// Every chart goes through `chart`, which sizes it, redraws it when the page changes and lists it in
// `talusCharts` with whether it drew.
let D = JSON.parse(document.getElementById("data").textContent);  // what the program wrote into the page
// The page once for each experiment that it shows: what differs between them, over what they share.
const views = [D, ...D.others.map((other, k) => ({...D, ...other, suffix: "-" + (k + 1)}))];
// Calls with the page of one of them.
function within(view, make) {
  const outer = D;
  D = view;
  try {
    return make();
  } finally {
    D = outer;
  }
}
// One id in the whole page, whichever experiment it is of.
const idOf = (id) => id + (D.suffix || "");

let ink, soft, line, paper, axisLine, starColor;
// The page's colours as the reader's system has them; paper is always light.
function readTheme() {
  const style = getComputedStyle(document.documentElement);
  [ink, soft, line, paper, axisLine, starColor] = ["ink", "soft", "line", "paper", "axis", "star"]
    .map((name) => style.getPropertyValue("--" + name).trim());
}
readTheme();
const {palette, regions: regionShades, light_ink: lightInk} = D.colors;
const sequence = ["#fde725", "#7ad151", "#22a884", "#2a788e", "#414487", "#440154"];  // best is dark
const star = "path://M0,-10 L2.6,-3.2 L9.8,-3.1 L4,1.3 L6.2,8.2 L0,4.1 L-6.2,8.2 L-4,1.3 " +
    "L-9.8,-3.1 L-2.6,-3.2 Z";

const fontFamily = getComputedStyle(document.body).fontFamily;

window.talusCharts = [];  // {id, drawn, redraw}: drawn whether seen yet or not

// One chart that fails must not take the others with it; the console has what went wrong.
function onEachChart(act) {
  for (const made of window.talusCharts) {
    try {
      act(made);
    } catch (error) {
      console.error(made.id, error);
    }
  }
}
function redrawAll() {
  readTheme();
  onEachChart((made) => made.redraw());
}
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redrawAll);
// Charts are drawn when they scroll into view; on paper all of them are, as pictures in light colours. The pictures
// must stand before the pages are laid out: what grows afterwards pushes the end of the page off the paper.
window.addEventListener("beforeprint", () => {
  onEachChart((made) => made.start());
  onEachChart((made) => made.toPaper());
});
window.matchMedia("print").addEventListener("change", (e) => {
  redrawAll();
  if (e.matches) onEachChart((made) => made.toPaper());
});

const hasWebGl = (() => {
  try {
    const canvas = document.createElement("canvas");
    return Boolean(canvas.getContext("webgl2") || canvas.getContext("webgl"));
  } catch (error) {
    return false;
  }
})();

// All that the next frames would draw, now. The canvases are numbered among everything that was drawn since: a new
// one has the last number.
function drawSpace(made) {
  const last = echarts.zrender.init(document.createElement("div")), canvases = [];
  for (let id = made.getZr().id + 1; id < last.id; ++id) canvases.push(echarts.zrender.getInstance(id));
  last.dispose();
  for (let frame = 0; frame < 3; ++frame) {
    canvases.filter(Boolean).forEach((canvas) => canvas.flush());
    made.getZr().animation.update();
  }
}

// Draws `makeOption(width)` into a new element when that scrolls near the window: a long page opens
// at once. Returns {figure, redraw}.
function chart(name, title, caption, makeOption, size = "") {
  const id = idOf(name), view = D;
  const place = element("div", {class: "chart " + size, id, role: "img", "aria-label": title});
  const figure = element("figure", {}, element("h3", {}, title), place,
      caption ? element("figcaption", {}, caption) : null);
  const entry = {id, drawn: false};
  window.talusCharts.push(entry);
  let made = null;
  const redraw = () => {
    if (!made) return;
    const onPaper = window.matchMedia("print").matches;  // where the place itself is not shown
    const option = within(view, () => makeOption(onPaper ? made.getWidth() : place.clientWidth));
    if (option.tooltip && option.tooltip.formatter) {  // it is called later, when another page may be at hand
      const text = option.tooltip.formatter;
      option.tooltip = {...option.tooltip, formatter: (e) => within(view, () => text(e))};
    }
    if (option.height_px) place.style.height = option.height_px + "px";
    delete option.height_px;
    if (!onPaper) made.resize();
    made.setOption({animation: false, textStyle: {fontFamily, fontSize: 13, color: ink}, ...option},
        {notMerge: true});
  };
  const start = () => {
    if (made) return;
    watcher.disconnect();
    made = echarts.init(place, null, {renderer: "canvas"});
    made.on("finished", () => { entry.drawn = true; });
    redraw();
    let width = place.clientWidth;
    new ResizeObserver(() => requestAnimationFrame(() => {
      if (place.clientWidth === width) return;
      width = place.clientWidth;
      redraw();
    })).observe(figure);
  };
  const watcher = new IntersectionObserver((entries) => {
    if (entries.some((e) => e.isIntersecting)) start();
  }, {rootMargin: "400px"});
  watcher.observe(place);
  const toPaper = () => {
    if (!made) return;
    if (entry.picture) entry.picture.remove();
    // A picture finer than the screen's would leave out what WebGL draws. Its camera moves with the frames, and its
    // texts come from canvases of their own.
    const inSpace = Boolean(made.getOption().grid3D);
    if (inSpace) drawSpace(made);
    const pixelRatio = inSpace ? window.devicePixelRatio : 2;
    entry.picture = made.getRenderedCanvas({pixelRatio, backgroundColor: paper});
    entry.picture.removeAttribute("style");  // its size on the screen
    entry.picture.className = "paper";
    place.after(entry.picture);
  };
  Object.assign(entry, {redraw, start, toPaper});
  return {figure, redraw};
}

// Shapes, too, for those who see no colours.
const symbols = ["circle", "diamond", "triangle", "rect", "roundRect", "pin"];
const scaleFactors = [...new Set(views.flatMap((view) => view.trials.scale))].sort((a, b) => b - a);

// The same in every chart.
function scaleLook(factor) {
  const k = scaleFactors.indexOf(factor);
  return {symbol: symbols[k % symbols.length], itemStyle: {color: palette[k % palette.length], opacity: .8}};
}

const withUnit = (title, unit) => title + (unit ? " (" + unit + ")" : "");
const nameOf = (p) => withUnit(p.symbol, p.unit);

// What a search minimises: a quantity, or how far it comes out from the measured one.
const inWords = (o) => o.is_distance ? "distance from the measured " + o.title : o.title;

// Ticks of a logarithmic axis that holds fewer than two powers of ten, which are all that the library labels: 1, 2 and
// 5 of each decade; where fewer than two of these fit, about five even steps. Undefined: the powers do.
function ticksBetween(low, high) {
  const inside = (x) => x >= low * (1 - 1e-9) && x <= high * (1 + 1e-9);
  const round = (x) => Number(x.toPrecision(12));
  const powers = [];
  for (let k = Math.floor(Math.log10(low)); k <= Math.ceil(Math.log10(high)); ++k) powers.push(k);
  const some = (digits) => powers.flatMap((k) => digits.map((digit) => round(digit * 10 ** k))).filter(inside);
  if (some([1]).length > 1) return undefined;
  if (some([1, 2, 5]).length > 1) return some([1, 2, 5]);
  const rough = (high - low) / 5, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((digit) => rough <= digit * power * (1 + 1e-9));
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({length: 12}, (_, k) => round((first + k) * step)).filter(inside);
}

// The scale of an axis from low to high.
function scaleOf(log, low, high) {
  const customValues = log ? ticksBetween(low, high) : undefined;
  return {type: log ? "log" : "value", min: low, max: high, axisTick: {show: true, customValues},
    axisLabel: {color: soft, fontSize: 12, formatter: tick, hideOverlap: true, customValues}};
}

// A parameter's axis on its own scale, over its whole search range or a part of it, whose ends are no round values.
const parameterAxis = (p, {vertical = false, low = p.low, high = p.high} = {}) => {
  const scale = scaleOf(p.log, low, high);
  if (!scale.axisLabel.customValues) {
    scale.axisLabel.showMinLabel = low === p.low ? undefined : false;
    scale.axisLabel.showMaxLabel = high === p.high ? undefined : false;
  }
  return {...scale, name: nameOf(p), nameLocation: "middle", nameGap: vertical ? 50 : 30,
    nameTextStyle: {color: ink, fontSize: 13}, axisLine: {onZero: false, lineStyle: {color: axisLine}},
    splitLine: {lineStyle: {color: line}}};
};
const valueAxis = (name, more = {}) => ({
  type: "value", name, nameLocation: "middle", nameGap: 46, nameTextStyle: {color: ink, fontSize: 13},
  axisLine: {show: true, onZero: false, lineStyle: {color: axisLine}}, axisTick: {show: true},
  axisLabel: {color: soft, hideOverlap: true, formatter: tick},
  splitLine: {lineStyle: {color: line}}, ...more,
});
const margins = {left: 70, right: 24, top: 36, bottom: 52};
const legendStyle = {top: 0, left: 0, icon: "circle", itemHeight: 11, itemWidth: 14, itemGap: 14, type: "scroll",
                     get textStyle() { return {color: soft, fontSize: 13}; }};
const tooltipStyle = {confine: true, borderColor: "#dfe4e8", backgroundColor: "#ffffff",
                      textStyle: {color: lightInk, fontSize: 13}};
const lines = (texts) => texts.map((t) => echarts.format.encodeHTML(t)).join("<br>");

const doneTrials = () => D.trials.id.map((_, i) => i).filter((i) => D.trials.state[i] === "ok");
const isOfSearch = (i) => D.trials.purpose[i] !== "confirm";
// Of those rows of a column that have a value; null without any.
function meanOf(column, rows) {
  const known = rows.map((i) => column[i]).filter((x) => x !== null);
  return known.length ? known.reduce((a, b) => a + b) / known.length : null;
}
// How far trial i is from an objective's aim, and the trials that tell; none where no trial has its metric yet.
function valuesOf(objective) {
  const t = D.trials, m = D.metrics.findIndex((metric) => metric.name === objective.metric);
  const far = (x) => objective.is_distance ? Math.abs(x - objective.reference) : x;
  return {trials: m < 0 ? [] : doneTrials().filter((i) => t.metrics[m][i] !== null),
    value: (i) => far(t.metrics[m][i]),
    // Repeats of a set count by their mean.
    valueOfSet: (rows) => far(meanOf(t.metrics[m], rows))};
}

// At most `limit` of them, evenly through their order, and always those that `keep` names.
function thin(indices, limit, keep = new Set()) {
  if (indices.length <= limit) return indices;
  const step = indices.length / limit;
  const chosen = new Set(Array.from({length: limit}, (_, k) => indices[Math.floor(k * step)]));
  return indices.filter((i) => chosen.has(i) || keep.has(i));
}

// A trial, or the mean of a set's repeats.
function trialText(...rows) {
  const t = D.trials, [i] = rows;
  return [rows.length > 1 ? "Mean of trials " + rows.map((row) => t.id[row]).join(", ")
      : "Trial " + t.id[i] + ", " + t.purpose[i],
    ...D.parameters.map((p, k) => p.symbol + " = " + formatUnit(t.values[k][i], p.unit)),
    ...D.metrics.map((m, k) => m.title + " = " + formatUnit(meanOf(t.metrics[k], rows), m.unit))];
}
