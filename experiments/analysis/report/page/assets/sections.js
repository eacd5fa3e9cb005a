// The sections of the page that are text and tables.

function standing() {
  const c = D.campaign, {searched, reused, confirming, failed, running} = c.counts;
  const parts = [counted(searched, "simulation") + (c.budget ? " of at most " + c.budget : "")];
  if (confirming) parts[0] += " and " + confirming + (confirming === 1 ? " that confirms" : " that confirm") + " the answer";
  if (failed) parts.push(failed + " failed");
  if (running) parts.push(running + (c.state === "running" ? " under way" : " to be run or collected"));
  if (reused) parts.push("reused: " + (c.reused_from.length ? c.reused_from.join(", ") : counted(reused, "simulation")));
  if (c.core_hours !== null) parts.push(duration(3600 * c.core_hours) + " of core time" + (confirming ? " in all" : ""));
  return [element("span", {class: "state"}, D.headline && D.headline.unsettled ? "budget used" : c.state),
    c.ended_silently ? [" ", element("code", {}, "talus resume " + c.folder), " goes on. "] : " ",
    ...withCode(parts.join(" · ") +
      (c.stop_reason && !(D.headline && D.headline.unsettled) ? ". Why it stopped: " + c.stop_reason : ""))];
}

function sensitivityTable() {
  const h = D.headline;
  if (!h || !h.sobol_total.length) return [];
  return [element("div", {class: "card"}, element("h3", {},
      "What the " + (h.sobol_of ? "misfit of the images of \u201c" + h.sobol_of + "\u201d" : inWords(D.campaign.objective)) + " depends on"),
    table("Sensitivity", [{title: "Parameter", text: true}, {title: "alone (first-order Sobol index)"},
           {title: "with its interactions (total)"}],
      D.parameters.map((p, k) => [p.symbol, shareBar(h.sobol_first[k]), shareBar(h.sobol_total[k])])))];
}

const shareBar = (x) => x === null || x === undefined ? "–" : element("span", {}, percent(x),
  element("span", {class: "bar", "aria-hidden": "true"},
    element("i", {style: `width:${Math.min(100, Math.max(0, 100 * x))}%`})));

// The experiment's angle, with its standard error from run to run.
const experimentOf = (o) => !o.is_distance ? "–" : formatUnit(o.reference, o.unit, 4) +
  (o.reference_error === null ? "" : " ± " + format(o.reference_error, 2));

// The posterior that each objective gives by itself.
function knowledgeTable() {
  if (!D.knowledge.length) return [];
  const region = (k) => k.low === null ? percent(k.region) : percent(k.region) + " (" + percent(k.low) + " to " + percent(k.high) + ")";
  const holds = (k) => (k.holds ? "yes" : "no") + (k.num_refits ? "; " + k.num_holding + " of " + k.num_refits + " refits do" : "");
  return [element("div", {class: "card", id: idOf("knowledge")}, element("h3", {}, "What each objective knows by itself"),
    table("What each objective knows", [{title: "Objective", text: true}, {title: "Joint 90\u00a0% region", unit: "of the searched ranges"},
        {title: "Holds the recommended set", text: true}],
      D.knowledge.map((k) => k.absent ? [k.title, "–", k.absent] : [k.title, region(k), holds(k)])),
    D.knowledge_sentence ? element("p", {}, D.knowledge_sentence) : null,
    element("p", {class: "note"}, "The posterior of each alone, from the same trials with the same statistics: the smaller " +
      "its region, the more it says. In brackets: 90\u00a0% of what the share may be with other trials; refits leave out " +
      "a quarter of the trials in turn."))];
}

function comparisonSection() {
  const answered = D.objectives.filter((o) => !o.absent);
  const columns = [{title: "Objective", text: true}, {title: "Measured"}, {title: "Experiment"},
    ...D.parameters.map((p) => ({title: p.symbol, unit: p.unit})), {title: "Sets that tie"}];
  const first = answered.map((o) => {
    const b = o.trials.best[0];
    return [o.title, formatUnit(b.quantity, o.unit, 4), experimentOf(o),
      ...b.values.map((x) => format(x)),
      o.noise_sd === null ? "–" : o.trials.num_tied + " of " + o.trials.num_sets];
  });
  const parts = !answered.length ? [element("p", {class: "lead"}, doneTrials().length ? "No objective has a best set."
    : "No trial has succeeded: no objective has a best set.")] : [
    ...knowledgeTable(),
    element("p", {class: "lead"}, "The best set by each objective, and how many sets tie with it: those whose objective " +
      "is within the scatter of one simulation. A dash: no set was simulated twice, so that the scatter is not known."),
    element("div", {class: "card"}, table("Best sets", columns, first))];
  const silent = D.objectives.filter((o) => o.absent);
  if (silent.length) {
    parts.push(element("div", {class: "notice"}, element("ul", {}, silent.map((o) =>
      element("li", {}, o.title + ": " + o.absent)))));
  }
  if (answered.length) parts.push(element("div", {class: "card"}, answered.map((o, k) => element("details", {open: k === 0},
    element("summary", {}, "The ten best by " + o.title),
    table("The ten best by " + o.title, [{title: "Rank"}, {title: o.title, unit: o.unit},
           ...(o.is_distance ? [{title: "Off by", unit: o.unit}] : []),
           ...D.parameters.map((p) => ({title: p.symbol, unit: p.unit})), {title: "Trials", text: true}],
      o.trials.best.map((b, rank) => [rank + 1, format(b.quantity, 4),
        ...(o.is_distance ? [format(b.objective, 3)] : []), ...b.values.map((x) => format(x)),
        b.trials.slice(0, 8).join(", ") + (b.trials.length > 8 ? ", …" : "")]))))));
  return parts;
}

const comparing = new Set(["sad_px", "sad_mm2", "sad_relative", "rmse_gray", "rmse", "iou"]);

function measuresTable() {
  const shown = D.metrics.map((_, k) => k).filter((k) => !D.metrics[k].name.endsWith("_px"));
  return element("div", {class: "card"},
    table("Measures", [{title: "Measure", text: true},
           ...D.measures.map((m) => ({title: m.title, unit: m.note, profile: true}))],
      shown.map((k) => [D.metrics[k].title +
        (D.metrics[k].unit ? " (" + D.metrics[k].unit + ")" : ""),
        // The experiment is not compared with itself.
        ...D.measures.map((m, column) => column === 0 && comparing.has(D.metrics[k].name) ? "–"
          : m.values[k] !== null ? format(m.values[k], 4) : column === 0 ? "–" : "not defined")])),
    !D.campaign.has_image ? null : element("p", {class: "note"}, "AOR: angle of repose by methods 1 (height over base radius), 2 (regression " +
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
    const kind = t.reason[i].replace(/\d+/g, "#");  // reasons that differ in seeds, times and folders are one
    if (!groups.has(kind)) groups.set(kind, {first: t.reason[i], differ: false, ids: []});
    const group = groups.get(kind);
    group.differ ||= t.reason[i] !== group.first;
    group.ids.push(id);
  });
  if (!groups.size) return [element("p", {class: "lead"}, "No trial failed.")];
  const rows = [...groups.values()].sort((a, b) => b.ids.length - a.ids.length).map(({first, differ, ids}) =>
    [first + (differ ? " (the numbers differ)" : ""), ids.length, ids.slice(0, 20).join(", ") + (ids.length > 20 ? ", …" : "")]);
  return [element("div", {class: "card"}, table("Failures", [{title: "Reason", text: true, wide: true}, {title: "Trials"},
    {title: "Which", text: true, wide: true}], rows))];
}

function stagesTable() {
  if (!D.stages.length) return [];
  return [element("div", {class: "card"}, table("Time", [{title: "Stage", text: true}, {title: "Time"}],
    D.stages.map((s) => [s.name, duration(s.seconds)])))];
}
