// Puts the page together.
function section(id, title, lead, parts) {
  const shown = parts.filter(Boolean);
  if (!shown.length) return;
  document.getElementById("nav").append(element("a", {href: "#" + id}, title));
  document.getElementById("main").append(element("section", {id, "aria-labelledby": id + "-title"},
    element("h2", {id: id + "-title"}, title), lead ? element("p", {class: "lead"}, lead) : null, shown));
}
// What each experiment's own part shows, side by side.
function eachExperiment(make) {
  if (views.length === 1) return make();
  const columns = views.map((view) => within(view, () => [view, make().filter(Boolean)])).filter(([, parts]) => parts.length);
  return columns.length ? [element("div", {class: "grid two experiments"}, columns.map(([view, parts]) =>
    element("div", {}, element("h3", {}, view.campaign.experiment), parts)))] : [];
}
const card = (figure) => figure && element("div", {class: "card"}, figure);

const modelLead = () => "All from the model that gives the answer: the posterior of the parameters, given every " +
  "simulation and what was measured. " +
  (D.slices.length ? "The slices show the expected " + inWords(D.campaign.objective) + " through the " +
    (D.headline ? "recommended set" : "best set so far") +
    ", with 90\u00a0% bands." : "");

function modelSection() {
  if (!D.model) {
    return D.model_absent ? [element("div", {class: "notice"}, element("p", {}, 
      D.model_absent.startsWith("no model") ? capital(D.model_absent) : "No model: " + D.model_absent))] : [];
  }
  const grid = (charts) => charts.length ? element("div", {class: "grid three stacked"}, charts) : null;
  return [grid([...D.marginals.map((m, k) => card(marginalChart(m, k))), ...D.pairs.map((p, k) => card(pairChart(p, k)))]),
    grid(D.slices.map((s, k) => card(sliceChart(s, k)))),
    ...sensitivityTable()];
}

function profileParts() {
  return [D.overlay ? overlayFigure()
      : D.overlay_absent ? element("div", {class: "notice"}, "No photographs to lay the heap over: " + D.overlay_absent) : null,
    D.film ? filmFigure() : null,
    D.outlines.length ? card(outlineChart()) : null, D.pictures.length ? pictures() : null];
}

function build() {
  const any = (some) => views.some((view) => within(view, some));
  const known = any(() => doneTrials().length > 0 && D.objectives.some((objective) => !objective.absent));
  const tried = any(() => D.trials.id.length > 0), has_image = any(() => D.campaign.has_image);
  document.getElementById("name").textContent = D.campaign.name;
  document.getElementById("standing").append(element("span", {}, ...standing()));
  section("answer", "Answer", "", [...answerSection(), leftOut()]);
  section("predictions", "Predictions", "What the calibrated sets give in other tests or processes, simulated by talus " +
    "predict: the range of a single run, and where its uncertainty comes from.", predictionSection());
  section("convergence-section", "Convergence", "", known ? eachExperiment(() => [card(convergenceChart())]) : []);
  section("space-section", "Parameter space", "", known ? eachExperiment(() => [card(spaceChart())]) : []);
  section("model", "Model", D.model ? modelLead() : "", modelSection());
  if (has_image) section("profiles", "Profiles", "The average profile of the experiment (AEHP) and the average profiles of " +
    "the best simulations (ANHP). In a signed map, blue is where the simulation has too little powder, red " +
    "where it has too much.", eachExperiment(profileParts));
  section("measures", has_image ? "Angles and measures" : "Measures", "", eachExperiment(() => [measuresTable()]));
  section("compare", "Objectives", "", D.objectives.length ? eachExperiment(comparisonSection) : []);
  section("trials-section", "Trials", "", tried ? eachExperiment(() => [card(trialTable())]) : []);
  section("failures", "Failures", "", tried ? eachExperiment(failuresSection) : []);
  section("time", "Time", "", tried ? [...eachExperiment(() => [card(timeChart())]), ...stagesTable()] : []);
  section("methods", "For a methods section", "Written from this campaign's journal; check it before you use it.",
    [element("div", {class: "card"}, element("p", {id: "methods-text"}, D.methods))]);
  section("spec", "Spec and versions", "", [
    element("div", {class: "card"}, table("Versions",
      [{title: "What", text: true}, {title: "Version", text: true}],
      D.versions.map((v) => [v.name, v.version]))),
    element("div", {class: "card"}, element("h3", {}, "The spec as it was given"), element("pre", {}, D.spec))]);
  if (D.headline) document.getElementById("footer").append("On one sheet of paper: ", element("a", {href: "summary.html"}, "summary.html"),
    " beside this page. ");
  document.getElementById("footer").append(
    "Charts by Apache ECharts " + echarts.version + " (Apache-2.0) and ECharts-GL (BSD-3-Clause), both in this " +
    "page: it needs no network.");
}
build();
