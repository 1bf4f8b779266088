// Bundles src/ into dist/report.html: the whole page but for the data of a run, for pipelines/report/report.cpp to fill in.
import { build } from 'esbuild';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, 'dist');

async function bundle(entry) {
  const result = await build({
    absWorkingDir: here,
    entryPoints: [entry],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: ['chrome100', 'firefox100', 'safari15.4'],
    charset: 'utf8',
    legalComments: 'inline',
  });
  return result.outputFiles[0].text.trim();
}

const script = await bundle('src/main.js');
const style = await bundle('src/style.css');
if (/<\/script|<!--/i.test(script) || /<\/style/i.test(style)) {
  throw new Error('the bundle would end its own element');
}
// Replaced by functions: "$" in a bundle has no meaning.
const page = readFileSync(join(here, 'src/page.html'), 'utf8')
  .replace('/* style */', () => style)
  .replace('/* script */', () => script);
mkdirSync(out, { recursive: true });
writeFileSync(join(out, 'report.html'), page);
