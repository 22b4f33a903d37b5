/// The samples of a deep map.
import { channelOf } from "./channels.js";
import { textOf } from "./numbers.js";
import { remembered, unpacked } from "./planes.js";
import { byId, element } from "./reading.js";

const parts = [["Z", "f32"], ["ZBack", "f32"], ["area", "f32"], ["A", "f32"], ["id", "u32"]];
/// The columns of the list: the identifier is short and names the triangle.
const columns = ["id", "Z", "ZBack", "area", "A"];

/// All samples of a tile, and where those of each pixel begin.
async function samplesOf(map, number) {
  const { values: counts } = await channelOf(map, "samples").tile(0, number), begins = new Uint32Array(counts.length + 1);
  for (let k = 0; k < counts.length; ++k) begins[k + 1] = begins[k] + counts[k];
  const all = await Promise.all(parts.map(([, type], k) => unpacked(`m${map.number}-d${k}-0-${number}`, type, begins.at(-1))));
  return { begins, all, bytes: 20 * begins.at(-1) + 4 * begins.length };
}

/// The samples of a pixel, the nearest first: { Z, ZBack, area, A, id }.
export async function samplesAt(map, [x, y]) {
  const { number, place } = channelOf(map, "samples").placeOf(x, y);
  const { begins, all } = await remembered(`m${map.number}-deep-${number}`, () => samplesOf(map, number));
  return Array.from({ length: begins[place + 1] - begins[place] }, (_, k) =>
    Object.fromEntries(parts.map(([name], part) => [name, all[part][begins[place] + k]])));
}

let listing = 0;

/// Lists the samples of a pixel, where the map is deep.
export async function showSamples(map, pixel) {
  const mine = ++listing, section = byId("deep-section");
  section.hidden = !map.deep || !pixel;
  if (section.hidden) return;
  const samples = await samplesAt(map, pixel), table = byId("samples");
  if (mine !== listing) return;
  const head = element("tr");
  head.append(...columns.map((name) => element("th", name, { scope: "col" })));
  table.replaceChildren(...samples.length ? [head] : [], ...samples.map((sample) => {
    const row = element("tr");
    row.append(...columns.map((name) => element("td", textOf(sample[name], name !== "id"))));
    return row;
  }));
  byId("deep-said").textContent = samples.length ? "nearest first" : "no sample";
}
