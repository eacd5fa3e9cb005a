// A photograph and a simulated heap on top of each other: a slider cuts from one to the other, and both
// outlines are drawn over them.
const svg = (tag, attributes, ...children) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
};

function overlayFigure() {
  const o = D.overlay, width = o.simulated.width, height = o.simulated.height;
  const photograph = element("img", {src: o.photographs[0].uri, alt: "Photograph of the heap", width, height});
  const simulated = element("img", {src: o.simulated.uri, alt: "Simulated heap, " + o.simulated.title, width, height,
    class: "above"});
  const colours = [palette[0], palette[1]];
  const outlines = svg("svg", {viewBox: `0 0 ${width} ${height}`, class: "above", "aria-hidden": "true"},
    ...o.outlines.map((outline, k) => svg("polyline", {fill: "none", stroke: colours[k], "stroke-width": 1.6,
      "stroke-dasharray": k === 0 ? "none" : "5 3", "vector-effect": "non-scaling-stroke",
      points: outline.points.map(([x, z]) => (o.center_x + x / o.pixel_mm).toFixed(2) + "," +
        (o.baseline - z / o.pixel_mm).toFixed(2)).join(" ")})));
  const cut = (share) => { simulated.style.clipPath = `inset(0 0 0 ${share}%)`; };
  cut(50);
  const slider = element("input", {type: "range", min: 0, max: 100, value: 50, id: idOf("overlay-slider"),
    "aria-label": "photograph to the left, simulation to the right of this place",
    oninput: (e) => cut(Number(e.target.value))});
  const chooser = element("select", {id: idOf("overlay-view"), onchange: (e) => {
    photograph.src = o.photographs[Number(e.target.value)].uri; }},
    o.photographs.map((p, k) => element("option", {value: k}, p.title)));
  const legend = o.outlines.map((outline, k) => element("span", {class: "key"},
    element("i", {style: `border-top: 3px ${k ? "dashed" : "solid"} ${colours[k]}`}), outline.title));
  return element("figure", {class: "card", id: idOf("overlay")}, element("h3", {}, "Photograph and simulation, " +
      o.simulated.title),
    element("div", {class: "row"}, element("label", {}, "View", chooser),
      element("label", {class: "grow"}, "Photograph", slider, "simulation"), legend,
      element("label", {}, element("input", {type: "checkbox", checked: "checked", onchange: (e) => {
        outlines.style.display = e.target.checked ? "" : "none"; }}), "outlines")),
    element("div", {class: "layers"}, photograph, simulated, outlines),
    element("figcaption", {}, "One scale. The outlines are those of the average profiles at half intensity, not of the " +
      "single photograph shown."));
}

// The simulated test from its filling on, closed until it is asked for: it moves without end.
function filmFigure() {
  return element("details", {class: "card", id: idOf("film")},
    element("summary", {}, "Film of the simulation, " + D.film.title),
    element("img", {src: D.film.uri, alt: "Film of the simulated test, " + D.film.title}));
}

// The heap as it was photographed beside the recommended one as it was simulated; without photographs the average
// profiles of both. One pair an experiment that has images.
function heapPair() {
  const o = D.overlay;
  const confirming = D.pictures.find((p) => p.title.startsWith("ANHP") && p.title.includes("confirming"));
  const pair = o ? [[o.photographs[0], "Photograph"], [o.simulated, "Simulated, " + o.simulated.title]]
    : confirming ? [[D.pictures[0], "Measured, average profile"], [confirming, "Simulated, average profile"]] : null;
  if (!pair) return null;
  return element("div", {}, views.length > 1 ? element("h3", {}, D.campaign.experiment) : null,
    element("div", {class: "pair"}, pair.map(([picture, title]) => element("figure", {},
      element("img", {src: picture.uri, alt: title, width: picture.width, height: picture.height}),
      element("figcaption", {}, title)))));
}
const heapPairs = () => {
  const pairs = views.map((view) => within(view, heapPair)).filter(Boolean);
  return pairs.length ? element("div", {class: pairs.length > 1 ? "card several" : "card", id: "heap-pair"}, pairs) : null;
};
