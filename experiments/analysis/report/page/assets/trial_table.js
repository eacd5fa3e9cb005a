// The table of all trials: sorted by any column, filtered by words and by conditions such as
// `sad_mm2<1.2` or `state=failed`, shown a page at a time so that 10 000 trials stay quick.
const rowsPerPage = 50;

function trialColumns() {
  const t = D.trials;
  const column = (key, title, unit, value, text = false) => ({key, title, unit, value, text});
  return [
    column("trial", "Trial", "", (i) => t.id[i]),
    column("state", "State", "", (i) => t.state[i], true),
    column("purpose", "Purpose", "", (i) => t.purpose[i], true),
    ...(scaleFactors.length > 1 ? [column("scale_factor", "Scale factor", "", (i) => t.scale[i])] : []),
    ...D.parameters.map((p, k) => column(p.name, p.symbol, p.unit, (i) => t.values[k][i])),
    ...D.metrics.map((m, k) => ({...column(m.name, m.title, m.unit, (i) => t.metrics[k][i]),
                                 more: /_(left|right)_deg$|_px$|relative|triangle|cohesive/.test(m.name)})),
    column("time_s", "Time", "s", (i) => t.seconds[i]),
    column("reason", "Reason", "", (i) => t.reason[i], true),
  ];
}

// One word of the filter as a test of a row; a condition names a column.
function condition(word, columns) {
  const parts = /^([^<>=]+)(<=|>=|<|>|=)(.+)$/.exec(word);
  const named = parts && columns.find((c) => c.key.toLowerCase() === parts[1] ||
      c.title.toLowerCase() === parts[1]);
  if (!named) {
    return (i) => columns.some((c) => c.text && String(c.value(i)).toLowerCase().includes(word));
  }
  const right = parts[3], number = Number(right);
  if (parts[2] === "=") {
    return (i) => named.text ? String(named.value(i)).toLowerCase() === right : named.value(i) === number;
  }
  const compare = {"<": (a) => a < number, ">": (a) => a > number, "<=": (a) => a <= number,
                   ">=": (a) => a >= number}[parts[2]];
  return (i) => named.value(i) !== null && compare(named.value(i));
}

function trialTable() {
  const columns = trialColumns(), t = D.trials;
  let sorted = 0, falling = false, page = 0, rows = t.id.map((_, i) => i);
  const body = element("tbody"), count = element("span", {id: idOf("trial-count"), role: "status"});
  const heads = columns.map((c, k) => element("th",
      {class: [c.text ? "text" : "", c.more ? "more" : ""].join(" ").trim() || undefined,
       scope: "col", "data-key": c.key, onclick: () => sortBy(k)},
      element("button", {type: "button"}, c.title, ...(c.unit ? [element("br"), element("small", {}, c.unit)] : []))));
  const back = element("button", {onclick: () => { --page; show(); }}, "Previous");
  const next = element("button", {onclick: () => { ++page; show(); }}, "Next");
  const filter = element("input", {type: "search", id: idOf("trial-filter"), size: 34,
    placeholder: "words or conditions: state=ok " + (D.metrics[0] ? D.metrics[0].name + "<1" : ""),
    "aria-label": "Filter the trials", oninput: () => { page = 0; arrange(); }});

  function sortBy(k) {
    falling = sorted === k && !falling;
    sorted = k;
    page = 0;
    arrange();
  }
  function arrange() {
    const tests = filter.value.toLowerCase().split(/\s+/).filter(Boolean)
        .map((word) => condition(word, columns));
    const value = columns[sorted].value;
    const order = (a, b) => typeof a === "string" ? a.localeCompare(b) : a - b;
    rows = t.id.map((_, i) => i).filter((i) => tests.every((test) => test(i)));
    rows.sort((i, j) => {  // what has no value comes last, whichever way
      const a = value(i), b = value(j);
      if (a === null || b === null) return (a === null) - (b === null) || i - j;
      return (falling ? -1 : 1) * order(a, b) || i - j;
    });
    heads.forEach((head, k) => head.setAttribute("aria-sort",
        k !== sorted ? "none" : falling ? "descending" : "ascending"));
    show();
  }
  function show() {
    const from = page * rowsPerPage, part = rows.slice(from, from + rowsPerPage);
    body.replaceChildren(...part.map((i) => element("tr",
        {class: t.state[i] === "failed" ? "failed" : undefined}, columns.map((c) =>
        element("td", {class: c.text ? "text" : c.more ? "more" : undefined},
            c.text || c.key === "trial" ? c.value(i) : c.key === "scale_factor" ? tick(c.value(i)) : format(c.value(i), 4))))));
    count.textContent = rows.length === 0 ? "no trial fits" :
      (from + 1) + " to " + (from + part.length) + " of " + rows.length + " trials";
    back.disabled = page === 0;
    next.disabled = from + rowsPerPage >= rows.length;
  }
  const grid = element("table", {id: idOf("trials"), class: "trials", "aria-label": "Trials"}, element("thead", {}, element("tr", {}, heads)), body);
  arrange();
  return element("div", {}, element("div", {class: "row"}, filter, count, back, next,
      element("label", {}, element("input", {type: "checkbox",
          onchange: (e) => grid.classList.toggle("all", e.target.checked)}), "all measures")),
      element("div", {class: "scroll"}, grid));
}
