/// The values of a map as the page holds them, tile by tile (apps/view/packing.h).

async function inflated(text) {
  const bytes = new Uint8Array(text.length * 7 >> 3);
  for (let k = 0, at = 0, bits = 0, count = 0; k < text.length; ++k) {
    bits |= ((text.charCodeAt(k) ^ 0x55) & 127) << count;
    count += 7;
    if (count >= 8) { bytes[at++] = bits; bits >>>= 8; count -= 8; }
  }
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
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
    const zigzag = bytes[1 + k] | bytes[1 + count + k] << 8 | bytes[1 + 2 * count + k] << 16 | bytes[1 + 3 * count + k] << 24;
    words[k] = (zigzag >>> 1 ^ -(zigzag & 1)) + expected;
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

/// The first pixel of each identifier, and of each pixel the place of its identifier among these.
export function segmentsOf(identifiers) {
  const count = identifiers.length, bits = 33 - Math.clz32(count), table = new Uint32Array(2 ** bits); // places + 1
  const firsts = new Uint32Array(count), places = new Uint32Array(count);
  let found = 0;
  for (let k = 0; k < count; ++k) {
    const identifier = identifiers[k];
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

/// `parts` are the X and Y of the unit vectors whose Z is unpacked, `segments` those of the tile; both may be missing.
export async function unpacked(id, type, columns, parts, segments) {
  const bytes = await inflated(document.getElementById(id).textContent), { bytes: size, values } = types[type];
  const isBySegment = bytes[0] >= 4, width = isBySegment ? segments.firsts.length : columns;
  const some = (all) => isBySegment ? at(all, segments.firsts) : all;
  const words = (bytes[0] & 3) === 2 ? unpackedThird(bytes, width, parts.map(some))
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
