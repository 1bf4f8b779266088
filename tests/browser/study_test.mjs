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
function study_test(name, study, body) {
  test(name, async () => {
    const page = await browser.newPage({ viewport: { width: 1300, height: 1500 } });
    const complaints = [];
    page.on('console', (message) => complaints.push(message.text()));
    page.on('pageerror', (error) => complaints.push(error.message));
    await page.goto(`file://${join(out, study, 'study.html')}`);
    await page.screenshot({ path: join(out, 'screenshots', `study_${study}.png`) });
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
  assert.deepEqual((await texts(page, '#answer tr:first-child td')).slice(1), ['x', 'y', 'f [m]', 'g [N]']);
});
