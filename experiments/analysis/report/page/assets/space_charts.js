// The parameter space: where the trials lie, which each objective prefers, and what the model says.

// Three dimensions when there are three parameters and the browser has WebGL, else two. Null before any objective has a
// value: there is nothing to colour by.
function spaceChart() {
  const t = D.trials, n = D.parameters.length;
  const three = n >= 3 && hasWebGl;
  const axes = three ? [0, 1, 2] : n >= 2 ? [0, 1] : [0];
  const answered = D.objectives.filter((o) => !o.absent);
  if (!answered.length) return null;
  const own = Math.max(0, answered.findIndex((o) => o.key === D.campaign.objective.key));
  // -1: by scale factor, where there are several: their objectives do not compare.
  let colorBy = scaleFactors.length > 1 ? -1 : own;
  const rowOf = new Map(t.id.map((id, i) => [id, i]));
  const kept = new Set(answered.flatMap((o) => o.trials.best.map((b) => rowOf.get(b.trials[0]))));
  const rowsOf = (set) => set.trials.map((id) => rowOf.get(id));
  const logOf = (k, x) => D.parameters[k].log && three ? Math.log10(x) : x;
  const at = (values) => axes.map((k) => logOf(k, values[k]));
  const point = (i) => at(t.values.map((column) => column[i]));

  const option = (width) => {
    const o = answered[colorBy < 0 ? own : colorBy];
    const {trials: usable, value, valueOfSet} = valuesOf(o);
    const shown = thin(usable, 3000, kept);
    const sorted = shown.map(value).sort((a, b) => a - b);
    // The colours end at the 90 % point: beyond it a trial is simply bad, and the legend says so.
    const low = sorted[0], high = sorted[Math.floor(.9 * (sorted.length - 1))];
    const kind = three ? "scatter3D" : "scatter";
    const size = shown.length > 1000 ? 4 : 8;
    const extra = n === 1 ? (rows) => [valueOfSet(rows)] : () => [];
    const trialSeries = (name, some, style, symbol = "circle") => ({type: kind, name, symbolSize: size, symbol,
      itemStyle: {opacity: .9, borderWidth: three ? .4 : .5, borderColor: paper, ...style},
      data: some.map((i) => [...point(i), ...extra([i]), value(i), i])});
    const byScale = colorBy < 0;
    const series = byScale
      ? scaleFactors.map((factor, k) => trialSeries("scale factor " + tick(factor),
          shown.filter((i) => t.scale[i] === factor), scaleLook(factor).itemStyle, scaleLook(factor).symbol))
      : [trialSeries("trials", shown, {})];
    const numTrialSeries = series.length;
    answered.forEach((objective, k) => series.push({
      type: kind, name: "ten best by " + objective.title, symbolSize: 15 + 3 * k,
      itemStyle: {color: "rgba(255,255,255,0)", borderColor: palette[k % palette.length], borderWidth: 2, opacity: 1},
      data: objective.trials.best.map((b) => {
        const rows = rowsOf(b);
        return {value: [...at(b.values), ...extra(rows), b.objective, rows[0]], rows};
      })}));
    // One parameter is marked by a line: the axis across it is of whichever objective is shown.
    if (D.headline && n === 1) {
      series.push({type: kind, name: "recommended", symbol: "path://M-1,-9 L1,-9 L1,9 L-1,9 Z", data: [],
        itemStyle: {color: starColor}, markLine: verticalMark(D.headline.values[0].value)});
    } else if (D.headline) {
      series.push({type: kind, name: "recommended", symbol: star, symbolSize: 26, z: 9,
        itemStyle: {color: starColor, borderColor: paper, borderWidth: 1, opacity: 1},
        data: [[...at(D.headline.values.map((v) => v.value)), 0, -1]]});
    }
    const selected = Object.fromEntries(
        answered.map((objective) => ["ten best by " + objective.title, objective === o]));
    const narrow = width < 560;
    const place = document.getElementById(idOf("space")), height = place.clientHeight || 560;  // 0 on paper
    const common = {
      legend: {...legendStyle, selected, icon: undefined,
               data: series.slice(byScale ? 0 : numTrialSeries).map((s) => ({name: s.name, icon: s.symbol || "circle"}))},
      tooltip: {...tooltipStyle, formatter: (e) => {
        const rows = e.data.rows || e.data.slice(-1);
        return rows[0] < 0 ? "recommended" : lines(trialText(...rows));
      }},
      visualMap: byScale ? undefined : {seriesIndex: 0, dimension: axes.length + (n === 1 ? 1 : 0), min: low, max: high,
        inRange: {color: [...sequence].reverse()}, calculable: false, orient: "horizontal",
        left: 0, bottom: 0, itemWidth: 12, itemHeight: narrow ? 90 : 150,
        text: ["≥ " + formatUnit(high, o.unit), o.value_title + "  " + format(low)],
        textStyle: {color: soft}},
      series,
    };
    if (!three) {
      return {...common, grid: {...margins, bottom: 92}, xAxis: parameterAxis(D.parameters[axes[0]]),
        yAxis: n === 1 ? valueAxis(withUnit(o.value_title, o.unit), {min: 0})
          : parameterAxis(D.parameters[axes[1]], {vertical: true})};
    }
    const axis = (k) => {
      const p = D.parameters[axes[k]];
      return {type: "value", min: logOf(axes[k], p.low), max: logOf(axes[k], p.high),
        name: narrow ? p.symbol : nameOf(p),  // a longer one is cut off at the edge
        nameGap: narrow ? 18 : 24, nameTextStyle: {color: ink, fontSize: narrow ? 12 : 14, lineHeight: 24},
        axisLabel: {textStyle: {color: soft, fontSize: narrow ? 10 : 12, lineHeight: 22},
          // The first label of x would stand on that of z.
          formatter: (x) => k === 0 && x === logOf(axes[0], p.low) ? ""
            : tick(p.log ? Number((10 ** x).toPrecision(3)) : x)},
        interval: p.log ? 1 : undefined,
        axisLine: {lineStyle: {color: axisLine, width: 1}}, splitLine: {lineStyle: {color: line}}};
    };
    return {...common, xAxis3D: axis(0), yAxis3D: axis(1), zAxis3D: axis(2),
      grid3D: {boxWidth: 100, boxDepth: 100, boxHeight: 84, top: -10, bottom: 30,
        axisPointer: {show: false}, environment: "none",
        viewControl: {projection: "orthographic", orthographicSize: Math.max(165, 200 * height / width), alpha: 22,
          beta: 38, minOrthographicSize: 60, maxOrthographicSize: 320, zoomSensitivity: 0}}};
  };
  const made = chart("space", three ? "Trials in the space of three parameters"
      : "Trials in the parameter space", three ? "Drag to turn. Rings mark the ten best sets of an " +
      "objective: choose which in the legend. The star is the recommended set."
      : n >= 3 ? "This browser has no WebGL, so the space is shown in two dimensions."
      : "Rings mark the ten best sets of an objective; the " + (n === 1 ? "line" : "star") + " is the recommended set.",
      option, "tall");
  const chooser = element("select", {id: idOf("space-objective"),
      onchange: (e) => { colorBy = Number(e.target.value); made.redraw(); }},
      [...(scaleFactors.length > 1 ? [element("option", {value: -1, selected: true}, "scale factor")] : []),
       ...answered.map((o, k) => element("option", {value: k, selected: k === colorBy}, o.title))]);
  const choices = [element("label", {}, "Colour by", chooser)];
  if (n > axes.length) {
    axes.forEach((_, a) => choices.push(element("label", {}, "xyz"[a], element("select",
        {onchange: (e) => { axes[a] = Number(e.target.value); made.redraw(); }},
        D.parameters.map((p, k) => element("option", {value: k, selected: k === axes[a]}, p.symbol))))));
  }
  made.figure.insertBefore(element("div", {class: "row"}, choices), made.figure.children[1]);
  return made.figure;
}

const verticalMark = (x, text) => ({silent: true, symbol: "none", precision: 18, data: [{xAxis: x}],
  lineStyle: {color: starColor, type: "solid", width: 1.5}, label: {show: Boolean(text),
    formatter: text, color: starColor}});

function sliceChart(slice, k) {
  const p = D.parameters[slice.parameter], o = D.campaign.objective;
  const v = D.headline ? D.headline.values[slice.parameter] : null;
  const banded = slice.high[0] !== null;
  return chart("slice-" + k, "Expected " + inWords(o) + " along " + p.symbol, "", () => ({
    grid: {...margins, top: 24},
    tooltip: {...tooltipStyle, trigger: "axis", formatter: (list) => {
      const i = list[0].dataIndex;
      return lines([p.symbol + " = " + formatUnit(slice.x[i], p.unit),
        "expected " + inWords(o) + " = " + formatUnit(slice.mean[i], o.unit),
        ...(banded ? ["90 %: " + format(slice.low[i]) + " to " + formatUnit(slice.high[i], o.unit)] : [])]);
    }},
    xAxis: parameterAxis(p),
    yAxis: valueAxis(withUnit(o.value_title, o.unit), {min: 0}),
    series: [
      ...(banded ? [{type: "line", stack: "band", data: slice.x.map((x, i) => [x, slice.low[i]]), symbol: "none",
       lineStyle: {opacity: 0}, silent: true},
      {type: "line", stack: "band", symbol: "none", lineStyle: {opacity: 0}, silent: true,
       data: slice.x.map((x, i) => [x, slice.high[i] - slice.low[i]]),
       areaStyle: {color: palette[0], opacity: .18}}] : []),
      {type: "line", data: slice.x.map((x, i) => [x, slice.mean[i]]), symbol: "none",
       lineStyle: {color: palette[0], width: 2},
       markLine: v ? verticalMark(v.value) : undefined,
       markArea: v && v.low !== null ? {silent: true, itemStyle: {color: starColor, opacity: .07},
                      data: [[{xAxis: v.low}, {xAxis: v.high}]]} : undefined},
    ],
  }), "small").figure;
}

// How likely each value of a parameter is, beside what was known before the first simulation.
function marginalChart(marginal, k) {
  const p = D.parameters[marginal.parameter];
  const v = D.headline ? D.headline.values[marginal.parameter] : null;
  return chart("marginal-" + k, "Posterior of " + p.symbol, "", () => ({
    grid: {...margins, top: 24},
    tooltip: {...tooltipStyle, trigger: "axis", formatter: (list) => {
      const i = list[0].dataIndex;
      return lines([p.symbol + " = " + formatUnit(marginal.x[i], p.unit),
        format(marginal.density[i] / marginal.prior[i], 2) + " times as likely as before the simulations"]);
    }},
    xAxis: parameterAxis(p),
    yAxis: valueAxis("density / even density", {min: 0}),
    series: [
      {type: "line", data: marginal.x.map((x, i) => [x, marginal.density[i]]), symbol: "none",
       lineStyle: {color: palette[0], width: 2}, areaStyle: {color: palette[0], opacity: .18},
       markLine: v ? verticalMark(v.value) : undefined},
      {type: "line", data: [[p.low, marginal.prior[0]], ...marginal.x.map((x, i) => [x, marginal.prior[i]]),
        [p.high, marginal.prior[marginal.prior.length - 1]]], symbol: "none", silent: true,
       lineStyle: {color: soft, type: "dashed", width: 1}},
    ],
  }), "small").figure;
}

// The part of an axis to show: the cells of the region with some room, not all that was searched.
function zoomed(inside, edges) {
  const cells = inside.map((some, k) => some ? k : -1).filter((k) => k >= 0);
  if (!cells.length) return {};
  const from = cells[0], to = cells[cells.length - 1] + 1, room = Math.max(3, Math.ceil(.5 * (to - from)));
  return {low: edges[Math.max(0, from - room)], high: edges[Math.min(edges.length - 1, to + room)]};
}

const regionShade = (level) => regionShades[level < .5 ? 0 : 1];

// Cells between the edges pair.x and pair.y, drawn on the true axes: the posterior's joint regions.
function pairChart(pair, k, id = "pair-" + k, size = "small") {
  const [px, py] = [D.parameters[pair.i], D.parameters[pair.j]];
  const nx = pair.x.length - 1, zooms = id === "region";
  const meaning = (v) => "inside the joint 90 % region; the smallest region that holds it is that of " +
    percent(Math.max(v, .001));
  const inside = pair.value.filter((v) => v < .9).length / pair.value.length;
  const [zoomX, zoomY] = !zooms ? [{}, {}] : [
    zoomed(pair.x.slice(1).map((_, c) => pair.y.slice(1).some((_y, r) => pair.value[r * nx + c] < .9)), pair.x),
    zoomed(pair.y.slice(1).map((_, r) => pair.x.slice(1).some((_x, c) => pair.value[r * nx + c] < .9)), pair.y)];
  const sets = D.headline ? D.headline.representatives.filter((set) => !set.recommended) : [];
  return chart(id, "Joint region of " + px.symbol + " and " + py.symbol,
      (D.parameters.length > 2 ? "The shadow of the joint region on this plane: dark 50\u00a0%, light 90\u00a0%."
        : "Dark: 50\u00a0% of the posterior, light: 90\u00a0%.") + " Blank: ruled out at that level." +
      (D.headline ? " Star: recommended." : "") +
      (!sets.length ? "" : D.headline.fits ? " Numbers: sets that fit equally." : " Numbers: sets that miss as little.") +
      (D.parameters.length > 2 ? " The light area is " + percent(inside) + " of the searched plane: all that these " +
        "two may be, whatever the others are." : "") +
      (zooms ? (D.parameters.length > 2 ? "" : " The patch is for both together.") + " Searched: " + [px, py].map((p) => p.symbol + " " + tick(p.low) + " to " +
        tick(p.high)).join(", ") + "." : ""), () => ({
    grid: {...margins, top: 16},
    tooltip: {...tooltipStyle, formatter: (e) => e.seriesType !== "custom" ? e.name : lines([
      px.symbol + ": " + format(pair.x[e.data[0]]) + " to " + formatUnit(pair.x[e.data[0] + 1], px.unit),
      py.symbol + ": " + format(pair.y[e.data[1]]) + " to " + formatUnit(pair.y[e.data[1] + 1], py.unit),
      meaning(e.data[2])])},
    xAxis: parameterAxis(px, zoomX), yAxis: parameterAxis(py, {vertical: true, ...zoomY}),
    series: [
      {type: "custom", progressive: 0, data: pair.value.map((v, c) => [c % nx, Math.floor(c / nx), v])
         .filter((cell) => cell[2] < .9),
       encode: {x: -1, y: -1}, clip: true,
       renderItem: (params, api) => {
         const cx = api.value(0), cy = api.value(1);
         const a = api.coord([pair.x[cx], pair.y[cy]]), b = api.coord([pair.x[cx + 1], pair.y[cy + 1]]);
         return {type: "rect", shape: {x: a[0], y: b[1], width: b[0] - a[0] + .5, height: a[1] - b[1] + .5},
           style: {fill: regionShade(api.value(2))}};
       }},
      ...(D.headline ? [{type: "scatter", symbol: star, symbolSize: 14, z: 5,
        itemStyle: {color: starColor, borderColor: "#fff", borderWidth: 1},
        data: [{name: "recommended", value: [D.headline.values[pair.i].value, D.headline.values[pair.j].value]}]}] : []),
      ...(sets.length ? [{type: "scatter", symbol: "circle", symbolSize: 20, z: 6,
        itemStyle: {color: "#ffffff", borderColor: lightInk, borderWidth: 1.5},
        label: {show: true, formatter: (e) => String(e.dataIndex + 1), color: lightInk, fontSize: 12, fontWeight: 600},
        data: sets.map((set, i) => ({name: "set " + (i + 1), value: [set.values[pair.i], set.values[pair.j]]}))}] : []),
    ],
  }), size).figure;
}
