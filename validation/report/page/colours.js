function viridis(t) {
  const c = [[0.2777,0.0054,0.3341],[0.1051,1.4046,1.3846],[-0.3309,0.2148,0.0951],[-4.6342,-5.7991,-19.3324],[6.2283,14.1799,56.6906],[4.7764,-13.7451,-65.353],[-5.4355,4.6459,26.3124]];
  const rgb = [0, 0, 0];
  for (let k = 6; k >= 0; --k) for (let j = 0; j < 3; ++j) rgb[j] = rgb[j] * t + c[k][j];
  return rgb.map((x) => Math.round(255 * Math.min(1, Math.max(0, x))));
}
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

