/// Colours of values. A colour is a number, as a canvas holds it: alpha, blue, green, red from the highest byte.
import { added, background, missing, page } from "./channels.js";

const opaque = 255 * 2 ** 24;
export const rgb = (r, g, b) => opaque + Math.round(b) * 65536 + Math.round(g) * 256 + Math.round(r);
export const partsOf = (colour) => [colour & 255, colour >>> 8 & 255, colour >>> 16 & 255];
export const css = (colour) => `rgb(${partsOf(colour).join(" ")})`;
/// Whether letters on it are to be dark.
export function isLight(colour) {
  const [r, g, b] = partsOf(colour);
  return 0.299 * r + 0.587 * g + 0.114 * b > 140;
}

const tables = Object.fromEntries(Object.entries(page.colours).map(([name, digits]) => [name,
  Uint32Array.from({ length: digits.length / 6 }, (_, k) =>
    rgb(...[0, 2, 4].map((at) => parseInt(digits.slice(6 * k + at, 6 * k + at + 2), 16))))]));

/// From −1, blue, by white to 1, orange, as in the pages of `fathom validate`.
const diverging = Uint32Array.from({ length: 257 }, (_, k) => {
  const t = k / 128 - 1;
  return t < 0 ? rgb(255 + 220 * t, 255 + 150 * t, 255 + 40 * t) : rgb(255 - 40 * t, 255 - 180 * t, 255 - 215 * t);
});

const isDark = () => matchMedia("(prefers-color-scheme: dark)").matches;
/// Of pixels that have no value.
export function specialColours(colourMap) {
  const none = colourMap === "grey" ? rgb(74, 92, 122) : isDark() ? rgb(52, 59, 69)
    : colourMap === "diverging" ? rgb(150, 156, 164) : rgb(206, 210, 216);
  return { [background]: none, [missing]: isDark() ? rgb(70, 170, 100) : rgb(20, 20, 20), [added]: rgb(120, 60, 160), none: rgb(96, 96, 96),
    nan: rgb(255, 120, 0), above: rgb(230, 25, 120), below: rgb(120, 40, 200) };
}

/// The colour of an identifier, as `fathom preview` has it: hue by the golden ratio.
function colourOfIdentifier(id) {
  const hash = Math.imul(id, 2654435769) >>> 0, hue = hash / 4294967296 * 6;
  const saturation = 0.45 + 0.15 * ((hash >>> 7) % 4), value = 0.65 + 0.1 * ((hash >>> 11) % 4);
  const part = (offset) => {
    const k = (offset + hue) % 6;
    return 255 * (value - value * saturation * Math.min(1, Math.max(0, Math.min(k, 4 - k))));
  };
  return rgb(part(5), part(3), part(1));
}

const rightSurface = rgb(146, 154, 164), wrongSurface = rgb(215, 25, 28);
/// The colour of an identifier of a channel.
export function colourOfNumber(source, number, special) {
  if (source.isFight) return number ? wrongSurface : rightSurface;
  return number === source.none ? special.none : colourOfIdentifier(number);
}

/// The scales: where a value lies between the ends, 0 to 1 or beyond. Logarithms and inverses need ends above 0.
const places = {
  linear: (low, high, first = low / 2, length = high / 2 - first) => (value) => (value / 2 - first) / length,
  log: (low, high, length = Math.log(high / low)) => (value) => Math.log(value / low) / length,
  inverse: (low, high, first = 1 / low, length = first - 1 / high) => (value) => (first - 1 / value) / length };

/// The share of the sorted values that are below.
function rankIn(sorted) {
  return (value) => {
    let low = 0, high = sorted.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (sorted[middle] < value) low = middle + 1; else high = middle;
    }
    return low / Math.max(1, sorted.length - 1);
  };
}

export function placeOn(scale, low, high, sorted) {
  if (!(low < high)) return () => 0.5;
  if (scale === "equalised") return rankIn(sorted.filter((value) => value >= low && value <= high));
  return places[low > 0 ? scale : "linear"](low, high);
}

/// How the values of a source are drawn: `colour(value, mask)`, and `paint(tile)`, the colours of a tile.
export class Shading {
  constructor(source, { colours, scale, low, high }, sorted) {
    Object.assign(this, { source, low, high, special: specialColours(colours) });
    this.table = source.isDifference ? diverging : tables[colours];
    this.place = placeOn(source.isDifference ? "linear" : scale, low, high, sorted);
    this.inside = source.isIdentifier ? (id) => colourOfNumber(source, id, this.special) : (value) => this.numberColour(value);
  }
  at(t) {
    const last = this.table.length - 1;
    return this.table[Math.round(last * Math.min(1, Math.max(0, t)))];
  }
  numberColour(value) {
    if (Number.isNaN(value)) return this.special.nan;
    if (value === Infinity) return this.special.above;
    if (value === -Infinity) return this.special.below;
    return this.at(this.place(value));
  }
  colour(value, mask) { return mask === 1 ? this.inside(value) : this.special[mask]; }
  paint(tile) {
    const colours = new Uint32Array(tile.columns * tile.rows);
    if (tile.parts) {
      const byte = (k, part) => Number.isNaN(tile.parts[part][k]) ? 0 : 127.5 * (Math.min(1, Math.max(-1, tile.parts[part][k])) + 1);
      for (let k = 0; k < colours.length; ++k) {
        colours[k] = tile.mask && !tile.mask[k] ? this.special[background] : rgb(byte(k, 0), byte(k, 1), byte(k, 2));
      }
      return colours;
    }
    const { values, mask } = tile;
    for (let k = 0; k < colours.length; ++k) colours[k] = mask && mask[k] !== 1 ? this.special[mask[k]] : this.inside(values[k]);
    return colours;
  }
}
