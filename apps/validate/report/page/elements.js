"use strict";
const byId = (id) => document.getElementById(id);
const classNames = ["equal", "within quantization", "within arithmetic", "edge", "z-fight", "missed surface", "convention", "unexplained"];
const classColours = [[226,232,240],[168,205,230],[86,150,200],[240,190,80],[150,95,190],[40,160,120],[235,110,60],[200,20,30]];
const label = (r) => r.renderer + (r.variant ? " " + r.variant : "");
const titleOf = (r) => r.scene + ", " + label(r);
const short = (x, n = 4) => x === null || !isFinite(x) ? "–" : (x != 0 && Math.abs(x) < 1e-3 ? Number(x).toExponential(n - 1) : Number(x).toPrecision(n)).replace(/\.?0+(e|$)/, "$1");
const counted = (n, one, many = one + "s") => n + " " + (n == 1 ? one : many);
const element = (tag, text, attributes = {}) => { const e = document.createElement(tag); if (text !== undefined) e.textContent = text; for (const k in attributes) e.setAttribute(k, attributes[k]); return e; };
const row = (table, cells, tag = "td") => { const r = table.insertRow(); for (const c of cells) r.append(c instanceof Node ? c : element(tag, c)); return r; };
const heading = (content, attributes = {}) => { const h = element("th", undefined, { scope: "col", ...attributes }); h.append(content); return h; };
const colourKey = (c) => { const k = element("span", undefined, { class: "key" }); k.style.background = "rgb(" + classColours[c] + ")"; return k; };
/// Of a class in a result: where no triangle numbers were read, z-fighting shows only where depths reveal it.
const isUnknown = (r, name) => name == "z-fight" && r.z_fighting && !r.z_fighting.triangle_numbers;
const pixelsText = (r, name) => !isUnknown(r, name) ? r.pixels[name] : r.pixels[name] ? "≥ " + r.pixels[name] : "unknown";
const shareText = (r, name, n) => isUnknown(r, name) && !r.pixels[name] ? "–" : (isUnknown(r, name) ? "≥ " : "") + (100 * r.pixels[name] / n).toFixed(3) + " %";
const findingText = (f) => f.text + " (" + counted(f.pixels, "pixel") + ")";
