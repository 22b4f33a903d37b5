/// What was found, and what it rests on.
function findingBox(f, style) {
  const box = element("div", findingText(f), { class: style });
  if (f.alternatives) box.append(element("div", "As good an explanation: " + f.alternatives.join(", ")));
  if (f.evidence) { const list = element("ul"); for (const line of f.evidence) list.append(element("li", line)); box.append(list); }
  return box;
}
let current = -1, marked = null, turns = 0;
/// Shows a result. A later call, also for the same result, takes the place of one that still unpacks its maps.
async function show(k) {
  const mine = ++turns;
  current = k; marked = null;
  const r = results[k];
  for (const b of document.querySelectorAll("#matrix button")) b.setAttribute("aria-pressed", b.dataset.case == k);
  byId("title").textContent = titleOf(r);
  byId("version").textContent = r.version || r.file || "";
  for (const id of ["findings", "maps-shown", "classes", "bounds", "scatter", "formats", "worst"]) byId(id).replaceChildren();
  if (r.failure) { byId("findings").append(element("div", r.failure, { class: "finding" })); return isShown(mine); }
  if (!r.findings.length) byId("findings").append(element("div", r.verdict, { class: isGood(r) ? "note" : "finding" }));
  for (const f of r.findings) byId("findings").append(findingBox(f, "finding"));
  for (const f of r.notes) byId("findings").append(findingBox(f, "note"));
  const scene = await sceneOf(r.scene), map = await mapOf(k), n = scene.depths.length;
  if (mine !== turns) return;
  let low = Infinity, high = -Infinity;
  for (const d of scene.depths) if (isFinite(d)) { low = Math.min(low, d); high = Math.max(high, d); }
  const log = high / low > 20, place = (d) => log ? Math.log(d / low) / Math.log(high / low) : (d - low) / (high - low || 1);
  const nothing = getComputedStyle(document.body).backgroundColor.match(/\d+/g).slice(0, 3).map(Number);
  const grey = nothing[0] < 128 ? [96, 104, 116] : nothing; // behind black and white
  const depthColour = (d) => isFinite(d) ? depthColourAt(place(d)) : nothing;
  const relative = new Float64Array(n), sizes = [];
  for (let i = 0; i < n; ++i) {
    const t = scene.depths[i], o = map.depths[i];
    relative[i] = t === o ? 0 : (o - t) / t;
    if (isFinite(relative[i]) && relative[i] != 0) sizes.push(Math.abs(relative[i]));
  }
  sizes.sort((a, b) => a - b);
  const most = sizes.length ? sizes[Math.floor(0.98 * (sizes.length - 1))] : 1e-7;
  const differenceColour = (i) => {
    const t = scene.depths[i], o = map.depths[i];
    if (isFinite(t) != isFinite(o)) return isFinite(t) ? [20, 20, 20] : [120, 60, 160];
    return isFinite(t) && isFinite(relative[i]) ? diverging(Math.max(-1, Math.min(1, relative[i] / most))) : grey;
  };
  const key = element("div"); key.style.fontSize = ".8rem";
  classNames.forEach((name, c) => { if (!r.pixels[name]) return; const s = element("span"); s.style.marginRight = ".8em"; s.style.display = "inline-block"; s.append(colourKey(c), term(name)); key.append(s); });
  const scale = () => bar(depthColourAt, short(low), short(high) + (log ? " (logarithmic)" : ""));
  const w = scene.width, h = scene.height;
  const differenceKey = bar((t) => diverging(2 * t - 1), short(-most, 2), short(most, 2));
  differenceKey.append(element("div", "black: surface missing, violet: surface added", { class: "dim small" }));
  byId("maps-shown").append(
    figure("Truth: depth", drawn(w, h, (i) => depthColour(scene.depths[i])), scale()),
    figure(label(r) + ": depth, same scale", drawn(w, h, (i) => depthColour(map.depths[i])), scale()),
    figure("Relative difference", drawn(w, h, differenceColour), differenceKey),
    figure("Class", drawn(w, h, (i) => classColours[map.classes[i]]), key));
  const read = (x, y) => {
    const i = y * w + x, t = scene.depths[i], o = map.depths[i], id = scene.triangles[i];
    byId("reading").textContent = "pixel (" + x + ", " + y + "): " + classNames[map.classes[i]] + (id == 4294967295 ? "" : ", triangle " + id) + "\ntruth " + (isFinite(t) ? t : "background") + "   other " + (isFinite(o) ? o : "background") + "\ndifference " + (isFinite(o - t) ? short(o - t) + ", relative " + short(relative[i]) : "–") + "\n" + classNames[map.classes[i]] + ": " + meanings[classNames[map.classes[i]]];
  };
  for (const canvas of document.querySelectorAll("#maps-shown canvas")) {
    const at = (e) => { const b = canvas.getBoundingClientRect(); read(Math.min(w - 1, Math.max(0, Math.floor((e.clientX - b.left - 1) / (b.width - 2) * w))), Math.min(h - 1, Math.max(0, Math.floor((e.clientY - b.top - 1) / (b.height - 2) * h)))); };
    canvas.addEventListener("pointermove", at); canvas.addEventListener("pointerdown", at);
  }
  const classes = byId("classes"); row(classes, ["class", "pixels", "share", element("th", "meaning", { class: "text" })], "th");
  classNames.forEach((name, c) => { const cell = element("td"); cell.append(colourKey(c), name); row(classes, [cell, pixelsText(r, name), element("td", shareText(r, name, n), { class: "whole" }), element("td", meanings[name], { class: "text" })]); });
  const fights = r.z_fighting;
  const fightText = !fights.triangle_numbers ? "No triangle numbers were read: z-fighting shows only where depths reveal it. " : fights.by_format_alone === null ? "" : "Of the format alone, exact depths rounded once, " + counted(fights.by_format_alone, "pixel") + " would z-fight. ";
  byId("bounds").textContent = fightText + "Bounds: half of the depth intervals are narrower than " + short(r.bounds.median_relative_width, 3) + " of the depth (" + short(r.bounds.median_width_in_steps, 3) + " steps of the storage); " + (100 * r.bounds.may_share).toFixed(2) + " % of the pixels that triangles touch are undecided: a triangle may be drawn there or not. Errors: median " + short(r.errors.median_relative, 3) + ", greatest " + short(r.errors.greatest_relative, 3) + " of the depth.";
  scatter(scene, map, relative);
  const plotted = formats(r.scene);
  const worst = byId("worst"); row(worst, ["pixel", element("th", "class", { class: "text" }), "truth", "other", heading(term("bound", "allowed")), element("th", "triangle and its corners", { class: "text" })], "th");
  for (const p of r.worst) {
    const b = element("button", "(" + p.pixel.join(", ") + ")", { type: "button" }), cell = element("td"); cell.append(b);
    b.addEventListener("click", () => { read(...p.pixel); byId("reading").scrollIntoView({ block: "center" }); mark(p.pixel); });
    row(worst, [cell, element("td", p.class, { class: "text whole" }), short(p.truth, 9), short(p.other, 9), short(p.least, 9) + " … " + short(p.greatest, 9), element("td", p.corners ? p.triangle + ": " + p.corners.map((c) => "(" + c.join(", ") + ")").join(" ") : "–", { class: "text" })]);
  }
  function mark(pixel) {
    const canvas = document.querySelectorAll("#maps-shown canvas");
    for (const c of canvas) { const g = c.getContext("2d"); g.strokeStyle = "#f0f"; g.strokeRect(pixel[0] - 3.5, pixel[1] - 3.5, 8, 8); }
  }
  await plotted;
  isShown(mine);
}
const isShown = (turn) => { if (turn === turns) document.documentElement.dataset.ready = turn; }; // for tests

