// Opening a report in headless Chromium, and what can be asked of it.
import { chromium } from 'playwright-core';
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const out = dirname(fileURLToPath(import.meta.url));

export function start_browser() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking',
      '--disable-component-update', '--disable-sync', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
}

/** Opens a report; `page.complaints` collects console messages, errors and requests other than for the file. */
export async function open_report(browser, file, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1400, height: 900 }, colorScheme: 'light', ...options });
  page.complaints = [];
  const url = `file://${join(out, file)}`;
  page.on('console', (message) => page.complaints.push(`console ${message.type()}: ${message.text()}`));
  page.on('pageerror', (error) => page.complaints.push(`error: ${error.message}`));
  page.on('request', (request) => {
    if (request.url() !== url && !request.url().startsWith('data:')) {
      page.complaints.push(`request: ${request.url()}`);
    }
  });
  await page.goto(url);
  await page.waitForSelector('html.ready');
  return page;
}

export const frame_of = (page) => page.$eval('#slider', (slider) => Number(slider.value));
export const last_frame = (page) => page.$eval('#slider', (slider) => Number(slider.max));

export async function go_to(page, frame) {
  await page.$eval('#slider', (slider, value) => {
    slider.value = value;
    slider.dispatchEvent(new Event('input'));
  }, frame);
  await drawn(page);
}

/** Waits until what was asked for is on the screen. */
export const drawn = (page) =>
  page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

/**
 * The 3-D picture as seen, without what lies over it: its size, a hash of its pixels, and where there is a strong hue:
 * beams and probes; grid, supports and background have none. `points` are every seventh of these pixels.
 */
export async function picture(page) {
  await drawn(page);
  const png = await page.locator('#canvas').screenshot({ style: '#overlay, #legend { visibility: hidden }' });
  return page.evaluate(async (text) => {
    const image = new Image();
    image.src = `data:image/png;base64,${text}`;
    await image.decode();
    const { width, height } = image;
    const context = Object.assign(document.createElement('canvas'), { width, height }).getContext('2d');
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    const found = { width, height, hash: 0, count: 0, points: [], left: width, right: 0, top: height, bottom: 0 };
    const columns = new Set();
    for (let i = 0; i < data.length; i += 4) {
      const [r, g, b] = [data[i], data[i + 1], data[i + 2]];
      found.hash = (Math.imul(found.hash, 31) + (r << 16) + (g << 8) + b) | 0;
      if (Math.max(r, g, b) - Math.min(r, g, b) > 60) {
        const x = (i / 4) % width, y = Math.floor(i / 4 / width);
        found.left = Math.min(found.left, x);
        found.right = Math.max(found.right, x);
        found.top = Math.min(found.top, y);
        found.bottom = Math.max(found.bottom, y);
        columns.add(x);
        if (found.count++ % 7 === 0) {
          found.points.push([x, y]);
        }
      }
    }
    return { ...found, columns: columns.size };
  }, png.toString('base64'));
}

/** histories.csv: { names, rows }, an empty field is NaN. */
export function histories(directory) {
  const [header, ...lines] = readFileSync(join(out, directory, 'histories.csv'), 'utf8').trim().split('\n');
  return {
    names: header.split(','),
    rows: lines.map((line) => line.split(',').map((field) => (field === '' ? NaN : Number(field)))),
    value(row, name) {
      return this.rows.at(row)[this.names.indexOf(name)];
    },
  };
}

/** What a plot's key shows, by name: the exact numbers behind the texts. */
export const readings = (page, plot) => page.$eval(`[data-plot="${plot}"]`, (figure) =>
  Object.fromEntries([...figure.querySelectorAll('.keys li')].map((item) =>
    [item.querySelector('.key').textContent, item.querySelector('data').value])));
