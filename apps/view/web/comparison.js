/// What is drawn: one map, two side by side or in turns, or their difference.
import { channelOf, maps } from "./channels.js";
import { Shading } from "./colours.js";
import { Difference, endOfDifferences } from "./difference.js";
import { coloursOf, scaleOf } from "./state.js";
import { statisticsOf, together } from "./statistics.js";

/// Whether B can be laid upon A: it has the same size, and the channel.
export const isComparable = (a, b, channel) => a !== b && a.width === b.width && a.height === b.height && Boolean(channelOf(b, channel));

/// The sources of a state, A first, each with a name.
function sourcesOf(state) {
  const a = maps[state.map], b = maps[state.other], first = channelOf(a, state.channel);
  if (state.mode === "single" || !b) return [{ name: first.name, source: first }];
  return [["A", first], ["B", channelOf(b, state.channel)]].map(([name, source]) => ({ name: `${name}: ${state.channel}`, source }));
}

/// The ends of the colours, unless the user chose them: those of all values, which the page knows without their pixels. Errors
/// in diverging colours are white where they are 0.
function endsOf(sources, state) {
  const [{ source: first }] = sources;
  if (first.isColour) return [0, 1];
  const ranges = sources.map(({ source }) => source.range ?? [Infinity, -Infinity]);
  const low = Math.min(...ranges.map(([least]) => least)), high = Math.max(...ranges.map(([, greatest]) => greatest));
  if (!first.isError || coloursOf(state) !== "diverging") return [low, high];
  const end = Math.max(Math.abs(low), Math.abs(high));
  return [-end, end];
}
const rangeOf = (state, [low, high]) => ({ low: state.low ?? low, high: state.high ?? high });

/// { layers, sources, source, counting, shading }: what the picture, the reading and the histogram show. `counting` is a
/// promise of the statistics: they need all tiles, and the colours do so only if the values settle them.
export async function shownBy(state) {
  const sources = sourcesOf(state);
  if (state.mode === "difference" && sources.length > 1 && !sources[0].source.isColour) {
    const source = new Difference(maps[state.map], sources[0].source, sources[1].source, state.measure);
    const statistics = await statisticsOf(source), end = endOfDifferences(statistics);
    const shading = new Shading(source, { ...state, ...rangeOf(state, [-end, end]) }, statistics.sorted);
    return { layers: [{ source, shading }], sources: [...sources, { name: source.label, source }], source, counting: statistics, shading };
  }
  const { source } = sources[0], counting = Promise.all(sources.map((each) => statisticsOf(each.source))).then(together);
  const settings = { ...state, scale: scaleOf(state), colours: coloursOf(state), ...rangeOf(state, endsOf(sources, state)) };
  const sorted = settings.scale === "equalised" ? (await counting)?.sorted : null;
  const layers = sources.map((each) => ({ source: each.source, shading: new Shading(each.source, settings, sorted) }));
  return { layers, sources, source, counting, shading: layers[0].shading };
}

/// Shows A and B in turns; by hand only where the user wants no motion.
export class Flicker {
  constructor(turn) { Object.assign(this, { turn, showsOther: false, timer: null }); }
  start() {
    this.stop();
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) this.timer = setInterval(() => this.swap(), 600);
  }
  swap() { this.showsOther = !this.showsOther; this.turn(this.showsOther); }
  stop() { clearInterval(this.timer); this.timer = null; this.showsOther = false; }
  get isRunning() { return this.timer !== null; }
}
