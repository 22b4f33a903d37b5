/// The page: one state, and all parts that show it.
import { maps } from "./channels.js";
import { Flicker, shownBy } from "./comparison.js";
import { fillControls, fillRange, listen, mended, shortNames } from "./controls.js";
import { showSamples } from "./deep.js";
import { Histogram } from "./histogram.js";
import { Picture } from "./picture.js";
import { showProbe } from "./probe.js";
import { Profile } from "./profile.js";
import { byId, showReading } from "./reading.js";
import { fragmentOf, scaleOf, stateOf } from "./state.js";

let state = mended(stateOf(location.hash)), shown = null, turns = 0, hovered = null;

const picture = new Picture(byId("picture"), {
  hover(pixel) { hovered = pixel; read(); },
  select(pixel, by) {
    state.pixel = picture.selected = pixel;
    hovered = null;
    picture.draw();
    remember();
    showProbe(maps[state.map], pixel);
    read().then((text) => { if (by === "key" && text) byId("said").textContent = text; });
  },
  line(line, isDone) {
    state.line = picture.line = line;
    picture.draw();
    if (!isDone) return;
    picture.drawsLine = false;
    showLineButton();
    profile.show(line, shown.sources);
    remember();
  },
  split(share) { change({ split: share }); },
  moved() { lookedAt(); } });
const profile = new Profile(byId("profile"));
const histogram = new Histogram(byId("histogram"), (low, high) => change({ low, high }));
const flicker = new Flicker((showsOther) => {
  byId("badge").textContent = showsOther ? "B" : "A";
  showLayers(showsOther);
});

function read() {
  if (!shown) return Promise.resolve("");
  const map = maps[state.map], pixel = hovered ?? state.pixel;
  showSamples(map, pixel);
  return showReading(map, pixel, shown.sources);
}

/// The link to what is seen, a moment after the last change: browsers count how often it changes.
let linking = null;
function remember() {
  clearTimeout(linking);
  linking = setTimeout(() => history.replaceState(null, "", fragmentOf(state) || location.pathname + location.search), 150);
}
function lookedAt() {
  const [x, y] = picture.centre;
  Object.assign(state, picture.isFitted ? { x: null, y: null, zoom: null } : { x, y, zoom: picture.zoom });
  remember();
}

function showLayers(showsOther) {
  const { layers } = shown;
  if (state.mode === "slider") picture.show(layers, state.split);
  else picture.show([layers[showsOther ? 1 : 0]], null);
}

/// Shows the state: the picture first, then what takes longer.
async function showAll() {
  const mine = ++turns;
  fillControls(state);
  const next = await shownBy(state);
  if (mine !== turns) return;
  shown = next;
  const { source, counting, shading, sources } = shown;
  picture.selected = state.pixel;
  picture.line = state.line;
  if (state.mode === "flicker") { if (!flicker.isRunning) flicker.start(); } else flicker.stop();
  byId("badge").hidden = state.mode !== "flicker";
  showLayers(flicker.showsOther);
  fillRange(state, shading);
  read();
  profile.show(state.line, sources);
  const statistics = await counting;
  if (mine !== turns) return;
  await histogram.show(source, statistics, shading, scaleOf(state));
  if (mine === 1) performance.mark("histogram"); // for scripts/dev/measure-view
  document.documentElement.dataset.ready = mine; // for tests
}

function change(changes) {
  const isSizeKept = !("map" in changes) || maps[changes.map]?.width === maps[state.map].width && maps[changes.map]?.height === maps[state.map].height;
  state = mended({ ...state, ...changes });
  if ("map" in changes) showProbe(maps[state.map], state.pixel);
  remember();
  if (!isSizeKept) { picture.centre = null; Object.assign(state, { x: null, y: null, zoom: null }); }
  if (Object.keys(changes).join() === "split" && shown) { fillControls(state); showLayers(false); return; }
  showAll();
}

const showLineButton = () => byId("draw-line").setAttribute("aria-pressed", String(Boolean(picture.drawsLine)));
function zoomTo(zoom) {
  const [x, y] = hovered ?? state.pixel ?? picture.centre;
  picture.look(x + 0.5, y + 0.5, zoom);
  lookedAt();
}
const actions = {
  fit() { picture.fit(); lookedAt(); },
  whole() { picture.look(...picture.centre, 1); lookedAt(); },
  closer() { picture.zoomBy(2); },
  farther() { picture.zoomBy(0.5); },
  "numbers-view"() { zoomTo(64); },
  swap() { clearInterval(flicker.timer); flicker.swap(); },
  "draw-line"() { picture.drawsLine = !picture.drawsLine; showLineButton(); },
  "no-line"() { picture.line = null; change({ line: null }); },
  async link() {
    clearTimeout(linking);
    const address = location.href.split("#")[0] + fragmentOf(state);
    history.replaceState(null, "", address);
    try { await navigator.clipboard.writeText(address); byId("said").textContent = "link copied"; }
    catch { byId("said").textContent = "the address of the page is the link"; }
    byId("link").textContent = "Copied";
    setTimeout(() => { byId("link").textContent = "Copy link"; }, 1200);
  },
  help() { byId("keys").showModal(); } };
for (const [id, act] of Object.entries(actions)) byId(id)?.addEventListener("click", act);

/// The next entry of a list of choices, or the one before.
function step(id, by) {
  const select = byId(id), next = select.options[select.selectedIndex + by];
  if (!next || select.closest("[hidden]")) return;
  select.value = next.value;
  select.dispatchEvent(new Event("change"));
}
const keys = { "+": "closer", "=": "closer", "-": "farther", 0: "fit", 1: "whole", n: "numbers-view", p: "draw-line", l: "link", "?": "help", b: "swap" };
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input, select, dialog")) return;
  if (event.key.startsWith("Arrow")) { if (!event.target.closest("pre")) picture.keydown(event); return; }
  if (event.key === "[" || event.key === "]") step("channel", event.key === "[" ? -1 : 1);
  else if (event.key === "Escape") { picture.drawsLine = false; showLineButton(); }
  else if (keys[event.key] === "swap" && state.mode !== "flicker") return;
  else if (keys[event.key]) actions[keys[event.key]]();
  else return;
  event.preventDefault();
});
addEventListener("hashchange", () => {
  state = mended(stateOf(location.hash));
  place();
  showAll();
  showProbe(maps[state.map], state.pixel);
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", showAll);

function place() {
  if (state.zoom !== null && state.x !== null && state.y !== null) picture.look(state.x, state.y, state.zoom);
  else picture.centre = null;
}

/// The names of a few maps; a report has dozens.
const heading = (names) => names.length > 3 ? `${names[0]} and ${names.length - 1} more maps` : names.join(", ");

const [{ width, height }] = maps;
byId("title").textContent = heading(shortNames());
document.title = `${byId("title").textContent} – Fathom`;
byId("size").textContent = maps.every((map) => map.width === width && map.height === height) ? `${width} × ${height}` : "";
globalThis.fathom = { maps, state: () => state }; // for the console and for tests
listen(change);
place();
showAll();
showProbe(maps[state.map], state.pixel);
