#include "validation/report/page.h"

namespace fathom::validation {

const char* const page_head = R"page(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Validation</title>
<style>
:root { --line: #c9ced6; --soft: #f3f5f8; --ink: #1c2430; --dim: #5a6473; }
* { box-sizing: border-box; }
body { font: 15px/1.45 system-ui, sans-serif; color: var(--ink); margin: 0 auto; max-width: 84rem; padding: 1rem; }
h1 { font-size: 1.5rem; margin: 0 0 .3rem; } h2 { font-size: 1.15rem; margin: 1.6rem 0 .5rem; }
p { margin: .3rem 0; max-width: 60rem; } .dim { color: var(--dim); } .small { font-size: .78rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .88rem; }
th, td { border: 1px solid var(--line); padding: .2rem .5rem; text-align: right; }
th { background: var(--soft); font-weight: 600; } th:first-child, td:first-child { text-align: left; }
td.text, th.text { text-align: left; }
#matrix td { padding: 0; } #matrix th.turned { vertical-align: bottom; text-align: right; }
#matrix button { all: unset; box-sizing: border-box; display: block; width: 100%; padding: .25rem .5rem; cursor: pointer; text-align: right; }
#matrix button:focus-visible, #matrix button[aria-pressed=true] { outline: 3px solid #1c2430; outline-offset: -3px; }
.good { background: #d9f0e1; } .fault { background: #f6c7c1; } .none { background: #e6e6e6; color: var(--dim); }
.maps { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(18rem, 100%), 1fr)); gap: .8rem; }
figure { margin: 0; } figcaption { font-size: .85rem; margin-bottom: .2rem; }
.maps canvas { width: 100%; display: block; image-rendering: pixelated; background: #fff; border: 1px solid var(--line); cursor: crosshair; }
.bar { height: .7rem; border: 1px solid var(--line); } .ends { display: flex; justify-content: space-between; font-size: .78rem; color: var(--dim); }
#reading { font: .85rem/1.5 ui-monospace, monospace; background: var(--soft); border: 1px solid var(--line); padding: .4rem .6rem; margin: .6rem 0; min-height: 3.8em; white-space: pre-wrap; overflow-wrap: anywhere; }
.key { display: inline-block; width: .85em; height: .85em; border: 1px solid #0004; vertical-align: -.08em; margin-right: .4em; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(26rem, 100%), 1fr)); gap: 1rem; }
svg { width: 100%; height: auto; border: 1px solid var(--line); background: #fff; } svg text { font: 11px system-ui, sans-serif; fill: #333; }
#worst button { font: inherit; cursor: pointer; } #worst td { vertical-align: top; }
.finding { background: #f6c7c1; padding: .3rem .6rem; margin: .3rem 0; }
</style></head>
<body>
<h1>Validation against the exact map</h1>
<p id="verdict"></p>
<p class="dim">Each cell counts the pixels that no cause explains; behind it, what was found. Choose one to look at its maps.</p>
<div class="wide"><table id="matrix"></table></div>
<h2 id="title"></h2>
<p id="version" class="dim"></p>
<div id="findings"></div>
<div class="maps" id="maps-shown"></div>
<div id="reading" aria-live="polite">Point at a pixel to read its values.</div>
<div class="wide"><table id="classes"></table></div>
<p id="bounds"></p>
<div class="plots">
<figure><figcaption>Relative error against depth, a point a pixel</figcaption><div id="scatter"></div></figure>
<figure><figcaption>Greatest relative error against depth, by depth format, on this scene</figcaption><div id="formats"></div></figure>
</div>
<h2>Pixels to look at first</h2>
<div class="wide"><table id="worst"></table></div>
<h2>All results</h2>
<div class="wide"><table id="all"></table></div>
<h2>Versions</h2>
<div class="wide"><table id="versions"></table></div>
)page";

const char* const page_script = R"page(<script>
"use strict";
const report = JSON.parse(document.getElementById("report").textContent);
const stored = JSON.parse(document.getElementById("maps").textContent);
const results = report.results;
const byId = (id) => document.getElementById(id);
const classNames = ["equal", "within quantization", "within arithmetic", "edge", "z-fight", "missed surface", "convention", "unexplained"];
const classColours = [[226,232,240],[168,205,230],[86,150,200],[240,190,80],[150,95,190],[40,160,120],[235,110,60],[200,20,30]];
const classMeaning = ["the exact depth rounded once, or background in both", "a neighbour of the exact depth in the storage", "the visible surface, its depth within the bound of the model", "the sample is nearer to an edge than the model tells", "another surface, not told from the visible one by depth", "a ray slipped between triangles", "explained by a fault of the whole image", "no cause: a bug"];
const label = (r) => r.renderer + (r.variant ? " " + r.variant : "");
const faults = (r) => r.failure ? 0 : r.pixels.unexplained + r.pixels.convention;
const short = (x, n = 4) => x === null || !isFinite(x) ? "–" : (x != 0 && Math.abs(x) < 1e-3 ? Number(x).toExponential(n - 1) : Number(x).toPrecision(n)).replace(/\.?0+(e|$)/, "$1");
const element = (tag, text, attributes = {}) => { const e = document.createElement(tag); if (text !== undefined) e.textContent = text; for (const k in attributes) e.setAttribute(k, attributes[k]); return e; };
const row = (table, cells, tag = "td") => { const r = table.insertRow(); for (const c of cells) r.append(c instanceof Node ? c : element(tag, c)); return r; };

async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
async function words(text) {
  const bytes = await unpacked(text), n = bytes.length / 4, result = new Uint32Array(n);
  for (let i = 0; i < n; ++i) result[i] = bytes[i] | bytes[n + i] << 8 | bytes[2 * n + i] << 16 | bytes[3 * n + i] << 24;
  return result;
}
const scenes = {}, maps = {};
async function sceneOf(name) {
  if (!scenes[name]) {
    const s = stored.scenes[name], bits = await words(s.depths);
    scenes[name] = { width: s.width, height: s.height, bits, depths: new Float32Array(bits.buffer), triangles: await words(s.triangles) };
  }
  return scenes[name];
}
async function mapOf(k) {
  if (!maps[k]) {
    const scene = await sceneOf(results[k].scene), bits = await words(stored.maps[k].differences);
    for (let i = 0; i < bits.length; ++i) bits[i] += scene.bits[i];
    maps[k] = { depths: new Float32Array(bits.buffer), classes: await unpacked(stored.maps[k].classes) };
  }
  return maps[k];
}

function viridis(t) {
  const c = [[0.2777,0.0054,0.3341],[0.1051,1.4046,1.3846],[-0.3309,0.2148,0.0951],[-4.6342,-5.7991,-19.3324],[6.2283,14.1799,56.6906],[4.7764,-13.7451,-65.353],[-5.4355,4.6459,26.3124]];
  const rgb = [0, 0, 0];
  for (let k = 6; k >= 0; --k) for (let j = 0; j < 3; ++j) rgb[j] = rgb[j] * t + c[k][j];
  return rgb.map((x) => Math.round(255 * Math.min(1, Math.max(0, x))));
}
const diverging = (t) => t < 0 ? [255 + 220 * t, 255 + 150 * t, 255 + 40 * t] : [255 - 40 * t, 255 - 180 * t, 255 - 215 * t];

function drawn(width, height, colour) {
  const canvas = element("canvas", undefined, { width, height });
  const context = canvas.getContext("2d"), image = context.createImageData(width, height);
  for (let i = 0; i < width * height; ++i) { const c = colour(i); image.data.set([c[0], c[1], c[2], 255], 4 * i); }
  context.putImageData(image, 0, 0);
  return canvas;
}
function bar(colour, low, high) {
  const stops = []; for (let k = 0; k <= 16; ++k) stops.push("rgb(" + colour(k / 16).map(Math.round).join(",") + ")");
  const box = element("div"), strip = element("div", undefined, { class: "bar" }), ends = element("div", undefined, { class: "ends" });
  strip.style.background = "linear-gradient(to right," + stops.join(",") + ")";
  ends.append(element("span", low), element("span", high)); box.append(strip, ends);
  return box;
}
function figure(caption, canvas, legend) { const f = element("figure"); f.append(element("figcaption", caption), canvas, legend); return f; }

let current = -1, marked = null;
async function show(k) {
  current = k; marked = null;
  const r = results[k];
  for (const b of document.querySelectorAll("#matrix button")) b.setAttribute("aria-pressed", b.dataset.case == k);
  byId("title").textContent = r.scene + ", " + label(r);
  byId("version").textContent = r.version || "";
  for (const id of ["findings", "maps-shown", "classes", "bounds", "scatter", "formats", "worst"]) byId(id).replaceChildren();
  if (r.failure) { byId("findings").append(element("div", r.failure, { class: "finding" })); return; }
  for (const f of r.findings) byId("findings").append(element("div", f.text + " (" + f.pixels + " pixels)", { class: "finding" }));
  const scene = await sceneOf(r.scene), map = await mapOf(k), n = scene.depths.length;
  if (current != k) return;
  let low = Infinity, high = -Infinity;
  for (const d of scene.depths) if (isFinite(d)) { low = Math.min(low, d); high = Math.max(high, d); }
  const log = high / low > 20, place = (d) => log ? Math.log(d / low) / Math.log(high / low) : (d - low) / (high - low || 1);
  const depthColour = (d) => isFinite(d) ? viridis(1 - Math.min(1, Math.max(0, place(d)))) : [255, 255, 255];
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
    return isFinite(relative[i]) ? diverging(Math.max(-1, Math.min(1, relative[i] / most))) : [255, 255, 255];
  };
  const key = element("div"); key.style.fontSize = ".8rem";
  classNames.forEach((name, c) => { if (!r.pixels[name]) return; const s = element("span"); s.style.marginRight = ".8em"; s.style.display = "inline-block"; const b = element("span", undefined, { class: "key" }); b.style.background = "rgb(" + classColours[c] + ")"; s.append(b, name); key.append(s); });
  const scale = () => bar((t) => viridis(1 - t), short(low), short(high) + (log ? " (logarithmic)" : ""));
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
    byId("reading").textContent = "pixel (" + x + ", " + y + "): " + classNames[map.classes[i]] + (id == 4294967295 ? "" : ", triangle " + id) + "\ntruth " + (isFinite(t) ? t : "background") + "   other " + (isFinite(o) ? o : "background") + "\ndifference " + (isFinite(o - t) ? short(o - t) + ", relative " + short(relative[i]) : "–");
  };
  for (const canvas of document.querySelectorAll("#maps-shown canvas")) {
    const at = (e) => { const b = canvas.getBoundingClientRect(); read(Math.min(w - 1, Math.max(0, Math.floor((e.clientX - b.left - 1) / (b.width - 2) * w))), Math.min(h - 1, Math.max(0, Math.floor((e.clientY - b.top - 1) / (b.height - 2) * h)))); };
    canvas.addEventListener("pointermove", at); canvas.addEventListener("pointerdown", at);
  }
  const classes = byId("classes"); row(classes, ["class", "pixels", "share", element("th", "meaning", { class: "text" })], "th");
  classNames.forEach((name, c) => { const cell = element("td"), b = element("span", undefined, { class: "key" }); b.style.background = "rgb(" + classColours[c] + ")"; cell.append(b, name); row(classes, [cell, r.pixels[name], (100 * r.pixels[name] / n).toFixed(3) + " %", element("td", classMeaning[c], { class: "text" })]); });
  byId("bounds").textContent = "Bounds: half of the depth intervals are narrower than " + short(r.bounds.median_relative_width, 3) + " of the depth (" + short(r.bounds.median_width_in_steps, 3) + " steps of the storage); " + (100 * r.bounds.may_share).toFixed(2) + " % of the pixels that triangles touch are undecided. Errors: median " + short(r.errors.median_relative, 3) + ", greatest " + short(r.errors.greatest_relative, 3) + " of the depth.";
  scatter(scene, map, relative);
  formats(r.scene);
  const worst = byId("worst"); row(worst, ["pixel", "class", "truth", "other", "allowed", element("th", "triangle and its corners", { class: "text" })], "th");
  for (const p of r.worst) {
    const b = element("button", "(" + p.pixel.join(", ") + ")", { type: "button" }), cell = element("td"); cell.append(b);
    b.addEventListener("click", () => { read(...p.pixel); byId("reading").scrollIntoView({ block: "center" }); mark(p.pixel); });
    row(worst, [cell, element("td", p.class, { class: "text" }), short(p.truth, 9), short(p.other, 9), short(p.least, 9) + " … " + short(p.greatest, 9), element("td", p.corners ? p.triangle + ": " + p.corners.map((c) => "(" + c.join(", ") + ")").join(" ") : "–", { class: "text" })]);
  }
  function mark(pixel) {
    const canvas = document.querySelectorAll("#maps-shown canvas");
    for (const c of canvas) { const g = c.getContext("2d"); g.strokeStyle = "#f0f"; g.strokeRect(pixel[0] - 3.5, pixel[1] - 3.5, 8, 8); }
  }
}

const svgElement = (tag, attributes, text) => { const e = document.createElementNS("http://www.w3.org/2000/svg", tag); for (const k in attributes) e.setAttribute(k, attributes[k]); if (text !== undefined) e.textContent = text; return e; };
function axes(xLow, xHigh, yLow, yHigh) {
  const W = 460, H = 300, left = 58, bottom = 36, top = 10, right = 12;
  const lx = Math.log10, x = (v) => left + (W - left - right) * (lx(v) - lx(xLow)) / (lx(xHigh) - lx(xLow) || 1), y = (v) => H - bottom - (H - top - bottom) * (lx(v) - lx(yLow)) / (lx(yHigh) - lx(yLow) || 1);
  const svg = svgElement("svg", { viewBox: "0 0 " + W + " " + H, role: "img" });
  for (let e = Math.ceil(lx(yLow)); e <= lx(yHigh); ++e) { const v = 10 ** e; svg.append(svgElement("line", { x1: left, x2: W - right, y1: y(v), y2: y(v), stroke: "#ddd" }), svgElement("text", { x: left - 6, y: y(v) + 4, "text-anchor": "end" }, "1e" + e)); }
  const ticks = []; for (let e = Math.floor(lx(xLow)); e <= Math.ceil(lx(xHigh)); ++e) for (const m of [1, 2, 5]) { const v = m * 10 ** e; if (v >= xLow && v <= xHigh) ticks.push(v); }
  const step = Math.ceil(ticks.length / 8);
  ticks.forEach((v, i) => { if (i % step) return; svg.append(svgElement("line", { x1: x(v), x2: x(v), y1: top, y2: H - bottom, stroke: "#eee" }), svgElement("text", { x: x(v), y: H - bottom + 14, "text-anchor": "middle" }, short(v, 3))); });
  if (ticks.length < 2) svg.append(svgElement("text", { x: left, y: H - bottom + 14 }, short(xLow, 3)), svgElement("text", { x: W - right, y: H - bottom + 14, "text-anchor": "end" }, short(xHigh, 3)));
  svg.append(svgElement("text", { x: (W + left) / 2, y: H - 6, "text-anchor": "middle" }, "depth"), svgElement("rect", { x: left, y: top, width: W - left - right, height: H - top - bottom, fill: "none", stroke: "#999" }));
  return { svg, x, y };
}
function pairs(scene, map) {
  const list = [];
  for (let i = 0; i < scene.depths.length; ++i) { const t = scene.depths[i], o = map.depths[i]; if (isFinite(t) && isFinite(o) && map.classes[i] <= 2) list.push([t, Math.abs(o - t) / t, i]); }
  return list;
}
function range(lists) {
  let a = Infinity, b = 0, c = Infinity, d = 0;
  for (const list of lists) for (const [t, e] of list) { a = Math.min(a, t); b = Math.max(b, t); if (e > 0) { c = Math.min(c, e); d = Math.max(d, e); } }
  if (!(d > 0)) { c = 1e-9; d = 1e-6; }
  if (!(b > 0)) { a = 0.1; b = 10; }
  if (a == b) { a /= 1.1; b *= 1.1; }
  return [a, b, 10 ** Math.floor(Math.log10(Math.max(c, d * 1e-6))), 10 ** Math.ceil(Math.log10(d))];
}
function scatter(scene, map) {
  const list = pairs(scene, map), [a, b, c, d] = range([list]), { svg, x, y } = axes(a, b, c, d);
  const step = Math.max(1, Math.floor(list.length / 4000));
  for (let i = 0; i < list.length; i += step) { const [t, e, p] = list[i]; svg.append(svgElement("circle", { cx: x(t).toFixed(1), cy: y(Math.max(e, c)).toFixed(1), r: 1.2, fill: "rgb(" + classColours[map.classes[p]].map((v) => Math.round(v * 0.8)) + ")" })); }
  byId("scatter").replaceChildren(svg, element("p", "Colours are those of the classes; exact pixels lie on the lower border.", { class: "dim" }));
}
const hues = ["#0b62a4", "#d1541c", "#2a8f4f", "#8a3fa0", "#b08c00", "#00868b", "#c0226a", "#555555", "#7aa62a", "#3a3ad0"];
async function formats(sceneName) {
  const shown = results.map((r, k) => k).filter((k) => results[k].scene == sceneName && !results[k].failure);
  const scene = await sceneOf(sceneName), lists = [];
  for (const k of shown) lists.push(pairs(scene, await mapOf(k)));
  if (results[current].scene != sceneName) return;
  const [a, b, c, d] = range(lists), { svg, x, y } = axes(a, b, c, d), bins = 24, key = element("p");
  shown.forEach((k, j) => {
    const top = new Array(bins).fill(0);
    for (const [t, e] of lists[j]) { const i = Math.min(bins - 1, Math.floor(bins * Math.log(t / a) / Math.log(b / a))); top[i] = Math.max(top[i], e); }
    const points = top.map((e, i) => e > 0 ? x(a * (b / a) ** ((i + 0.5) / bins)).toFixed(1) + "," + y(Math.max(e, c)).toFixed(1) : null).filter((p) => p);
    const colour = hues[j % hues.length], dash = ["", "6 3", "2 2"][Math.floor(j / hues.length) % 3];
    svg.append(svgElement("polyline", { points: points.join(" "), fill: "none", stroke: colour, "stroke-width": k == current ? 3 : 1.4, "stroke-dasharray": dash }));
    const s = element("span"); s.style.marginRight = "1em"; s.style.display = "inline-block"; s.style.fontSize = ".82rem"; const m = element("span", undefined, { class: "key" }); m.style.background = colour; s.append(m, label(results[k]) + (dash ? " (dashed)" : "")); key.append(s);
  });
  byId("formats").replaceChildren(svg, key);
}

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
</script>
)page";

}  // namespace fathom::validation
