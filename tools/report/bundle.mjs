// node bundle.mjs PAGE.cpp: makes one HTML page of page/ and the libraries that it imports, and writes it as
// C++, the definition of pageTemplate() (tools/report/page.h). CMake runs it in the folder where `npm ci` has
// put the libraries.
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = process.cwd();
const page = join(dirname(fileURLToPath(import.meta.url)), 'page');
const { buildSync } = createRequire(join(here, 'package.json'))('esbuild');

// Of the libraries in the page, which their licences want to go along.
function licences() {
  const { dependencies } = JSON.parse(readFileSync('package.json', 'utf8'));
  const texts = Object.keys(dependencies)
    .filter((name) => name !== 'esbuild') // that makes the page and is no part of it
    .map((name) => {
      const folder = join('node_modules', name);
      const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
      return `${name}\n\n${readFileSync(join(folder, file), 'utf8').trim()}\n`;
    });
  return `/*\n${texts.join('\n')}*/`;
}

function bundled(entry) {
  const { outputFiles } = buildSync({
    entryPoints: [join(page, entry)],
    nodePaths: [join(here, 'node_modules')],
    bundle: true,
    minify: true,
    write: false,
    format: 'esm',
    charset: 'utf8',
    legalComments: 'none',
    banner: { js: licences() },
    target: ['chrome115', 'firefox115', 'safari16.4'],
  });
  return outputFiles[0].text;
}

const parts = { '/*style*/': bundled('page.css'), '/*script*/': bundled('main.js') };
let html = readFileSync(join(page, 'page.html'), 'utf8');
for (const [place, text] of Object.entries(parts)) {
  if (/<\/(script|style)/i.test(text)) throw new Error(`${place} would end its own element`);
  html = html.replace(place, () => text);
}
const kEnd = 'fluidtex_page';
if (html.includes(`)${kEnd}"`)) throw new Error('the page holds the end of its own C++ text');
writeFileSync(
  process.argv[2],
  `// Made by tools/report/bundle.mjs.
#include "tools/report/page.h"

std::string_view fluidtex::tools::pageTemplate() {
  static constexpr char kPage[] = R"${kEnd}(${html})${kEnd}";
  return {kPage, sizeof kPage - 1};
}
`,
);
