const comparison = JSON.parse(byId("comparison").textContent), changes = comparison.changes;
document.title = "Validation compared";
const verdicts = ["worse", "better", "changed", "same", "new", "gone", "not comparable"];
const verdictMeaning = { worse: "more unexplained or missed pixels, fewer equal ones, a new finding, or not drawn any more", better: "the opposite in one of these and worse in none", changed: "other counts or errors, neither better nor worse", same: "the same counts and errors", new: "not in the baseline", gone: "only in the baseline", "not comparable": "another image size or another scene of that name" };
const tone = (verdict) => "is-" + verdict.replace(" ", "-");
const of = (verdict) => changes.filter((c) => c.verdict == verdict);
const unexplained = (r) => r && !r.failure ? r.pixels.unexplained : undefined;
const arrow = (a, b) => { const s = element("span", undefined, { class: "whole" }); s.append(element("span", a, { class: "dim" }), " → ", element("b", b)); return s; };
const cellOf = (content, attributes = {}) => { const c = element("td", undefined, attributes); c.append(content); return c; };

const kinds = (r) => r && !r.failure ? r.findings : [];
const lacking = (from, other) => kinds(from).filter((f) => !kinds(other).some((g) => g.kind == f.kind));
const newFindings = (c) => lacking(c.after, c.before), goneFindings = (c) => lacking(c.before, c.after);
const foundIn = (c) => [...newFindings(c).map((f) => "new: " + f.text), ...goneFindings(c).map((f) => "gone: " + f.text)];

/// A figure in both runs: once where it is the same, else with an arrow, coloured where more of it is bad or good.
function figureCell(before, after, wish) {
  if (before === after) return element("td", after, { class: "dim" });
  const better = wish && (after > before) == (wish == "more");
  return cellOf(arrow(before, after), { class: wish ? better ? "good" : "fault" : "moved" });
}
/// A cell of the overview.
function summaryOf(c) {
  const a = unexplained(c.before), b = unexplained(c.after);
  if (c.verdict == "new") return b === undefined ? "new: not drawn" : "new: " + b;
  if (c.verdict == "gone") return "gone";
  if (c.verdict == "not comparable") return "?";
  if (a === undefined || b === undefined) return a === b ? "not drawn" : (a ?? "not drawn") + " → " + (b ?? "not drawn");
  return a != b ? a + " → " + b : c.verdict == "same" ? "=" : c.verdict;
}
function overview() {
  const sceneNames = [...new Set(changes.map((c) => c.scene))], labels = [...new Set(changes.map(label))];
  const matrix = byId("matrix"), head = row(matrix, ["scene"], "th");
  for (const l of labels) head.append(element("th", l, { class: "turned" }));
  for (const s of sceneNames) {
    const line = row(matrix, [element("th", s)]);
    for (const l of labels) {
      const k = changes.findIndex((c) => c.scene == s && label(c) == l), cell = element("td"); line.append(cell);
      if (k < 0) continue;
      cell.className = tone(changes[k].verdict);
      const button = element("button", summaryOf(changes[k]), { type: "button", title: s + ", " + l + ": " + changes[k].verdict });
      button.addEventListener("click", () => point(k)); cell.append(button);
    }
  }
}
/// Leads from the overview to a row that tells more, if there is one.
function point(k) {
  for (const r of document.querySelectorAll("tr.pointed")) r.classList.remove("pointed");
  const line = byId("change-" + k);
  if (line) { line.classList.add("pointed"); line.scrollIntoView({ block: "center" }); }
}
function details() {
  const shown = verdicts.filter((v) => !["same", "new", "gone"].includes(v)).flatMap((v) => changes.map((c, k) => [c, k]).filter(([c]) => c.verdict == v));
  byId("unchanged").textContent = of("same").length + " of " + changes.length + " results have the same counts and errors as before.";
  if (!shown.length) return;
  const both = (c) => c.verdict != "not comparable" && !c.before.failure && !c.after.failure;
  const moved = classNames.filter((name) => shown.some(([c]) => both(c) && c.before.pixels[name] != c.after.pixels[name]));
  const table = byId("changed"), wishes = { equal: "more", "missed surface": "fewer", unexplained: "fewer" };
  row(table, ["scene", element("th", "renderer", { class: "text" }), element("th", "", { class: "text" }), ...moved, "median error", "greatest error", element("th", "found", { class: "text" })], "th");
  for (const [c, k] of shown) {
    const found = element("td", undefined, { class: "text found" });
    for (const text of [c.obstacle, ...(both(c) ? foundIn(c) : [...c.worse, ...c.better])]) if (text) found.append(element("div", text));
    const figures = both(c) ? [...moved.map((name) => figureCell(c.before.pixels[name], c.after.pixels[name], wishes[name])), figureCell(short(c.before.median_error, 2), short(c.after.median_error, 2)), figureCell(short(c.before.greatest_error, 2), short(c.after.greatest_error, 2))] : [element("td", "", { colspan: moved.length + 2 })];
    row(table, [c.scene, element("td", label(c), { class: "text whole" }), element("td", c.verdict, { class: "text " + tone(c.verdict) }), ...figures, found]).id = "change-" + k;
  }
}
function findings() {
  const place = byId("findings");
  for (const [heading, list, style] of [["New", newFindings, "finding"], ["Gone", goneFindings, "finding no-more"]])
    for (const c of changes) for (const f of list(c)) place.append(element("div", heading + " – " + c.scene + ", " + label(c) + ": " + f.text + " (" + f.pixels + " pixels)", { class: style }));
  if (!place.childNodes.length) place.append(element("p", "The same as in the baseline.", { class: "dim" }));
}
function newAndGone() {
  const table = byId("others"), shown = [...of("new"), ...of("gone")];
  if (!shown.length) { table.replaceWith(element("p", "Both runs have the same scenes, renderers and variants.", { class: "dim" })); return; }
  row(table, ["scene", element("th", "renderer", { class: "text" }), element("th", "", { class: "text" }), "equal", "unexplained", element("th", "findings", { class: "text" })], "th");
  for (const c of shown) {
    const r = c.after ?? c.before;
    row(table, [c.scene, element("td", label(c), { class: "text whole" }), element("td", c.verdict, { class: "text " + tone(c.verdict) }), ...(r.failure ? ["–", "–"] : [r.pixels.equal, r.pixels.unexplained]), element("td", r.failure || r.findings.map((f) => f.text).join("; ") || "–", { class: "text" })]);
  }
}
function versions() {
  const pairs = new Map();
  for (const c of changes) if (c.before && c.after) pairs.set(JSON.stringify([label(c), c.before.version, c.after.version]), [label(c), c.before.version, c.after.version]);
  const all = [...pairs.values()], other = all.filter(([, a, b]) => a != b), table = byId("versions");
  byId("kept").textContent = other.length ? all.length - other.length + " others are the same." : "All " + all.length + " are the same.";
  if (!other.length) return;
  row(table, ["renderer", element("th", "baseline", { class: "text" }), element("th", "this run", { class: "text" })], "th");
  for (const [l, a, b] of other) row(table, [l, element("td", a || "–", { class: "text" }), element("td", b || "–", { class: "text moved" })]);
}
byId("verdict").textContent = (of("worse").length ? of("worse").length + (of("worse").length == 1 ? " result is worse" : " results are worse") : "Nothing is worse") + " than in the baseline. Fathom " + (comparison.fathom.before == comparison.fathom.after ? comparison.fathom.after + " in both" : comparison.fathom.before + " → " + comparison.fathom.after) + ".";
for (const v of verdicts) if (of(v).length) byId("counts").append(element("span", of(v).length + " " + v, { class: "chip " + tone(v), title: verdictMeaning[v] }));
overview(); details(); findings(); newAndGone(); versions();
