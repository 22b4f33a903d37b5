/// What the values of a source are like: ends, counts, a histogram.

const sampleSize = 65536;

/// Of the level that is counted, the coarsest: of maps up to 4 million pixels that is every pixel.
export const countedLevel = (source) => source.levels - 1;

function count(counts, key) { counts.set(key, (counts.get(key) ?? 0) + 1); }

async function gathered(source) {
  const level = countedLevel(source), { columns, rows } = source.grid(level), pixels = columns * rows;
  const every = Math.max(1, Math.floor(pixels / sampleSize)), sample = [], ids = new Map();
  const found = { level, pixels, masks: [0, 0, 0, 0], nan: 0, above: 0, below: 0, low: Infinity, high: -Infinity, ids };
  let finite = 0;
  for await (const { values, mask } of source.tiles(level)) {
    for (let k = 0; k < values.length; ++k) {
      const kind = mask ? mask[k] : 1, value = values[k];
      ++found.masks[kind];
      if (kind !== 1) continue;
      if (source.isIdentifier) { count(ids, value); continue; }
      if (!Number.isFinite(value)) { ++found[Number.isNaN(value) ? "nan" : value > 0 ? "above" : "below"]; continue; }
      if (value < found.low) found.low = value;
      if (value > found.high) found.high = value;
      if (finite++ % every === 0) sample.push(value);
    }
  }
  found.sorted = Float64Array.from(sample).sort();
  if (source.range) [found.low, found.high] = source.range; // of all pixels
  return found;
}

const known = new Map();

/// Counted once: { pixels, masks, low, high, sorted, ids, … }; `sorted` is a sample of the finite values.
export function statisticsOf(source) {
  if (source.isColour) return Promise.resolve(null);
  if (!known.has(source.key)) known.set(source.key, gathered(source));
  return known.get(source.key);
}

/// Of several sources as of one.
export function together(all) {
  if (all.length === 1 || all.includes(null)) return all[0];
  const sum = { ...all[0], low: Math.min(...all.map((s) => s.low)), high: Math.max(...all.map((s) => s.high)) };
  sum.sorted = Float64Array.from(all.flatMap((s) => [...s.sorted])).sort();
  return sum;
}

/// How many values lie in each of `bins` equal parts of [0, 1] by `place`.
export async function histogramOf(source, place, bins) {
  const counts = new Float64Array(bins);
  for await (const { values, mask } of source.tiles(countedLevel(source))) {
    for (let k = 0; k < values.length; ++k) {
      if (mask && mask[k] !== 1 || !Number.isFinite(values[k])) continue;
      const t = place(values[k]);
      if (t >= 0 && t <= 1) ++counts[Math.min(bins - 1, Math.floor(t * bins))];
    }
  }
  return counts;
}
