function start() {
  const sceneNames = [...new Set(results.map((r) => r.scene))], labels = [...new Set(results.map(label))];
  const failures = results.filter((r) => r.failure).length, bad = results.reduce((s, r) => s + (r.failure ? 0 : r.pixels.unexplained), 0), found = results.reduce((s, r) => s + (r.failure ? 0 : r.findings.length), 0);
  byId("verdict").textContent = results.length - failures + " maps of " + sceneNames.length + " scenes: " + (bad ? bad + " pixels unexplained" : "every pixel is explained") + (found ? ", " + found + " findings" : "") + (failures ? ", " + failures + " not drawn" : "") + ". Fathom " + report.fathom + ".";
  const matrix = byId("matrix"); const head = row(matrix, ["scene"], "th");
  for (const l of labels) head.append(element("th", l, { class: "turned" }));
  for (const s of sceneNames) {
    const line = row(matrix, [element("th", s)]);
    for (const l of labels) {
      const k = results.findIndex((r) => r.scene == s && label(r) == l), cell = element("td"); line.append(cell);
      if (k < 0) continue;
      const r = results[k], b = element("button", r.failure ? "not drawn" : r.pixels.unexplained + (r.findings.length ? " + " + r.findings.map((f) => f.kind).join(", ") : ""), { type: "button", "data-case": k });
      cell.className = r.failure ? "none" : faults(r) || r.findings.length ? "fault" : "good";
      b.addEventListener("click", () => show(k)); cell.append(b);
    }
  }
  const all = byId("all"); row(all, ["scene", "renderer", ...classNames, "median error", "greatest error", "bound", "may"], "th");
  for (const r of results) row(all, r.failure ? [r.scene, label(r), element("td", r.failure, { colspan: 12, class: "text" })] : [r.scene, label(r), ...classNames.map((c) => r.pixels[c]), short(r.errors.median_relative, 2), short(r.errors.greatest_relative, 2), short(r.bounds.median_relative_width, 2), (100 * r.bounds.may_share).toFixed(2) + " %"]);
  const versions = byId("versions"); row(versions, ["renderer", element("th", "version", { class: "text" })], "th");
  for (const text of new Set(results.map((r) => JSON.stringify([label(r), r.version || r.failure])))) { const [l, v] = JSON.parse(text); row(versions, [l, element("td", v, { class: "text" })]); }
  const first = results.findIndex((r) => faults(r)), any = results.findIndex((r) => !r.failure);
  if (results.length) show(first >= 0 ? first : Math.max(any, 0));
}
start();
