// The sections of the page that are text and tables.
const objectiveValue = (x, digits) => formatUnit(x, D.campaign.objective.unit, digits);

function standing() {
  const c = D.campaign, {searched, confirming, failed, running} = c.counts;
  const parts = [searched + " simulations" + (c.budget ? " of at most " + c.budget : "")];
  if (confirming) parts.push(confirming + " confirming");
  if (failed) parts.push(failed + " failed");
  if (running) parts.push(running + " running");
  if (c.core_hours !== null) parts.push(format(c.core_hours) + " core-hours");
  return [element("span", {class: "state"}, c.state),
    parts.join(" · ") + (c.stop_reason ? ". Why it stopped: " + c.stop_reason : "")];
}

function valueTile(p, v) {
  const place = (x) => 100 * (p.log ? Math.log(x / p.low) / Math.log(p.high / p.low)
                                    : (x - p.low) / (p.high - p.low));
  const clamp = (x) => Math.min(100, Math.max(0, x));
  const ranged = v.low !== null && v.high !== null;
  const from = ranged ? clamp(place(v.low)) : 0, to = ranged ? clamp(place(v.high)) : 0;
  return element("div", {class: "value"},
    element("div", {class: "what"}, p.symbol + " ", element("span", {}, p.title)),
    element("div", {class: "number"}, format(v.value), " ", element("small", {}, p.unit)),
    element("div", {class: "range"}, ranged
      ? "90\u00a0% range" + (D.parameters.length > 1 ? ", all together, " : " ") + format(v.low) + " to " + formatUnit(v.high, p.unit)
      : "no range: the strategy has no model"),
    element("div", {class: "track", "aria-hidden": "true"},
      ranged ? element("div", {class: "band", style: `left:${from}%;width:${to - from}%`}) : null,
      element("div", {class: "dot", style: `left:${clamp(place(v.value))}%`})),
    element("div", {class: "ends"}, element("span", {}, tick(p.low)),
      element("span", {}, p.log ? "searched, logarithmic" : "searched"),
      element("span", {}, tick(p.high))));
}

function fact(name, value, note) {
  return element("div", {}, element("dt", {}, name),
    element("dd", {}, value, note ? element("small", {}, note) : null));
}

const setText = (values) => D.parameters.map((p, k) => p.symbol + " " + formatUnit(values[k], p.unit)).join(", ");

// The pair of parameters that says most: the one that is tied closest.
function closestPair() {
  const inside = (pair) => pair.value.filter((level) => level < .9).length;
  return [...D.pairs].sort((a, b) => inside(a) - inside(b))[0];
}

// What kind of answer it is, before any number, with the figure of its region; and each part of it.
function verdict(h) {
  if (!h.verdict) return [];
  const closest = closestPair();
  const region = closest && D.model.posterior ? card(pairChart(closest, 0, "region", "")) : null;
  // One answer alone stands below, with its ranges.
  const parts = h.branches.length > 1 ? element("div", {class: "card", id: "branches"},
    element("h3", {}, "The separate answers"),
    table([{title: "", text: true}, ...h.branches.map((b, i) => ({title: "Answer " + (i + 1),
        unit: percent(b.share) + " of the region"}))],
      D.parameters.map((p, k) => [p.symbol + (p.unit ? " (" + p.unit + ")" : ""), ...h.branches.map((b) =>
        element("span", {}, format(b.values[k]), element("br"), element("small", {},
          format(b.low[k]) + " to " + format(b.high[k]))))]))) : null;
  return [element("div", {class: "card", id: "verdict"}, element("p", {}, element("strong", {}, h.verdict))),
    region ? element("div", {class: "grid two stacked"}, region, element("div", {}, nextSteps(h), parts)) : parts];
}

function nextSteps(h) {
  if (!h.next.length) return null;
  return element("div", {class: "card", id: "next"}, element("h3", {},
      h.verdict_kind === "point" ? "What would narrow it further" : "What to do next"),
    element("ol", {class: "steps"}, h.next.map((step) => element("li", {}, element("strong", {}, step.what),
      element("div", {}, "Costs " + step.cost + "."), element("div", {}, "Leaves " + step.leaves + ".")))));
}

// "0.12", of a logarithmic range "a factor of 3".
const widthText = (p, w) => p.log ? "a factor of " + format((p.high / p.low) ** w, 2)
  : formatUnit(w * (p.high - p.low), p.unit, 2);

// What `talus next` has found: every candidate, and the heaps that the best ones would tell apart.
function nextTable() {
  if (!D.next) return [];
  const cost = (c) => c.simulations ? c.simulations + " simulations, " + duration(c.core_time) : "no simulation";
  const pictured = D.next.candidates.filter((c) => c.uri);
  return [element("div", {class: "card", id: "next-table"}, element("h3", {}, "What each next step is expected to teach"),
    D.next.outdated ? element("p", {class: "note"}, "Trials have ended since: run talus next again.") : null,
    table([{title: "Candidate", text: true, wide: true}, {title: "Expected", unit: "bits"},
        ...D.parameters.map((p, k) => ({title: p.symbol + " known within", unit: "now " + widthText(p, D.next.width[k])})),
        {title: "Costs", text: true}],
      D.next.candidates.map((c) => [c.name + ": " + c.what, c.bits === null ? "?" : format(c.bits, 2),
        ...D.parameters.map((p, k) => c.bits === null ? "?" : widthText(p, c.width[k])), cost(c)])),
    element("p", {class: "note"}, "Made by talus next, before any of it is done. One bit halves the volume of what is " +
      "possible." + (D.next.candidates.some((c) => c.bits === null)
        ? " ?: talus next DIR --simulate runs the simulations that tell." : ""))),
    pictured.length ? element("div", {class: "grid three stacked", id: "told-apart"}, pictured.slice(0, 3).map((c) =>
      element("figure", {class: "card"}, element("h3", {}, c.name),
        element("img", {src: c.uri, alt: "Two simulated heaps that fit equally and that " + c.name + " tells apart",
          width: c.picture_width, height: c.picture_height}),
        element("figcaption", {}, "Both fit so far: left " + setText(c.apart[0]) + ", right " + setText(c.apart[1]) +
          ". This is how they come out of it.")))) : null];
}

// Heaps of sets that fit equally, side by side; of one set alone, its heap.
function representativeHeaps(h) {
  const o = D.campaign.objective;
  if (!h.representatives.some((set) => set.uri)) return null;
  const others = h.representatives.filter((set) => !set.recommended);
  return element("div", {class: "grid three stacked", id: "representatives"}, h.representatives.map((set) =>
    set.uri ? element("figure", {class: "card"},
      element("h3", {}, (set.recommended ? "Recommended: " : "Set " + (others.indexOf(set) + 1) + ": ") +
        setText(set.values)),
      element("img", {src: set.uri, alt: "Simulated heap of trial " + set.trial, width: set.width, height: set.height}),
      element("figcaption", {}, (set.expected === null ? "" : "Expected " + o.title + " " + formatUnit(set.expected, o.unit) +
        (set.expected_sd === null ? "" : " ± " + format(set.expected_sd, 2)) + ". ") +
        "Shown is trial " + set.trial + (set.distance > .01 ? ", the nearest simulated, at " + setText(set.trial_values) : "") +
        ": " + formatUnit(set.trial_objective, o.unit) + ".")) : null));
}

// The best trial at the finest scale factor; nothing before there is one.
function bestSoFar() {
  const o = D.campaign.objective, t = D.trials;
  const m = D.metrics.findIndex((metric) => metric.name === o.metric);
  if (m < 0) return null;
  const value = (i) => o.is_angle ? Math.abs(t.metrics[m][i] - o.reference) : t.metrics[m][i];
  const usable = doneTrials().filter((i) => t.metrics[m][i] !== null && t.scale[i] === D.campaign.scale_factor);
  if (!usable.length) return null;
  const i = usable.reduce((a, b) => value(b) < value(a) ? b : a);
  return fact("Best so far", objectiveValue(value(i)), "trial " + t.id[i] + ": " +
    setText(t.values.map((column) => column[i])));
}

// By what the latest trials took and how many run at a time; the search may stop before.
function timeLeft() {
  const t = D.trials, ended = t.id.map((_, i) => i).filter((i) => t.state[i] !== "running" && t.seconds[i] !== null);
  const left = D.campaign.budget - t.id.length;
  if (D.campaign.state !== "running" || !D.campaign.budget || left <= 0 || !ended.length) return null;
  const latest = ended.slice(-10);
  const each = latest.reduce((sum, i) => sum + t.seconds[i], 0) / latest.length;
  const workers = Math.max(1, t.state.filter((s) => s === "running").length);
  return fact("Time left", "at most about " + duration(left * each / workers),
    left + " simulations of the budget, " + workers + " at a time");
}

// Where a campaign that runs stands: the best trial, the time left, the region and how it has shrunk.
function soFar() {
  const facts = [bestSoFar(), timeLeft(), D.region_share === null ? null
    : fact("Joint 90\u00a0% region so far", percent(D.region_share), "of the plane of the parameters it ties closest")];
  const history = D.region_history;
  const shrinking = history.length < 2 ? null : card(chart("shrinking", "The region as it shrinks",
    "Share of the searched plane inside the joint 90\u00a0% region, since this page is watched.", () => ({
      grid: margins, tooltip: {...tooltipStyle, formatter: (e) =>
        lines(["After trial " + e.data[0] + ": " + percent(e.data[1])])},
      xAxis: valueAxis("trials", {nameGap: 28, min: history[0][0]}), yAxis: valueAxis("share", {min: 0}),
      series: [{type: "line", data: history, lineStyle: {color: palette[0], width: 2}, itemStyle: {color: palette[0]}}],
    }), "small").figure);
  const region = D.model && D.model.posterior && D.pairs.length ? card(pairChart(closestPair(), 0, "region", "")) : null;
  return [element("div", {class: "card", id: "so-far"}, element("dl", {class: "facts"}, facts)),
    region || shrinking ? element("div", {class: "grid two stacked"}, region, shrinking) : null];
}

function answerSection() {
  const h = D.headline, o = D.campaign.objective, parts = [];
  if (!h) {
    parts.push(element("div", {class: "card"}, element("p", {}, "The campaign has not concluded yet. " +
      (D.model ? "So far its model recommends " +
        D.parameters.map((p, k) => p.symbol + " = " + formatUnit(D.model.values[k], p.unit)).join(", ") +
        (D.model.expected === null ? "" : " and expects a " + o.title + " of " + formatUnit(D.model.expected, o.unit) +
          (D.model.expected_sd === null ? "" : " ± " + format(D.model.expected_sd, 2)) + " there") + "."
        : "There are too few trials to say anything about the best set."))), ...soFar());
  } else {
    parts.push(...verdict(h));
    const facts = [];
    if (h.predicted !== null) {
      facts.push(fact("Predicted " + o.title, objectiveValue(h.predicted) +
        (h.predicted_sd ? " ± " + format(h.predicted_sd, 2) : ""), "by the model that answers"));
    }
    const inProfile = h.confirmed_profile === null ? ""
      : "; " + objectiveValue(h.confirmed_profile) + (o.key === "sad" ? "" : " SAD") + " of their mean profile" +
        (h.confirmed_over_floor === null ? "" : ", " + format(h.confirmed_over_floor, 2) + " × the noise floor");
    facts.push(h.num_confirmed
      ? fact("Confirmed " + o.title, objectiveValue(h.confirmed) +
          (h.num_confirmed > 1 ? " in single runs" : " in a single run"),
          h.num_confirmed > 1 ? "mean of " + h.num_confirmed + " fresh seeds" + inProfile : inProfile.slice(2))
      : fact("Confirmed " + o.title, "not yet", "no fresh seed has been run"));
    facts.push(o.noise_floor === null
      ? fact("Noise floor of the experiment", "unknown", "needs more than one run of photographs")
      : fact("Noise floor of the experiment", objectiveValue(o.noise_floor), "leave one run out, SAD"));
    facts.push(fact("Scatter of one simulation", h.noise_sd === null ? "unknown" : objectiveValue(h.noise_sd),
      "standard deviation between seeds"));
    if (h.tied_volume !== null) {
      facts.push(h.posterior
        ? fact("Joint 90\u00a0% region", percent(h.tied_volume), "of the searched volume; each range above spans it alone")
        : fact("Sets within the scatter", percent(h.tied_volume), "of the searched volume: a thin region may still " +
            "span each range alone"));
    }
    parts.push(element("div", {class: "card"},
      element("div", {class: "answer"}, D.parameters.map((p, k) => valueTile(p, h.values[k]))),
      element("dl", {class: "facts"}, facts),
      h.model ? element("p", {class: "note"}, h.model) : null));
    parts.push(representativeHeaps(h));
  }
  parts.push(...nextTable());
  if (D.warnings.length) {
    parts.splice(1, 0, element("div", {class: "notice", role: "note", id: "alarms"}, element("strong", {}, "Before you use it"),
      element("ul", {}, D.warnings.map((w) => element("li", {}, w)))));
  }
  if (D.held_out.length) {
    parts.push(element("div", {class: "card", id: "held-out"}, element("h3", {}, "Held out"),
      element("ul", {class: "plain"}, D.held_out.map((line) => element("li", {}, line)))));
  }
  if (D.conditions.length) {
    parts.push(element("div", {class: "card"}, element("h3", {}, "It holds for"),
      element("ul", {class: "plain"}, D.conditions.map((c) => element("li", {}, c)))));
  }
  return parts;
}

function sensitivityTable() {
  const h = D.headline;
  if (!h || !h.sobol_total.length) return [];
  return [element("div", {class: "card"}, element("h3", {}, "What " + D.campaign.objective.title + " depends on"),
    table([{title: "Parameter", text: true}, {title: "alone (first-order Sobol index)"},
           {title: "with its interactions (total)"}],
      D.parameters.map((p, k) => [p.symbol, shareBar(h.sobol_first[k]), shareBar(h.sobol_total[k])])))];
}

const shareBar = (x) => x === null || x === undefined ? "–" : element("span", {}, percent(x),
  element("span", {class: "bar", "aria-hidden": "true"},
    element("i", {style: `width:${Math.min(100, Math.max(0, 100 * x))}%`})));

// The experiment's angle, with its standard error from run to run.
const experimentOf = (o) => !o.is_angle ? "–" : formatUnit(o.reference, o.unit, 4) +
  (o.reference_error === null ? "" : " ± " + format(o.reference_error, 2));

function comparisonSection() {
  const answered = D.objectives.filter((o) => !o.absent);
  const columns = [{title: "Objective", text: true}, {title: "Measured"}, {title: "Experiment"},
    ...D.parameters.map((p) => ({title: p.symbol, unit: p.unit})), {title: "Sets that tie"},
    {title: "Tied volume"}];
  const first = answered.map((o) => {
    const b = o.trials.best[0];
    return [o.title, formatUnit(b.quantity, o.unit, 4), experimentOf(o),
      ...b.values.map((x) => format(x)),
      o.noise_sd === null ? "–" : o.trials.num_tied + " of " + o.trials.num_sets,
      o.noise_sd === null ? "–" : shareBar(o.trials.tied_volume)];
  });
  const parts = [
    element("p", {class: "lead"}, "The best set by each objective, and how much of the searched volume " +
      "ties with it: sets whose objective is within the scatter of one simulation. The smaller " +
      "that volume, the more unique the answer. A dash: no set was simulated twice, so that the scatter is not " +
      "known."),
    element("div", {class: "card"}, table(columns, first))];
  const silent = D.objectives.filter((o) => o.absent);
  if (silent.length) {
    parts.push(element("div", {class: "notice"}, element("ul", {}, silent.map((o) =>
      element("li", {}, o.title + ": " + o.absent)))));
  }
  parts.push(element("div", {class: "card"}, answered.map((o, k) => element("details", {open: k === 0},
    element("summary", {}, "The ten best by " + o.title),
    table([{title: "Rank"}, {title: o.title, unit: o.unit},
           ...(o.is_angle ? [{title: "Off by", unit: o.unit}] : []),
           ...D.parameters.map((p) => ({title: p.symbol, unit: p.unit})), {title: "Trials", text: true}],
      o.trials.best.map((b, rank) => [rank + 1, format(b.quantity, 4),
        ...(o.is_angle ? [format(b.objective, 3)] : []), ...b.values.map((x) => format(x)),
        b.trials.slice(0, 8).join(", ") + (b.trials.length > 8 ? ", …" : "")]))))));
  return parts;
}

const comparing = new Set(["sad_px", "sad_mm2", "sad_relative", "rmse_gray", "rmse", "iou"]);

function measuresTable() {
  const shown = D.metrics.map((_, k) => k).filter((k) => !D.metrics[k].name.endsWith("_px"));
  return element("div", {class: "card"},
    table([{title: "Measure", text: true},
           ...D.measures.map((m) => ({title: m.title, unit: m.note, profile: true}))],
      shown.map((k) => [D.metrics[k].title +
        (D.metrics[k].unit ? " (" + D.metrics[k].unit + ")" : ""),
        // The experiment is not compared with itself.
        ...D.measures.map((m, column) => column === 0 && comparing.has(D.metrics[k].name) ? "–"
          : m.values[k] !== null ? format(m.values[k], 4) : "not defined")])),
    element("p", {class: "note"}, "AOR: angle of repose by methods 1 (height over base radius), 2 (regression " +
      "over the slope) and 3 (over the part of the slope next to the base). NEBP: number of equivalent black " +
      "pixels, the area of the profile. SAD, RMSE and IoU compare with the experiment."));
}

function pictures() {
  return element("div", {class: "grid two"}, D.pictures.map((p, k) => element("figure",
    // The experiment has a row of its own; then profile and map of a trial stand side by side.
    {class: k === 0 ? "card alone" : "card"},
    element("h3", {}, p.title), element("img", {src: p.uri, alt: p.title, width: p.width,
      height: p.height}), p.caption ? element("figcaption", {}, p.caption) : null)));
}

function failuresSection() {
  const t = D.trials, groups = new Map();
  t.id.forEach((id, i) => {
    if (t.state[i] !== "failed") return;
    if (!groups.has(t.reason[i])) groups.set(t.reason[i], []);
    groups.get(t.reason[i]).push(id);
  });
  if (!groups.size) return [element("p", {class: "lead"}, "No trial failed.")];
  const rows = [...groups].sort((a, b) => b[1].length - a[1].length).map(([reason, ids]) =>
    [reason, ids.length, ids.slice(0, 20).join(", ") + (ids.length > 20 ? ", …" : "")]);
  return [element("div", {class: "card"}, table([{title: "Reason", text: true, wide: true}, {title: "Trials"},
    {title: "Which", text: true, wide: true}], rows))];
}

function stagesTable() {
  if (!D.stages.length) return [];
  return [element("div", {class: "card"}, table([{title: "Stage", text: true}, {title: "Time"}],
    D.stages.map((s) => [s.name, duration(s.seconds)])))];
}
