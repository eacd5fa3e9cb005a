// Numbers and elements as the page writes them.
const superscripts = {"-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷",
                      8: "⁸", 9: "⁹"};
const superscript = (n) => [...String(n)].map((c) => superscripts[c]).join("");

// `digits` significant ones; a power of ten outside 0.001 … 99 999.
function format(x, digits = 3) {
  if (x === null || x === undefined || !Number.isFinite(x)) return "–";
  if (x === 0) return "0";
  const size = Math.abs(x);
  const minus = (text) => text.replace("-", "−");
  if (size >= 1e-3 && size < 99999.5) {
    const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
    return minus(x.toFixed(Math.min(decimals, 12)));
  }
  const [mantissa, exponent] = x.toExponential(digits - 1).split("e");
  return minus(mantissa) + " × 10" + superscript(Number(exponent));
}
// "1 run", "2 runs".
const counted = (count, noun) => count + " " + noun + (count === 1 ? "" : "s");
// The same as short as can be: "0.2", "10⁻⁵".
function tick(x) {
  if (x === 0) return "0";
  const power = Math.log10(Math.abs(x));
  if (Math.abs(power - Math.round(power)) < 1e-9 && (power < -3 || power > 4)) {
    return (x < 0 ? "−" : "") + "10" + superscript(Math.round(power));
  }
  if (Math.abs(x) >= 1e-3 && Math.abs(x) < 1e5) return String(Number(x.toPrecision(4))).replace("-", "−");
  return format(x, 3).replace(/\.?0+ ×/, " ×");
}
const formatUnit = (x, unit, digits) =>
    unit === "°" ? format(x, digits) + "°" : format(x, digits) + (unit ? " " + unit : "");
const percent = (x) => (x === null || x === undefined) ? "–"
    : x > 0 && x < 0.001 ? "< 0.1 %" : format(100 * x, x < 0.1 ? 2 : 3) + " %";

const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

function duration(seconds) {
  if (seconds === null || !Number.isFinite(seconds)) return "–";
  if (seconds < 120) return format(seconds, 3) + " s";
  if (seconds < 7200) return format(seconds / 60, 3) + " min";
  return format(seconds / 3600, 3) + " h";
}

// What stands in backticks, as the terminal has it, is a command.
const withCode = (text) => text.split("`").map((part, i) => i % 2 ? element("code", {}, part) : part);

// element("p", {class: "note"}, "text", child …): text is never taken for markup.
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value !== undefined && value !== false) made.setAttribute(name, value);
  }
  made.append(...children.flat().filter((c) => c !== null && c !== undefined));
  return made;
}

// A table; name: what a screen reader calls it; columns: {title, unit, text: left-aligned}.
function table(name, columns, rows) {
  const heads = columns.map((c) => element("th",
      {class: c.text ? "text" : c.profile ? "profile" : undefined, scope: "col"},
      c.title, ...(c.unit ? [element("br"), element("small", {}, c.unit)] : [])));
  return element("div", {class: "scroll"}, element("table", {"aria-label": name},
      element("thead", {}, element("tr", {}, heads)),
      element("tbody", {}, rows.map((row) => element("tr", {}, row.map((cell, i) =>
          element("td", {class: columns[i].wide ? "text wide" : columns[i].text ? "text" : undefined},
              cell)))))));
}
