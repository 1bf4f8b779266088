// How many times larger than they are displacements from the drawing are shown.
import { number, round_down } from './format.js';

/** The factor that makes the largest displacement a tenth of the model's size as heights are shown, rounded down; 1 where it
 * is that large. */
function automatic(data, heights) {
  const [low, high] = data.box;
  const size = Math.max(...high.map((value, k) => value - low[k]));
  return Math.max(1, round_down((0.1 * size) / (data.shapes.displacement * heights)));
}

/** Starts the control; with `large` at the automatic factor, else as it is. */
export function start_exaggeration(data, view, $, large) {
  const round_off = 1e-12 * Math.max(...data.box.flat().map(Math.abs));
  if (!view || !data.shapes.displaced || data.shapes.displacement <= round_off) {
    return;
  }
  $('exaggeration').hidden = false;
  const slider = $('exaggerate'), auto = automatic(data, view.heights);
  slider.max = Math.max(3, Math.ceil(Math.log10(auto)));
  const show = (factor) => {
    slider.value = Math.log10(factor);
    const text = `× ${number(factor, factor < 10 ? 2 : 3)}`;
    $('exaggerated').textContent = text;
    slider.setAttribute('aria-valuetext', text);
    view.exaggerate(factor);
  };
  slider.addEventListener('input', () => show(10 ** Number(slider.value)));
  for (const button of document.querySelectorAll('[data-times]')) {
    const { times } = button.dataset;
    button.title = times === 'auto' ? `× ${number(auto, 3)}: the largest displacement is a tenth of the model` : '';
    button.addEventListener('click', () => show(times === 'auto' ? auto : Number(times)));
  }
  show(large ? auto : 1);
}
