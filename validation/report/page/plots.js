const svgElement = (tag, attributes, text) => { const e = document.createElementNS("http://www.w3.org/2000/svg", tag); for (const k in attributes) e.setAttribute(k, attributes[k]); if (text !== undefined) e.textContent = text; return e; };
function axes(xLow, xHigh, yLow, yHigh) {
  const W = 460, H = 300, left = 58, bottom = 36, top = 10, right = 12;
  const lx = Math.log10, x = (v) => left + (W - left - right) * (lx(v) - lx(xLow)) / (lx(xHigh) - lx(xLow) || 1), y = (v) => H - bottom - (H - top - bottom) * (lx(v) - lx(yLow)) / (lx(yHigh) - lx(yLow) || 1);
  const svg = svgElement("svg", { viewBox: "0 0 " + W + " " + H, role: "img", "aria-label": "Errors against depth, both on logarithmic scales" });
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

