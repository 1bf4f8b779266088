// Time histories as small SVG pictures with one common cursor, and fields along the beams.
import { line_style } from './colours.js';
import { element, number, number_beside, readable_unit, round_down } from './format.js';
import { carried_round_off, energy_parts, round_off_of } from './tables.js';

const height = 150, right = 14, top = 10, bottom = 24;

/** Round values between low and high, about `wanted` of them. */
export function ticks(low, high, wanted) {
  const span = high - low;
  let step = round_down(span / wanted);
  if (span / step > 1.9 * wanted) {
    step = round_down(2.5 * step);
  }
  const values = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * span; ++k) {
    values.push(k * step);
  }
  return { step, values };
}

/** Labels with as many decimals as the step needs, the unit that they are in and how much of the SI unit it is. */
function labels_of({ step, values }, si_unit) {
  const { unit, factor } = readable_unit(Math.max(...values.map(Math.abs), step), si_unit);
  const decimals = Math.max(0, -Math.floor(Math.log10(step / factor) + 1e-9));
  return {
    unit,
    factor,
    texts: values.map((value) => (value / factor).toFixed(Math.min(decimals, 12)).replace('-', '−')),
  };
}

/** The width of what stands left of the axis, of which a character takes at most 6.5 pixels. */
const margin_of = (texts) => Math.max(58, 10 + Math.ceil(6.5 * Math.max(...texts.map((text) => text.length))));

/** Least and greatest value of all series; a margin where they are (nearly) equal. */
function range_of(series) {
  let low = Infinity, high = -Infinity;
  for (const { values } of series) {
    for (const value of values) {
      if (value < low) { low = value; }
      if (value > high) { high = value; }
    }
  }
  if (low > high) {
    return [0, 1];
  }
  const least_span = 1e-9 * Math.max(Math.abs(low), Math.abs(high)) || 1;
  if (high - low < least_span) {
    return [low - least_span, high + least_span];
  }
  const margin = 0.04 * (high - low);
  return [low - margin, high + margin];
}

/**
 * The path of a history. Where many frames share a pixel only the first, least, greatest and last of them are drawn,
 * which gives the same picture. A gap where values are not numbers; `steps`: constant up to each frame.
 */
function path_of(time, values, x_of, y_of, pixels, steps) {
  let path = '';
  let pen_up = true;
  const add = (i) => {
    if (Number.isNaN(values[i])) {
      pen_up = true;
      return;
    }
    const x = x_of(time[i]).toFixed(2), y = y_of(values[i]).toFixed(2);
    path += pen_up ? `M${x} ${y}` : steps ? `V${y}H${x}` : `L${x} ${y}`;
    pen_up = false;
  };
  const frames = time.length;
  const per_pixel = frames / pixels;
  if (per_pixel <= 2) {
    for (let i = 0; i < frames; ++i) {
      add(i);
    }
    return path;
  }
  for (let p = 0; p < pixels; ++p) {
    const from = Math.floor(p * per_pixel), to = Math.min(Math.floor((p + 1) * per_pixel), frames);
    let least = from, greatest = from;
    for (let i = from; i < to; ++i) {
      if (values[i] < values[least]) { least = i; }
      if (values[i] > values[greatest]) { greatest = i; }
    }
    const drawn = [...new Set([from, Math.min(least, greatest), Math.max(least, greatest), to - 1])];
    drawn.forEach(add);
  }
  return path;
}

/** The area within the errors of a history, cut off where the plot ends. */
function band_of(time, values, errors, x_of, y_of) {
  const edge = (i, sign) => {
    const y = y_of(values[i] + sign * errors[i]);
    return `${x_of(time[i]).toFixed(1)} ${Math.min(Math.max(y, top), height - bottom).toFixed(1)}`;
  };
  const known = [...time.keys()].filter((i) => !Number.isNaN(values[i]) && !Number.isNaN(errors[i]));
  const every = Math.max(1, Math.floor(known.length / 1000));
  const some = known.filter((_, k) => k % every === 0 || k === known.length - 1);
  return some.length < 2 ? '' : `M${some.map((i) => edge(i, 1)).join('L')}L${some.reverse().map((i) => edge(i, -1)).join('L')}Z`;
}

/**
 * Axes, their ticks and labels, for a width in pixels; x_of and y_of turn values into pixels, of which x starts at `left`.
 * `unit` is what the labels of y are in, `factor` how much of the SI unit it is.
 */
function axes(svg, width, [start, end], [low, high], x_unit, y_unit) {
  const y_ticks = ticks(low, high, 4), y_labels = labels_of(y_ticks, y_unit), left = margin_of(y_labels.texts);
  const x_of = (x) => left + ((x - start) / (end - start)) * (width - left - right);
  const y_of = (value) => height - bottom - ((value - low) / (high - low)) * (height - bottom - top);
  svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
  svg.setAttribute('width', width);
  const x_ticks = ticks(start, end, Math.max(2, Math.floor(width / 90))), x_labels = labels_of(x_ticks, x_unit);
  const parts = [];
  y_ticks.values.forEach((value, i) => {
    const y = y_of(value).toFixed(1);
    parts.push(element('svg:line', { class: value === 0 ? 'zero' : 'gridline', x1: left, x2: width - right, y1: y, y2: y }),
      element('svg:text', { x: left - 6, y, dy: '0.35em', 'text-anchor': 'end' }, y_labels.texts[i]));
  });
  const { unit } = x_labels, xs = x_ticks.values.map(x_of), last = xs.length - 1;
  const at_end = xs[last] > width - right - 12, digit = 6.5;
  const room = width - 2 - xs[last] - (x_labels.texts[last].length / 2 + 1) * digit;
  const fits = at_end || room >= unit.length * digit;  // else the unit takes the place of the last number
  xs.forEach((at, i) => {
    const x = at.toFixed(1), ends = at_end && i === last;
    parts.push(element('svg:line', { class: 'tick', x1: x, x2: x, y1: height - bottom, y2: height - bottom + 4 }),
      element('svg:text', { x: ends ? width - 2 : x, y: height - 7, 'text-anchor': ends ? 'end' : 'middle' },
        i < last || fits ? x_labels.texts[i] + (ends ? ` ${unit}` : '') : ''));
  });
  if (!at_end) {
    parts.push(element('svg:text', { x: width - 2, y: height - 7, 'text-anchor': 'end' }, unit));
  }
  parts.push(element('svg:line', { class: 'axis', x1: left, x2: width - right, y1: height - bottom, y2: height - bottom }));
  return { parts, left, x_of, y_of, unit: y_labels.unit, factor: y_labels.factor };
}

/** A line and a name, for the key of a plot. */
const key_of = (name, style, reading) => element('li', {}, element('svg:svg', { class: 'swatch', viewBox: '0 0 26 8',
  'aria-hidden': 'true' }, element('svg:line', { x1: 0, x2: 26, y1: 4, y2: 4, style: `stroke: ${style.colour}`,
  'stroke-dasharray': style.dash })), element('span', { class: 'key' }, name), reading);

export class Plot {
  /**
   * series: [{ name, values, style }]; marks: { mesh: [times], body: [{ time, text }] };
   * pick(time) is called when the reader points at a time.
   */
  constructor({ title, unit, series, steps = false, time_unit = 's' }, time, marks, pick) {
    this.title = title;
    this.time_unit = time_unit;
    this.unit = unit;
    this.series = series;
    this.largest = 0;
    this.steps = steps;
    this.time = time;
    this.marks = marks;
    series.forEach((one, i) => { one.style = line_style(one.style ?? i); });
    this.svg = element('svg:svg', { class: 'plot', role: 'img', height });
    this.cursor = element('svg:line', { class: 'cursor', y1: top - 4, y2: height - bottom });
    this.keys = series.map((one) => {
      const reading = element('data', { class: 'reading' });
      return { reading, item: key_of(one.name, one.style, reading) };
    });
    this.shown_unit = element('span', { class: 'unit' });
    this.element = element('figure', { class: 'card plot-card' },
      element('figcaption', {}, element('span', { class: 'plot-title' }, title), ' ', this.shown_unit),
      element('ul', { class: 'keys' }, ...this.keys.map(({ item }) => item)), this.svg);
    const follow = (event) => {
      const box = this.svg.getBoundingClientRect();
      const [start, end] = [time[0], time[time.length - 1]];
      const part = (event.clientX - box.left - this.left) / (box.width - this.left - right);
      pick(start + Math.min(Math.max(part, 0), 1) * (end - start));
    };
    this.svg.addEventListener('pointerdown', (event) => {
      this.svg.setPointerCapture(event.pointerId);
      follow(event);
    });
    this.svg.addEventListener('pointermove', (event) => {
      if (event.buttons & 1) {
        follow(event);
      }
    });
  }

  /** Takes other values in place of those it has, in the order of its series. */
  set_values(values) {
    this.series.forEach((one, i) => { one.values = values[i]; });
    const { width } = this;
    this.width = undefined;
    this.layout(width);
    this.read(this.frame ?? 0);
  }

  /** Draws for a width in pixels. */
  layout(width) {
    if (width === this.width || width < 120) {
      return;
    }
    this.width = width;
    const { time, svg } = this;
    const [low, high] = range_of(this.series);
    this.largest = Math.max(Math.abs(low), Math.abs(high));
    const [start, end] = [time[0], time[time.length - 1]];
    const { parts, left, x_of, y_of, unit, factor } = axes(svg, width, [start, end], [low, high], this.time_unit, this.unit);
    this.shown_unit.textContent = unit ? `[${unit}]` : '';
    this.factor = factor;
    this.left = left;
    this.x_of = x_of;
    parts.push(element('svg:path', { class: 'mesh-marks',
      d: this.marks.mesh.map((t) => `M${x_of(t).toFixed(1)} ${height - bottom}v-5`).join('') }));
    for (const { time: t, text } of this.marks.body) {
      const x = x_of(t).toFixed(1);
      parts.push(element('svg:line', { class: 'body-mark', x1: x, x2: x, y1: top, y2: height - bottom },
        element('svg:title', {}, text)));
    }
    for (const { values, style, errors, in_doubt } of this.series.filter((one) => one.errors)) {
      parts.push(element('svg:path', { class: 'band', style: in_doubt ? null : `fill: ${style.colour}`,
        d: band_of(time, values, errors, x_of, y_of) }));
    }
    for (const { values, style } of this.series) {
      parts.push(element('svg:path', { class: 'history', style: `stroke: ${style.colour}`, 'stroke-dasharray': style.dash,
        d: path_of(time, values, x_of, y_of, Math.round(width - left - right), this.steps) }));
    }
    svg.replaceChildren(...parts, this.cursor);
    svg.setAttribute('aria-label', `${this.title} [${this.unit}] from ${number(start)} to ${number(end)} ${this.time_unit}: `
      + this.series.map(({ name, values }) => `${name} ends at ${number(values[values.length - 1])}`).join(', '));
    this.move_cursor(this.frame ?? 0);
    this.read(this.frame ?? 0);
  }

  move_cursor(frame) {
    this.frame = frame;
    if (this.x_of) {
      this.cursor.setAttribute('transform', `translate(${this.x_of(this.time[frame]).toFixed(1)} 0)`);
    }
  }

  read(frame) {
    this.keys.forEach(({ reading }, i) => {
      const value = this.series[i].values[frame];
      reading.value = Number.isNaN(value) ? '' : value;
      reading.textContent = number_beside(value / (this.factor ?? 1), this.largest / (this.factor ?? 1));
    });
  }
}

/** A field over the reference arc length of the beams, in the shown frame. */
export class AlongPlot {
  constructor(data) {
    this.data = data;
    const { shapes, names } = data;
    this.svg = element('svg:svg', { class: 'plot', role: 'img', height });
    this.select = element('select', { id: 'along-field', 'aria-label': 'What is shown along the beams' },
      ...shapes.fields.map(({ name }, i) => element('option', { value: i }, name)));
    this.shown_unit = element('span', { class: 'unit' });
    this.readings = names.beams.map(() => element('data', { class: 'reading' }));
    this.styles = names.beams.map((_, i) => line_style(i));
    this.element = element('figure', { class: 'card plot-card', 'data-plot': 'along' },
      element('figcaption', {}, this.select, ' ', this.shown_unit),
      element('ul', { class: 'keys' }, ...names.beams.map((name, i) => key_of(name, this.styles[i], this.readings[i]))), this.svg);
    const wanted = ['bending moment', 'axial force'].map((name) => shapes.fields.findIndex((f) => f.name === name));
    this.select.value = wanted.find((i) => i >= 0) ?? 0;
    this.select.addEventListener('change', () => this.layout(this.width, true));
    this.frame = 0;
  }

  layout(width, again = false) {
    if ((width === this.width && !again) || width < 120) {
      return;
    }
    this.width = width;
    const { data: { shapes }, svg } = this;
    this.field = Number(this.select.value);
    const { name, unit, min, max } = shapes.fields[this.field];
    let end = 0;
    shapes.load(this.frame);
    for (let beam = 0; beam < shapes.beam_count; ++beam) {
      const first = shapes.places_start(this.frame, beam), n = shapes.count(this.frame, beam);
      end = Math.max(end, shapes.floats[first + n]);
    }
    // One scale for the whole run: a curve that grows is seen to grow.
    const { parts, x_of, y_of, unit: shown, factor } = axes(svg, width, [0, end], range_of([{ values: [min, max] }]), 'm', unit);
    this.shown_unit.textContent = shown ? `[${shown}]` : '';
    this.factor = factor;
    this.x_of = x_of;
    this.y_of = y_of;
    this.paths = this.styles.map((style) => element('svg:path',
      { class: 'history', style: `stroke: ${style.colour}`, 'stroke-dasharray': style.dash }));
    svg.replaceChildren(...parts, ...this.paths);
    svg.setAttribute('aria-label', `${name} [${unit}] over the reference arc length of the beams`);
    this.show(this.frame);
  }

  show(frame) {
    this.frame = frame;
    if (!this.x_of) {
      return;
    }
    const { shapes } = this.data;
    shapes.load(frame);
    const { min, max } = shapes.fields[this.field];
    const largest = Math.max(Math.abs(min), Math.abs(max));
    this.paths.forEach((path, beam) => {
      const n = shapes.count(frame, beam), places = shapes.places_start(frame, beam);
      const values = shapes.field_start(frame, beam, this.field);
      const { min: low, max: high } = shapes.beam_range(frame, beam, this.field);
      let d = '', at_low = 0, at_high = 0, least = 256, greatest = -1;
      for (let i = 0; i < 4 * n; ++i) {
        const a = shapes.floats[places + (i >> 2)], b = shapes.floats[places + (i >> 2) + 1];
        const s = a + ((b - a) * (i & 3)) / 3, byte = shapes.bytes[values + i];
        d += `${i ? 'L' : 'M'}${this.x_of(s).toFixed(1)} ${this.y_of(low + ((high - low) * byte) / 255).toFixed(1)}`;
        if (byte < least) { least = byte; at_low = s; }
        if (byte > greatest) { greatest = byte; at_high = s; }
      }
      path.setAttribute('d', d);
      const text = (value, s) => `${number_beside(value / this.factor, largest / this.factor, 4)} at ${number(s, 4)} m`;
      this.readings[beam].value = `${low} ${high}`;
      this.readings[beam].textContent = `${text(low, at_low)} … ${text(high, at_high)}`;
    });
  }
}

/** The name of an object of histories. */
function name_of({ names }, of, index) {
  return { probe: names.probes, body: names.bodies, beam: names.beams, reaction: names.reactions,
    connector: names.connectors }[of]?.[index] ?? of;
}

/** Whether the error of a history is no bound at its end. */
const is_in_doubt = (run, quantity) => (run?.accuracy?.quantities ?? []).some((one) => one.quantity === quantity && one.not_converged);

/** What there is to plot of a run; nothing is read before it is drawn. */
export function plots_of(data, at_rest = false) {
  const { names, time } = data;
  const values = (of, index, name) => data.column(of, index, name).values;
  // With the errors of a history; in doubt where they are no bound.
  const with_errors = (of, index, name, series) => {
    const errors = data.column(of, index, name)?.errors;
    return errors ? { ...series, errors, in_doubt: is_in_doubt(data.run, `${name_of(data, of, index)}.${name}`) } : series;
  };
  const length_of = (of, index, parts) => {
    const vectors = parts.map((name) => values(of, index, name));
    return Float64Array.from(time, (_, i) => Math.hypot(...vectors.map((v) => v[i])));
  };
  const points = [...names.bodies.map((name, index) => ({ of: 'body', name, index })),
    ...names.probes.map((name, index) => ({ of: 'probe', name, index }))];
  // Of a model in a plane of two coordinates the third one does not move.
  const across = (data.run?.model?.plane_normal ?? []).findIndex((part) => Math.abs(part) > 1 - 1e-9);
  const parts = ['x', 'y', 'z'].filter((_, k) => k !== across);
  const plots = points.map(({ of, name, index }) => ({
    title: `Position of ${name}`, unit: 'm', id: `${of}-${index}-position`, is_position: true,
    series: parts.map((part) => with_errors(of, index, part, { name: part, values: values(of, index, part) })),
  }));
  if (points.length && !at_rest) {
    plots.push({ title: 'Speed', unit: 'm/s', id: 'speed',
      series: points.map(({ of, name, index }) => (
        with_errors(of, index, 'speed', { name, values: length_of(of, index, ['vx', 'vy', 'vz']) }))) });
  }
  const of_bodies = (title, unit, id, key) => {
    const series = names.bodies.map((name, i) => with_errors('body', i, key, { name, values: data.column('body', i, key)?.values }))
      .filter(({ values: known }) => known?.some((value) => !Number.isNaN(value)));
    if (series.length) {
      plots.push({ title, unit, id, series });
    }
  };
  // What hangs on connectors alone has no place on a beam.
  const sliding = names.bodies.map((name, i) => ({ name, i })).filter(({ i }) => values('body', i, 's').some((s) => !Number.isNaN(s)));
  if (sliding.length) {
    plots.push({ title: 'Place on the beam s', unit: 'm', id: 's',
      series: sliding.map(({ name, i }) => with_errors('body', i, 's', { name, values: values('body', i, 's') })) });
    plots.push({ title: 'Joint force', unit: 'N', id: 'joint-force',
      series: sliding.map(({ name, i }) => with_errors('body', i, 'joint_force.x',
        { name, values: length_of('body', i, ['joint_force.x', 'joint_force.y', 'joint_force.z']) })) });
  }
  of_bodies('Friction', 'N', 'friction', 'friction_force');
  if (names.connectors?.length) {
    plots.push({ title: 'Force of the connectors', unit: 'N', id: 'connector-force',
      series: names.connectors.map((name, i) => with_errors('connector', i, 'force', { name, values: values('connector', i, 'force') })) });
  }
  // A rigid guide has no length to change and carries nothing.
  const beams = names.beams.map((name, i) => ({ name, i })).filter(({ i }) => !data.run?.model?.beams?.[i]?.rigid);
  if (beams.length) {
    plots.push({ title: 'Length of the beam', unit: 'm', id: 'length',
      series: beams.map(({ name, i }) => with_errors('beam', i, 'length', { name, values: values('beam', i, 'length') })) });
  }
  if (names.reactions.length) {
    plots.push({ title: 'Reactions', unit: 'N', id: 'reactions',
      series: names.reactions.map((name, i) => with_errors('reaction', i, 'fx', { name, values: length_of('reaction', i, ['fx', 'fy', 'fz']) })) });
  }
  const along = (title, unit, id, of_beams, of_probes) => {
    const series = beams.flatMap(({ name, i }) => of_beams.map(([key, word]) => (
      with_errors('beam', i, key, { name: word ? `${name}, ${word}` : name, values: values('beam', i, key) }))));
    if (of_probes && beams.length) {
      series.push(...names.probes.map((name, i) => with_errors('probe', i, of_probes, { name, values: values('probe', i, of_probes) })));
    }
    const round_off = Math.max(round_off_of(data.run, unit),
      ...(data.run?.model?.beams ?? []).map((beam) => carried_round_off(beam, unit)));
    const there = series.filter((one) => one.values.some((value) => !Number.isNaN(value)));
    if (there.every((one) => one.values.every((value) => !(Math.abs(value) > round_off)))) {
      for (const one of there) { one.values = one.values.map((value) => 0 * value); }
    }
    if (there.length) {
      plots.push({ title, unit, id, series: there });
    }
  };
  along('Axial force', 'N', 'axial-force', [['axial_force.min', 'least'], ['axial_force.max', 'greatest']], 'axial_force');
  along('Bending moment', 'N m', 'moment', [['moment.max', 'largest']], 'moment');
  along('Stress', 'Pa', 'stress', [['stress.max', 'largest']], 'stress');
  if (data.shapes.sections) {
    along('Torque', 'N m', 'torque', [['torque.max', 'largest']], 'torque');
    along('Twist from the drawing', 'rad', 'twist', [['twist.max', 'largest']], 'twist');
    along('Von Mises stress', 'Pa', 'von-mises', [['von_mises.max', 'largest']], 'von_mises');
  }
  along('Displacement from the drawing', 'm', 'displacement', [['displacement.max', 'largest']], null);
  plots.push({ title: 'Energy', unit: 'J', id: 'energy',
    series: energy_parts(data).map((name) => with_errors('energy', 0, name, { name, values: values('energy', 0, name) })) });
  if (at_rest) {
    return plots;
  }
  const total = values('energy', 0, 'total');
  plots.push({ title: 'Change of the total energy', unit: 'J', id: 'energy-change',
    series: [{ name: 'total − start', values: total.map((e) => e - total[0]), style: 5 }] });
  plots.push({ title: 'Step size', unit: 's', id: 'step', steps: true,
    series: [{ name: 'step', values: values('run', 0, 'step') }] });
  return plots;
}
