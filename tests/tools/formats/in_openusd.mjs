// node in_openusd.mjs STAGE FIRST LAST: OpenUSD itself, as WebAssembly (Autodesk's build) in Chromium, opens a stage and
// goes through its frames. Prints what Hydra is given of the mesh at each. Run in a folder into which the package may be
// fetched. Exits with 77 where it or Chromium is missing.
import { spawn } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { dirname, join, relative } from 'node:path';
import { fetchPackages } from './packages.mjs';

const [stage, first, last] = process.argv.slice(2);
const run = dirname(stage);
const library = join(dirname(fetchPackages().resolve('three-usdz-loader/package.json')), 'external');

// The stage and what it may refer to.
const files = [];
const collect = (folder) => {
  for (const name of readdirSync(folder)) {
    const path = join(folder, name);
    if (statSync(path).isDirectory()) collect(path);
    else if (/\.(usda|png)$/.test(name)) files.push(relative(run, path));
  }
};
collect(run);

// Runs in the browser.
async function inBrowser(names, stageName, from, to) {
  const usd = await window.getUsdModule(undefined, '', undefined);
  await usd.ready;
  for (const name of names) {
    const parts = ('run/' + name).split('/');
    for (let n = 1; n < parts.length; ++n) {
      const folder = '/' + parts.slice(0, n).join('/');
      if (!usd.FS.analyzePath(folder).exists) usd.FS.mkdir(folder);
    }
    const bytes = new Uint8Array(await (await fetch('/run/' + encodeURIComponent(name))).arrayBuffer());
    usd.FS.createDataFile('/' + parts.slice(0, -1).join('/'), parts.at(-1), bytes, true, true, true);
  }
  let mesh = { primvars: {} };
  const handlers = {
    updatePoints: (points) => (mesh.points = Array.from(points)),
    updateIndices: (indices) => (mesh.indices = Array.from(indices)),
    updatePrimvar: (name, data, dimension, interpolation) => (mesh.primvars[name] = { rows: data.length / dimension, interpolation }),
    setMaterial: (id) => (mesh.material = id),
  };
  // Whatever else it says of a prim is passed over.
  const prim = () => new Proxy({}, { get: (target, key) => handlers[key] ?? (() => {}) });
  const nothing = () => undefined;
  const driver = new usd.HdWebSyncDriver(
    { createRPrim: prim, createBPrim: nothing, createSPrim: (type) => (type === 'material' ? prim() : undefined), CommitResources: nothing },
    '/run/' + stageName);
  const stage = driver.GetStage();
  const found = { start: stage.GetStartTimeCode(), end: stage.GetEndTimeCode(), rate: stage.GetTimeCodesPerSecond(), frames: {} };
  for (let frame = from; frame <= to; ++frame) {
    mesh = { primvars: {} };
    driver.SetTime(frame);
    driver.Draw();
    found.frames[frame] = mesh;
  }
  return found;
}

const page = `<script src="emHdBindings.js"></script><script>
const answer = (found) => fetch('/found', { method: 'POST', body: JSON.stringify(found) });
(${inBrowser})(${JSON.stringify(files)}, ${JSON.stringify(relative(run, stage))}, ${first}, ${last})
  .then(answer, (error) => answer({ error: String(error) }));
</script>`;
const types = { js: 'text/javascript', wasm: 'application/wasm', html: 'text/html' };
let browser, scratch;

function finish(found) {
  browser.kill();
  browser.once('exit', () => {
    rmSync(scratch, { recursive: true, force: true, maxRetries: 5 });
    process.stdout.write('\nFOUND\n' + JSON.stringify(found) + '\n', () => process.exit(0));
  });
}

const server = createServer((request, response) => {
  const path = decodeURIComponent(request.url.slice(1));
  if (path === 'found') {
    let text = '';
    request.on('data', (part) => (text += part));
    request.on('end', () => finish(JSON.parse(text)));
    return response.end();
  }
  const name = path || 'index.html';
  // Threads of WebAssembly ask for both.
  response.setHeader('Cross-Origin-Opener-Policy', 'same-origin');
  response.setHeader('Cross-Origin-Embedder-Policy', 'require-corp');
  response.setHeader('Content-Type', types[name.split('.').at(-1)] ?? 'application/octet-stream');
  try {
    response.end(path === '' ? page : readFileSync(path.startsWith('run/') ? join(run, path.slice(4)) : join(library, path)));
  } catch {
    response.statusCode = 404;
    response.end();
  }
});
server.listen(0, '127.0.0.1', () => {
  scratch = mkdtempSync(join(tmpdir(), 'fluidtex-openusd-'));
  const flags = ['--headless', '--no-sandbox', '--disable-gpu', '--remote-debugging-port=0', `--user-data-dir=${scratch}`];
  browser = spawn('chromium', [...flags, `http://127.0.0.1:${server.address().port}/`], { stdio: 'ignore' });
  browser.on('error', () => {
    console.error('in_openusd.mjs: chromium is not installed');
    process.exit(77);
  });
  setTimeout(() => finish({ error: 'no answer within two minutes' }), 120_000);
});
