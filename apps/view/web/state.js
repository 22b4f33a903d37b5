/// What is shown, and its link: all of it stands in the fragment of the page's address.
import { channelOf, maps, page } from "./channels.js";

export const defaults = {
  map: 0, other: -1, mode: "single", measure: "relative", channel: "", scale: "", colours: "",
  low: null, high: null, x: null, y: null, zoom: null, pixel: null, line: null, split: 0.5 };

const words = {
  mode: ["single", "slider", "flicker", "difference"], measure: ["absolute", "relative", "ulps"],
  scale: page.scales, colours: Object.keys(page.colours) };

const listOf = (length) => (text) => {
  const numbers = text.split(",").map(Number);
  return numbers.length === length && numbers.every(Number.isInteger) ? numbers : null;
};
const number = (text) => text !== "" && Number.isFinite(Number(text)) ? Number(text) : null;
const readers = {
  map: number, other: number, low: number, high: number, x: number, y: number, zoom: number, split: number,
  pixel: listOf(2), line: listOf(4), channel: (text) => text };

const defaultsOf = ({ map, channel }) => channelOf(maps[map], channel).defaults;
/// The scale and the colours that the user chose, or those of the channel.
export const scaleOf = (state) => state.scale || defaultsOf(state).scale;
export const coloursOf = (state) => state.colours || defaultsOf(state).colours;

/// What a fragment says; what it does not say, or says wrongly, is as by default.
export function stateOf(fragment) {
  const state = { ...defaults };
  for (const [key, text] of new URLSearchParams(fragment.replace(/^#/, ""))) {
    if (words[key]?.includes(text)) state[key] = text;
    else if (readers[key]) state[key] = readers[key](text) ?? defaults[key];
  }
  return state;
}

/// The fragment, with what differs from the defaults.
export function fragmentOf(state) {
  const pairs = Object.keys(defaults).filter((key) => String(state[key]) !== String(defaults[key]))
    .map((key) => `${key}=${encodeURIComponent(rounded(key, state[key])).replaceAll("%2C", ",")}`);
  return pairs.length ? "#" + pairs.join("&") : "";
}

/// Places and zoom need no more digits than can be seen.
function rounded(key, value) {
  return ["x", "y", "zoom", "split"].includes(key) ? Number(value.toPrecision(7)) : value;
}
