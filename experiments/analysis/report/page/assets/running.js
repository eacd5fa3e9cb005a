// The first section while the campaign runs: where it stands, and how far it has come.
function notYet() {
  const o = D.campaign.objective, {searched, reused, confirming, failed} = D.campaign.counts;
  if (D.campaign.state !== "running" && failed > 0 && searched + reused + confirming === 0) {
    return element("div", {class: "notice"}, "No trial succeeded: " + failed + " failed (see ",
      element("a", {href: "#failures"}, "Failures"), ").");
  }
  return element("div", {class: "card"}, element("p", {}, "The campaign has not concluded yet. " +
    (D.model ? "So far its model recommends " +
      D.parameters.map((p, k) => p.symbol + " = " + formatUnit(D.model.values[k], p.unit)).join(", ") +
      (D.model.expected === null ? "" : " and expects a " + inWords(o) + " of " + formatUnit(D.model.expected, o.unit) +
        (D.model.expected_sd === null ? "" : " ± " + format(D.model.expected_sd, 2)) + " there") + "."
      : "There are too few trials to say anything about the best set.")));
}

// The best trial at the finest scale factor, of the experiment that is shown; nothing before there is one.
function bestSoFar() {
  const o = D.campaign.objective, t = D.trials;
  const {trials, value} = valuesOf(o);
  const usable = trials.filter((i) => isOfSearch(i) && t.scale[i] === D.campaign.scale_factor);
  if (!usable.length) return null;
  const i = usable.reduce((a, b) => value(b) < value(a) ? b : a);
  const which = (D.campaign.num_experiments > 1 ? " of " + D.campaign.experiment : "") +
    (o.is_distance ? ": " + o.value_title : "");
  return fact("Best so far" + which, formatUnit(value(i), o.unit), "trial " + t.id[i] + ": " +
    setText(t.values.map((column) => column[i])));
}

// As `talus status` says it; the search may stop before.
function timeLeft() {
  if (D.campaign.state !== "running" || D.campaign.seconds_left === null) return null;
  return fact("Time left", "at most " + duration(D.campaign.seconds_left), "by the budget, with the confirmation");
}

// Where a campaign that runs stands: the best trial, the time left, the region and how it has shrunk.
function soFar() {
  const facts = [bestSoFar(), timeLeft(), D.region_share === null ? null
    : fact("Joint 90\u00a0% region so far", percent(D.region_share), "of the plane of the parameters it ties closest")]
    .filter(Boolean);
  const history = D.region_history;
  const shrinking = history.length < 2 ? null : card(chart("shrinking", "The region as it shrinks",
    "Share of the searched plane inside the joint 90\u00a0% region, since this page is watched.", () => ({
      grid: margins, tooltip: {...tooltipStyle, formatter: (e) =>
        lines(["After trial " + e.data[0] + ": " + percent(e.data[1])])},
      xAxis: valueAxis("trials", {nameGap: 28, min: history[0][0]}), yAxis: valueAxis("share", {min: 0}),
      series: [{type: "line", data: history, lineStyle: {color: palette[0], width: 2}, itemStyle: {color: palette[0]}}],
    }), "small").figure);
  const region = D.model && D.pairs.length ? card(pairChart(D.pairs[D.closest_pair], 0, "region", "")) : null;
  return [facts.length ? element("div", {class: "card", id: "so-far"}, element("dl", {class: "facts"}, facts)) : null,
    region || shrinking ? element("div", {class: "grid two stacked"}, region, shrinking) : null];
}
