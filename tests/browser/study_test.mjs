// study.html in a real browser; `run` makes the studies beside this file.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { out, start_browser } from './browser.mjs';

let browser;
before(async () => { browser = await start_browser(); });
after(() => browser.close());

/** Opens the page of a study for one test; it must not have complained when the test ends. */
function study_test(name, study, body, width = 1300) {
  test(name, async () => {
    const page = await browser.newPage({ viewport: { width, height: 1500 } });
    const complaints = [];
    page.on('console', (message) => complaints.push(message.text()));
    page.on('pageerror', (error) => complaints.push(error.message));
    await page.goto(`file://${join(out, study, 'study.html')}`);
    await page.screenshot({ path: join(out, 'screenshots', `study_${study}_${width}.png`) });
    await body(page);
    assert.deepEqual(complaints, []);
    await page.close();
  });
}

const texts = (page, selector) => page.$$eval(selector, (nodes) => nodes.map((node) => node.textContent));

study_test('a variant that is not done can be chosen, and says why', 'lost', async (page) => {
  await page.click('#lost tr');
  assert.deepEqual((await texts(page, '#chosen td')).slice(0, 3), ['2', '7', '2.000e+6']);
  assert.match(await page.textContent('#chosen p'), /^rejected: .*mass < 5/);
  assert.equal(await page.$$eval('#parallel .row.lost.chosen', (lines) => lines.length), 1);
});

study_test('axes and tables have units', 'lost', async (page) => {
  await page.click('#lost tr');
  const expected = ['mass [kg]', 'stiffness [N/m]', 'speed [m/s]', 'same [N]'];
  assert.deepEqual((await texts(page, '#chosen th')).slice(1), expected);
  const labels = await texts(page, '#parallel text');
  for (const name of expected) {
    assert.ok(labels.includes(name), name);
  }
  assert.ok((await texts(page, '#scatter text')).includes('stiffness [N/m]'));
});

study_test('the labels of an axis differ, and that of a constant has one', 'lost', async (page) => {
  const labels = await texts(page, '#parallel text');
  assert.equal(labels.filter((text) => text === '1.000e+9').length, 1);
  const scatter = await texts(page, '#scatter svg:nth-child(2) text');
  assert.ok(scatter.includes('1.000000e+6') && scatter.includes('1.000001e+6'), scatter.join());
});

study_test('a front that is longer than its table says so', 'front', async (page) => {
  const { optima } = JSON.parse(readFileSync(join(out, 'front/study.json'), 'utf8')).answer;
  const rows = (await page.$$('#answer tr')).length - 1;
  assert.ok(rows < optima.length, 'the front is long');
  assert.equal(await page.textContent('#answer p'), `${rows} of the ${optima.length} points of the front; study.json has all of them.`);
  assert.deepEqual((await texts(page, '#answer th')).slice(1), ['x', 'y', 'f [m]', 'g [N]']);
});

study_test('a front stands in order, from end to end', 'front', async (page) => {
  const { optima } = JSON.parse(readFileSync(join(out, 'front/study.json'), 'utf8')).answer;
  const all = optima.map(({ quantities }) => quantities.f);
  assert.deepEqual(all, all.toSorted((a, b) => a - b));
  const shown = (await texts(page, '#answer td:nth-child(4)')).map(Number);
  assert.deepEqual(shown, shown.toSorted((a, b) => a - b));
  assert.ok(Math.abs(shown[0] - all[0]) < 1e-4 && Math.abs(shown.at(-1) - all.at(-1)) < 1e-4, shown.join());
  await page.click('#answer tr:last-child');
  assert.equal(Number((await texts(page, '#chosen td'))[3]), shown.at(-1));
});

for (const study of ['grid', 'many', 'derivatives', 'indices', 'nothing', 'front', 'lost']) {
  study_test(`no words run into others, off the page or out of a drawing: ${study}`, study, async (page) => {
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'off the page');
    const { cut, crossed } = await page.evaluate(() => {
      const cut = [], crossed = [];
      for (const drawing of document.querySelectorAll('svg')) {
        const box = drawing.getBoundingClientRect(), upright = [];
        for (const node of drawing.querySelectorAll('text')) {
          const { left, right, top, bottom } = node.getBoundingClientRect();
          if (left < box.left - 1 || right > box.right + 1 || top < box.top - 1 || bottom > box.bottom + 1) cut.push(node.textContent);
          if (node.hasAttribute('transform')) continue;
          for (const other of upright) {
            if (left < other.right && other.left < right && top < other.bottom - 3 && other.top < bottom - 3) {
              crossed.push(`${node.textContent} over ${other.text}`);
            }
          }
          upright.push({ left, right, top, bottom, text: node.textContent });
        }
      }
      return { cut, crossed };
    });
    assert.deepEqual(cut, []);
    assert.deepEqual(crossed, []);
  });

  study_test(`below each heading there is something: ${study}`, study, async (page) => {
    const empty = await page.$$eval('h2', (headings) => headings.filter((heading) => {
      const next = heading.nextElementSibling;
      return !next || next.getBoundingClientRect().height === 0;
    }).map((heading) => heading.textContent));
    assert.deepEqual(empty, []);
  });
}

study_test('a plan names the variants in which quantities are least and greatest', 'grid', async (page) => {
  assert.deepEqual(await texts(page, '#answer th'), ['', 'value', 'variant', 'x', 'y']);
  const rows = await page.$$eval('#answer tr.click', (nodes) => nodes.map((row) => [...row.children].map((cell) => cell.textContent)));
  assert.deepEqual(rows.map(([name, value, , x, y]) => [name, value, x, y]), [
    ['least f [N]', '-1', '0', '-1'], ['greatest f [N]', '101', '10', '1'],
    ['least g [m]', '-10', '10', '-1'], ['greatest g [m]', '10', '10', '1']]);
  await page.click('#answer tr.click:nth-child(3)');
  assert.ok((await texts(page, '#chosen td')).includes('101'));
});

study_test('a grid of two variables is a family of curves and a map', 'grid', async (page) => {
  assert.ok((await texts(page, 'h2')).includes('Quantities over both variables'));
  assert.equal(await page.$$eval('#grid-map .family', (lines) => lines.length), 2 * 4);
  const titles = await texts(page, '#grid-map .cell title');
  assert.equal(titles.length, 2 * 24);
  assert.ok(titles.some((text) => text.endsWith('f [N] 101')), titles.join());
  await page.click('#grid-map .cell >> nth=23');
  assert.equal((await texts(page, '#chosen td'))[0], titles[23].match(/variant (\d+)/)[1]);
  assert.ok((await texts(page, '#scatter text')).includes('5'), 'round values stand between the ends of an axis');
});

study_test('curves in a plane are looked at from in front of it', 'plane', async (page) => {
  const { wide, high } = await page.$eval('#curves canvas', (canvas) => {
    const { width, height } = canvas, { data } = canvas.getContext('2d').getImageData(0, 0, width, height);
    let [left, right, top, bottom] = [width, 0, height, 0];
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        const at = 4 * (y * width + x);
        if (data[at + 3] > 60 && data[at + 2] > data[at] + 60) {  // blue, as the variants are
          [left, right, top, bottom] = [Math.min(left, x), Math.max(right, x), Math.min(top, y), Math.max(bottom, y)];
        }
      }
    }
    return { wide: right - left, high: bottom - top };
  });
  assert.ok(Math.abs(high / wide - 2 / 4) < 0.02, `${high} of ${wide} pixels: it falls by 2 m on 4 m`);
});

for (const [study, narrow] of [['grid', 390], ['many', 390], ['lost', 390]]) {
  study_test(`on a phone the axes lie below each other, and nothing is off the page: ${study}`, study, async (page) => {
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'off the page');
    const { width, slanted } = await page.$eval('#parallel', (drawing) => ({ width: drawing.getBoundingClientRect().width,
      slanted: drawing.querySelectorAll('text[transform]').length }));
    assert.ok(width <= narrow && slanted === 0);
    const names = await page.$$eval('#parallel text', (all) => all.map((text) => Number.parseFloat(getComputedStyle(text).fontSize)
      * text.ownerSVGElement.getScreenCTM().a));
    assert.ok(Math.min(...names) > 11, `letters of ${Math.min(...names)} pixels`);
  }, narrow);
}

for (const study of ['grid', 'many', 'lost', 'front', 'derivatives', 'indices', 'short', 'risk']) {
  study_test(`on a phone no column of a table is out of sight: ${study}`, study, async (page) => {
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'off the page');
    const cut = await page.$$eval('.wide', (all) => all.filter((each) => each.scrollWidth > each.clientWidth + 1)
      .map((each) => each.textContent.slice(0, 40)));
    assert.deepEqual(cut, []);
  }, 390);
}

study_test('a study of which no variant is done shows these', 'nothing', async (page) => {
  assert.deepEqual(await texts(page, 'h2'), ['Variants: one line each', 'Variants that are not done']);
  assert.match(await page.textContent('#counts'), /none of 3 variants is done: 3 rejected/);
});

study_test('a surrogate comes with its error, and its indices without intervals', 'many', async (page) => {
  const [{ q2 }] = JSON.parse(readFileSync(join(out, 'many/study.json'), 'utf8')).surrogates;
  const rows = await page.$$eval('#answer tr', (all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
  const row = rows.find(([name]) => name === 'deflection of the free end of the cantilever [m]');
  assert.ok(row, rows.join('; '));
  assert.ok(Math.abs(Number(row[1]) - q2) < 1e-4, row.join());
  assert.ok(!(await texts(page, '#more text')).some((text) => text.includes('interval')));
});

study_test('a search that was cut off says so', 'short', async (page) => {
  assert.match(await page.textContent('#answer p'), /has used up its evaluations/);
});

study_test('a probability says how many variants are not done', 'risk', async (page) => {
  const { not_done } = JSON.parse(readFileSync(join(out, 'risk/study.json'), 'utf8')).answer;
  assert.ok(not_done > 0);
  assert.match(await page.textContent('#answer p'), new RegExp(`^${not_done} variants are not done`));
});

study_test('indices come with their intervals', 'indices', async (page) => {
  assert.ok((await texts(page, '#more text')).some((text) => text.includes('lines: confidence intervals')));
  assert.equal((await page.$$('.whisker')).length, 2 * 19);
});
