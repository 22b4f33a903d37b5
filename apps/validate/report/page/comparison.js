const comparison = JSON.parse(byId("comparison").textContent), changes = comparison.changes;
document.title = "Validation compared";
const verdicts = ["worse", "better", "changed", "same", "new", "gone", "not comparable"];
Object.assign(meanings, { worse: "more unexplained or missed pixels, fewer equal ones, a new finding, or not drawn any more", better: "the opposite in one of these and worse in none", changed: "other counts or errors, neither better nor worse", same: "the same counts and errors", new: "not in the baseline", gone: "only in the baseline", "not comparable": "another image size or another scene of that name" });
const tone = (verdict) => "is-" + verdict.replace(" ", "-");
const of = (verdict) => changes.filter((c) => c.verdict == verdict);
const unexplained = (r) => r && !r.failure ? r.pixels.unexplained : undefined;
const arrow = (a, b) => { const s = element("span", undefined, { class: "whole" }); s.append(element("span", a, { class: "dim" }), " → ", element("b", b)); return s; };
const cellWith = (content, attributes = {}) => { const c = element("td", undefined, attributes); c.append(content); return c; };

const kinds = (r) => r && !r.failure ? r.findings : [];
const lacking = (from, other) => kinds(from).filter((f) => !kinds(other).some((g) => g.kind == f.kind));
const newFindings = (c) => lacking(c.after, c.before), goneFindings = (c) => lacking(c.before, c.after);
const foundIn = (c) => [...newFindings(c).map((f) => "new: " + f.text), ...goneFindings(c).map((f) => "gone: " + f.text)];

/// A figure in both runs: once where it is the same, else with an arrow, coloured where more of it is bad or good.
function figureCell(before, after, wish) {
  if (before === after) return element("td", after, { class: "dim" });
  const better = wish && (after > before) == (wish == "more");
  return cellWith(arrow(before, after), { class: wish ? better ? "good" : "fault" : "moved" });
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
/// Of what became of results, all but what stayed the same is counted.
const sums = verdicts.filter((v) => v != "same" && of(v).length).map((v) => ({ name: v, word: v, of: (c) => c.verdict == v ? 1 : 0, tone: tone(v) }));
const overview = (shown) => overviewTable(byId("matrix"), changes, { sums, shown, leads: (k) => changes[k].verdict != "same", choose: point, about: "What changed, for each renderer and variant on each scene",
  cellOf: (k) => ({ text: summaryOf(changes[k]), tone: tone(changes[k].verdict), says: changes[k].verdict }) });
/// Leads from the overview to the row that tells more.
function point(k) {
  for (const r of document.querySelectorAll("tr.pointed")) r.classList.remove("pointed");
  const line = byId("change-" + k);
  line.classList.add("pointed");
  line.scrollIntoView({ block: "center" });
}
const namesOf = (c) => [heading(c.scene, { scope: "row" }), element("td", label(c), { class: "text whole" }), element("td", c.verdict, { class: "text whole " + tone(c.verdict) })];
function details() {
  const shown = verdicts.filter((v) => !["same", "new", "gone"].includes(v)).flatMap((v) => changes.map((c, k) => [c, k]).filter(([c]) => c.verdict == v));
  byId("unchanged").textContent = of("same").length + " of " + counted(changes.length, "result") + (of("same").length == 1 ? " has" : " have") + " the same counts and errors as before.";
  byId("changed").closest(".wide").hidden = !shown.length;
  if (!shown.length) return;
  const both = (c) => c.verdict != "not comparable" && !c.before.failure && !c.after.failure;
  const moved = classNames.filter((name) => shown.some(([c]) => both(c) && c.before.pixels[name] != c.after.pixels[name]));
  const table = byId("changed"), wishes = { equal: "more", "missed surface": "fewer", unexplained: "fewer" };
  row(table.createTHead(), [heading("scene", { class: "corner" }), heading("renderer", { class: "text" }), heading("change", { class: "text" }), ...moved.map((name) => heading(term(name))), heading("median error"), heading("greatest error"), heading("found", { class: "text" })]);
  const body = table.createTBody();
  for (const [c, k] of shown) {
    const found = element("td", undefined, { class: "text found" });
    for (const text of [c.obstacle, ...(both(c) ? foundIn(c) : [...c.worse, ...c.better])]) if (text) found.append(element("div", text));
    const figures = both(c) ? [...moved.map((name) => figureCell(c.before.pixels[name], c.after.pixels[name], wishes[name])), figureCell(short(c.before.median_error, 2), short(c.after.median_error, 2)), figureCell(short(c.before.greatest_error, 2), short(c.after.greatest_error, 2))] : [element("td", "", { colspan: moved.length + 2 })];
    row(body, [...namesOf(c), ...figures, found]).id = "change-" + k;
  }
}
function findings() {
  const place = byId("findings");
  for (const [what, list, style] of [["New", newFindings, "finding"], ["Gone", goneFindings, "finding no-more"]])
    changes.forEach((c, k) => { for (const f of list(c)) place.append(element("div", what + " – " + c.scene + ", " + label(c) + ": " + findingText(f), { class: style, "data-change": k })); });
  if (!place.childNodes.length) place.append(element("p", "The same as in the baseline.", { class: "dim" }));
}
function newAndGone() {
  const table = byId("others"), shown = ["new", "gone"].flatMap((v) => changes.map((c, k) => [c, k]).filter(([c]) => c.verdict == v));
  if (!shown.length) { table.closest(".wide").replaceWith(element("p", "Both runs have the same scenes, renderers and variants.", { class: "dim" })); return; }
  row(table.createTHead(), [heading("scene", { class: "corner" }), heading("renderer", { class: "text" }), heading("change", { class: "text" }), heading(term("equal")), heading(term("unexplained")), heading(term("finding", "findings"), { class: "text" })]);
  const body = table.createTBody();
  for (const [c, k] of shown) {
    const r = c.after ?? c.before;
    row(body, [...namesOf(c), ...(r.failure ? ["–", "–"] : [r.pixels.equal, r.pixels.unexplained]), element("td", r.failure || r.findings.map((f) => f.text).join("; ") || "–", { class: "text" })]).id = "change-" + k;
  }
}
function versions() {
  const pairs = new Map();
  for (const c of changes) if (c.before && c.after) pairs.set(JSON.stringify([label(c), c.before.version, c.after.version]), [label(c), c.before.version, c.after.version]);
  const all = [...pairs.values()], other = all.filter(([, a, b]) => a != b), table = byId("versions");
  byId("kept").textContent = counted(all.length - other.length, "version is", "versions are") + " as in the baseline" + (other.length ? ", " + other.length + " not." : ".");
  if (!other.length) return;
  row(table, ["renderer", element("th", "baseline", { class: "text" }), element("th", "this run", { class: "text" })], "th");
  for (const [l, a, b] of other) row(table, [l, element("td", a || "–", { class: "text" }), element("td", b || "–", { class: "text moved" })]);
}
/// Only what the filter shows, in every table.
function showOnly(shown) {
  overview(shown);
  changes.forEach((c, k) => { for (const place of document.querySelectorAll("#change-" + k + ", [data-change='" + k + "']")) place.hidden = !shown(c); });
}
byId("verdict").textContent = (of("worse").length ? counted(of("worse").length, "result is", "results are") + " worse" : "Nothing is worse") + " than in the baseline. Fathom " + (comparison.fathom.before == comparison.fathom.after ? comparison.fathom.after + " in both" : comparison.fathom.before + " → " + comparison.fathom.after) + ".";
for (const v of verdicts) if (of(v).length) { const chip = element("span", of(v).length + " ", { class: "chip " + tone(v) }); chip.append(term(v)); byId("counts").append(chip); }
explainWords(); details(); findings(); newAndGone(); versions();
filterBy(changes, (c) => c.verdict != "same", "only what is not the same", showOnly);
walkByArrows(byId("matrix"));
fadeWhereMore();
addEventListener("resize", () => keepClear(byId("matrix")));
