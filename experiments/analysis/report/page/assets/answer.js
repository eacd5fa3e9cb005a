// The first section: what is known, how well, and what to do next.

function valueTile(p, v) {
  const place = (x) => 100 * (p.log ? Math.log(x / p.low) / Math.log(p.high / p.low)
                                    : (x - p.low) / (p.high - p.low));
  const clamp = (x) => Math.min(100, Math.max(0, x));
  const ranged = v.low !== null && v.high !== null;
  const from = ranged ? clamp(place(v.low)) : 0, to = ranged ? clamp(place(v.high)) : 0;
  return element("div", {class: p.nuisance ? "value nuisance" : "value"},
    element("div", {class: "what"}, p.symbol + " ", element("span", {}, p.title),
      p.nuisance ? element("strong", {}, " not asked for") : null),
    element("div", {class: "number"}, format(v.value), " ", element("small", {}, p.unit)),
    element("div", {class: "range"}, ranged ? "90\u00a0% range " + format(v.low) + " to " + formatUnit(v.high, p.unit) +
      (p.nuisance ? ", by itself" : "") + (v.prior ? " (prior " + v.prior + ")" : "")
      : "no range: too few trials for a model"),
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

// One parameter has several ranges, by what is asked of the others: side by side, each with what it is for.
function widths(h) {
  if (!h.widths.length) return null;
  const range = (w, k) => w.low[k] === null ? "–" : format(w.low[k]) + " to " + format(w.high[k]);
  return element("div", {class: "card", id: "widths"}, element("h3", {}, "How widely each parameter is known"),
    table("Ranges of each parameter", [{title: "", text: true, wide: true}, ...D.parameters.map((p) => ({title: p.symbol, unit: p.unit}))],
      h.widths.map((w) => [element("span", {}, element("strong", {}, w.title), element("br"), element("small", {}, w.means)),
        ...D.parameters.map((_, k) => range(w, k))])));
}

// The kind of answer, for who meets it for the first time.
const numAsked = D.parameters.filter((p) => !p.nuisance).length;
const kindText = {
  point: "One answer: with a probability of 90\u00a0% " + (numAsked === 1 ? "the value lies in its range."
    : (numAsked === 2 ? "both values lie in their ranges" : "all values lie in their ranges") + " at once."),
  curve: "The parameters trade against each other: every set along the curve fits. Take a whole set from it; never " +
    "combine the values of two.",
  region: "More than one answer: every set in the region fits as well as the errors of measurements and model allow.",
  separate: "More than one answer: each of these sets fits, and what lies between them does not.",
};

// What kind of answer it is, before any number, and how well it fits.
function verdict(h) {
  const lines = [...h.sentences.map((sentence) => element("p", {}, element("strong", {}, sentence))),
    h.verdict_kind && h.fits ? element("p", {class: "gloss"}, kindText[h.verdict_kind]) : null,
    h.trade_off ? element("p", {class: "gloss"}, h.trade_off) : null,
    h.fit_sentence ? element("p", {class: "gloss"}, h.fit_sentence) : null,
    h.use ? element("p", {class: "gloss"}, element("strong", {}, "Use it now? "), h.use) : null];
  return lines.some(Boolean) ? element("div", {class: "card", id: "verdict"}, lines) : null;
}

function alarms() {
  return D.warnings.length ? element("div", {class: "notice", role: "note", id: "alarms"},
    element("strong", {}, "Before you use it"),
    element("ul", {}, D.warnings.map((w) => element("li", {}, withCode(w))))) : null;
}

// Files beside the journal that are damaged.
function leftOut() {
  return D.left_out.length ? element("div", {class: "notice", role: "note", id: "left-out"},
    element("strong", {}, "Left out of this report"),
    element("ul", {}, D.left_out.map((line) => element("li", {}, withCode(line))))) : null;
}

const meetsText = {yes: "✓ fits", no: "✗ misses", unknown: "? open"};

const judged = (row) => [row.judgement, row.implausibility === null ? ""
  : "implausibility " + format(row.implausibility, 2)].filter(Boolean).join("; ");

// Each measurement beside what the recommended set gives of it.
function fitList(h) {
  if (!h.fit.length) return null;
  const implausible = h.fit.some((row) => row.implausibility !== null);
  return element("div", {class: "card", id: "fit"}, element("h3", {}, "How well it fits"),
    element("ul", {class: "fit"}, h.fit.map((row) => element("li", {},
      element("strong", {}, row.experiment + ", " + row.what), " ", element("span", {class: row.meets}, meetsText[row.meets]),
      row.held_out ? element("div", {}, "Held out: not used for the answer.") : null,
      element("div", {}, "Simulated: " + (row.simulated || "not yet") + "."),
      element("div", {}, "Measured: " + row.measured + "."),
      judged(row) ? element("div", {}, judged(row) + ".") : null))),
    element("p", {class: "note"}, (D.campaign.has_image ? "SAD: area by which two silhouettes differ. " : "") + (implausible ?
      "Implausibility: misfit of the experiment in standard deviations, all errors counted; above 3 no set fits." : "")));
}

function nextSteps(h) {
  if (!h.next.length) return null;
  const first = !h.fits
    ? [element("strong", {}, "First what \u201cUse it now?\u201d says."), " What would narrow the answer after that, the most useful first:"]
    : h.verdict_kind === "point" && h.has_card
    ? [element("code", {}, "talus card " + D.campaign.folder + " --format NAME"), " writes the set for your code (liggghts, lammps, lethe, yade, " +
       "mercurydpm). To narrow it further, the most useful first:"]
    : ["What would narrow the answer, the most useful first:"];
  return element("div", {class: "card", id: "next"}, element("h3", {}, "What to do next"), element("p", {class: "first"}, first),
    element("ol", {class: "steps"}, h.next.map((step) => element("li", {}, element("strong", {}, step.what),
      element("div", {}, "Costs " + step.cost + "."), element("div", {}, "Leaves " + step.leaves + ".")))));
}

// One answer alone stands above, with its ranges.
function branches(h) {
  if (h.branches.length < 2) return null;
  return element("div", {class: "card", id: "branches"}, element("h3", {}, "The separate answers"),
    table("The separate answers", [{title: "", text: true}, ...h.branches.map((b, i) => ({title: "Answer " + (i + 1),
        unit: percent(b.share) + " of the region"}))],
      D.parameters.map((p, k) => [p.symbol + (p.unit ? " (" + p.unit + ")" : ""), ...h.branches.map((b) =>
        element("span", {}, format(b.values[k]), element("br"), element("small", {},
          format(b.low[k]) + " to " + format(b.high[k]))))])));
}

// What a reader who knows the method looks for.
function facts(h) {
  const o = D.campaign.objective, list = [];
  if (h.predicted !== null) {
    list.push(fact("Predicted " + h.objective_title, formatUnit(h.predicted, h.objective_unit) +
      (h.predicted_sd ? " ± " + format(h.predicted_sd, 2) : ""),
      "of the mean heap, by the model that answers"));
  }
  if (h.noise_sd !== null) {
    list.push(fact("Scatter of one simulation", formatUnit(h.noise_sd, h.objective_unit),
      "standard deviation between seeds"));
  }
  if (o.is_sad && o.noise_floor === null) {
    list.push(fact("Noise floor of the experiment", "unknown", "needs more than one run of photographs"));
  }
  if (h.region_volume !== null) {
    list.push(fact("Joint 90\u00a0% region", percent(h.region_volume),
      "of the searched volume"));
  }
  if (!list.length && !h.model) return null;
  return element("div", {class: "card"}, element("h3", {}, "Of the model"), element("dl", {class: "facts first"}, list),
    h.model ? element("p", {class: "note"}, h.model) : null);
}

// "0.12", of a logarithmic range "a factor of 3".
const widthText = (p, w) => p.log ? "a factor of " + format((p.high / p.low) ** w, 2)
  : formatUnit(w * (p.high - p.low), p.unit, 2);

// What a test would show of the two sets that it tells apart best: their heaps and what differs, and their numbers.
function toldApart(c) {
  return element("figure", {class: "card"}, element("h3", {}, c.name),
    c.uri ? element("img", {src: c.uri, alt: "Two simulated heaps that fit equally and that " + c.name +
      " tells apart, and their difference", width: c.picture_width, height: c.picture_height}) : null,
    c.apart_by.length ? table("Numbers of " + c.name, [{title: "", text: true}, {title: "first"}, {title: "second"}],
      c.apart_by.map((n) => [n.title, ...n.values.map((x) => formatUnit(x, n.unit))])) : null,
    element("figcaption", {}, "Both fit so far: first " + setText(c.apart[0]) + ", second " + setText(c.apart[1]) +
      ". This is how they come out of it" + (c.uri ? "; look where the difference has colour." : ".")));
}

// What `talus next` has found: every candidate, and what the best ones would show.
function nextTable() {
  if (!D.next) return [];
  const cost = (c) => c.simulations ? counted(c.simulations, "simulation") + ", " + duration(c.core_time) : c.bits === null ? "–" : "no simulation";
  // What is not known: "?" where simulations would tell, "–" where none will; the candidate's own words say why.
  const known = (c, x, text) => x !== null ? text(x) : c.needs_simulations ? "?" : "–";
  const command = "talus next " + D.campaign.folder + D.next.asked;
  const goal = D.next.goal;
  const telling = D.next.candidates.filter((c) => c.apart.length && (c.uri || c.apart_by.length));
  return [element("div", {class: "card", id: "next-table"}, element("h3", {}, "What each next step is expected to teach"),
    D.next.outdated ? element("p", {class: "note"}, "Trials have ended since: run " + command + " again.") : null,
    table("Next steps", [{title: "Candidate", text: true, wide: true}, {title: "Costs", text: true},
        ...(goal ? [{title: goal.title + " of " + goal.process + " known within ±",
                     unit: "now " + formatUnit(goal.half_width, goal.unit, 2)}] : []),
        {title: "Leaves", unit: goal ? "of the goal's width" : "of the ranges' volume"}, {title: "Expected", unit: "bits"},
        ...D.parameters.map((p, k) => ({title: p.symbol + " known within", unit: "now " + widthText(p, D.next.width[k])}))],
      D.next.candidates.map((c) => [c.name + ": " + c.what, cost(c),
        ...(goal ? [known(c, c.goal, (x) => formatUnit(x, goal.unit, 2))] : []),
        known(c, c.remaining, percent), known(c, c.bits, (x) => format(x, 2)),
        ...D.parameters.map((p, k) => known(c, c.bits, () => widthText(p, c.width[k])))])),
    element("p", {class: "note"}, "Made by talus next, before any of it is done. One bit halves the volume of what is " +
      "possible." + (D.next.candidates.some((c) => c.needs_simulations)
        ? " ?: " + command + " --simulate runs the simulations that tell." : ""))),
    telling.length ? element("div", {class: "stacked", id: "told-apart"}, telling.slice(0, 3).map(toldApart))
      : null];
}

// What `talus sensitivity` has found: what the answer would be with each fixed thing at another value.
function sensitivity() {
  const s = D.sensitivity;
  if (!s) return null;
  const cell = (p, a) => !a ? "?" : formatUnit(a.to, p.unit) + " ± " + format(a.error, 1) +
    " (" + format(a.low, 2) + " to " + format(a.high, 2) + ")" + (a.exceeds ? " !" : a.told ? "" : " ?");
  return element("div", {class: "card", id: "sensitivity"}, element("h3", {}, "What the answer owes to what was held fixed"),
    s.outdated ? element("p", {class: "note"}, "Trials have ended since: run talus sensitivity again.") : null,
    element("ul", {class: "plain"}, s.alarms.map((line) => element("li", {}, line + "."))),
    table("Answers with one fixed thing moved", [{title: "Moved", text: true, wide: true},
        ...D.parameters.map((p, k) => ({title: p.symbol, unit: "now " + formatUnit(D.headline.values[k].value, p.unit)}))],
      s.moves.map((m) => [m.name + " " + m.to + " in place of " + m.from + (m.why_not ? ": not known, " + m.why_not : "") +
          (m.fits_no_set ? ": no set fits with it" : "") + (m.moves_still ? ": not settled" : ""),
        ...D.parameters.map((p, k) => cell(p, m.answer[k]))])),
    element("p", {class: "note"}, "Simulated at scale factor " + s.scale_factor + ", with the standard error of that, and the 90 % range " +
      "that would be left. !: beyond half of the stated range. ?: not told from the noise. Not settled: where it was simulated " +
      "last, the answer moves on."));
}

// Heaps of sets that fit equally, side by side; of one set alone, its heap.
function representativeHeaps(h) {
  const o = D.campaign.objective;
  if (!h.representatives.some((set) => set.uri)) return null;
  const others = h.representatives.filter((set) => !set.recommended);
  return element("div", {class: "grid three stacked", id: idOf("representatives")}, h.representatives.map((set) =>
    set.uri ? element("figure", {class: "card"},
      element("h3", {}, (D.campaign.num_experiments > 1 ? D.campaign.experiment + ": " : "") + (set.recommended ? "Recommended: " : "Set " + (others.indexOf(set) + 1) + ": ") +
        setText(set.values)),
      element("img", {src: set.uri, alt: "Simulated heap of trial " + set.trial, width: set.width, height: set.height}),
      element("figcaption", {}, "Trial " + set.trial + (D.campaign.num_experiments > 1 ? " of " + D.campaign.experiment : "") +
        (set.distance > .01 ? ", the nearest simulated, at " + setText(set.trial_values) : "") +
        ": " + o.value_title + " " + formatUnit(set.trial_objective, o.unit) + (set.expected === null ? "" :
          "; expected of the mean heap " + formatUnit(set.expected, o.unit) +
          (set.expected_sd === null ? "" : " ± " + format(set.expected_sd, 2))) + ".")) : null));
}

// With the figure of its region and the heaps of sets that fit equally.
function answerSection() {
  const h = D.headline;
  if (!h) return [notYet(), alarms(), ...soFar()];
  const region = D.pairs.length ? card(pairChart(D.pairs[D.closest_pair], 0, "region", "")) : null;
  const values = element("div", {class: "card"},
    element("div", {class: "answer"}, D.parameters.map((p, k) => valueTile(p, h.values[k]))));
  const next = nextSteps(h), shown = views.map((view) => within(view, () => representativeHeaps(view.headline))).filter(Boolean);
  const heaps = shown.length > 1 ? [element("div", {class: "grid two"}, shown)] : shown;
  const oneHeap = h.representatives.filter((set) => set.uri).length === 1;
  const said = verdict(h), seen = heapPairs();
  const isWide = D.parameters.length > 2;  // half the page would cut the last columns
  return [said && seen ? element("div", {class: "grid first-screen"}, said, seen) : said || seen, alarms(),
    predictionLines(),
    element("div", {class: "grid two"}, element("div", {}, values, region || fitList(h), isWide ? null : widths(h), oneHeap ? heaps : null),
      element("div", {}, next, region ? fitList(h) : null)),
    isWide ? widths(h) : null,
    branches(h), ...(oneHeap ? [] : heaps), ...nextTable(), sensitivity(), facts(h),
    D.held_out.length ? element("div", {class: "card", id: "held-out"}, element("h3", {}, "Held out"),
      element("ul", {class: "plain"}, D.held_out.map((line) => element("li", {}, line)))) : null,
    D.conditions.length ? element("div", {class: "card"}, element("h3", {}, "It holds for"),
      element("ul", {class: "plain"}, D.conditions.map((c) => element("li", {}, c)))) : null];
}
