/// The values along a line, as a plot.
import { surface } from "./channels.js";
import { short } from "./numbers.js";
import { byId } from "./reading.js";

const mostSamples = 4096, margin = { left: 58, right: 8, top: 8, bottom: 22 };
const styles = [["--first", []], ["--second", [5, 3]]];

/// The pixels of a line, one for each step along its longer side; of very long lines fewer.
function pixelsOn([x0, y0, x1, y1]) {
  const count = Math.min(mostSamples, Math.max(Math.abs(x1 - x0), Math.abs(y1 - y0)) + 1), last = Math.max(1, count - 1);
  return Array.from({ length: count }, (_, k) => [Math.round(x0 + (x1 - x0) * k / last), Math.round(y0 + (y1 - y0) * k / last)]);
}

async function valuesOn(source, pixels) {
  const read = await Promise.all(pixels.map(([x, y]) => source.at(x, y)));
  return read.map(({ value, mask }) => mask === surface && Number.isFinite(value) ? value : NaN);
}

/// Round numbers between two others, about five.
function marksBetween(low, high) {
  const rough = (high - low) / 6, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough), marks = [];
  for (let mark = Math.ceil(low / step) * step; mark <= high + step / 1e6; mark += step) marks.push(Math.abs(mark) < step / 1e6 ? 0 : mark);
  return marks;
}

export class Profile {
  constructor(canvas) {
    this.canvas = canvas;
    new ResizeObserver(() => this.draw()).observe(canvas);
    canvas.addEventListener("pointermove", (event) => this.point(event));
  }

  /// `sources` as the reading has them; null hides the plot.
  async show(line, sources) {
    const mine = this.line = line, section = byId("profile-section");
    section.hidden = !line;
    if (!line) return;
    const pixels = pixelsOn(line);
    const curves = await Promise.all(sources.filter(({ source }) => !source.isColour).map(async ({ name, source }) =>
      ({ name, values: await valuesOn(source, pixels) })));
    if (mine !== this.line) return;
    Object.assign(this, { pixels, curves });
    byId("profile-said").textContent = `from pixel ${line[0]}, ${line[1]} to ${line[2]}, ${line[3]}` +
      (curves.length > 1 ? `: ${curves[0].name} in full, ${curves[1].name} dashed` : "");
    this.draw();
  }

  plot() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const finite = this.curves.flatMap(({ values }) => values.filter((value) => !Number.isNaN(value)));
    let low = Math.min(...finite), high = Math.max(...finite);
    if (low === high) { const pad = Math.abs(low) / 100 || 1; low -= pad; high += pad; }
    const last = Math.max(1, this.pixels.length - 1);
    return { low, high, width, height, isEmpty: !finite.length,
      toX: (k) => margin.left + k / last * (width - margin.left - margin.right),
      toY: (value) => height - margin.bottom - (value - low) / (high - low) * (height - margin.top - margin.bottom) };
  }

  draw() {
    const { canvas } = this, ratio = devicePixelRatio, context = canvas.getContext("2d");
    Object.assign(canvas, { width: Math.round(canvas.clientWidth * ratio), height: Math.round(canvas.clientHeight * ratio) });
    if (!this.curves?.length || !canvas.clientWidth) return;
    const plot = this.plot(), colour = (name) => getComputedStyle(canvas).getPropertyValue(name);
    context.scale(ratio, ratio);
    context.font = "11px system-ui, sans-serif";
    context.fillStyle = colour("--dim");
    if (plot.isEmpty) { context.fillText("no surface along this line", margin.left, plot.height / 2); return; }
    context.strokeStyle = colour("--line");
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const mark of marksBetween(plot.low, plot.high)) {
      const y = plot.toY(mark);
      context.strokeRect(margin.left, y, plot.width - margin.left - margin.right, 0);
      context.fillText(short(mark, 6), margin.left - 5, y);
    }
    context.textBaseline = "bottom";
    context.textAlign = "left";
    context.fillText(this.pixels[0].join(", "), margin.left, plot.height);
    context.textAlign = "right";
    context.fillText(this.pixels.at(-1).join(", "), plot.width - margin.right, plot.height);
    this.curves.forEach(({ values }, k) => {
      context.strokeStyle = colour(styles[k][0]);
      context.setLineDash(styles[k][1]);
      context.lineWidth = 1.5;
      context.beginPath();
      values.forEach((value, at) => {
        if (Number.isNaN(value)) return;
        const isFirst = at === 0 || Number.isNaN(values[at - 1]);
        context[isFirst ? "moveTo" : "lineTo"](plot.toX(at), plot.toY(value));
        if (isFirst) context.lineTo(plot.toX(at) + 0.5, plot.toY(value));
      });
      context.stroke();
    });
  }

  point(event) {
    if (!this.curves?.length) return;
    const share = (event.offsetX - margin.left) / (this.canvas.clientWidth - margin.left - margin.right);
    const at = Math.round(Math.min(1, Math.max(0, share)) * (this.pixels.length - 1));
    byId("profile-value").textContent = `${this.pixels[at].join(", ")}: ` +
      this.curves.map(({ name, values }) => (this.curves.length > 1 ? name + " " : "") + (Number.isNaN(values[at]) ? "–" : short(values[at], 9))).join(", ");
  }
}
