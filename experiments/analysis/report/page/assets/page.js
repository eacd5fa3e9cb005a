// Puts the page together.
function section(id, title, lead, parts) {
  const shown = parts.filter(Boolean);
  if (!shown.length) return;
  document.getElementById("nav").append(element("a", {href: "#" + id}, title));
  document.getElementById("main").append(element("section", {id, "aria-labelledby": id + "-title"},
    element("h2", {id: id + "-title"}, title), lead ? element("p", {class: "lead"}, lead) : null, shown));
}
const card = (figure) => element("div", {class: "card"}, figure);

const modelLead = () => "All from the model that gives the answer: the posterior of the parameters, given every " +
  "simulation and what was measured. " +
  (D.slices.length ? "The slices show the expected " + D.campaign.objective.title + " through the " +
    (D.headline ? "recommended set" : "best set so far") +
    ", with 90\u00a0% bands." : "");

function modelSection() {
  if (!D.model) {
    return D.model_absent ? [element("div", {class: "notice"}, element("p", {}, "No model: " + D.model_absent))] : [];
  }
  const grid = (charts) => charts.length ? element("div", {class: "grid three stacked"}, charts) : null;
  return [grid([...D.marginals.map((m, k) => card(marginalChart(m, k))), ...D.pairs.map((p, k) => card(pairChart(p, k)))]),
    grid(D.slices.map((s, k) => card(sliceChart(s, k)))),
    ...sensitivityTable()];
}

function build() {
  const o = D.campaign.objective, c = D.campaign;
  const known = doneTrials().length > 0 && D.objectives.some((objective) => !objective.absent);
  // What follows the first section is of one experiment.
  const of = c.num_experiments > 1 ? "Of the experiment \u201c" + c.experiment + "\u201d: talus report " + c.folder +
    " --experiment NAME shows another. " : "";
  document.getElementById("name").textContent = D.campaign.name;
  document.getElementById("standing").append(...standing());
  section("answer", "Answer", "", answerSection());
  section("predictions", "Predictions", "What the calibrated sets give in other tests or processes, simulated by talus " +
    "predict: the range of a single run, and where its uncertainty comes from.", predictionSection());
  section("convergence-section", "Convergence", of, known ? [card(convergenceChart())] : []);
  section("space-section", "Parameter space", of, known ? [card(spaceChart())] : []);
  section("model", "Model", D.model ? modelLead() : "", modelSection());
  if (c.has_image) section("profiles", "Profiles", of + "The average profile of the experiment (AEHP) and the average profiles of " +
    "the best simulations (ANHP). In a signed map, blue is where the simulation has too little powder, red " +
    "where it has too much.", [D.overlay ? overlayFigure()
      : D.overlay_absent ? element("div", {class: "notice"}, "No photographs to lay the heap over: " + D.overlay_absent) : null,
      D.outlines.length ? card(outlineChart()) : null,
      D.pictures.length ? pictures() : null]);
  section("measures", c.has_image ? "Angles and measures" : "Measures", of, [measuresTable()]);
  section("compare", "Objectives", of, D.objectives.length ? comparisonSection() : []);
  section("trials-section", "Trials", of, D.trials.id.length ? [card(trialTable())] : []);
  section("failures", "Failures", of, D.trials.id.length ? failuresSection() : []);
  section("time", "Time", of, D.trials.id.length ? [card(timeChart()), ...stagesTable()] : []);
  section("methods", "For a methods section", "Written from this campaign's journal; check it before you use it.",
    [element("div", {class: "card"}, element("p", {id: "methods-text"}, D.methods))]);
  section("spec", "Spec and versions", "", [
    element("div", {class: "card"}, table("Versions",
      [{title: "What", text: true}, {title: "Version", text: true}],
      D.versions.map((v) => [v.name, v.version]))),
    element("div", {class: "card"}, element("h3", {}, "The spec as it was given"), element("pre", {}, D.spec))]);
  document.getElementById("footer").append(
    "Charts by Apache ECharts " + echarts.version + " (Apache-2.0) and ECharts-GL (BSD-3-Clause), both in this " +
    "page: it needs no network.");
}
build();
