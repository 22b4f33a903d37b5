/// The controls above the picture, filled from the state and reporting changes of it.
import { channelOf, firstChannel, maps } from "./channels.js";
import { isComparable } from "./comparison.js";
import { textOf } from "./numbers.js";
import { byId, element } from "./reading.js";
import { coloursOf, scaleOf } from "./state.js";

function fillSelect(select, entries, value) {
  select.replaceChildren(...entries.map(([key, text]) => element("option", text, { value: key })));
  select.value = value;
}

const title = (channel) => channel.meaning && channel.meaning !== channel.name ? `${channel.name} – ${channel.meaning}` : channel.name;

/// The names by which maps differ: without the folders that all have.
export function shortNames() {
  const folders = maps.map(({ name }) => name.split("/"));
  let same = 0;
  while (folders.every((parts) => parts.length > same + 1 && parts[same] === folders[0][same])) ++same;
  return folders.map((parts) => parts.slice(same).join("/"));
}

/// Makes a state that the page can show: numbers of maps that exist, a channel that the map has, a B that can be compared.
export function mended(state) {
  const isMap = (number) => Number.isInteger(number) && number >= 0 && number < maps.length;
  if (!isMap(state.map)) state.map = 0;
  const a = maps[state.map];
  if (!channelOf(a, state.channel)) state.channel = firstChannel(a).name;
  const isB = (number) => isMap(number) && isComparable(a, maps[number], state.channel);
  if (!isB(state.other)) state.other = maps.findIndex((_, number) => isB(number));
  if (state.other < 0) state.mode = "single";
  if (state.mode === "difference" && channelOf(a, state.channel).isColour) state.mode = "slider";
  if (state.low !== null && state.high !== null && !(state.low < state.high)) state.low = state.high = null;
  for (const key of ["pixel", "line"]) {
    if (state[key] && !state[key].every((at, k) => at >= 0 && at < (k % 2 ? a.height : a.width))) state[key] = null;
  }
  return state;
}

/// Why no map can be laid upon this one.
function whyIncomparable(a, channel) {
  const isOfSize = (b) => b !== a && b.width === a.width && b.height === a.height;
  return maps.some(isOfSize) ? `Compare: no other map of this size has ${channel}` : `Compare: no other map has ${a.width} × ${a.height} pixels`;
}

/// Shows the state in the controls.
export function fillControls(state) {
  const names = shortNames(), a = maps[state.map], channel = channelOf(a, state.channel);
  fillSelect(byId("map"), names.map((name, number) => [number, name]), state.map);
  fillSelect(byId("channel"), a.channels.map((each) => [each.name, title(each)]), state.channel);
  const others = names.map((name, number) => [number, name]).filter(([number]) => isComparable(a, maps[number], state.channel));
  fillSelect(byId("other"), others, state.other);
  for (const key of ["mode", "measure"]) byId(key).value = state[key];
  byId("scale").value = scaleOf(state);
  byId("colours").value = coloursOf(state);
  const isNumber = !channel.isIdentifier && !channel.isColour, isDifference = state.mode === "difference";
  byId("map-label").hidden = maps.length < 2;
  byId("comparing").hidden = others.length === 0;
  byId("incomparable").hidden = maps.length < 2 || others.length > 0;
  byId("incomparable").textContent = whyIncomparable(a, state.channel);
  byId("other-label").hidden = state.mode === "single";
  byId("measure-label").hidden = !isDifference || channel.isIdentifier;
  byId("split-label").hidden = state.mode !== "slider";
  byId("swap").hidden = state.mode !== "flicker";
  byId("scale-label").hidden = byId("colours-label").hidden = !isNumber || isDifference;
  byId("split").value = state.split;
}

/// Shows the ends of the colours; empty where they are those of the values.
export function fillRange(state, shading) {
  for (const end of ["low", "high"]) {
    byId(end).value = state[end] === null ? "" : String(state[end]);
    byId(end).placeholder = textOf(Number(shading[end].toPrecision(6)), false);
  }
}

/// `change(changes)` takes what the user chose, as part of a state.
export function listen(change) {
  const numeric = { map: true, other: true };
  const forgets = { channel: { low: null, high: null }, mode: { low: null, high: null }, measure: { low: null, high: null } };
  for (const key of ["map", "channel", "scale", "colours", "mode", "other", "measure"]) {
    byId(key).addEventListener("change", ({ target }) => change({ ...forgets[key], [key]: numeric[key] ? Number(target.value) : target.value }));
  }
  byId("split").addEventListener("input", ({ target }) => change({ split: Number(target.value) }));
  for (const end of ["low", "high"]) {
    byId(end).addEventListener("change", ({ target }) => {
      const number = target.value.trim() === "" ? null : Number(target.value);
      change({ [end]: Number.isFinite(number) ? number : null });
    });
  }
  byId("reset").addEventListener("click", () => change({ low: null, high: null }));
}
