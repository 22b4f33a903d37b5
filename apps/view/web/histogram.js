/// The histogram, which is the legend too: its bars have the colours of their values.
import { added, background, missing } from "./channels.js";
import { colourOfNumber, css, placeOn } from "./colours.js";
import { short, counted, percentage } from "./numbers.js";
import { gradientOf } from "./painting.js";
import { byId, element } from "./reading.js";
import { histogramOf } from "./statistics.js";

const bins = 160, mostListed = 24;

/// Values by the place on the axis, the inverse of placeOn().
function valueOn(scale, low, high) {
  if (scale === "log" && low > 0) return (t) => low * (high / low) ** t;
  if (scale === "inverse" && low > 0) return (t) => 1 / (1 / low - t * (1 / low - 1 / high));
  return (t) => low + t * (high - low);
}

function entry(colour, text) {
  const line = element("li"), key = element("span", "", { class: "key" });
  key.style.background = css(colour);
  line.append(key, text);
  return line;
}

/// What is not a plain value, with how many pixels there are.
function listSpecials(list, statistics, shading) {
  const { masks, pixels, nan, above, below } = statistics, { special } = shading;
  const add = (colour, name, count) => { if (count) list.append(entry(colour, `${name} (${percentage(count, pixels)})`)); };
  add(special[background], "no surface", masks[background]);
  add(special[missing], "surface in A only", masks[missing]);
  add(special[added], "surface in B only", masks[added]);
  add(special.above, "+∞", above);
  add(special.below, "−∞", below);
  add(special.nan, "not a number", nan);
}

/// The identifiers, the most frequent first.
function listIdentifiers(list, source, statistics, shading) {
  const all = [...statistics.ids].sort((a, b) => b[1] - a[1]);
  for (const [id, count] of all.slice(0, mostListed)) {
    const name = source.nameOf(id), isNone = id === source.none;
    list.append(entry(colourOfNumber(source, id, shading.special), `${isNone ? name : name ? id + "  " + name : id} (${percentage(count, statistics.pixels)})`));
  }
  if (source.isFight && statistics.ids.has(1)) list.append(element("li", "a few wrong pixels are drawn larger", { class: "dim" }));
  if (all.length > mostListed) list.append(element("li", `and ${all.length - mostListed} more`, { class: "dim" }));
}

const directions = [[255, 128, 128, "+x"], [0, 128, 128, "−x"], [128, 255, 128, "+y"], [128, 0, 128, "−y"], [128, 128, 255, "+z"], [128, 128, 0, "−z"]];

export class Histogram {
  /// `take(low, high)` is called with a range that the user drew; null, null: all values.
  constructor(canvas, take) {
    Object.assign(this, { canvas, take });
    canvas.addEventListener("pointerdown", (event) => this.begin(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.end(event));
    canvas.addEventListener("dblclick", () => take(null, null));
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  async show(source, statistics, shading, scale) {
    const list = element("ul"), hasNumbers = statistics && !source.isIdentifier && statistics.low <= statistics.high;
    Object.assign(this, { source, statistics, shading, counts: null, drag: null });
    byId("numbers").hidden = !hasNumbers;
    if (!statistics) for (const [r, g, b, name] of directions) list.append(entry(r + 256 * g + 65536 * b, name));
    else {
      if (source.isIdentifier) listIdentifiers(list, source, statistics, shading);
      listSpecials(list, statistics, shading);
    }
    byId("legend").replaceChildren(...list.children);
    if (!hasNumbers) return;
    const { low, high } = statistics, axis = scale === "equalised" || source.isDifference ? "linear" : scale;
    this.valueAt = valueOn(axis, low, high);
    this.placeOf = placeOn(axis, low, high, statistics.sorted);
    byId("ends").replaceChildren(element("span", short(low)), element("span", short(high)));
    byId("bar").style.background = gradientOf(shading);
    const mine = this.shading, counts = await histogramOf(source, this.placeOf, bins);
    if (mine !== this.shading) return;
    this.counts = counts;
    this.draw();
    const level = statistics.level ? `one of ${2 ** statistics.level} × ${2 ** statistics.level} pixels: ` : "";
    byId("histogram-said").textContent = `${level}${counted(statistics.masks[1], "value")}; heights are square roots of counts`;
  }

  draw() {
    const { canvas, counts, shading } = this, ratio = devicePixelRatio, { clientWidth: width, clientHeight: height } = canvas;
    Object.assign(canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    if (!counts || !width) return;
    const context = canvas.getContext("2d"), most = Math.sqrt(Math.max(...counts)) || 1, step = width / bins;
    const outline = new Path2D(), style = (name) => getComputedStyle(canvas).getPropertyValue(name);
    context.scale(ratio, ratio);
    counts.forEach((count, k) => {
      const tall = count ? Math.max(1, Math.sqrt(count) / most * (height - 2)) : 0, left = Math.floor(k * step), right = Math.ceil((k + 1) * step);
      context.fillStyle = css(shading.colour(this.valueAt((k + 0.5) / bins), 1));
      context.fillRect(left, height - tall, right - left, tall);
      outline.lineTo(left, height - tall);
      outline.lineTo(right, height - tall);
    });
    context.strokeStyle = style("--line"); // bars may have the colour of the paper
    context.stroke(outline);
    context.fillStyle = style("--shade");
    const [from, to] = this.drag ?? [shading.low, shading.high].map((end) => this.placeOf(end) * width);
    context.fillRect(0, 0, Math.max(0, from), height);
    context.fillRect(Math.min(width, to), 0, Math.max(0, width - to), height);
  }

  begin(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.from = event.offsetX;
  }
  move(event) {
    const t = Math.min(1, Math.max(0, event.offsetX / this.canvas.clientWidth));
    if (this.valueAt) byId("histogram-value").textContent = short(this.valueAt(t));
    if (this.from === undefined || Math.abs(event.offsetX - this.from) < 3) return;
    this.drag = [Math.min(this.from, event.offsetX), Math.max(this.from, event.offsetX)];
    this.draw();
  }
  end() {
    if (this.drag) this.take(...this.drag.map((x) => Number(short(this.valueAt(Math.min(1, Math.max(0, x / this.canvas.clientWidth))), 6))));
    this.drag = null;
    this.from = undefined;
  }
}
