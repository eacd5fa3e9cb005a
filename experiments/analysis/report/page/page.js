// Puts the page together from the data that the program wrote into it.
const D = JSON.parse(document.getElementById("data").textContent);

function section(id, title, lead, parts) {
  const shown = parts.filter(Boolean);
  if (!shown.length) return;
  document.getElementById("nav").append(element("a", {href: "#" + id}, title));
  document.getElementById("main").append(element("section", {id, "aria-labelledby": id + "-title"},
    element("h2", {id: id + "-title"}, title), lead ? element("p", {class: "lead"}, lead) : null, shown));
}
const card = (figure) => element("div", {class: "card"}, figure);

// The charts know the trials' numbers; the answer may stand on their images.
const modelNote = () => D.headline && D.headline.model.startsWith("modes")
  ? " This is a model of the numbers alone, drawn because it is quick to ask. The recommended set, its " +
    "ranges and the sensitivities come from a model of the images, which knows more: where the two " +
    "differ, believe that one."
  : "";

function build() {
  const o = D.campaign.objective;
  document.getElementById("name").textContent = D.campaign.name;
  document.getElementById("standing").append(...standing());
  section("answer", "Answer", "", answerSection());
  section("convergence-section", "Convergence", "", doneTrials().length ? [card(convergenceChart())] : []);
  section("space-section", "Parameter space", "", doneTrials().length ? [card(spaceChart())] : []);
  section("model", "Model", "What a Gaussian process of " + o.title + " says between the trials. The slices " +
    "pass through the " + (D.headline ? "recommended set" : "model's best set") + ", with 90\u00a0% bands; the pairs show the " +
    "chance that a set ties with the best, averaged over the other parameters." + modelNote(), D.slices.length ? [
      element("div", {class: "grid three"}, D.slices.map((s, k) => card(sliceChart(s, k)))),
      element("div", {class: "grid three", style: "margin-top:18px"}, D.pairs.map((p, k) => card(pairChart(p, k)))),
      element("div", {style: "margin-top:18px"}, sensitivityTable())] : []);
  section("profiles", "Profiles", "The average profile of the experiment (AEHP) and the average profiles of " +
    "the best simulations (ANHP). In a signed map, blue is where the simulation has too little powder, red " +
    "where it has too much.", [D.outlines.length ? card(outlineChart()) : null,
      D.pictures.length ? pictures() : null]);
  section("measures", "Angles and measures", "", [measuresTable()]);
  section("compare", "Objectives", "", D.objectives.length ? comparisonSection() : []);
  section("trials-section", "Trials", "", D.trials.id.length ? [card(trialTable())] : []);
  section("failures", "Failures", "", D.trials.id.length ? failuresSection() : []);
  section("time", "Time", "", D.trials.id.length ? [card(timeChart()), ...stagesTable()] : []);
  section("methods", "For a methods section", "Written from this campaign's journal; check it before you use it.",
    [element("div", {class: "card"}, element("p", {id: "methods-text"}, D.methods))]);
  section("spec", "Spec and versions", "", [
    element("div", {class: "card"}, table([{title: "What", text: true}, {title: "Version", text: true}],
      D.versions.map((v) => [v.name, v.version]))),
    element("div", {class: "card"}, element("h3", {}, "The spec as it was given"), element("pre", {}, D.spec))]);
  document.getElementById("footer").append(
    "Charts by Apache ECharts " + echarts.version + " (Apache-2.0) and ECharts-GL (BSD-3-Clause), both in this " +
    "page: it needs no network.");
}
build();
