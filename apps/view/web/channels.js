/// The maps of the page and their channels.
import { ready, remembered, segmentsOf, unpacked } from "./planes.js";

export const page = JSON.parse(document.getElementById("view").textContent);
export const background = 0, surface = 1, missing = 2, added = 3; // of a tile's mask

/// What all sources of pixels have: tiles of several levels, of which level n has every 2ⁿ-th pixel.
export class Source {
  constructor(map, key) {
    Object.assign(this, { key, width: map.width, height: map.height, levels: map.levels });
  }
  grid(level) {
    const columns = Math.ceil(this.width / 2 ** level), rows = Math.ceil(this.height / 2 ** level);
    return { columns, rows, across: Math.ceil(columns / page.tile), down: Math.ceil(rows / page.tile) };
  }
  /// How large a tile is: those at the right and at the bottom are smaller.
  sizeOf(level, number) {
    const { columns, rows, across } = this.grid(level);
    const left = number % across * page.tile, top = Math.floor(number / across) * page.tile;
    return { columns: Math.min(page.tile, columns - left), rows: Math.min(page.tile, rows - top) };
  }
  tile(level, number) {
    return remembered(`${this.key}-${level}-${number}`, () => this.made(level, number));
  }
  readyTile(level, number) { return ready(`${this.key}-${level}-${number}`); }
  /// The number of the tile of level 0 with a pixel, and the pixel's place in it.
  placeOf(x, y) {
    const { across } = this.grid(0), number = Math.floor(y / page.tile) * across + Math.floor(x / page.tile);
    return { number, place: y % page.tile * this.sizeOf(0, number).columns + x % page.tile };
  }
  /// { value, mask } of a pixel.
  async at(x, y) {
    const { number, place } = this.placeOf(x, y), tile = await this.tile(0, number);
    return { value: tile.values[place], mask: tile.mask ? tile.mask[place] : surface };
  }
  /// The values of every tile of a level, one after another.
  async* tiles(level) {
    const { across, down } = this.grid(level);
    for (let number = 0; number < across * down; ++number) yield await this.tile(level, number);
  }
}

/// A channel of a map as it is stored; `siblings` are all channels of the map.
class Channel extends Source {
  constructor(map, told, prefix, number, siblings) {
    super(map, `${prefix}-c${number}`);
    Object.assign(this, told, { prefix, siblings, camera: map.camera, scale: told.type === "u16" ? map.scale : undefined });
    this.isSingle = this.type === "f32";
    if (this.scale && this.range) this.range = this.range.map((code) => code / this.scale);
  }
  async made(level, number) {
    const size = this.sizeOf(level, number), end = `-${level}-${number}`;
    const [stored, mask] = await Promise.all([
      unpacked(this.key + end, this.type, size.columns, this.hints(level, number)),
      this.mask < 0 ? null : remembered(`${this.prefix}-k${this.mask}${end}`, async () => {
        const values = await unpacked(`${this.prefix}-k${this.mask}${end}`, "u8", size.columns);
        return { values, bytes: values.byteLength };
      })]);
    const values = this.scale ? Float64Array.from(stored, (code) => code / this.scale) : stored;
    return { ...size, values, mask: mask?.values, bytes: values.byteLength };
  }
  /// What may predict a tile of the channel: other channels of the map.
  hints(level, number) {
    const valuesOf = (channels) => Promise.all(channels.map(async (channel) => (await this.siblings[channel].tile(level, number)).values));
    const { across } = this.grid(level), step = 2 ** level;
    return {
      parts: () => valuesOf(this.unit),
      segments: () => this.siblings[this.by].segments(level, number),
      planes: async () => ({ normals: await valuesOf(this.normals), camera: this.camera, step,
        left: number % across * page.tile * step, top: Math.floor(number / across) * page.tile * step }) };
  }
  /// The segments of a tile of identifiers, which predict other channels.
  segments(level, number) {
    return remembered(`${this.key}-s-${level}-${number}`, async () => {
      const { values } = await this.tile(level, number), segments = segmentsOf(values);
      return { ...segments, bytes: segments.firsts.byteLength + segments.places.byteLength };
    });
  }
  /// What a number stands for; empty where nothing says it.
  nameOf(value) {
    if (this.isFight) return value ? "wrong" : "right";
    return value === this.none ? "none" : this.names?.[value] ?? "";
  }
}

/// The three parts of a channel of directions, which are drawn as red, green and blue.
class Directions extends Source {
  constructor(map, name, parts) {
    super(map, `${parts[0].key}-rgb`);
    const { meaning, defaults } = parts[0];
    Object.assign(this, { name, parts, meaning, defaults, isColour: true });
  }
  async made(level, number) {
    const tiles = await Promise.all(this.parts.map((part) => part.tile(level, number)));
    return { ...tiles[0], parts: tiles.map((tile) => tile.values), bytes: 0 };
  }
}

export const maps = page.maps.map((told, number) => {
  const stored = [];
  told.channels.forEach((channel, k) => stored.push(new Channel(told, channel, `m${number}`, k, stored)));
  const directions = told.directions.map(({ name, parts }) => new Directions(told, name, parts.map((k) => stored[k])));
  return { ...told, number, stored, channels: [...stored, ...directions] };
});
export const channelOf = (map, name) => map.channels.find((channel) => channel.name === name);

/// Z, or else the first channel.
export const firstChannel = (map) => channelOf(map, "Z") ?? map.channels[0];

/// The point in the world at the centre of a pixel with this planar depth, computed in binary64 as `fathom convert` does.
export function worldPoint(camera, x, y, depth) {
  const v = (y - camera.cy + camera.pixelCentre) / camera.fy;
  const u = (x - camera.cx + camera.pixelCentre - camera.skew * v) / camera.fx;
  const point = camera.orthographic ? [u, v, depth] : [u * depth, v * depth, depth];
  return camera.worldFromCamera.map((row) => row[0] * point[0] + row[1] * point[1] + row[2] * point[2] + row[3]);
}
