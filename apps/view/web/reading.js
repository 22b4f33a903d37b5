/// What the page knows of a pixel: the values of all channels, the point in the world.
import { channelOf, surface, worldPoint } from "./channels.js";
import { short, textOf } from "./numbers.js";

export const byId = (id) => document.getElementById(id);
export function element(name, text, attributes = {}) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

function textOfValue(channel, { value, mask }) {
  if (mask !== surface) return "–";
  if (!channel.isIdentifier) return textOf(value, channel.isSingle);
  const name = channel.nameOf(value);
  return value === channel.none ? name : name ? `${value}  ${name}` : String(value);
}

function addRow(table, name, text, meaning, isCurrent) {
  const row = table.insertRow();
  row.append(element("th", name, { scope: "row" }), element("td", text));
  if (meaning) row.title = meaning;
  if (isCurrent) row.className = "current";
}

/// The point in the world, where depth and camera say it: computed from the rounded depth.
async function pointOf(map, x, y) {
  const depth = channelOf(map, "Z");
  if (!map.camera || !depth || channelOf(map, "P.X")) return null;
  const { value, mask } = await depth.at(x, y);
  return mask === surface && Number.isFinite(value) ? worldPoint(map.camera, x, y, value) : null;
}

let turn = 0;

/// Fills the table with the values of a pixel. `sources` are the channels that the picture shows, with a name for each:
/// they stand first where they are more than one.
export async function showReading(map, pixel, sources) {
  const mine = ++turn, table = byId("values");
  if (!pixel) {
    byId("where").textContent = "Point at a pixel";
    table.replaceChildren();
    return "";
  }
  const [x, y] = pixel, stored = map.stored;
  const [shown, values, point] = await Promise.all([
    Promise.all(sources.map(({ source }) => source.at(x, y))),
    Promise.all(stored.map((channel) => channel.at(x, y))), pointOf(map, x, y)]);
  if (mine !== turn) return "";
  byId("where").textContent = `Pixel ${x}, ${y}` + (shown.every(({ mask }) => mask !== surface) ? ": no surface" : "");
  const body = element("tbody");
  if (sources.length > 1) {
    sources.forEach(({ name, source }, k) => addRow(body, name, textOfValue(source, shown[k]), source.meaning, true));
  }
  const current = sources[0].source;
  stored.forEach((channel, k) => addRow(body, channel.name, textOfValue(channel, values[k]), channel.meaning,
    sources.length === 1 && (channel === current || current.parts?.includes(channel))));
  if (point) {
    addRow(body, "world", point.map((part) => short(part, 9)).join(", "), "point in the world, computed in binary64 from the rounded depth");
  }
  table.replaceChildren(body);
  const index = stored.indexOf(current);
  return `pixel ${x}, ${y}: ` + (index >= 0 ? `${current.name} ${textOfValue(current, values[index])}` : byId("where").textContent);
}
