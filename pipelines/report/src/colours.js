// Colour maps that stay distinct for colour-blind readers.

// viridis (matplotlib, CC0) and ColorBrewer's RdBu (Apache-2.0) reversed, its middle darkened to stay visible on white.
const viridis = ['440154', '482878', '3e4989', '31688e', '26828e', '1f9e89', '35b779', '6ece58', 'b5de2b', 'fde725'];
const blue_red = ['174a86', '2f79b5', '75b0d6', 'b9c3cb', 'e0937c', 'cb4a42', '8e0f26'];

const channel = (hex, i) => parseInt(hex.slice(2 * i, 2 * i + 2), 16);

/** 256 colours, RGBA bytes. */
function table(stops) {
  const bytes = new Uint8Array(4 * 256);
  for (let k = 0; k < 256; ++k) {
    const place = (k / 255) * (stops.length - 1);
    const i = Math.min(Math.floor(place), stops.length - 2);
    for (let c = 0; c < 3; ++c) {
      bytes[4 * k + c] = Math.round(channel(stops[i], c) * (1 - place + i) + channel(stops[i + 1], c) * (place - i));
    }
    bytes[4 * k + 3] = 255;
  }
  return bytes;
}

/**
 * How a field is coloured whose values go from min to max: `low` and `high` are the values at the ends of the map.
 * Fields of both signs get a diverging map that is symmetric about zero.
 */
export function field_colours({ min, max }) {
  const largest = Math.max(-min, max);
  const both_signs = min < -0.01 * largest && max > 0.01 * largest;
  return both_signs
    ? { low: -largest, high: largest, stops: blue_red, table: table(blue_red) }
    : { low: min, high: max, stops: viridis, table: table(viridis) };
}

export const css_gradient = (stops) => `linear-gradient(to right, ${stops.map((s) => '#' + s).join(', ')})`;

/** Seven line styles: colours are CSS variables of both schemes, dashes tell them apart without colour. */
const dashes = ['', '7 3', '2 2.5', '9 3 2 3', '5 2 1.5 2 1.5 2', '12 4', '1 3 6 3'];
export const line_style = (i) => ({ colour: `var(--line-${i % dashes.length})`, dash: dashes[i % dashes.length] });
