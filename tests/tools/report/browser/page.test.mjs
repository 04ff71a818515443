// node page.test.mjs FLUIDTEX: the page of a run, in a real browser. Run in a folder where playwright-core
// may be installed. Exits with 77 where Chromium is missing, which ctest takes as skipped.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { accessSync, constants, copyFileSync, mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { delimiter, dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const fluidtex = resolve(process.argv[2]);
const scene = join(here, '../../small.toml');

function found(program) {
  for (const folder of process.env.PATH.split(delimiter)) {
    try {
      accessSync(join(folder, program), constants.X_OK);
      return join(folder, program);
    } catch {}
  }
  return null;
}

function skip(why) {
  console.log(`page.test.mjs: skipped: ${why}`);
  process.exit(77);
}

// The version that package-lock.json names.
function playwright() {
  for (const file of ['package.json', 'package-lock.json']) copyFileSync(join(here, file), file);
  const installed = spawnSync(
    'npm',
    ['ci', '--ignore-scripts', '--no-audit', '--no-fund', '--loglevel=error'],
    { encoding: 'utf8' },
  );
  if (installed.status !== 0) skip(`playwright-core cannot be fetched: ${installed.stderr}`);
  return createRequire(join(process.cwd(), 'package.json'))('playwright-core');
}

const program =
  found('chromium') ??
  found('chromium-browser') ??
  skip('chromium is not installed: apt-get install chromium');
const { chromium } = playwright();
const scratch = mkdtempSync(join(tmpdir(), 'fluidtex-page-'));
const browser = await chromium.launch({ executablePath: program, args: ['--no-sandbox', '--disable-gpu'] });
let server = null;

// A page whose complaints and requests are kept.
async function open(address, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, ...options });
  page.faults = [];
  page.elsewhere = [];
  page.on('console', (message) => message.type() === 'error' && page.faults.push(message.text()));
  page.on('pageerror', (error) => page.faults.push(String(error)));
  const origin = new URL(address).origin;
  page.on('request', (request) => {
    if (!/^(data|blob|file):/.test(request.url()) && new URL(request.url()).origin !== origin)
      page.elsewhere.push(request.url());
  });
  await page.goto(address);
  return page;
}

function hasNoFaults(page) {
  assert.deepEqual(page.faults, []);
  assert.deepEqual(page.elsewhere, []);
}

const picture = (page) => page.locator('#picture img').getAttribute('src');
// The pixels that are seen of the mesh, once that of `frame`, or any, is drawn.
async function mesh(page, frame = '') {
  await page.waitForFunction(
    (text) => document.querySelector('#mesh .what').textContent.startsWith(text),
    `Mesh of frame ${frame}`,
  );
  await page.waitForTimeout(300);
  return (await page.locator('#mesh canvas').screenshot()).toString('base64');
}

async function moveSlider(page, place) {
  await page.locator('#slider').evaluate((slider, value) => {
    slider.value = value;
    slider.dispatchEvent(new Event('input', { bubbles: true }));
  }, place);
  await page.waitForTimeout(300);
}

async function colorsIn(page, image) {
  return page.evaluate(async (data) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
    const canvas = new OffscreenCanvas(image.width, image.height).getContext('2d');
    canvas.drawImage(image, 0, 0);
    const pixels = new Uint32Array(canvas.getImageData(0, 0, image.width, image.height).data.buffer);
    return new Set(pixels).size;
  }, image);
}

async function looksAndTurns(page, blank) {
  const first = await mesh(page);
  assert.ok((await colorsIn(blank, first)) > 500, 'the mesh is drawn');
  const box = await page.locator('#mesh canvas').boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 120, box.y + box.height / 2 + 40, { steps: 5 });
  await page.mouse.up();
  const dragged = await mesh(page);
  assert.notEqual(dragged, first, 'dragging turns the mesh');
  await page.locator('#mesh canvas').press('ArrowLeft');
  const turned = await mesh(page);
  assert.notEqual(turned, dragged, 'an arrow key turns the mesh');
  for (const what of ['age', 'trust', 'speed']) {
    await page.locator('#mesh select').selectOption(what);
    assert.notEqual(await mesh(page), turned, `colours of ${what}`);
  }
  await page.locator('#mesh select').selectOption('texture');
  assert.equal(await mesh(page), turned, 'the texture comes back');
}

async function slides(page) {
  await moveSlider(page, 0);
  const [firstPicture, firstMesh] = [await picture(page), await mesh(page, 1)];
  await moveSlider(page, 4);
  assert.notEqual(await picture(page), firstPicture, 'the slider changes the picture');
  assert.notEqual(await mesh(page, 5), firstMesh, 'the slider changes the mesh');
  assert.match(await page.locator('#frame').textContent(), /^Frame 5,/);
  await page.locator('#slider').press('ArrowLeft');
  assert.match(await page.locator('#frame').textContent(), /^Frame 4,/);
}

// A click on a plot goes to the frame there.
async function plotsPick(page) {
  assert.ok((await page.locator('.plot canvas').count()) >= 7, 'plots are drawn');
  const over = page.locator('.plot .u-over').first();
  await over.scrollIntoViewIfNeeded();
  const box = await over.boundingBox();
  await page.mouse.click(box.x + 2, box.y + box.height / 2);
  assert.match(await page.locator('#frame').textContent(), /^Frame 1,/);
}

async function fits(page) {
  const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  assert.ok(content <= window, `${content} pixels fit into ${window}`);
}

async function testReport(out) {
  const address = pathToFileURL(join(out, 'report.html')).href;
  const blank = await browser.newPage();
  const page = await open(address);
  assert.equal(await page.title(), 'small – fluidtex');
  await looksAndTurns(page, blank);
  await slides(page);
  await plotsPick(page);
  await page.waitForFunction(() => document.querySelector('video').readyState > 0);
  assert.equal(await page.locator('video').evaluate((video) => video.videoWidth), 96);
  assert.match(await page.locator('#scene').textContent(), /\[texture\]\n/);
  await page.getByText('The frames in figures').click();
  await page.waitForFunction(() => document.querySelectorAll('#table tbody tr').length === 5);
  await fits(page);
  hasNoFaults(page);

  const phone = await open(address, { viewport: { width: 360, height: 740 }, colorScheme: 'dark' });
  await mesh(phone);
  await fits(phone);
  const background = (p) => p.evaluate(() => getComputedStyle(document.body).backgroundColor);
  assert.notEqual(await background(phone), await background(page), 'dark where dark is wanted');
  hasNoFaults(phone);
}

function firstLine(stream) {
  return new Promise((done) => stream.once('data', (data) => done(String(data).trim())));
}

async function testView(out) {
  mkdirSync(out);
  server = spawn(fluidtex, ['view', out], { stdio: ['ignore', 'pipe', 'inherit'] });
  const address = await firstLine(server.stdout);
  const page = await open(address);
  await page.waitForFunction(() => document.querySelector('#state').textContent === 'No frame is done yet.');
  const run = spawn(fluidtex, ['run', scene, '--out', out, '--quiet'], { stdio: 'inherit' });
  const ended = new Promise((done) => run.once('exit', done));
  await page.waitForFunction(
    () => document.querySelector('#state').textContent === 'All 5 frames are done.',
    null,
    { timeout: 300_000 },
  );
  assert.equal(await ended, 0);
  assert.equal(
    await page.locator('#slider').evaluate((slider) => `${slider.value} of ${slider.max}`),
    '4 of 4',
  );
  const blank = await browser.newPage();
  await looksAndTurns(page, blank);
  await slides(page);
  await page.waitForFunction(() => document.querySelector('video').readyState > 0);
  hasNoFaults(page);
}

try {
  const out = join(scratch, 'odd & <name> ü 100%20 #1?');
  const run = spawnSync(fluidtex, ['run', scene, '--out', out, '--quiet'], { stdio: 'inherit' });
  assert.equal(run.status, 0);
  await testReport(out);
  await testView(join(scratch, 'live'));
  console.log('page.test.mjs: passed');
} finally {
  server?.kill();
  await browser.close();
  rmSync(scratch, { recursive: true });
}
