/// How two channels differ, as a source of pixels: B − A, by the rule of `fathom compare`.
import { Source, added, background, missing, surface } from "./channels.js";
import { placeOfDouble, placeOfSingle } from "./numbers.js";

const steps = {
  f64: (a, b) => Number(placeOfDouble(b) - placeOfDouble(a)),
  u32: (a, b) => b - a,
  u16: (a, b) => b - a };

/// Differences of two numbers that are finite and not equal.
const differences = {
  absolute: () => (a, b) => b - a,
  relative: () => (a, b) => (b - a) / Math.max(Math.abs(a), Math.abs(b)),
  ulps: (a, b) => a.type === b.type && !a.scale && steps[a.type] || ((p, q) => placeOfSingle(q) - placeOfSingle(p)) };

/// Names of the differences in the table and in the profile.
const labels = { absolute: "B − A", relative: "(B − A) / larger", ulps: "B − A in ulps" };

export class Difference extends Source {
  constructor(map, first, second, measure) {
    super(map, `difference-${measure}-${first.key}-${second.key}`);
    Object.assign(this, { first, second, measure, name: first.name, isDifference: true });
    this.isSingle = false;
    this.label = first.isIdentifier ? "differs" : labels[measure];
    this.meaning = first.isIdentifier ? "1 where B differs from A" : `B − A, ${measure}`;
    this.between = first.isIdentifier ? (() => 1) : differences[measure](first, second);
  }
  of(a, b) {
    if (Object.is(a, b) || a === b) return 0;
    return Number.isFinite(a) && Number.isFinite(b) ? this.between(a, b) : NaN;
  }
  async made(level, number) {
    const [a, b] = await Promise.all([this.first.tile(level, number), this.second.tile(level, number)]);
    const values = new Float64Array(a.values.length), mask = new Uint8Array(values.length);
    for (let k = 0; k < values.length; ++k) {
      const inA = a.mask?.[k] ?? surface, inB = b.mask?.[k] ?? surface;
      mask[k] = inA ? inB ? surface : missing : inB ? added : background;
      if (mask[k] === surface) values[k] = this.of(a.values[k], b.values[k]);
    }
    return { columns: a.columns, rows: a.rows, values, mask, bytes: 9 * values.length };
  }
}

/// The end of the colours of a difference: 98 % of the differences that are not 0 are at most that.
export function endOfDifferences(statistics) {
  const sizes = statistics.sorted.map(Math.abs).filter((size) => size > 0).sort();
  return sizes.length ? sizes[Math.floor(0.98 * (sizes.length - 1))]
    : Math.max(Math.abs(statistics.low), Math.abs(statistics.high)) || 1;
}
