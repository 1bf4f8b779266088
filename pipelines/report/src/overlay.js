// What lies over the 3-D picture: names, signs of scale and direction.
import { Vector3 } from 'three';
import { element, number, round_down } from './format.js';
import { Labels } from './labels.js';

export class Overlay {
  /** Of named points, { name, symbol, of: 'body' or 'probe' }. */
  constructor(overlay, points, gravity, grid_step) {
    this.points = points;
    const labels = points.map(({ name, of }) => element('span', { class: `label ${of}` }, name));
    this.names = new Labels(points.map(({ of }, i) => ({ label: labels[i], is_below: of === 'probe' })));
    this.scale_bar = element('span', { class: 'scale-bar' });
    this.scale_text = element('span');
    const directions = [['x', [1, 0, 0]], ['y', [0, 1, 0]], ['z', [0, 0, 1]]];
    if (gravity && Math.hypot(...gravity) > 0) {
      directions.push(['g', gravity]);
    }
    this.triad = directions.map(([name, direction]) => ({
      direction: new Vector3(...direction).normalize(),
      line: element('svg:line', { class: `axis-${name}` }),
      tip: element('svg:path', { class: `tip axis-${name}`, d: 'M6 0 L-3 3 L-3 -3 Z' }),
      text: element('svg:text', { class: `axis-${name}`, 'text-anchor': 'middle', dy: '0.35em' }, name),
      reach: name === 'g' ? 24 : 30,
    }));
    const triad = element('svg:svg', { class: 'triad', viewBox: '-46 -46 92 92', 'aria-hidden': 'true' },
      ...this.triad.flatMap(({ line, tip, text }) => [line, tip, text]));
    const grid_hint = element('span', { class: 'grid-hint' }, `grid ${number(grid_step)} m`);
    this.enlarged_text = element('span', { class: 'grid-hint', id: 'enlarged' });
    overlay.append(element('div', { class: 'labels' }, ...labels), triad,
      element('div', { class: 'scale' }, this.scale_bar, this.scale_text, grid_hint, this.enlarged_text));
  }

  /** Says what is shown larger than it is: [factor, what]. */
  enlarged(all) {
    this.enlarged_text.textContent = all.filter(([factor]) => factor !== 1)
      .map(([factor, what]) => `${what} × ${number(factor, factor < 10 ? 2 : 3)}`).join(', ');
  }

  /** Draws it for a camera. */
  draw(view) {
    this.names.place(this.points.map(({ symbol: { position: p } }) => {
      const dx = p.x - view.target.x, dy = p.y - view.target.y, dz = p.z - view.target.z;
      return [view.width / 2 + view.scale * (dx * view.x.x + dy * view.x.y + dz * view.x.z),
        view.height / 2 - view.scale * (dx * view.y.x + dy * view.y.y + dz * view.y.z)];
    }));
    if (this.drawn_scale !== view.scale) {
      this.drawn_scale = view.scale;
      const length = round_down(130 / view.scale);
      this.scale_bar.style.width = `${length * view.scale}px`;
      this.scale_text.textContent = `${number(length)} m`;
    }
    if (this.drawn_azimuth !== view.azimuth || this.drawn_elevation !== view.elevation) {
      this.drawn_azimuth = view.azimuth;
      this.drawn_elevation = view.elevation;
      this.draw_triad(view);
    }
  }

  draw_triad(view) {
    for (const { direction, line, tip, text, reach } of this.triad) {
      const x = direction.dot(view.x), y = -direction.dot(view.y);
      const short = Math.hypot(x, y) < 0.15;  // it points at the viewer
      line.setAttribute('x2', (x * reach).toFixed(1));
      line.setAttribute('y2', (y * reach).toFixed(1));
      tip.setAttribute('transform',
        `translate(${x * reach} ${y * reach}) rotate(${(Math.atan2(y, x) * 180) / Math.PI})`);
      tip.style.display = text.style.display = short ? 'none' : '';
      text.setAttribute('x', (x * (reach + 11)).toFixed(1));
      text.setAttribute('y', (y * (reach + 11)).toFixed(1));
    }
  }
}
