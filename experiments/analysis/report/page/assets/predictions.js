// What `talus predict` has found: a line each on the first screen, and a section with all of it.
const predictedRange = (n) => formatUnit(n.mean, n.unit) + (n.low === null
  ? ", of one run" : ", 90\u00a0% of runs in " + format(n.low) + " to " +
  formatUnit(n.high, n.unit)) + (n.silent ? ", " + n.silent : "");

const shareText = (n) => n.parameters_share === null ? "" : "; " + percent(n.parameters_share) +
  " of the variance from the parameters";

const measuredThere = (n) => n.measured === null ? "–" : formatUnit(n.measured.value, n.unit) + " ± " +
  format(n.measured.error, 2) + ": " + (n.low === null ? "one run does not tell" : n.measured.inside ? "inside" : n.measured.another_inside
    ? "outside, yet a draw gives it" : n.measured.another_is_told ? "outside, and no draw gives it" : "outside; one run of a draw does not tell whether it gives it");

// By what a number is told, with what either misses of draws that were left out.
const toldBy = (n) => n.surrogate === null ? "draws" : (n.surrogate.used ? "surrogate, scale factor " +
  format(n.surrogate.scale_factor) : "draws") + " (" + formatUnit(n.surrogate.left_out, n.unit, 2) + " and " +
  formatUnit(n.surrogate.draws, n.unit, 2) + ")";

const titleOf = (n) => n.title + (n.silent ? " (" + n.silent + ")" : "");

// The numbers that the test is made for.
function predictionLine(p) {
  const known = p.numbers.filter((n) => n.mean !== null), usual = known.filter((n) => n.usual);
  return element("li", {}, element("strong", {}, p.name), ": ", (usual.length ? usual : known.slice(0, 1)).map((n) =>
    n.title + " " + predictedRange(n) + shareText(n) + (n.measured === null ? "" : "; measured " + measuredThere(n)))
    .join("; "), p.ended < p.runs ? " (" + p.ended + " of " + p.runs + " runs)" : "", p.outdated ? "; by an earlier state of the campaign: predict again" : "");
}

function predictionLines() {
  return D.predictions.length ? element("div", {class: "card", id: "predicted"},
    element("h3", {}, "What the calibrated set predicts"),
    element("ul", {class: "plain"}, D.predictions.map(predictionLine))) : null;
}

function predictionCard(p) {
  const by = {posterior: p.draws + " draws of the posterior", recommended: "the recommended set", set: "one set"}[p.by];
  const picture = (uri, size, alt, caption) => uri ? element("figure", {class: "card"},
    element("img", {src: uri, alt, width: size[0], height: size[1]}), element("figcaption", {}, caption)) : null;
  const pictures = [picture(p.mean, p.mean_size, "Mean predicted silhouette of " + p.name,
      "Mean silhouette: 95\u00a0% of single runs fill the red outline, 5\u00a0% the blue one."),
    picture(p.different, p.different_size, "The two most different draws of " + p.name, p.different_sets.length === 2
      ? "The two draws that differ most: left " + setText(p.different_sets[0]) + ", right " + setText(p.different_sets[1]) +
        "." : "")].filter(Boolean);
  return element("div", {class: "card"}, element("h3", {}, p.name + " (" + p.test + ")"),
    element("p", {class: "note"}, "By " + by + ", " + (p.test === "scene" ? "" : "scale factor " + format(p.scale_factor) + ", ") +
      p.ended + " of " + p.runs + " runs." + (p.outdated ? " Trials of the campaign have ended since: predict again." : "")),
    p.notes.length ? element("ul", {class: "plain"}, p.notes.map((note) => element("li", {}, note))) : null,
    table("Prediction of " + p.name, [{title: "Number", text: true}, {title: "Mean"}, {title: "90\u00a0% of runs"},
        {title: "Parameters, sd"}, {title: "Single run, sd"}, {title: "Parameters' share of the variance"},
        {title: "Told by", text: true}, {title: "Measured", text: true}],
      p.numbers.map((n) => n.mean === null ? [titleOf(n), "–", "–", "–", "–", "–", "–", "–"] : [titleOf(n), formatUnit(n.mean, n.unit),
        n.low === null ? "–" : format(n.low) + " to " + formatUnit(n.high, n.unit), formatUnit(n.parameters_sd, n.unit, 2),
        formatUnit(n.run_sd, n.unit, 2), percent(n.parameters_share), toldBy(n), measuredThere(n)])),
    pictures.length ? element("div", {class: "grid two"}, pictures) : null);
}

const predictionSection = () => D.predictions.map(predictionCard);
