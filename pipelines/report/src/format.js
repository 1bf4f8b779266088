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

export const unit_text = (unit) => unit.replace('^2', '²');
