/// Drawing on a canvas: tiles of a source, numbers on pixels, what is marked.
import { page } from "./channels.js";
import { isLight, css } from "./colours.js";
import { textWithin } from "./numbers.js";

const numbersFrom = 34, gridFrom = 20; // CSS pixels per pixel of the map
const leastSquare = 5; // CSS pixels: a few wrong pixels of a tile are drawn at least so large
const mostCanvases = 256; // or as many as there are tiles in sight
const paintTime = 6; // milliseconds of a frame for colouring tiles, from the first on: the rest of them takes the next frames
const mostLoads = 3; // tiles that are unpacked at once: those that leave the sight meanwhile are not asked for

function coloured(shading, tile) {
  const canvas = new OffscreenCanvas(tile.columns, tile.rows), colours = shading.paint(tile);
  const bytes = new Uint8ClampedArray(colours.buffer);
  canvas.getContext("2d").putImageData(new ImageData(bytes, tile.columns, tile.rows), 0, 0);
  return canvas;
}

/// A tile as a picture of its own, remembered by the shading that coloured it; null where it is to be coloured and time is up.
/// Above `most` pictures, that which was drawn longest ago is forgotten.
function canvasOf(shading, key, tile, { isTimeUp, most }) {
  const canvases = shading.canvases ??= new Map(), known = canvases.get(key);
  if (!known && isTimeUp()) return null;
  const canvas = known ?? coloured(shading, tile);
  canvases.delete(key);
  canvases.set(key, canvas);
  if (canvases.size > most) canvases.delete(canvases.keys().next().value);
  return canvas;
}

/// Whether the time for colouring has passed; it begins with the first question, so that every frame colours a tile.
function timer() {
  let end = null;
  return () => performance.now() > (end ??= performance.now() + paintTime);
}

/// Calls `visit(number, left, top)` for the tiles of a level that are in sight; lengths in pixels of the map.
function forTiles(view, source, level, visit) {
  const { across, down } = source.grid(level), side = page.tile * 2 ** level;
  const range = (from, to, count) => [Math.max(0, Math.floor(from / side)), Math.min(count - 1, Math.floor(to / side))];
  const [firstColumn, lastColumn] = range(view.left, view.right, across), [firstRow, lastRow] = range(view.top, view.bottom, down);
  for (let row = firstRow; row <= lastRow; ++row) {
    for (let column = firstColumn; column <= lastColumn; ++column) visit(row * across + column, column * side, row * side);
  }
}

/// The level whose pixels are nearest to those of the screen, and not larger.
const levelFor = (view, source) => Math.min(source.levels - 1, Math.max(0, Math.floor(-Math.log2(view.zoom * view.ratio))));

/// The levels whose tiles are drawn, one over the other.
function levelsFor(view, source) {
  const level = levelFor(view, source), last = source.levels - 1;
  return level === last ? [level] : [last, level];
}

function countTiles(view, source, levels) {
  let count = 0;
  for (const level of levels) forTiles(view, source, level, () => ++count);
  return count;
}

/// The pixels of a tile where the wrong surface wins; empty if they are many, which can be seen without help.
function fightsOf(tile) {
  const places = [];
  tile.values.forEach((value, place) => { if (value && (!tile.mask || tile.mask[place])) places.push(place); });
  return places.length > tile.values.length / 200 ? [] : places;
}

/// Few such pixels would vanish in a picture that is smaller than the map.
function paintFights(context, view, shading, { tile, left, top, step }) {
  context.fillStyle = css(shading.colour(1, 1));
  for (const place of tile.fights ??= fightsOf(tile)) {
    const x = left + (place % tile.columns + 0.5) * step, y = top + (Math.floor(place / tile.columns) + 0.5) * step;
    context.fillRect(view.toX(x) - (leastSquare - 1) / 2, view.toY(y) - (leastSquare - 1) / 2, leastSquare, leastSquare);
  }
}

/// Draws the tiles that are there, and calls `missing(promise)` for some that are not. Until these come, tiles of the
/// coarsest level stand in for them.
export function paintTiles(context, view, { source, shading }, missing) {
  const levels = levelsFor(view, source), most = Math.max(mostCanvases, countTiles(view, source, levels));
  const limits = { isTimeUp: timer(), most };
  const drawn = [];
  let loads = 0;
  context.imageSmoothingEnabled = view.zoom * view.ratio < 1;
  for (const level of levels) {
    forTiles(view, source, level, (number, left, top) => {
      const tile = source.readyTile(level, number);
      if (!tile) {
        if (++loads <= mostLoads) missing(source.tile(level, number));
        return;
      }
      const canvas = canvasOf(shading, `${level}-${number}`, tile, limits);
      if (!canvas) { missing(Promise.resolve()); return; }
      const x = view.toX(left), y = view.toY(top);
      const right = view.toX(Math.min(source.width, left + tile.columns * 2 ** level));
      const bottom = view.toY(Math.min(source.height, top + tile.rows * 2 ** level));
      context.drawImage(canvas, x, y, right - x, bottom - y);
      drawn.push({ tile, left, top, step: 2 ** level });
    });
  }
  if (source.isFight && view.zoom < leastSquare) drawn.forEach((each) => paintFights(context, view, shading, each));
}

function forPixels(view, source, visit) {
  const lastX = Math.min(source.width - 1, Math.floor(view.right)), lastY = Math.min(source.height - 1, Math.floor(view.bottom));
  for (let y = Math.max(0, Math.floor(view.top)); y <= lastY; ++y) {
    for (let x = Math.max(0, Math.floor(view.left)); x <= lastX; ++x) visit(x, y);
  }
}

/// What stands on a pixel: its value, of directions a line for each part.
function linesOf(source, tile, place, letters) {
  if (tile.parts) return tile.parts.map((part) => textWithin(part[place], true, letters));
  return [textWithin(tile.values[place], source.isSingle, letters)];
}

/// The values, on pixels that are large enough.
export function paintNumbers(context, view, { source, shading }) {
  if (view.zoom < numbersFrom) return;
  const size = Math.min(13, Math.max(9, view.zoom / 6)), letters = Math.floor((view.zoom - 4) / (0.61 * size));
  context.font = `${size}px ui-monospace, "DejaVu Sans Mono", monospace`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  forPixels(view, source, (x, y) => {
    const { number, place } = source.placeOf(x, y), tile = source.readyTile(0, number);
    if (!tile || tile.mask && tile.mask[place] !== 1) return;
    const colour = tile.parts ? shading.paint(onePixel(tile, place))[0] : shading.colour(tile.values[place], 1);
    context.fillStyle = isLight(colour) ? "#000" : "#fff";
    const lines = linesOf(source, tile, place, letters);
    lines.forEach((line, k) => context.fillText(line, view.toX(x + 0.5), view.toY(y + 0.5) + (k - (lines.length - 1) / 2) * 1.2 * size));
  });
}

const onePixel = (tile, place) => ({ columns: 1, rows: 1, mask: tile.mask && [tile.mask[place]], parts: tile.parts.map((part) => [part[place]]) });

/// Lines between pixels that are large.
export function paintGrid(context, view, source) {
  if (view.zoom < gridFrom) return;
  context.strokeStyle = "rgb(128 128 128 / 45%)";
  context.lineWidth = 1;
  context.beginPath();
  const left = Math.max(0, Math.floor(view.left)), right = Math.min(source.width, Math.ceil(view.right));
  const top = Math.max(0, Math.floor(view.top)), bottom = Math.min(source.height, Math.ceil(view.bottom));
  for (let x = left; x <= right; ++x) { context.moveTo(view.toX(x) + 0.5, view.toY(top)); context.lineTo(view.toX(x) + 0.5, view.toY(bottom)); }
  for (let y = top; y <= bottom; ++y) { context.moveTo(view.toX(left), view.toY(y) + 0.5); context.lineTo(view.toX(right), view.toY(y) + 0.5); }
  context.stroke();
}

/// Twice, so that it can be seen on every colour.
function stroked(context, path, width) {
  for (const [style, extra] of [["#000", 2], ["#fff", 0]]) {
    context.strokeStyle = style;
    context.lineWidth = width + extra;
    context.stroke(path);
  }
}

/// A frame around a pixel.
export function paintMark(context, view, [x, y]) {
  const path = new Path2D(), grown = Math.max(0, 7 - view.zoom) / 2;
  path.rect(view.toX(x) - grown, view.toY(y) - grown, view.zoom + 2 * grown, view.zoom + 2 * grown);
  stroked(context, path, 1.5);
}

export function paintLine(context, view, [x0, y0, x1, y1]) {
  const path = new Path2D();
  path.moveTo(view.toX(x0 + 0.5), view.toY(y0 + 0.5));
  path.lineTo(view.toX(x1 + 0.5), view.toY(y1 + 0.5));
  stroked(context, path, 1.5);
}

/// The border between two maps.
export function paintDivider(context, x, height) {
  const path = new Path2D();
  path.moveTo(x, 0);
  path.lineTo(x, height);
  path.moveTo(x - 4, height / 2 - 7);
  path.lineTo(x - 10, height / 2);
  path.lineTo(x - 4, height / 2 + 7);
  path.moveTo(x + 4, height / 2 - 7);
  path.lineTo(x + 10, height / 2);
  path.lineTo(x + 4, height / 2 + 7);
  stroked(context, path, 2);
}

/// The colours by themselves, from the low end to the high one.
export const gradientOf = (shading) => "linear-gradient(to right, " +
  Array.from({ length: 33 }, (_, k) => css(shading.at(k / 32))).join(", ") + ")";
