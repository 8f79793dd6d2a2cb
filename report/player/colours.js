// The colours of scales and families, as in the report's pictures.

const stops = ['F3F0E8', 'F6D9A6', 'F3B466', 'E8853B', 'CF5246', 'A02C5D', '5F1A5C'];  // as colour.cpp
const palette = ['0072B2', 'D55E00', '009E73', 'CC79A7', 'E69F00', '56B4E9', '333333'];
const rgb = hex => [0, 2, 4].map(i => parseInt(hex.replace('#', '').slice(i, i + 2), 16) / 255);

/** 256 colours between the stops, four bytes each. */
function scaleBytes() {
  const bytes = new Uint8Array(4 * 256), colours = stops.map(rgb);
  for (let i = 0; i < 256; ++i) {
    const at = i / 255 * (stops.length - 1), a = Math.min(Math.floor(at), stops.length - 2);
    bytes.set(
        [0, 1, 2].map(k => Math.round(255 * (colours[a][k] + (at - a) * (colours[a + 1][k] - colours[a][k])))), 4 * i);
    bytes[4 * i + 3] = 255;
  }
  return bytes;
}
