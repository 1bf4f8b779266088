// The page: picture, time, plots and tables, and what links them.
import { css_gradient } from './colours.js';
import { read_data } from './data.js';
import { element, number, readable_unit } from './format.js';
import { start_exaggeration } from './exaggeration.js';
import { critical_table, modes_of, modes_table, speeds_plot, start_modes } from './modes.js';
import { Player, speeds } from './player.js';
import { AlongPlot, Plot, plots_of } from './plots.js';
import { accuracy_line, collector_tables, diagnostics_list, energy_table, events_table, evidence_table, extremes_table, model_tables, run_tables, values_tables } from './tables.js';
import { View } from './view.js';

const $ = (id) => document.getElementById(id);
const data = read_data();
const { time, run } = data;
const has_modes = modes_of(run).length > 0;
const is_static = time.length === 1 || has_modes;
const is_load_steps = run?.model?.analysis === 'static' && !is_static;  // time is the load factor
const time_unit = is_load_steps ? '' : 's';
const events = run?.events ?? [];

const has_nothing_along = data.shapes.fields.every(({ min, max }) => min === 0 && max === 0);  // of straight guides

let view = null;
let plots = [];
let along = null;
let choose_colours = () => {};
let last_reading = 0;
const player = new Player(time, show);

/** Shows the player's frame everywhere. While it plays, numbers change ten times a second: enough to read them. */
function show() {
  const { frame, playing } = player;
  view?.show(frame);
  if ($('instant').checked) {
    choose_colours();
  }
  for (const plot of plots) {
    plot.move_cursor(frame);
  }
  along?.show(frame);
  const now = performance.now();
  if (!playing || now - last_reading > 100) {
    last_reading = now;
    show_numbers(frame);
  }
}

function show_numbers(frame) {
  for (const plot of plots) {
    plot.read(frame);
  }
  const text = is_load_steps ? `load × ${time[frame].toFixed(time_decimals)}` : `${time[frame].toFixed(time_decimals)} s`;
  $('time').textContent = text;
  $('slider').value = frame;
  $('slider').setAttribute('aria-valuetext', text);
  $('slider').style.setProperty('--part', frame / Math.max(player.last, 1));
  $('play').setAttribute('aria-label', player.playing ? 'Pause' : 'Play');
  $('play').classList.toggle('playing', player.playing);
  const counts = data.shapes.counts;
  let elements = 0;
  for (let beam = 0; beam < data.shapes.beam_count; ++beam) {
    elements += counts[frame * data.shapes.beam_count + beam];
  }
  $('element-count').textContent = `${elements} elements`;
}

const is_drawing = run?.status === 'drawn';  // of a model that has not run
const duration = time[time.length - 1] - time[0];
const time_decimals = is_static ? 0
  : Math.min(9, Math.max(0, Math.ceil(-Math.log10(duration / (time.length - 1)) - 1e-9)));

function set_header() {
  $('title').textContent = data.title;
  if (!run) {
    return;
  }
  const done = run.status === 'done';
  $('status').textContent = done ? 'done' : is_drawing ? 'as drawn' : run.accuracy ? 'not as right as asked' : 'ended early';
  $('status').classList.toggle('early', !done && !is_drawing);
  $('status').title = run.status;
  const warnings = run.diagnostics.filter(({ severity }) => severity !== 'note').length;
  const facts = [is_drawing ? 'nothing is computed yet' : has_modes ? `${modes_of(run).length} modes` : is_static ? 'static equilibrium'
    : is_load_steps ? `static equilibrium, loads times ${number(time[0])} to ${number(time[time.length - 1])}` : `${number(time[0])} to ${number(time[time.length - 1])} s`,
    is_static ? null : `${time.length} frames`,
    warnings ? `${warnings} warning${warnings > 1 ? 's' : ''}` : null, `nurbeam ${run.nurbeam}`];
  $('facts').textContent = facts.filter(Boolean).join(' · ');
}

function set_notes() {
  const notes = [];
  if (run && run.status !== 'done' && !is_drawing) {
    notes.push(run.accuracy ? `Not as right as was asked: ${run.status}` : `The run ended early: ${run.status}`);
  }
  if (accuracy_line(run)) {
    notes.push(accuracy_line(run));
  }
  if (data.stored_frames > time.length) {
    notes.push(`This page holds ${time.length} of the ${data.stored_frames} stored frames, evenly chosen; `
      + 'histories.csv and results.nc hold all of them.');
  }
  $('notes').append(...notes.map((text) => element('p', { class: 'card notice' }, text)));
}

/** What the beams are coloured by at first: in statics their stress, where there is any; modes by the displacement. */
function first_field(fields) {
  const of = (...names) => names.map((name) => fields.findIndex((field) => field.name === name && (field.min !== 0 || field.max !== 0)))
    .find((i) => i >= 0) ?? 0;
  if (is_drawing) {
    return of('curvature');
  }
  if (has_modes) {
    return of('displacement');
  }
  return is_static || is_load_steps ? of('stress', 'bending moment', 'axial force') : of('speed');
}

function start_view() {
  try {
    view = new View($('canvas'), $('overlay'), data);
  } catch (error) {
    // The tables and plots are of use without a picture.
    $('stage').classList.add('broken');
    $('stage').append(element('p', { class: 'notice' }, `No 3-D picture: ${error.message}`));
    return;
  }
  const fields = data.shapes.fields;
  $('field').append(...fields.map(({ name }, i) => element('option', { value: i }, name)));
  $('field').value = first_field(fields);
  choose_colours = () => {
    if (fields.length === 0) {
      return;  // there are no beams to colour
    }
    const { name, unit } = fields[$('field').value];
    const of_shape = has_modes && name === 'displacement';  // which is of any amplitude
    const { low, high, stops } = view.set_field(Number($('field').value), has_modes || $('instant').checked);
    $('legend-bar').style.background = css_gradient(stops);
    const { unit: shown, factor } = of_shape ? { unit: 'of the largest', factor: high }
      : readable_unit(Math.max(Math.abs(low), Math.abs(high)), unit);
    const texts = [low, (low + high) / 2, high].map((value) => number(value / factor, 4));
    ['legend-low', 'legend-middle', 'legend-high'].forEach((id, i) => { $(id).textContent = texts[i]; });
    $('legend-unit').textContent = shown;
  };
  for (const id of ['field', 'instant']) {
    $(id).addEventListener('change', choose_colours);
  }
  choose_colours();
  $('legend').hidden = has_nothing_along;
  $('loads-choice').hidden = !run?.model?.loads?.length;
  for (const button of document.querySelectorAll('[data-view]')) {
    button.addEventListener('click', () => view.set_view(button.dataset.view));
  }
  $('fit').addEventListener('click', () => view.fit());
  $('sections').parentElement.hidden = !view.has_sections;
  const heights = view.suited_heights;
  if (heights > 1) {
    $('heights-choice').hidden = false;
    $('heights-name').textContent = `Heights × ${heights}`;
    $('heights').addEventListener('change', () => view.set_heights($('heights').checked ? heights : 1));
    view.set_heights(heights);
  }
  $('start-choice').hidden = is_static && !data.shapes.displaced;
  $('start-name').textContent = data.shapes.displaced ? 'Drawn shape' : 'Start shape';
  const options = { paths: 'show_paths', nodes: 'show_nodes', start: 'show_start', loads: 'show_loads', sections: 'show_sections' };
  for (const [id, method] of Object.entries(options)) {
    $(id).addEventListener('change', () => view[method]($(id).checked));
    view[method]($(id).checked);
  }
  $('names').addEventListener('change', () => $('overlay').classList.toggle('no-names', !$('names').checked));
  $('canvas').addEventListener('keydown', (event) => {
    if (event.key === 'f') {
      view.fit();
      return;
    }
    const moves = { ArrowLeft: [-20, 0], ArrowRight: [20, 0], ArrowUp: [0, -20], ArrowDown: [0, 20] };
    if (event.shiftKey && moves[event.key]) {
      view.view.orbit(...moves[event.key]);
    } else if (event.key === '+' || event.key === '=') {
      view.view.zoom(1.25);
    } else if (event.key === '-') {
      view.view.zoom(0.8);
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
    view.moved();
  });
  const follow_scheme = () => view.set_scheme();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', follow_scheme);
  // Paper gets a copy of the picture in the light scheme and the paper's size, whatever the screen has.
  const set_printed = (printed) => {
    document.documentElement.classList.toggle('printed', printed);
    view.set_scheme();
    view.resize();
  };
  addEventListener('beforeprint', () => {
    set_printed(true);
    const copy = $('print-picture');
    copy.width = $('canvas').width;
    copy.height = $('canvas').height;
    copy.getContext('2d').drawImage($('canvas'), 0, 0);
  });
  addEventListener('afterprint', () => set_printed(false));
}

function start_player() {
  if (has_modes) {
    start_modes(data, view, $, () => choose_colours());
    $('instant').closest('label').hidden = true;
    return;
  }
  if (is_static) {
    $('transport').hidden = true;
    for (const label of document.querySelectorAll('.of-time')) {
      label.hidden = true;
    }
    return;
  }
  $('slider').max = player.last;
  $('slider').addEventListener('input', () => {
    player.playing = false;
    player.go(Number($('slider').value));
  });
  $('play').addEventListener('click', () => player.toggle());
  $('speed').append(...speeds.map((speed) => element('option', { value: speed },
    speed < 1 ? `1/${Math.round(1 / speed)} ×` : `${speed} ×`)));
  $('speed').value = player.speed;
  $('speed').addEventListener('change', () => { player.speed = Number($('speed').value); });
  $('loop').addEventListener('change', () => { player.loop = $('loop').checked; });
  document.addEventListener('keydown', on_key);
}

/** Keys of time, unless a control has its own use for them. */
function on_key(event) {
  const { target } = event;
  if (event.ctrlKey || event.metaKey || event.altKey || target.closest('select, .scroll, .table-card')) {
    return;
  }
  const is_slider = target === $('slider');
  const has_own_space = target.closest('button, input, a') && !is_slider;
  const step = event.shiftKey ? 10 : 1;
  const actions = {
    ' ': has_own_space ? null : () => player.toggle(),
    ArrowLeft: () => player.go(player.frame - step),
    ArrowRight: () => player.go(player.frame + step),
    Home: () => player.go(0),
    End: () => player.go(player.last),
  };
  const action = actions[event.key];
  if (action) {
    event.preventDefault();
    if (event.key !== ' ') {
      player.playing = false;
    }
    action();
  }
}

/** Draws plots for the width that they have, whenever it changes. */
function keep_laid_out(shown) {
  const layout = () => {
    for (const plot of shown) {
      plot.layout(Math.floor(plot.element.clientWidth - 24));
    }
  };
  new ResizeObserver(layout).observe($('plots'));
  layout();
}

function start_plots() {
  if (is_static) {
    $('plots-title').textContent = 'Values';
    const over_speed = speeds_plot(run);
    $('plots').append(...[over_speed?.element, critical_table(run), has_modes ? modes_table(run) : null, ...values_tables(data)]
      .filter(Boolean));
    if (over_speed) {
      keep_laid_out([over_speed]);
    }
    return;
  }
  const mesh_kinds = ['split', 'merge'];
  const marks = {
    mesh: events.filter(({ kind }) => mesh_kinds.includes(kind)).map((event) => event['time [s]']),
    body: events.filter(({ kind }) => kind.startsWith('left') || kind.startsWith('stopped')).map((event) =>
      ({ time: event['time [s]'], text: `${event.body}: ${event.kind} at ${number(event['time [s]'])} s` })),
  };
  const pick = (t) => {
    player.playing = false;
    player.go_to_time(t);
  };
  const descriptions = plots_of(data, is_load_steps);
  plots = descriptions.map((description) => {
    const plot = new Plot({ ...description, time_unit }, time, marks, pick);
    plot.element.dataset.plot = description.id;
    return plot;
  });
  // Small motions of what is far from the origin are seen only from where they start.
  const positions = plots.map((plot, i) => ({ plot, values: descriptions[i].series.map(({ values }) => values) }))
    .filter((_, i) => descriptions[i].is_position);
  $('from-start-choice').hidden = positions.length === 0;
  $('from-start').addEventListener('change', () => {
    for (const { plot, values } of positions) {
      plot.set_values($('from-start').checked ? values.map((x) => x.map((value) => value - x[0])) : values);
    }
  });
  $('plots').append(...plots.map((plot) => plot.element));
  keep_laid_out(plots);
  if (marks.mesh.length || marks.body.length) {
    $('plots-note').textContent = 'Short marks above the time axis: elements split or merged. '
      + (marks.body.length ? 'Dashed lines: a body left its beam or stopped. ' : '');
  }
}

function start_along() {
  if (has_nothing_along || is_drawing) {
    $('along').closest('section').hidden = true;
    return;
  }
  along = new AlongPlot(data);
  $('along').append(along.element);
  const layout = () => along.layout(Math.floor(along.element.clientWidth - 24));
  new ResizeObserver(layout).observe($('along'));
  layout();
}

function fill_tables() {
  const fill = (id, ...parts) => $(id).append(...parts.flat().filter(Boolean));
  fill('model', model_tables(run));
  fill('extremes', [...collector_tables(run), extremes_table(run, time_unit, (time) => player.go_to_time(time))]);
  fill('balance', energy_table(data));
  fill('events', events_table(events, (t) => player.go_to_time(t)));
  fill('warnings', diagnostics_list(run?.diagnostics ?? []));
  fill('evidence', [evidence_table(run)]);
  $('evidence').closest('section').hidden = !run?.evidence?.length;
  fill('run', run_tables(run));
}

set_header();
set_notes();
start_view();
start_player();
start_exaggeration(data, view, $, is_static || is_load_steps);
start_along();
start_plots();
fill_tables();
if (is_drawing) {
  for (const id of ['plots', 'extremes', 'balance', 'events', 'evidence', 'run']) {
    $(id).closest('section').hidden = true;
  }
}
if (!has_modes) {
  show();
}
document.documentElement.classList.add('ready');
