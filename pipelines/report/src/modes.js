// Modes of vibration and buckling: the state that they are about swings in the shape of one of them.
import { element, number } from './format.js';
import { Plot } from './plots.js';
import { table_of } from './tables.js';

/** The modes of a run, as run.json has them; none in runs that have no such thing. */
export const modes_of = (run) => run?.modes ?? run?.buckling ?? [];

const name_of = (mode) => (mode.factor === undefined ? `${mode.number}: ${number(mode['frequency [Hz]'])} Hz`
  : `${mode.number}: ${number(mode.factor)} × the loads`);

/** Effective masses as parts of the whole mass, without round-off. */
const percents = (masses, whole) => masses.map((mass) => (mass < 1e-5 * whole ? '0' : number((100 * mass) / whole, 3))).join(', ');

/** A table of them; modes.csv has the digits, and the participation. */
export const modes_table = (run) => (run.modes
  ? table_of('Modes of vibration', run.modes.map((mode) => ({
    mode: mode.number, 'frequency [Hz]': mode['frequency [Hz]'], 'period [s]': mode['period [s]'] && Number(mode['period [s]'].toPrecision(4)),
    'effective mass in x, y, z [%]': percents(mode['effective_mass [kg]'], run['mass [kg]']) })))
  : table_of('Factors of the loads', modes_of(run)));

/** Natural frequencies over the speed of rotation (Campbell), with the line that they meet at critical speeds; nothing of runs
 *  without such speeds. */
export function speeds_plot(run) {
  const over = run?.modes_over_speed;
  if (!over) {
    return null;
  }
  const speeds = over['speeds [rad/s]'], critical = over.critical_speeds;
  const series = over.lines.map(({ name, 'frequency [Hz]': values }) => ({ name, values: values.map((value) => value ?? NaN) }));
  if (critical.length > 0) {
    series.push({ name: '1× speed', values: speeds.map((speed) => speed / (2 * Math.PI)) });
  }
  const marks = { mesh: [], body: critical.map(({ 'speed [rad/s]': speed, line }) =>
    ({ time: speed, text: `critical speed ${number(speed)} rad/s: ${line}` })) };
  const plot = new Plot({ title: 'Natural frequencies over speed', unit: 'Hz', series, time_unit: 'rad/s' }, speeds, marks,
    (at) => {
      const near = speeds.reduce((best, speed, i) => (Math.abs(speed - at) < Math.abs(speeds[best] - at) ? i : best), 0);
      plot.move_cursor(near);
      plot.read(near);
    });
  plot.element.dataset.plot = 'speeds';
  return plot;
}

/** The critical speeds of a run; speeds.csv has the frequencies. */
export const critical_table = (run) => (run?.modes_over_speed?.critical_speeds.length
  ? table_of('Critical speeds', run.modes_over_speed.critical_speeds.map(({ 'speed [rad/s]': speed, line }) =>
    ({ 'speed [rad/s]': speed, 'speed [rev/min]': Number((speed * 30 / Math.PI).toPrecision(4)), line })))
  : null);

/** Frame 0 of the page's data is the state, the frame at time i its shape in mode i. */
class Swing {
  constructor(data) {
    this.data = data;
    this.histories = [...data.names.bodies.map((_, i) => ['body', i]), ...data.names.probes.map((_, i) => ['probe', i])]
      .flatMap(([of, i]) => ['x', 'y', 'z'].map((name) => data.column(of, i, name).values));
    this.places = [...data.time].map((_, frame) => this.histories.map((values) => values[frame]));  // as stored
  }

  /** The control points of all beams at a frame, as stored. */
  points(frame) {
    const { shapes } = this.data;
    shapes.frame = -1;  // what is decoded may have been moved
    shapes.load(frame);
    return Array.from({ length: shapes.beam_count }, (_, beam) => {
      const start = shapes.points_start(beam);
      return shapes.floats.slice(start, start + 3 * (3 * shapes.count(frame, beam) + 1));
    });
  }

  /** Takes the shape of a mode. */
  choose(mode) {
    this.frame = this.data.time.indexOf(mode.number);
    this.rest = this.points(0);
    this.shape = this.points(this.frame);
    this.moved = this.places[this.frame];
  }

  /** Moves all points to a part of the shape, from -1 to 1. */
  move(part) {
    const { shapes } = this.data;
    shapes.load(this.frame);
    for (let beam = 0; beam < shapes.beam_count; ++beam) {
      const rest = this.rest[beam], shape = this.shape[beam], start = shapes.points_start(beam);
      for (let i = 0; i < rest.length; ++i) {
        shapes.floats[start + i] = rest[i] + part * (shape[i] - rest[i]);
      }
    }
    this.histories.forEach((values, i) => { values[this.frame] = values[0] + part * (this.moved[i] - values[0]); });
  }
}

/** Makes the transport of the page choose a mode and let it swing; two seconds a period, whatever it takes. `chosen` is called
 *  when another mode is shown. */
export function start_modes(data, view, $, chosen) {
  const modes = modes_of(data.run), swing = new Swing(data), period = 2;
  const choice = element('select', { id: 'mode', 'aria-label': 'Mode' },
    ...modes.map((mode, i) => element('option', { value: i }, name_of(mode))));
  $('speed').closest('label').hidden = $('loop').closest('label').hidden = true;
  $('transport').append(element('label', { class: 'choice' }, element('span', {}, 'Mode'), ' ', choice));
  const slider = $('slider'), play = $('play');
  slider.min = -100;
  slider.max = 100;
  slider.setAttribute('aria-label', 'Part of the amplitude');
  let playing = false, phase = 0.25, clock;

  const show = () => {
    const part = Math.sin(2 * Math.PI * phase);
    swing.move(part);
    view?.show(swing.frame);
    slider.value = Math.round(100 * part);
    slider.style.setProperty('--part', (1 + part) / 2);
    $('time').textContent = `mode ${modes[Number(choice.value)].number}`;
  };
  const tick = (now) => {
    if (!playing) {
      return;
    }
    phase += clock === undefined ? 0 : Math.min((now - clock) / 1000, 0.25) / period;
    clock = now;
    show();
    requestAnimationFrame(tick);
  };
  const set_playing = (on) => {
    playing = on;
    clock = undefined;
    play.setAttribute('aria-label', on ? 'Pause' : 'Play');
    play.classList.toggle('playing', on);
    if (on) {
      requestAnimationFrame(tick);
    }
  };
  choice.addEventListener('change', () => {
    swing.choose(modes[Number(choice.value)]);
    show();
    chosen();
  });
  play.addEventListener('click', () => set_playing(!playing));
  slider.addEventListener('input', () => {
    set_playing(false);
    phase = Math.asin(Number(slider.value) / 100) / (2 * Math.PI);
    show();
  });
  document.addEventListener('keydown', (event) => {
    if (event.key === ' ' && !event.target.closest('button, input, a, select')) {
      event.preventDefault();
      set_playing(!playing);
    }
  });
  swing.choose(modes[0]);
  show();
  chosen();
}
