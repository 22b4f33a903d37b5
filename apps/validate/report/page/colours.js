/// The colours of `fathom preview`, from the nearest depth to the farthest.
const depthColours = JSON.parse(byId("depth-colours").textContent);
const depthColourAt = (t) => depthColours[Math.round((depthColours.length - 1) * Math.min(1, Math.max(0, t)))];
const diverging = (t) => t < 0 ? [255 + 220 * t, 255 + 150 * t, 255 + 40 * t] : [255 - 40 * t, 255 - 180 * t, 255 - 215 * t];

function drawn(width, height, colour) {
  const canvas = element("canvas", undefined, { width, height });
  const context = canvas.getContext("2d"), image = context.createImageData(width, height);
  for (let i = 0; i < width * height; ++i) { const c = colour(i); image.data.set([c[0], c[1], c[2], 255], 4 * i); }
  context.putImageData(image, 0, 0);
  return canvas;
}
function bar(colour, low, high) {
  const stops = []; for (let k = 0; k <= 16; ++k) stops.push("rgb(" + colour(k / 16).map(Math.round).join(",") + ")");
  const box = element("div"), strip = element("div", undefined, { class: "bar" }), ends = element("div", undefined, { class: "ends" });
  strip.style.background = "linear-gradient(to right," + stops.join(",") + ")";
  ends.append(element("span", low), element("span", high)); box.append(strip, ends);
  return box;
}
function figure(caption, canvas, legend) { const f = element("figure"); f.append(element("figcaption", caption), canvas, legend); return f; }

