const isGood = (r) => !r.failure && !r.pixels.unexplained && !r.findings.length;
const sums = [
  { name: "unexplained", word: "unexplained", of: (r) => r.failure ? 0 : r.pixels.unexplained, tone: "fault" },
  { name: "findings", word: "finding", of: (r) => r.failure ? 0 : r.findings.length, tone: "fault" },
  { name: "not drawn", word: "not drawn", of: (r) => r.failure ? 1 : 0, tone: "none" }];
/// The fault first, then sums.
function verdict() {
  const drawn = results.filter((r) => !r.failure), [bad, found, failures] = sums.map((sum) => results.reduce((s, r) => s + sum.of(r), 0));
  const failed = !drawn.every(isGood);
  return (failed ? report.verdict[0].toUpperCase() + report.verdict.slice(1) + ". " : "")
    + counted(drawn.length, "map") + " of " + counted(distinct(drawn, (r) => r.scene).length, "scene") + ": "
    + (failed ? counted(bad, "pixel") + " unexplained, " + counted(found, "finding") : "every pixel is explained")
    + (failures ? ", " + failures + " not drawn" : "") + ". Fathom " + report.fathom + ".";
}
function cellOf(k) {
  const r = results[k];
  if (r.failure) return { text: "not drawn", tone: "none", says: r.failure };
  const kinds = r.findings.map((f) => f.kind).join(", ");
  return { text: [...(r.pixels.unexplained || !kinds ? [r.pixels.unexplained] : []), ...(kinds ? [kinds] : [])].join(" + "), tone: faults(r) || kinds ? "fault" : "good",
    says: counted(r.pixels.unexplained, "pixel") + " unexplained" + (kinds ? "; found: " + kinds : "") };
}
function allResults(shown) {
  const all = byId("all");
  all.replaceChildren();
  row(all.createTHead(), [heading("scene", { class: "corner" }), heading("renderer", { class: "text" }), ...classNames.map((name) => heading(term(name))), heading("median error"), heading("greatest error"), heading(term("bound")), heading(term("may"))]);
  const body = all.createTBody();
  for (const r of results) {
    if (!shown(r)) continue;
    const names = [heading(r.scene, { scope: "row" }), element("td", label(r), { class: "text" })];
    row(body, r.failure ? [...names, element("td", r.failure, { colspan: 12, class: "text" })] : [...names, ...classNames.map((c) => pixelsText(r, c)), short(r.errors.median_relative, 2), short(r.errors.greatest_relative, 2), short(r.bounds.median_relative_width, 2), element("td", (100 * r.bounds.may_share).toFixed(2) + " %", { class: "whole" })]);
  }
}
function versions() {
  const table = byId("versions");
  row(table, ["renderer", element("th", "version", { class: "text" })], "th");
  for (const text of new Set(results.map((r) => JSON.stringify([label(r), r.version || r.failure || r.file])))) { const [l, v] = JSON.parse(text); row(table, [l, element("td", v, { class: "text" })]); }
}
/// A link to the page that shows a result: report.html#spot,%20vtk%20unorm24.
const linkTo = (r) => "#" + encodeURI(titleOf(r));
function choose(k) {
  history.replaceState(null, "", linkTo(results[k]));
  show(k);
}
function start() {
  byId("verdict").textContent = verdict();
  explainWords();
  filterBy(results, (r) => !isGood(r), "only what is not fully explained", (shown) => {
    overviewTable(byId("matrix"), results, { cellOf, sums, shown, choose, isChosen: (k) => k == current, about: "Unexplained pixels and findings of each renderer and variant on each scene" });
    allResults(shown);
  });
  walkByArrows(byId("matrix"));
  addEventListener("resize", () => keepClear(byId("matrix")));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => show(current));
  versions();
  fadeWhereMore();
  const linked = results.findIndex((r) => location.hash == linkTo(r)), first = results.findIndex((r) => faults(r)), any = results.findIndex((r) => !r.failure);
  if (results.length) show(linked >= 0 ? linked : first >= 0 ? first : Math.max(any, 0));
}
start();
