async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
async function words(text) {
  const bytes = await unpacked(text), n = bytes.length / 4, result = new Uint32Array(n);
  for (let i = 0; i < n; ++i) result[i] = bytes[i] | bytes[n + i] << 8 | bytes[2 * n + i] << 16 | bytes[3 * n + i] << 24;
  return result;
}
const scenes = {}, maps = {};
async function sceneOf(name) {
  if (!scenes[name]) {
    const s = stored.scenes[name], bits = await words(s.depths);
    scenes[name] = { width: s.width, height: s.height, bits, depths: new Float32Array(bits.buffer), triangles: await words(s.triangles) };
  }
  return scenes[name];
}
async function mapOf(k) {
  if (!maps[k]) {
    const scene = await sceneOf(results[k].scene), bits = await words(stored.maps[k].differences);
    for (let i = 0; i < bits.length; ++i) bits[i] += scene.bits[i];
    maps[k] = { depths: new Float32Array(bits.buffer), classes: await unpacked(stored.maps[k].classes) };
  }
  return maps[k];
}

