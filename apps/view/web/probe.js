/// The answer of `fathom probe` to a pixel, from the server of this page.
import { page } from "./channels.js";
import { byId } from "./reading.js";

async function answerAbout(map, [x, y]) {
  try {
    const reply = await fetch(`probe?map=${map.number}&x=${x}&y=${y}`);
    return reply.ok ? await reply.text() : "The server does not know this pixel.";
  } catch {
    return "The server has ended: start 'fathom view … --serve' again.";
  }
}

let probing = 0;

/// Shows it, where there is a server that can be asked.
export async function showProbe(map, pixel) {
  const mine = ++probing, answer = byId("probe");
  byId("probe-section").hidden = !page.probes;
  if (!page.probes) return;
  answer.textContent = pixel ? "probing …" : "Click on a pixel to ask why it has its value.";
  if (!pixel) return;
  const text = await answerAbout(map, pixel);
  if (mine === probing) answer.textContent = text;
}
