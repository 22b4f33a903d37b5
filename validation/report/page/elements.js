"use strict";
const byId = (id) => document.getElementById(id);
const classNames = ["equal", "within quantization", "within arithmetic", "edge", "z-fight", "missed surface", "convention", "unexplained"];
const classColours = [[226,232,240],[168,205,230],[86,150,200],[240,190,80],[150,95,190],[40,160,120],[235,110,60],[200,20,30]];
const classMeaning = ["the exact depth rounded once, or background in both", "a neighbour of the exact depth in the storage", "the visible surface, its depth within the bound of the model", "the sample is nearer to an edge than the model tells", "another surface, not told from the visible one by depth", "a ray slipped between triangles", "explained by a fault of the whole image", "no cause: a bug"];
const label = (r) => r.renderer + (r.variant ? " " + r.variant : "");
const short = (x, n = 4) => x === null || !isFinite(x) ? "–" : (x != 0 && Math.abs(x) < 1e-3 ? Number(x).toExponential(n - 1) : Number(x).toPrecision(n)).replace(/\.?0+(e|$)/, "$1");
const element = (tag, text, attributes = {}) => { const e = document.createElement(tag); if (text !== undefined) e.textContent = text; for (const k in attributes) e.setAttribute(k, attributes[k]); return e; };
const row = (table, cells, tag = "td") => { const r = table.insertRow(); for (const c of cells) r.append(c instanceof Node ? c : element(tag, c)); return r; };

