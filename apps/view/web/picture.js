/// The picture: what of the map is in sight, and what the pointer and the keys do with it.
import { paintDivider, paintGrid, paintLine, paintMark, paintNumbers, paintTiles } from "./painting.js";

const mostZoom = 256, clickSlop = 4, dividerSlop = 10;
const clamped = (value, low, high) => Math.min(high, Math.max(low, value));

export class Picture {
  /// `told` is called with what the user did: hover(pixel or null), select(pixel), line(line, isDone), split(share), moved().
  constructor(canvas, told) {
    Object.assign(this, { canvas, told, layers: [], centre: null, zoom: 1, selected: null, line: null, split: null });
    this.context = canvas.getContext("2d");
    this.pointers = new Map();
    new ResizeObserver(() => this.resized()).observe(canvas);
    for (const name of ["pointerdown", "pointermove", "pointerup", "pointercancel", "pointerleave"]) {
      canvas.addEventListener(name, (event) => this[name](event));
    }
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("dblclick", (event) => this.zoomAt(event.offsetX, event.offsetY, event.shiftKey ? 0.5 : 2));
  }
  get source() { return this.layers[0]?.source; }
  get width() { return this.canvas.clientWidth; }
  get height() { return this.canvas.clientHeight; }

  /// Layers are { source, shading }; with `split`, the second is drawn right of that share of the width.
  show(layers, split) {
    this.layers = layers;
    this.split = split;
    if (!this.centre) this.fit();
    this.draw();
  }

  /// All of the map; small maps enlarged by a whole factor.
  fit() {
    this.fitInto();
    this.draw();
  }
  fitInto() {
    const { source } = this;
    if (!source || !this.width) return;
    const most = Math.min(this.width / source.width, this.height / source.height);
    this.isFitted = true;
    this.centre = [source.width / 2, source.height / 2];
    this.zoom = most > 1 ? Math.floor(Math.min(most, mostZoom)) : most;
  }
  look(x, y, zoom) {
    this.isFitted = false;
    this.centre = [x, y];
    this.zoom = clamped(zoom, this.leastZoom(), mostZoom);
    this.draw();
  }
  leastZoom() { return this.source ? Math.min(1, 0.5 * Math.min(this.width / this.source.width, this.height / this.source.height)) : 0.01; }

  view() {
    const { width, height, zoom, centre: [x, y] } = this, left = x - width / 2 / zoom, top = y - height / 2 / zoom;
    return { zoom, ratio: devicePixelRatio, left, top, right: left + width / zoom, bottom: top + height / zoom,
      toX: (u) => Math.round((u - left) * zoom), toY: (v) => Math.round((v - top) * zoom) };
  }
  pixelAt(x, y) {
    const { left, top, zoom } = this.view(), pixel = [Math.floor(left + x / zoom), Math.floor(top + y / zoom)];
    return pixel[0] >= 0 && pixel[1] >= 0 && pixel[0] < this.source.width && pixel[1] < this.source.height ? pixel : null;
  }
  /// Of a place beside the map, the nearest pixel.
  nearestPixel(x, y) {
    const { left, top, zoom } = this.view();
    return [clamped(Math.floor(left + x / zoom), 0, this.source.width - 1), clamped(Math.floor(top + y / zoom), 0, this.source.height - 1)];
  }

  draw() {
    this.frame ??= requestAnimationFrame(() => { this.frame = null; this.drawNow(); });
  }
  drawNow() {
    const { canvas, context, layers } = this, ratio = devicePixelRatio;
    const width = Math.round(this.width * ratio), height = Math.round(this.height * ratio);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, width, height);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    if (!layers.length || !this.centre) return;
    const view = this.view(), border = this.split === null ? null : Math.round(this.split * this.width);
    let isWhole = true;
    layers.forEach((layer, k) => {
      context.save();
      if (border !== null) {
        context.beginPath();
        context.rect(k ? border : 0, 0, k ? this.width - border : border, this.height);
        context.clip();
      }
      paintTiles(context, view, layer, (promise) => {
        isWhole = false;
        promise.then(() => this.draw());
      });
      paintNumbers(context, view, layer);
      context.restore();
    });
    paintGrid(context, view, this.source);
    if (border !== null) paintDivider(context, border, this.height);
    if (this.line) paintLine(context, view, this.line);
    if (this.selected) paintMark(context, view, this.selected);
    if (isWhole && !this.wasWhole) performance.mark("picture"); // for scripts/dev/measure-view
    this.wasWhole ||= isWhole;
  }
  /// Draws in this frame. One later, the browser would have stretched the old picture to the new size.
  resized() {
    if (this.isFitted) this.fitInto();
    this.drawNow();
  }

  zoomAt(x, y, factor) {
    const { left, top, zoom } = this.view(), u = left + x / zoom, v = top + y / zoom;
    const next = clamped(zoom * factor, this.leastZoom(), mostZoom);
    this.look(u - (x - this.width / 2) / next, v - (y - this.height / 2) / next, next);
    this.told.moved();
  }
  zoomBy(factor) { this.zoomAt(this.width / 2, this.height / 2, factor); }
  pan(dx, dy) {
    this.look(this.centre[0] - dx / this.zoom, this.centre[1] - dy / this.zoom, this.zoom);
    this.told.moved();
  }

  pointerdown(event) {
    if (event.button !== 0 || !this.source) return;
    this.canvas.setPointerCapture(event.pointerId);
    const at = { x: event.offsetX, y: event.offsetY };
    this.pointers.set(event.pointerId, at);
    this.pressed = { ...at, moved: false, action: "pan" };
    if (this.split !== null && Math.abs(at.x - this.split * this.width) < dividerSlop) this.pressed.action = "split";
    else if (event.shiftKey || this.drawsLine) Object.assign(this.pressed, { action: "line", from: this.nearestPixel(at.x, at.y) });
  }
  pointermove(event) {
    if (!this.source) return;
    const before = this.pointers.get(event.pointerId), at = { x: event.offsetX, y: event.offsetY };
    if (!before) { this.told.hover(this.pixelAt(at.x, at.y)); return; }
    if (this.pointers.size === 2) { this.pinched(event.pointerId, before, at); return; }
    if (Math.hypot(at.x - this.pressed.x, at.y - this.pressed.y) > clickSlop) this.pressed.moved = true;
    if (!this.pressed.moved) return;
    this.pointers.set(event.pointerId, at);
    if (this.pressed.action === "pan") this.pan(at.x - before.x, at.y - before.y);
    else if (this.pressed.action === "split") this.told.split(clamped(at.x / this.width, 0, 1));
    else this.told.line([...this.pressed.from, ...this.nearestPixel(at.x, at.y)], false);
  }
  pinched(id, before, at) {
    const [other] = [...this.pointers].filter(([each]) => each !== id).map(([, place]) => place);
    const distance = (place) => Math.hypot(place.x - other.x, place.y - other.y);
    this.pressed.moved = true;
    this.pressed.action = "pan";
    this.pointers.set(id, at);
    this.pan((at.x - before.x) / 2, (at.y - before.y) / 2);
    this.zoomAt((at.x + other.x) / 2, (at.y + other.y) / 2, distance(at) / Math.max(1, distance(before)));
  }
  pointerup(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    const { moved, action, from } = this.pressed, at = [event.offsetX, event.offsetY];
    if (moved && action === "line") this.told.line([...from, ...this.nearestPixel(...at)], true);
    else if (!moved && this.pixelAt(...at)) this.told.select(this.pixelAt(...at), "pointer");
  }
  pointercancel(event) { this.pointers.delete(event.pointerId); }
  pointerleave() { if (!this.pointers.size) this.told.hover(null); }
  wheel(event) {
    event.preventDefault();
    if (this.source) this.zoomAt(event.offsetX, event.offsetY, Math.exp(-clamped(event.deltaY * (event.deltaMode ? 30 : 1), -240, 240) / 240));
  }

  /// The selected pixel moves with the arrows, and stays in sight.
  keydown(event) {
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }, step = steps[event.key];
    if (!step || event.ctrlKey || event.metaKey || event.altKey || !this.source) return;
    event.preventDefault();
    const far = event.shiftKey ? 10 : 1;
    const [x, y] = this.selected ?? [Math.floor(this.centre[0]) - step[0], Math.floor(this.centre[1]) - step[1]];
    const pixel = [clamped(x + far * step[0], 0, this.source.width - 1), clamped(y + far * step[1], 0, this.source.height - 1)];
    const { left, top, right, bottom } = this.view();
    if (pixel[0] < left || pixel[0] + 1 > right || pixel[1] < top || pixel[1] + 1 > bottom) {
      this.look(pixel[0] + 0.5, pixel[1] + 0.5, this.zoom);
      this.told.moved();
    }
    this.told.select(pixel, "key");
  }
}
