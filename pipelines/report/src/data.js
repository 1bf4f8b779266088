// The data of the page: what pipelines/report/report.cpp has written, decoded only where and when it is looked at.

const digit_of = new Uint8Array(128);
[...'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/'].forEach((c, i) => {
  digit_of[c.charCodeAt(0)] = i;
});

/** Decodes `bytes` bytes of base64 text that starts at `offset` into `out`; allocates nothing. */
export function decode_base64(text, offset, bytes, out) {
  let from = offset;
  let to = 0;
  const whole = bytes - (bytes % 3);
  while (to < whole) {
    const word =
      (digit_of[text.charCodeAt(from)] << 18) |
      (digit_of[text.charCodeAt(from + 1)] << 12) |
      (digit_of[text.charCodeAt(from + 2)] << 6) |
      digit_of[text.charCodeAt(from + 3)];
    out[to] = word >> 16;
    out[to + 1] = word >> 8;
    out[to + 2] = word;
    from += 4;
    to += 3;
  }
  if (to < bytes) {
    const a = digit_of[text.charCodeAt(from)];
    const b = digit_of[text.charCodeAt(from + 1)];
    const c = digit_of[text.charCodeAt(from + 2)];
    out[to] = (a << 2) | (b >> 4);
    if (to + 1 < bytes) {
      out[to + 1] = (b << 4) | (c >> 2);
    }
  }
}

/** Characters that `bytes` bytes take in base64, with its padding. */
const base64_length = (bytes) => 4 * Math.ceil(bytes / 3);

function decoded(text, Type) {
  const bytes = (text.length / 4) * 3 - (text.endsWith('==') ? 2 : text.endsWith('=') ? 1 : 0);
  const buffer = new ArrayBuffer(bytes);
  decode_base64(text, 0, bytes, new Uint8Array(buffer));
  return new Type(buffer);
}

/** One time history; `values` is a Float64Array with one value per frame, decoded at its first use. */
class Column {
  constructor(column, values, errors) {
    this.of = column.of;
    this.index = column.index;
    this.name = column.name;
    this.unit = column.unit;
    this.text = values;
    this.errors_text = errors ?? null;
  }
  /** Of mesh and step, one for each frame; undefined where they are not known. */
  get errors() {
    if (this.errors_text !== null) {
      this.decoded_errors = decoded(this.errors_text, Float64Array);
      this.errors_text = null;
    }
    return this.decoded_errors;
  }
  get values() {
    if (this.text !== null) {
      this.decoded = decoded(this.text, Float64Array);
      this.text = null;
    }
    return this.decoded;
  }
}

/**
 * The shapes of all beams at all frames. Each frame is one piece of base64, decoded into a buffer that is used
 * again for every frame. Of each beam with n elements it holds, one after the other:
 *   points   3 n + 1 control points (x, y, z), float32, relative to `origin`; neighbours share their end
 *   displacements 3 n + 1 (x, y, z), float32, of these points from where they are drawn, if `displaced`
 *   weights  4 n, float32, if `rational`
 *   axes     12 n, float32, if `sections`: the section's x axis d1 at u = 0, 1/3, 2/3, 1; not a number without torsion
 *   places   n + 1, float32: reference arc length s of the nodes
 *   ranges   per field 2, float32: its least and greatest value in this beam and frame
 *   fields   per field 4 n bytes: the values at u = 0, 1/3, 2/3, 1, from 0 at the least to 255 at the greatest
 */
class Shapes {
  constructor(description, text, beam_count, frame_count) {
    this.rational = description.rational;
    this.displaced = Boolean(description.displaced) && description.displacement > 0;
    this.has_displacements = Boolean(description.displaced);
    this.displacement = description.displacement ?? 0;  // the largest of the run [m]
    this.factor = 1;  // displacements are shown times this; 0 is the drawing
    this.sections = Boolean(description.sections);
    this.fields = description.fields;
    this.origin = description.origin;
    this.text = text;
    this.beam_count = beam_count;
    this.counts = decoded(description.element_counts, Uint32Array);
    this.offsets = new Float64Array(frame_count);
    let offset = 0;
    let most_bytes = 0;
    this.most_elements = new Uint32Array(beam_count);
    for (let frame = 0; frame < frame_count; ++frame) {
      let bytes = 0;
      for (let beam = 0; beam < beam_count; ++beam) {
        const n = this.count(frame, beam);
        bytes += this.bytes_of(n);
        this.most_elements[beam] = Math.max(this.most_elements[beam], n);
      }
      this.offsets[frame] = offset;
      offset += base64_length(bytes);
      most_bytes = Math.max(most_bytes, bytes);
    }
    this.bytes = new Uint8Array(most_bytes);
    this.floats = new Float32Array(this.bytes.buffer, 0, most_bytes >> 2);
    this.starts = new Uint32Array(beam_count);
    this.frame = -1;
  }
  count(frame, beam) {
    return this.counts[frame * this.beam_count + beam];
  }
  bytes_of(n) {
    return (this.has_displacements ? 8 : 4) * (3 * (3 * n + 1)) + (this.rational ? 16 * n : 0) + (this.sections ? 48 * n : 0) + 4 * (n + 1)
      + (8 + 4 * n) * this.fields.length;
  }
  /** Decodes a frame into `bytes` (also seen as `floats`), the beams from `starts` on. */
  load(frame) {
    if (frame === this.frame) {
      return;
    }
    let bytes = 0;
    for (let beam = 0; beam < this.beam_count; ++beam) {
      this.starts[beam] = bytes;
      bytes += this.bytes_of(this.count(frame, beam));
    }
    decode_base64(this.text, this.offsets[frame], bytes, this.bytes);
    this.frame = frame;
    if (this.displaced && this.factor !== 1) {
      this.exaggerate();
    }
  }
  /** Shows displacements times `factor` from now on. */
  set_factor(factor) {
    this.factor = factor;
    this.frame = -1;
  }
  exaggerate() {
    for (let beam = 0; beam < this.beam_count; ++beam) {
      const points = this.points_start(beam), numbers = 3 * (3 * this.count(this.frame, beam) + 1);
      for (let i = points; i < points + numbers; ++i) {
        this.floats[i] += (this.factor - 1) * this.floats[i + numbers];
      }
    }
  }
  /** Least and greatest coordinates of the loaded frame as it is shown, relative to the origin. */
  extent() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let beam = 0; beam < this.beam_count; ++beam) {
      const points = this.points_start(beam), numbers = 3 * (3 * this.count(this.frame, beam) + 1);
      for (let i = 0; i < numbers; ++i) {
        low[i % 3] = Math.min(low[i % 3], this.floats[points + i]);
        high[i % 3] = Math.max(high[i % 3], this.floats[points + i]);
      }
    }
    return [low, high];
  }
  displacements_start(frame, beam) {
    return this.points_start(beam) + 3 * (3 * this.count(frame, beam) + 1);
  }
  /** What `factor` adds to the position of the material at s of a beam of the loaded frame. */
  shift(beam, s) {
    if (!this.displaced || this.factor === 1) {
      return [0, 0, 0];
    }
    const moved = this.point(beam, s, this.displacements_start(this.frame, beam));
    return (moved?.r ?? [0, 0, 0]).map((d) => (this.factor - 1) * d);
  }
  points_start(beam) {
    return this.starts[beam] >> 2;
  }
  weights_start(frame, beam) {
    return this.points_start(beam) + (this.has_displacements ? 6 : 3) * (3 * this.count(frame, beam) + 1);
  }
  axes_start(frame, beam) {
    return this.weights_start(frame, beam) + (this.rational ? 4 * this.count(frame, beam) : 0);
  }
  places_start(frame, beam) {
    return this.axes_start(frame, beam) + (this.sections ? 12 * this.count(frame, beam) : 0);
  }
  /** Least and greatest value of a field in a beam of the loaded frame. */
  beam_range(frame, beam, field) {
    const at = this.places_start(frame, beam) + this.count(frame, beam) + 1 + 2 * field;
    return { min: this.floats[at], max: this.floats[at + 1] };
  }
  field_start(frame, beam, field) {
    const n = this.count(frame, beam);
    return 4 * (this.places_start(frame, beam) + n + 1 + 2 * this.fields.length) + 4 * n * field;
  }
  /** Least and greatest value of a field in all beams of the loaded frame; of its whole run where it has none there. */
  field_range(field) {
    let low = Infinity, high = -Infinity;
    for (let beam = 0; beam < this.beam_count; ++beam) {
      const { min, max } = this.beam_range(this.frame, beam, field);
      low = Math.min(low, min);
      high = Math.max(high, max);
    }
    return low <= high ? { min: low, max: high } : this.fields[field];
  }
  /**
   * Position (relative to `origin`) and tangent of a beam of the loaded frame at s; nothing where it does not reach.
   * The same of other control points than those of the beam, from `start` on.
   */
  point(beam, s, start = this.points_start(beam)) {
    const n = this.count(this.frame, beam), places = this.places_start(this.frame, beam);
    const slack = 1e-6 * (this.floats[places + n] - this.floats[places]);
    if (s < this.floats[places] - slack || s > this.floats[places + n] + slack) {
      return null;
    }
    let element = 0;
    while (element < n - 1 && this.floats[places + element + 1] <= s) { ++element; }
    const [a, b] = [this.floats[places + element], this.floats[places + element + 1]];
    const u = Math.min(Math.max((s - a) / (b - a), 0), 1), v = 1 - u;
    const basis = [v * v * v, 3 * u * v * v, 3 * u * u * v, u * u * u];
    const slopes = [-v * v, v * v - 2 * u * v, 2 * u * v - u * u, u * u];
    const point = [0, 0, 0], slope = [0, 0, 0];
    let w = 0, dw = 0;
    for (let k = 0; k < 4; ++k) {
      const weight = this.rational ? this.floats[this.weights_start(this.frame, beam) + 4 * element + k] : 1;
      const from = start + 9 * element + 3 * k;
      w += basis[k] * weight;
      dw += slopes[k] * weight;
      for (let c = 0; c < 3; ++c) {
        point[c] += basis[k] * weight * this.floats[from + c];
        slope[c] += slopes[k] * weight * this.floats[from + c];
      }
    }
    const r = point.map((x) => x / w), t = slope.map((x, c) => x - dw * r[c]), size = Math.hypot(...t) || 1;
    return { r, t: t.map((x) => x / size) };
  }
}

/** Reads the page's own data. */
export function read_data() {
  const data = JSON.parse(document.getElementById('data').textContent);
  const columns = data.columns.map((column, i) => new Column(column, data.values[i], data.errors?.[i]));
  const time = columns.find((column) => column.of === 'run' && column.name === 'time').values;
  const shapes = new Shapes(data.shapes, document.getElementById('shapes').textContent, data.names.beams.length,
    time.length);
  const column = (of, index, name) => columns.find((c) => c.of === of && c.index === index && c.name === name);
  return {
    title: data.title,
    names: data.names,
    run: data.run,
    stored_frames: data.stored_frames,
    box: data.box,
    time,
    shapes,
    column,
  };
}
