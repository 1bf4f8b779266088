// Numbers and elements of the page.

const superscript = (exponent) => [...String(exponent)].map((c) => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[c])).join('');

/** A number with at most `digits` significant digits, a true minus and a power of ten where it is short. */
export function number(value, digits = 6) {
  if (value === null || value === undefined || !Number.isFinite(value)) {
    return '–';
  }
  if (value === 0) {
    return '0';
  }
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e6) {
    return String(Number(value.toPrecision(digits))).replace('-', '−');
  }
  const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
  return `${Number(mantissa)}·10${superscript(Number(exponent))}`.replace(/^-/, '−');
}

const prefixes = {
  m: [['µm', 1e-6], ['mm', 1e-3], ['m', 1]],
  N: [['mN', 1e-3], ['N', 1], ['kN', 1e3], ['MN', 1e6]],
  'N m': [['mN m', 1e-3], ['N m', 1], ['kN m', 1e3], ['MN m', 1e6]],
  Pa: [['Pa', 1], ['kPa', 1e3], ['MPa', 1e6], ['GPa', 1e9]],
  J: [['mJ', 1e-3], ['J', 1], ['kJ', 1e3], ['MJ', 1e6]],
  s: [['µs', 1e-6], ['ms', 1e-3], ['s', 1]],
};

/** The unit that numbers up to `largest`, of a quantity in an SI unit, are read in, and how much of the SI unit it is. */
export function readable_unit(largest, unit) {
  const known = prefixes[unit];
  if (!known || !(largest > 0)) {
    const exponent = common_exponent(largest);
    return { unit: scaled_unit(exponent, unit === '1' ? '' : unit_text(unit)), factor: 10 ** exponent };
  }
  const [name, factor] = known.filter(([, each]) => largest >= each * (1 - 0.5e-4)).at(-1) ?? known[0];
  return { unit: name, factor };
}

/** A value with the unit that it is read in: "30.69 MPa". */
export function readable(value, unit, digits = 4) {
  if (!Number.isFinite(value)) {
    return number(value);
  }
  const { unit: shown, factor } = prefixes[unit] ? readable_unit(Math.abs(value), unit) : { unit: unit_text(unit), factor: 1 };
  return `${number(value / factor, digits)} ${shown}`.trim();
}

/** The same, but what is only round-off beside `largest` is 0. */
export function number_beside(value, largest, digits = 6) {
  return number(Math.abs(value) < 1e-10 * largest ? 0 : value, digits);
}

/** Power of ten, a multiple of three, that numbers up to `largest` are best written with; 0 for everyday ones. */
export function common_exponent(largest) {
  const exponent = largest > 0 ? Math.floor(Math.log10(largest) + 1e-9) : 0;
  return exponent >= 5 || exponent <= -3 ? 3 * Math.floor(exponent / 3) : 0;
}

/** "×10³ m" for exponent 3 and unit m. */
export const scaled_unit = (exponent, unit) => (exponent ? `×10${superscript(exponent)} ${unit}` : unit).trim();

/** The largest of 1, 2, 5 times a power of ten that is not above `value` > 0. */
export function round_down(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  const factor = value / power;
  return (factor >= 5 ? 5 : factor >= 2 ? 2 : 1) * power;
}

/** A new element with attributes and children; texts become text nodes, never markup. */
export function element(tag, attributes = {}, ...children) {
  const made = tag.startsWith('svg:')
    ? document.createElementNS('http://www.w3.org/2000/svg', tag.slice(4))
    : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== undefined && value !== null) {
      made.setAttribute(name, value);
    }
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** The parts of "cable.displacement.max" with places between them where a line may end. */
export const breakable = (name) => name.split(/(?<=[._])/).flatMap((part, i) => (i ? [element('wbr'), part] : [part]));

export const unit_text = (unit) => unit.replace('^2', '²');
