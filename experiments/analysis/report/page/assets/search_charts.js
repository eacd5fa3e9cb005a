// How the search went: the objective trial by trial, and the time each trial took. Null where no trial has any yet.
function convergenceChart() {
  const t = D.trials, o = D.campaign.objective;
  const {trials: all, value} = valuesOf(o);
  if (!all.length) return null;
  const best = [];
  let least = Infinity;
  for (const i of all) {
    if (isOfSearch(i) && t.scale[i] === D.campaign.scale_factor && value(i) < least) {
      least = value(i);
      best.push([t.id[i], least]);
    }
  }
  const last = t.id.length ? t.id[t.id.length - 1] : 0;
  if (best.length) best.push([last, least]);
  const noise = o.noise_sd;
  const shown = thin(all, 4000);
  // Grains of another size make another heap: what is compared is told apart by colour.
  const kindOf = scaleFactors.length > 1 ? (i) => "scale factor " + tick(t.scale[i]) +
    (t.purpose[i] === "confirm" ? ", confirm" : "") : (i) => t.purpose[i];
  const kinds = [...new Set(shown.map(kindOf))];
  const lookOf = (name, k) => scaleFactors.length < 2
    ? {symbol: "circle", itemStyle: {color: palette[k % palette.length], opacity: .8}}
    : name.endsWith("confirm") ? {symbol: "diamond", itemStyle: {color: starColor}}
    : scaleLook(t.scale[shown.find((i) => kindOf(i) === name)]);
  const drawn = [...all.map(value), ...(o.noise_floor === null ? [] : [o.noise_floor])];
  const top = drawn.reduce((a, b) => Math.max(a, b)), lowest = drawn.reduce((a, b) => Math.min(a, b));
  let logarithmic = false;
  const option = () => ({
    grid: margins,
    legend: {...legendStyle, data: [...kinds, "best so far", ...(noise ? ["± noise of one trial"] : []),
      ...(o.noise_floor === null ? [] : ["noise floor of the experiment"])]},
    tooltip: {...tooltipStyle, trigger: "item",
              formatter: (e) => e.data && e.data[2] !== undefined ? lines(trialText(e.data[2])) : ""},
    xAxis: valueAxis("trial", {nameGap: 28, min: 0, max: Math.max(1, last), minInterval: 1}),
    yAxis: valueAxis(withUnit(o.value_title, o.unit), logarithmic ? scaleOf(true, lowest, top) : {min: 0}),
    series: [
      ...(noise && !logarithmic ? [
        {type: "line", step: "end", data: best.map(([x, y]) => [x, Math.max(0, y - noise)]),
         stack: "noise", symbol: "none", lineStyle: {opacity: 0}, silent: true},
        {type: "line", step: "end", data: best.map(([x, y]) => [x, y + noise - Math.max(0, y - noise)]),
         stack: "noise", name: "± noise of one trial", symbol: "none", lineStyle: {opacity: 0},
         areaStyle: {color: D.colors.scatter_band, opacity: .38}, itemStyle: {color: "#c3ced6"}, silent: true}] : []),
      {type: "line", step: "end", name: "best so far", data: best, symbol: "none", silent: true,
       lineStyle: {color: ink, width: 2}, itemStyle: {color: ink}},
      ...(o.noise_floor === null ? [] : [
        {type: "line", name: "noise floor of the experiment", symbol: "none", silent: true,
         data: [[0, o.noise_floor], [Math.max(1, last), o.noise_floor]],
         lineStyle: {color: soft, type: "dashed", width: 1.5}, itemStyle: {color: soft}}]),
      ...kinds.map((name, k) => ({
        type: "scatter", name, symbolSize: shown.length > 800 ? 4 : name.endsWith("confirm") && scaleFactors.length > 1 ? 14 : 7,
        ...lookOf(name, k),
        data: shown.filter((i) => kindOf(i) === name).map((i) => [t.id[i], value(i), i])})),
    ],
  });
  const made = chart("convergence", capital(inWords(o)) + " of each trial, and the best so far",
      "Each point is one simulation" + (scaleFactors.length > 1 ? "; the best is of those at scale factor " +
        tick(D.campaign.scale_factor) : "") + ". The axis starts at zero unless it is logarithmic. " +
      (all.length > shown.length ? shown.length + " of " + all.length + " trials are drawn. " : "") +
      (t.state.includes("failed") ? "Failed trials have no value and are listed below." : ""), option);
  made.figure.insertBefore(element("div", {class: "row"}, element("label", {},
      element("input", {type: "checkbox", disabled: !(lowest > 0 && top > lowest),
                        onchange: (e) => { logarithmic = e.target.checked; made.redraw(); }}),
      "logarithmic axis")), made.figure.children[1]);
  return made.figure;
}

function timeChart() {
  const t = D.trials;
  const all = t.id.map((_, i) => i).filter((i) => t.seconds[i] !== null);
  const shown = thin(all, 3000);
  if (!shown.length) return null;
  return chart("times", "Time of each simulation", "Wall time of one trial on one worker.", () => ({
    grid: margins, legend: legendStyle,
    tooltip: {...tooltipStyle, formatter: (e) =>
      lines(["Trial " + t.id[e.data[2]] + ": " + duration(e.data[1])])},
    xAxis: valueAxis("trial", {nameGap: 28, min: 0}),
    yAxis: valueAxis("time (s)", {min: 0}),
    series: ["ok", "failed"].map((state, k) => ({
      type: "scatter", name: state, symbolSize: shown.length > 800 ? 4 : 6,
      symbol: state === "failed" ? "diamond" : "circle",
      itemStyle: {color: palette[k], opacity: .75},
      data: shown.filter((i) => t.state[i] === state).map((i) => [t.id[i], t.seconds[i], i])})),
  }), "small").figure;
}
