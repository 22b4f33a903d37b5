/// The values of a map as the page holds them, tile by tile (apps/view/packing.h).

async function inflated(text) {
  const bytes = new Uint8Array(text.length * 7 >> 3);
  for (let k = 0, at = 0, bits = 0, count = 0; k < text.length; ++k) {
    bits |= ((text.charCodeAt(k) ^ 0x55) & 127) << count;
    count += 7;
    if (count >= 8) { bytes[at++] = bits; bits >>>= 8; count -= 8; }
  }
  // Written directly: the stream of a Blob takes twice as long.
  const { readable, writable } = new DecompressionStream("deflate"), writer = writable.getWriter();
  const [inflated] = await Promise.all([new Response(readable).arrayBuffer(), writer.write(bytes), writer.close()]);
  return new Uint8Array(inflated);
}

/// A difference of 32 bits, whose bytes begin at a place, each `count` after the previous one.
function residual(bytes, place, count) {
  const zigzag = bytes[place] | bytes[place + count] << 8 | bytes[place + 2 * count] << 16 | bytes[place + 3 * count] << 24;
  return zigzag >>> 1 ^ -(zigzag & 1);
}

const arrays = { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array };

/// Words of 32 bits, the Z of unit vectors that have these X and Y.
function unpackedThird(bytes, columns, [x, y]) {
  const count = (bytes.length - 1) / 4, words = new Uint32Array(count);
  const third = new Float32Array(1), bits = new Uint32Array(third.buffer);
  for (let k = 0; k < count; ++k) {
    const hasLeft = k % columns !== 0, left = hasLeft ? words[k - 1] : 0;
    let expected = left;
    if (!hasLeft || x[k] !== x[k - 1] || y[k] !== y[k - 1]) {
      const square = 1 - x[k] * x[k] - y[k] * y[k];
      third[0] = square > 0 ? Math.sqrt(square) : 0;
      expected = bits[0] | left & 0x80000000;
    }
    words[k] = residual(bytes, 1 + k, count) + expected;
  }
  return words;
}

const largestSingle = (2 - 2 ** -23) * 2 ** 127, isDepth = (z) => z > 0 && z <= largestSingle;

/// The numbers of a plane with the normal (a, b, c) along a ray: height = slope · depth + offset. Functions of their own: if
/// every call of unpackedDepths() made new ones, the browser would compile it again for the second tile.
const slope = (orthographic, a, b, c, u, v) => orthographic ? c : a * u + b * v + c;
const offset = (orthographic, a, b, u, v) => orthographic ? a * u + b * v : 0;

/// Depths of known planes, as words of 32 bits (apps/view/plane_prediction.h). The tile begins at the pixel (left, top) and
/// has every `step`-th one. Of this row and of the upper one, between columns of NaN, are kept: the normals in the frame of
/// the camera, the rays, the depths, and the heights of the planes.
function unpackedDepths(bytes, columns, { normals: [xs, ys, zs], camera, left, top, step }) {
  const count = (bytes.length - 1) / 4, depths = new Float32Array(count), words = new Uint32Array(depths.buffer);
  const { orthographic, fx, fy, cx, cy, skew, pixelCentre, worldFromCamera: [p, q, r] } = camera;
  const [nx, ny, nz, us, known, heights] = Array.from({ length: 6 }, () => new Float64Array(2 * columns + 4).fill(NaN));
  let next = 1, end = 1 + count; // places in `bytes`: of pixels on known planes, and of the other pixels
  for (let first = 0, here = 1, above = columns + 3, v = 0, upperV = 0; first < count; first += columns) {
    v = (top + first / columns * step - cy + pixelCentre) / fy;
    for (let column = 0; column < columns; ++column) {
      const k = first + column, at = here + column, upper = above + column, x = xs[k], y = ys[k], z = zs[k];
      const isAsLeft = column > 0 && x === xs[k - 1] && y === ys[k - 1] && z === zs[k - 1];
      const u = us[at] = (left + column * step - cx + pixelCentre - skew * v) / fx;
      if (isAsLeft && x === 0 && y === 0 && z === 0) { // no surface: such a plane predicts nothing
        nx[at] = ny[at] = nz[at] = 0;
        heights[at] = NaN;
        words[k] = words[k - 1] + residual(bytes, next++, count);
        known[at] = depths[k];
        continue;
      }
      const a = nx[at] = isAsLeft ? nx[at - 1] : p[0] * x + q[0] * y + r[0] * z;
      const b = ny[at] = isAsLeft ? ny[at - 1] : p[1] * x + q[1] * y + r[1] * z;
      const c = nz[at] = isAsLeft ? nz[at - 1] : p[2] * x + q[2] * y + r[2] * z;
      const ownSlope = slope(orthographic, a, b, c, u, v), ownOffset = offset(orthographic, a, b, u, v);
      let sum = 0, added = 0, found = 0, place = 0;
      if (nx[at - 1] === a && ny[at - 1] === b && nz[at - 1] === c) { sum += heights[at - 1]; ++added; }
      if (nx[upper] === a && ny[upper] === b && nz[upper] === c) { sum += heights[upper]; ++added; }
      if (nx[upper - 1] === a && ny[upper - 1] === b && nz[upper - 1] === c) { sum += heights[upper - 1]; ++added; }
      if (nx[upper + 1] === a && ny[upper + 1] === b && nz[upper + 1] === c) { sum += heights[upper + 1]; ++added; }
      if (added) {
        place = next++;
        found = (sum / added - ownOffset) / ownSlope;
      } else {
        place = --end;
        for (let from = at - 1, fromV = v, side = 0; side < 2; from = upper, fromV = upperV, ++side) {
          const height = slope(orthographic, a, b, c, us[from], fromV) * known[from] + offset(orthographic, a, b, us[from], fromV);
          const theirSlope = slope(orthographic, nx[from], ny[from], nz[from], u, v);
          const theirs = (heights[from] - offset(orthographic, nx[from], ny[from], u, v)) / theirSlope;
          const mean = ((height - ownOffset) / ownSlope + theirs) / 2;
          if (isDepth(mean)) { sum += mean; ++added; }
        }
        found = sum / added;
      }
      if (isDepth(found)) depths[k] = found;
      else if (column) words[k] = words[k - 1];
      else if (first) words[k] = words[k - columns];
      words[k] += residual(bytes, place, count);
      const depth = known[at] = depths[k];
      heights[at] = ownSlope * depth + ownOffset;
    }
    [here, above, upperV] = [above, here, v];
  }
  return words;
}

/// Words of 8, 16 or 32 bits.
function unpackedWords(bytes, size, columns) {
  const count = (bytes.length - 1) / size, isGradient = (bytes[0] & 3) === 1, words = new arrays[size](count);
  for (let first = 0; first < count; first += columns) {
    for (let k = first; k < first + columns; ++k) {
      let zigzag = bytes[1 + k];
      if (size > 1) zigzag |= bytes[1 + count + k] << 8;
      if (size > 2) zigzag |= bytes[1 + 2 * count + k] << 16 | bytes[1 + 3 * count + k] << 24;
      let expected = k > first ? words[k - 1] : first ? words[k - columns] : 0;
      if (isGradient && first && k > first) expected += words[k - columns] - words[k - columns - 1];
      words[k] = (zigzag >>> 1 ^ -(zigzag & 1)) + expected;
    }
  }
  return words;
}

/// Words of 64 bits, as pairs of 32 bits, the lower first.
function unpackedPairs(bytes, columns) {
  const count = (bytes.length - 1) / 8, isGradient = bytes[0] === 1, words = new Uint32Array(2 * count);
  const half = (first, k) => (bytes[1 + first * count + k] | bytes[1 + (first + 1) * count + k] << 8
    | bytes[1 + (first + 2) * count + k] << 16 | bytes[1 + (first + 3) * count + k] << 24) >>> 0;
  for (let k = 0; k < count; ++k) {
    const low = half(0, k), high = half(4, k), sign = -(low & 1);
    let lowSum = ((low >>> 1 | high << 31) ^ sign) >>> 0, highSum = (high >>> 1 ^ sign) >>> 0;
    const hasLeft = k % columns !== 0, hasUpper = k >= columns;
    const add = (from, factor) => { lowSum += factor * words[2 * from]; highSum += factor * words[2 * from + 1]; };
    if (hasLeft) add(k - 1, 1);
    else if (hasUpper) add(k - columns, 1);
    if (isGradient && hasLeft && hasUpper) { add(k - columns, 1); add(k - columns - 1, -1); }
    words[2 * k] = lowSum;
    words[2 * k + 1] = highSum + Math.floor(lowSum / 4294967296);
  }
  return words;
}

/// How the bytes of each type are read.
const types = {
  u8: { bytes: 1, values: (words) => words },
  u16: { bytes: 2, values: (words) => words },
  u32: { bytes: 4, values: (words) => words },
  f32: { bytes: 4, values: (words) => new Float32Array(words.buffer) },
  f64: { bytes: 8, values: (words) => new Float64Array(words.buffer) } };

/// How often the identifier is another than that of the pixel before.
function countRuns(identifiers) {
  let runs = 1;
  for (let k = 1; k < identifiers.length; ++k) runs += identifiers[k] === identifiers[k - 1] ? 0 : 1;
  return runs;
}

/// The first pixel of each identifier, and of each pixel the place of its identifier among these.
export function segmentsOf(identifiers) {
  const count = identifiers.length, runs = countRuns(identifiers), bits = 33 - Math.clz32(runs);
  const table = new Uint32Array(2 ** bits); // places + 1, at most half full
  const firsts = new Uint32Array(runs), places = new Uint32Array(count);
  let found = 0;
  for (let k = 0; k < count; ++k) {
    const identifier = identifiers[k];
    if (k && identifier === identifiers[k - 1]) { places[k] = places[k - 1]; continue; }
    let slot = Math.imul(identifier, 2654435769) >>> 32 - bits;
    while (table[slot] && identifiers[firsts[table[slot] - 1]] !== identifier) slot = slot + 1 & table.length - 1;
    if (!table[slot]) { firsts[found] = k; table[slot] = ++found; }
    places[k] = table[slot] - 1;
  }
  return { firsts: firsts.slice(0, found), places };
}

/// The values at these places; a loop takes a quarter of the time of `from()`.
function at(values, places) {
  const found = new values.constructor(places.length);
  for (let k = 0; k < found.length; ++k) found[k] = values[places[k]];
  return found;
}

/// `hints` has what a tile may be predicted from, as functions: `parts`, the X and Y of the unit vectors whose Z is unpacked;
/// `segments` of the tile; `planes` that its depths show.
export async function unpacked(id, type, columns, hints) {
  const bytes = await inflated(document.getElementById(id).textContent), { bytes: size, values } = types[type];
  const prediction = bytes[0] & 3, isBySegment = bytes[0] >= 4, segments = isBySegment ? await hints.segments() : null;
  const width = isBySegment ? segments.firsts.length : columns;
  const some = (all) => isBySegment ? at(all, segments.firsts) : all;
  const words = prediction === 3 ? unpackedDepths(bytes, width, await hints.planes())
    : prediction === 2 ? unpackedThird(bytes, width, (await hints.parts()).map(some))
      : size === 8 ? unpackedPairs(bytes, width) : unpackedWords(bytes, size, width);
  return values(isBySegment ? at(words, segments.places) : words);
}

/// What was unpacked last, up to so many bytes; a page of 16384 × 16384 pixels holds more than a browser has room for.
class Memory {
  constructor(limit) { this.limit = limit; this.used = 0; this.entries = new Map(); }
  get(key) {
    const entry = this.entries.get(key);
    if (entry) { this.entries.delete(key); this.entries.set(key, entry); }
    return entry;
  }
  put(key, entry, bytes) {
    entry.bytes = bytes;
    this.entries.set(key, entry);
    this.used += bytes;
    for (const [oldest, { bytes: freed }] of this.entries) {
      if (this.used <= this.limit || oldest === key) break;
      this.entries.delete(oldest);
      this.used -= freed;
    }
  }
}
const memory = new Memory(3 << 28), pending = new Map();

/// The tile that `make` returns a promise of, made once; `ready()` finds it without waiting.
export function remembered(key, make) {
  const entry = memory.get(key);
  if (entry) return Promise.resolve(entry.tile);
  if (!pending.has(key)) {
    pending.set(key, make().then((tile) => {
      memory.put(key, { tile }, tile.bytes);
      return tile;
    }).finally(() => pending.delete(key)));
  }
  return pending.get(key);
}
export const ready = (key) => memory.get(key)?.tile;
