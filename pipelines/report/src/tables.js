// What run.json says, and the model, as tables.
import { breakable, element, number, number_beside, readable, readable_unit, unit_text } from './format.js';

/** "length [m]" as its two parts. */
function name_and_unit(key) {
  const match = /^(.*) \[(.*)\]$/.exec(key);
  return match ? { name: match[1], unit: unit_text(match[2]) } : { name: key, unit: '' };
}

function cell_text(value) {
  if (value === null || value === undefined || value === '' || Number.isNaN(value)) {
    return '–';
  }
  if (Array.isArray(value)) {
    const largest = Math.max(...value.map(Math.abs));
    return `(${value.map((v) => number_beside(v, largest)).join(', ')})`;
  }
  return typeof value === 'number' ? number(value) : String(value);
}

/** The largest magnitude of the numbers in a table's rows, by their units. */
function largest_by_unit(rows) {
  const largest = {};
  for (const [key, value] of rows.flatMap(Object.entries)) {
    if (typeof value === 'number') {
      const { unit } = name_and_unit(key);
      largest[unit] = Math.max(largest[unit] ?? 0, Math.abs(value) || 0);
    }
  }
  return largest;
}

/** What is only the round-off of a run, in that unit; 0 of runs that do not tell. */
export const round_off_of = (run, unit) => run?.round_off?.[unit] ?? 0;

/** Rows without round-off: numbers that are nothing beside the largest of the same unit, or in the run, are 0. */
function without_round_off(rows, run) {
  const largest = largest_by_unit(rows);
  return rows.map((row) => Object.fromEntries(Object.entries(row).map(([key, value]) => {
    const { unit } = name_and_unit(key);
    const is_nothing = typeof value === 'number' && unit
      && Math.abs(value) <= Math.max(1e-10 * largest[unit], round_off_of(run, unit));
    return [key, is_nothing ? 0 : value];
  })));
}

/** Rows in the units that people read, which stand in their keys; the columns of one SI unit have one unit. */
function in_readable_units(rows) {
  const largest = largest_by_unit(rows);
  const shown = (key) => {
    const { name, unit } = name_and_unit(key);
    if (!unit || !(unit in largest)) {
      return { key, factor: 1 };
    }
    const { unit: read, factor } = readable_unit(largest[unit], unit);
    return { key: `${name} [${read}]`, factor };
  };
  return rows.map((row) => Object.fromEntries(Object.entries(row).map(([key, value]) => {
    const to = shown(key);
    return [to.key, typeof value === 'number' ? value / to.factor : value];
  })));
}

/** Numbers stand to the right, and no line ends in them. */
const class_of = (value) => (typeof value === 'number' ? 'number whole' : null);

/** A table of objects that all have the same keys; numbers to the right. */
export function table_of(caption, rows, keys = Object.keys(rows[0] ?? {})) {
  if (rows.length === 0) {
    return null;
  }
  const heads = keys.map((key) => {
    const { name, unit } = name_and_unit(key);
    const numeric = rows.some((row) => typeof row[key] === 'number');
    return element('th', { scope: 'col', class: numeric ? 'number' : null }, name.replaceAll('_', ' '),
      unit ? element('span', { class: 'unit' }, ` [${unit}]`) : null);
  });
  const body = rows.map((row) => element('tr', {}, ...keys.map((key, i) => element(i === 0 ? 'th' : 'td', {
    scope: i === 0 ? 'row' : null,
    class: class_of(row[key]),
    'data-head': key.replaceAll('_', ' '),
  }, cell_text(row[key])))));
  return element('div', { class: 'card table-card', tabindex: 0, role: 'region', 'aria-label': caption },
    element('table', { class: keys.length > 4 ? 'stack' : null }, element('caption', {}, caption), element('thead', {}, element('tr', {}, ...heads)),
      element('tbody', {}, ...body)));
}

/** The same with one column per object, for few objects of many properties. */
function table_of_columns(caption, rows) {
  if (rows.length === 0 || rows.length > 4) {
    return table_of(caption, rows);
  }
  const [first, ...keys] = [...new Set(rows.flatMap(Object.keys))];
  const body = keys.map((key) => {
    const { name, unit } = name_and_unit(key);
    return element('tr', {}, element('th', { scope: 'row' }, name, unit ? element('span', { class: 'unit' }, ` [${unit}]`)
      : null), ...rows.map((row) => element('td', { class: class_of(row[key]) ?? 'number' }, cell_text(row[key]))));
  });
  return element('div', { class: 'card table-card', tabindex: 0, role: 'region', 'aria-label': caption },
    element('table', {}, element('caption', {}, caption),
      element('thead', {}, element('tr', {}, element('td'), ...rows.map((row) =>
        element('th', { scope: 'col', class: 'number' }, row[first])))),
      element('tbody', {}, ...body)));
}

/** Names and values, one below the other. */
export function facts_of(caption, facts) {
  return element('div', { class: 'card' }, caption ? element('h3', {}, caption) : null,
    element('dl', { class: 'facts' }, ...facts.flatMap(([name, value]) =>
      [element('dt', {}, name), element('dd', {}, value)])));
}

/** A beam as a column of its table: of a rigid guide what it has. */
function beam_column({ 'section outline [m]': outline, ...rest }) {
  return rest.rigid ? Object.fromEntries(Object.entries(rest).filter(([key]) =>
    ['name', 'length [m]', 'CAD segments', 'element'].includes(key))) : rest;
}

/** "cable at 3 m", "load" or a point. */
function end_text(end) {
  return end.beam !== undefined ? `${end.beam} at ${number(end['s [m]'])} m` : end.body ?? cell_text(end['point [m]']);
}

/** Tables of the model; none if run.json was written before it held one. */
export function model_tables(run) {
  const model = run?.model;
  if (!model) {
    return [element('p', { class: 'none' }, 'run.json of these results does not describe the model.')];
  }
  const gravity = model['gravity [m/s^2]'];
  return [
    facts_of('', [
      ['Kind', model.dimension === 2 ? 'planar' : 'spatial'],
      ['Gravity', `${cell_text(gravity)} m/s²`],
      ['Units', 'SI: metre, kilogram, second, newton, joule'],
    ]),
    table_of_columns('Beams', model.beams.map(beam_column)),
    table_of('Bodies', model.bodies),
    table_of('Supports', model.supports.map(({ outward, ...rest }) => rest)),
    table_of_columns('Sliding joints', model.joints),
    table_of('Connectors', (model.connectors ?? []).map((one) => ({ ...one, from: end_text(one.from), to: end_text(one.to) })),
      ['name', 'type', 'from', 'to', 'stiffness [N/m]', 'damping [N s/m]', 'length [m]', 'force at the start [N]']),
    table_of('Loads', model.loads,
      ['beam', 'kind', 'value', 's [m]', 'direction', 'place speed [m/s]', 'in time'].filter((key) => (
        key === 's [m]' ? model.loads.some((load) => key in load)
          : key !== 'place speed [m/s]' || model.loads.some((load) => load[key] !== 0)))),
  ];
}

/** The parts of the energy that a run knows. */
export const energy_parts = (data) => ['kinetic', 'gravity', 'axial', 'bending', 'dissipated', 'total', 'input', 'spring']
  .filter((name) => data.column('energy', 0, name));

/** Where the energy was at the start and the end of the run. */
export function energy_table(data) {
  const last = data.time.length - 1;
  const rows = energy_parts(data).filter((name) => data.column('energy', 0, name).values.some((value) => Math.abs(value) > round_off_of(data.run, 'J'))).map((name) => {
    const { values } = data.column('energy', 0, name);
    return last === 0 ? { energy: name, 'value [J]': values[0] }
      : { energy: name, 'start [J]': values[0], 'end [J]': values[last], 'change [J]': values[last] - values[0] };
  });
  const drift = data.run?.['energy_drift [J]'];
  return [
    table_of('Energy balance', without_round_off(rows, data.run)),
    typeof drift === 'number' && last > 0
      ? element('p', { class: 'note' }, `The total, with what was dissipated and less the work put in, departed by at most ${drift > round_off_of(data.run, 'J') ? `${number(drift, 3)} J` : 'round-off'} from its start.`)
      : null,
  ];
}

/** What the round-off of a beam's strains makes of a section force in N or N m; 0 of what is in other units. */
export function carried_round_off(beam, unit) {
  const force = 1e-13 * beam['EA [N]'];
  return { N: force, 'N m': force * beam['length [m]'] }[unit] ?? 0;
}

/** Whether section forces of a beam, and with them its stresses, are the round-off of its strains. */
function carries_nothing(beam, extremes) {
  return extremes.filter(({ quantity }) => quantity.startsWith(`${beam.name}.`)).every(({ value, unit }) => (
    !['N', 'N m'].includes(unit) || Math.abs(value) <= carried_round_off(beam, unit)));
}

/** How far the layer reaches in which bending rounds a kink, where the extreme is in one. */
function layer_note(extreme) {
  const reach = extreme['in a layer of [m]'];
  return typeof reach === 'number' ? element('span', { class: 'unit' }, ` in a layer of ${readable(reach, 'm', 3)}`) : null;
}

/** How many of its numbers a run knows how well; nothing of runs that were not asked. */
export function accuracy_line(run) {
  const accuracy = run?.accuracy;
  if (!accuracy) {
    return null;
  }
  const part = accuracy.target ?? 0.02;
  const numbers = accuracy.quantities.filter(({ value, error }) => value !== 0 || error !== 0);
  const right = numbers.filter(({ relative, not_converged }) => !not_converged && relative !== null && relative <= part);
  const parted = accuracy['parted [s]'];
  return `right to ${number(100 * part, 3)} %: ${right.length} of ${numbers.length} numbers`
    + (typeof parted === 'number' ? `; from ${number(parted, 3)} s on the runs part, and averages alone may be right` : '')
    + '. Bands in the plots and ± in the tables are errors of mesh and step; grey ones are no bounds.';
}

/** The extremes of the run; a button shows their time, or the load factor that has no unit. */
export function extremes_table(run, time_unit, go_to_time) {
  const all = (run?.extremes ?? []).filter(({ value }) => value !== null && value !== 0);
  const idle = (run?.model?.beams ?? []).filter((beam) => carries_nothing(beam, all));
  const largest = (unit) => Math.max(...all.filter((one) => one.unit === unit).map(({ value }) => Math.abs(value)));
  const extremes = all.filter(({ quantity, unit, value }) => (
    Math.abs(value) > round_off_of(run, unit)
    && !(['N', 'N m', 'Pa'].includes(unit) && idle.some(({ name }) => quantity.startsWith(`${name}.`)))
    && Math.abs(value) > 1e-10 * largest(unit)));
  if (!extremes.length) {
    return element('p', { class: 'none' }, all.length ? 'The beams carry nothing.' : 'run.json of these results does not name any.');
  }
  const moving = extremes.some((extreme) => extreme['time [s]'] > 0);
  const with_errors = extremes.some(({ error }) => typeof error === 'number');
  const in_doubt = new Map((run.accuracy?.quantities ?? []).map((one) => [one.quantity, one.not_converged]));
  const error_cell = ({ quantity, error, unit }) => element('td', { class: `number whole${in_doubt.get(quantity) ? ' doubtful' : ''}`,
    title: in_doubt.get(quantity) ?? null }, typeof error === 'number' ? `± ${readable(error, unit, 2)}` : '–');
  const rows = extremes.map((extreme) => element('tr', {},
    element('th', { scope: 'row' }, ...breakable(extreme.quantity), layer_note(extreme)),
    element('td', { class: 'number whole', title: `${extreme.value} ${extreme.unit}` }, readable(extreme.value, extreme.unit, 5)),
    with_errors ? error_cell(extreme) : null,
    element('td', { class: 'number whole' }, number(extreme['s [m]'], 5)),
    moving ? element('td', { class: 'number whole' }, button_to(extreme['time [s]'], go_to_time)) : null));
  const head = (name, unit) => element('th', { scope: 'col', class: unit ? 'number' : null }, name,
    unit ? element('span', { class: 'unit' }, ` [${unit}]`) : null);
  return element('div', { class: 'card table-card', tabindex: 0, role: 'region', 'aria-label': 'Extremes' },
    element('table', {}, element('thead', {}, element('tr', {}, head('quantity'), element('th', { scope: 'col', class: 'number' }, 'value'),
      with_errors ? element('th', { scope: 'col', class: 'number' }, 'error') : null,
      head('at s', 'm'), moving ? head(time_unit ? 'at time' : 'at load', time_unit || '–') : null)), element('tbody', {}, ...rows)));
}

/** Statistics of contact forces, and what they lift; none of runs without collectors. */
export function collector_tables(run) {
  return (run?.collectors ?? []).filter(({ samples }) => samples > 0).flatMap((one) => {
    const row = (name, { 'frequencies [Hz]': ends, histogram, ...rest }) => ({ [one.name]: name, ...rest });
    const band = ({ 'frequencies [Hz]': [low, high] }) => `${number(low)} to ${number(high)} Hz`;
    const lost = one['loss of contact'];
    return [
      table_of_columns(`Contact force of ${one.name}`, [row(band(one.force), one.force), row('unfiltered', one['unfiltered force']),
        ...one.bands.slice(0, 2).map((force) => row(band(force), force))]),
      element('p', { class: 'note' }, `${one.samples} samples from ${number(one['from [s]'])} to ${number(one['to [s]'])} s. Contact was lost ${number(lost['part of the time [%]'], 3)} % of the time, ${lost.number} times, for ${number(lost['longest [s]'], 3)} s at most.`),
      table_of(`Uplift by ${one.name}`, in_readable_units(one.uplift)),
    ];
  });
}

/** Events with a button that shows their time. */
export function events_table(events, go_to_time) {
  if (!events.length) {
    return element('p', { class: 'none' }, 'No element was split or merged, and no body left its beam.');
  }
  const cell = (head, text) => element('td', { class: head.includes('[') ? 'number' : null, 'data-head': head }, text);
  const rows = events.map((event) => element('tr', {},
    element('th', { scope: 'row', class: 'number', 'data-head': 'time [s]' },
      button_to(event['time [s]'], go_to_time)),
    cell('kind', event.kind),
    cell('body', event.body || '–'),
    cell('beam', event.beam || '–'),
    cell('s [m]', cell_text(event['s [m]'])),
    cell('energy before [J]', number(event['energy_before [J]'])),
    cell('after [J]', number(event['energy_after [J]'])),
    cell('change [J]', number(event['energy_after [J]'] - event['energy_before [J]'], 3))));
  const head = (name, unit) => element('th', { scope: 'col', class: unit ? 'number' : null }, name,
    unit ? element('span', { class: 'unit' }, ` [${unit}]`) : null);
  return element('div', { class: 'card table-card scroll', tabindex: 0, role: 'region', 'aria-label': 'Events' },
    element('table', { class: 'stack' }, element('caption', {}, `${events.length} events`),
      element('thead', {}, element('tr', {}, head('time', 's'), head('kind'), head('body'), head('beam'),
        head('s', 'm'), head('energy before', 'J'), head('after', 'J'), head('change', 'J'))),
      element('tbody', {}, ...rows)));
}

function button_to(time, go_to_time) {
  const button = element('button', { type: 'button', class: 'link', title: 'Show this time' }, number(time));
  button.addEventListener('click', () => go_to_time(time));
  return button;
}

export function diagnostics_list(diagnostics) {
  if (!diagnostics.length) {
    return element('p', { class: 'none' }, 'None.');
  }
  return element('ul', { class: 'diagnostics' }, ...diagnostics.map(({ severity, where, message }) =>
    element('li', { class: `card ${severity}` }, element('strong', {}, severity), ' ',
      element('span', { class: 'where' }, where), element('span', { class: 'message' }, message))));
}

/** Which known answers cover what the run used. */
export function evidence_table(run) {
  const evidence = run?.evidence ?? [];
  if (!evidence.length) {
    return null;
  }
  const rows = evidence.map(({ feature, covered, problems }) => ({
    feature,
    'least error': problems.length ? problems[0].least_error : null,
    'met within 1e-4': covered ? 'yes' : 'no',
    'problems of nurbeam verify': problems.map(({ problem }) => problem).join(', '),
  }));
  return table_of('Known answers with the features of this run', rows);
}

export function run_tables(run) {
  if (!run) {
    return [];
  }
  const seconds = (key) => `${number(run['wall_times [s]'][key], 3)} s`;
  return [
    facts_of('', [
      ['Status', run.status],
      ['nurbeam', run.nurbeam],
      ['Steps', `${run.steps} (${run.rejected_steps} rejected), ${run.newton_iterations} Newton iterations`],
    ]),
    facts_of('Wall time', [['Import', seconds('import')], ['Model', seconds('model')], ['Motion', seconds('motion')],
      ['Length control', seconds('length_control')], ['Output', seconds('output')]]),
    element('div', { class: 'card' }, element('h3', {}, 'Input files and their SHA-256'), element('ul', { class: 'files' },
      ...run.inputs.map(({ file, sha256 }) => element('li', {}, file, element('code', {}, sha256))))),
  ];
}

/** The values of a static analysis, which has no histories to plot. */
export function values_tables(data) {
  const rows = (of, names, parts) => in_readable_units(without_round_off(names.map((name, i) =>
    Object.fromEntries([['name', name], ...parts.filter(([, part]) => data.column(of, i, part))
      .map(([label, part]) => [label, data.column(of, i, part).values[0]])])), data.run));
  const place = [['x [m]', 'x'], ['y [m]', 'y'], ['z [m]', 'z']];
  return [
    table_of('Places', [...rows('body', data.names.bodies, [...place, ['s [m]', 's']]),
      ...rows('probe', data.names.probes, place)]),
    table_of('Joint forces', rows('body', data.names.bodies, [['Fx [N]', 'joint_force.x'], ['Fy [N]', 'joint_force.y'], ['Fz [N]', 'joint_force.z']])),
    table_of('Connectors', rows('connector', data.names.connectors ?? [], [['force [N]', 'force'], ['length [m]', 'length']])),
    table_of_columns('Reactions', rows('reaction', data.names.reactions, [['Fx [N]', 'fx'], ['Fy [N]', 'fy'], ['Fz [N]', 'fz'],
      ['Mx [N m]', 'mx'], ['My [N m]', 'my'], ['Mz [N m]', 'mz']])),
    table_of_columns('Sections at probes', rows('probe', data.names.probes, [['axial force [N]', 'axial_force'],
      ['bending moment [N m]', 'moment'], ['moment 1 [N m]', 'moment_1'], ['moment 2 [N m]', 'moment_2'],
      ['torque [N m]', 'torque'], ['twist [rad]', 'twist'], ['shear force [N]', 'shear_force'], ['stress [Pa]', 'stress'],
      ['von Mises stress [Pa]', 'von_mises'],
      ['ux [m]', 'ux'], ['uy [m]', 'uy'], ['uz [m]', 'uz']])),
    table_of('Beams', rows('beam', data.names.beams, [['deformed length [m]', 'length']])),
  ];
}
