const svgElement = (tag, attributes, text) => { const e = document.createElementNS("http://www.w3.org/2000/svg", tag); for (const k in attributes) e.setAttribute(k, attributes[k]); if (text !== undefined) e.textContent = text; return e; };
function axes(xLow, xHigh, yLow, yHigh, { W, H, right } = { W: 460, H: 300, right: 12 }) {
  const left = 58, bottom = 36, top = 10;
  const lx = Math.log10, x = (v) => left + (W - left - right) * (lx(v) - lx(xLow)) / (lx(xHigh) - lx(xLow) || 1), y = (v) => H - bottom - (H - top - bottom) * (lx(v) - lx(yLow)) / (lx(yHigh) - lx(yLow) || 1);
  const svg = svgElement("svg", { viewBox: "0 0 " + W + " " + H, role: "img", "aria-label": "Errors against depth, both on logarithmic scales" });
  for (let e = Math.ceil(lx(yLow)); e <= lx(yHigh); ++e) { const v = 10 ** e; svg.append(svgElement("line", { x1: left, x2: W - right, y1: y(v), y2: y(v), stroke: "#ddd" }), svgElement("text", { x: left - 6, y: y(v) + 4, "text-anchor": "end" }, "1e" + e)); }
  const ticks = []; for (let e = Math.floor(lx(xLow)); e <= Math.ceil(lx(xHigh)); ++e) for (const m of [1, 2, 5]) { const v = m * 10 ** e; if (v >= xLow && v <= xHigh) ticks.push(v); }
  const step = Math.ceil(ticks.length / 8);
  ticks.forEach((v, i) => { if (i % step) return; svg.append(svgElement("line", { x1: x(v), x2: x(v), y1: top, y2: H - bottom, stroke: "#eee" }), svgElement("text", { x: x(v), y: H - bottom + 14, "text-anchor": "middle" }, short(v, 3))); });
  if (ticks.length < 2) svg.append(svgElement("text", { x: left, y: H - bottom + 14 }, short(xLow, 3)), svgElement("text", { x: W - right, y: H - bottom + 14, "text-anchor": "end" }, short(xHigh, 3)));
  svg.append(svgElement("text", { x: (W - right + left) / 2, y: H - 6, "text-anchor": "middle" }, "depth"), svgElement("rect", { x: left, y: top, width: W - left - right, height: H - top - bottom, fill: "none", stroke: "#999" }));
  return { svg, x, y, top, bottom: H - bottom, right: W - right };
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
const dashes = ["", "7 3", "2 2", "9 3 2 3"];
/// Paths about (0, 0); those that are not filled are white inside.
const markers = [["M-3,0a3,3 0 1,0 6,0a3,3 0 1,0 -6,0z", true], ["M-3,-3h6v6h-6z", false], ["M0,-4L4,3H-4z", true], ["M0,-4L4,0L0,4L-4,0z", false], ["M-3,-3L3,3M-3,3L3,-3", false], ["M-3,-3h6v6h-6z", true], ["M0,4L4,-3H-4z", false], ["M-4,0H4M0,-4V4", false], ["M0,-4L4,0L0,4L-4,0z", true]];
/// The j-th line's colour, dashes and marker; no two of the first 36 have both dashes and marker in common, so no colour is needed.
const styleOf = (j) => ({ colour: hues[j % hues.length], dash: dashes[j % dashes.length], marker: markers[j % markers.length] });
const lineIn = ({ colour, dash }, width, attributes) => svgElement("polyline", { fill: "none", stroke: colour, "stroke-width": width, "stroke-dasharray": dash, ...attributes });
const markerAt = ({ colour, marker: [d, filled] }, x, y) => svgElement("path", { d, transform: "translate(" + x.toFixed(1) + " " + y.toFixed(1) + ")", fill: filled ? colour : "#fff", stroke: colour, "stroke-width": 1.3 });
/// The height of a line at x, between its points.
function heightAt(points, x) {
  const i = Math.max(1, points.findIndex((p) => p[0] >= x)), [a, b] = [points[i - 1], points[i] ?? points[i - 1]];
  return b[0] == a[0] ? a[1] : a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
}
/// Heights for labels in their order, near the wanted ones, which ascend, and at least a gap apart.
function spread(wanted, top, bottom) {
  const gap = Math.min(13, (bottom - top) / Math.max(1, wanted.length - 1)), heights = [];
  wanted.forEach((y, i) => heights.push(Math.max(y, i ? heights[i - 1] + gap : top)));
  for (let i = heights.length - 1, most = bottom; i >= 0; --i, most -= gap) heights[i] = Math.min(heights[i], most);
  return heights;
}
/// A label for each line, right of the plot, with a piece of the line, led to its end.
function labelLines({ svg, top, bottom, right }, lines) {
  const sorted = lines.slice().sort((p, q) => p.end - q.end), heights = spread(sorted.map((line) => line.end), top, bottom);
  sorted.forEach(({ style, name, points, end, width }, i) => {
    const y = heights[i], at = right + 20;
    if (points.length) svg.append(svgElement("line", { x1: points[points.length - 1][0], y1: end, x2: at, y2: y, stroke: "#999", "stroke-width": 0.6 }));
    svg.append(lineIn(style, width, { points: at + "," + y + " " + (at + 26) + "," + y, class: "sample" }), markerAt(style, at + 13, y), svgElement("text", { x: at + 31, y: y + 3.5, class: "line-label", style: width > 2 ? "font-weight:700" : "" }, name + (points.length ? "" : ": no error")));
  });
}
async function formats(sceneName) {
  const shown = results.map((r, k) => k).filter((k) => results[k].scene == sceneName && !results[k].failure);
  const scene = await sceneOf(sceneName), lists = [];
  for (const k of shown) lists.push(pairs(scene, await mapOf(k)));
  if (results[current].scene != sceneName) return;
  const [a, b, c, d] = range(lists), plot = axes(a, b, c, d, { W: 680, H: 440, right: 225 }), { svg, x, y } = plot, bins = 24;
  const lines = shown.map((k, j) => {
    const top = new Array(bins).fill(0);
    for (const [t, e] of lists[j]) { const i = Math.min(bins - 1, Math.floor(bins * Math.log(t / a) / Math.log(b / a))); top[i] = Math.max(top[i], e); }
    const points = top.map((e, i) => e > 0 ? [x(a * (b / a) ** ((i + 0.5) / bins)), y(Math.max(e, c))] : null).filter((p) => p);
    return { style: styleOf(j), name: label(results[k]), points, end: points.length ? points[points.length - 1][1] : plot.bottom, width: k == current ? 3 : 1.4 };
  });
  for (const { style, name, points, width } of lines) {
    const line = lineIn(style, width, { points: points.map((p) => p.map((v) => v.toFixed(1)).join(",")).join(" "), class: "format" });
    line.append(svgElement("title", {}, name));
    svg.append(line);
  }
  // Four on each line, never two lines' at the same depth: lines may lie upon each other.
  lines.forEach(({ style, points }, j) => {
    if (points.length < 2) return points.forEach((p) => svg.append(markerAt(style, ...p)));
    const first = points[0][0], last = points[points.length - 1][0];
    for (let k = 0; k < 4; ++k) { const at = first + (last - first) * (k + (j + 0.5) / lines.length) / 4; svg.append(markerAt(style, at, heightAt(points, at))); }
  });
  labelLines(plot, lines);
  byId("formats").replaceChildren(svg);
}
