// What is said in words: title, summary, warnings, video, scene and the frames in figures.
import { kPlots } from './figures.js';
import { duration, plural, rounded } from './format.js';

const find = (selector) => document.querySelector(selector);

function listOf(run) {
  const frames = run.frames;
  const last = frames.at(-1);
  const seconds = frames.reduce(
    (sum, f) => sum + Object.values(f.seconds ?? {}).reduce((a, b) => a + b, 0),
    0,
  );
  return [
    run.quality && `${run.quality} quality`,
    last?.vertices && `${last.vertices.toLocaleString('en')} points`,
    plural(frames.length, 'frame'),
    seconds > 0 && `${duration(seconds)} on ${plural(run.threads, 'thread')}`,
    `seed ${run.seed}`,
    `fluidtex ${run.version}`,
  ].filter(Boolean);
}

function cell(kind, text) {
  const element = document.createElement(kind);
  element.textContent = text;
  if (kind === 'th') element.scope = 'col';
  return element;
}

let shown = []; // frames in the table

// One row a frame, one column a line of the plots. A long run's table takes time: it is made when it is
// opened.
function fillTable() {
  const table = find('#table'),
    frames = shown;
  if (!table.closest('details').open) return;
  const columns = kPlots
    .flatMap((plot) =>
      plot.lines.map((line) => ({
        head: line.name === plot.title ? plot.title : `${plot.title}: ${line.name}`,
        unit: plot.unit,
        of: line.of,
      })),
    )
    .filter((column) => frames.some((frame) => column.of(frame) != null));
  const head = document.createElement('thead').appendChild(document.createElement('tr'));
  head.append(
    cell('th', 'Frame'),
    cell('th', 'Time (s)'),
    ...columns.map((c) => cell('th', c.unit ? `${c.head} (${c.unit})` : c.head)),
  );
  const body = document.createElement('tbody');
  for (const frame of frames) {
    const row = document.createElement('tr');
    row.append(
      cell('td', frame.frame),
      cell('td', rounded(frame.time)),
      ...columns.map((c) => cell('td', rounded(c.of(frame)))),
    );
    body.append(row);
  }
  table.replaceChildren(head.parentNode, body);
}

find('#table').closest('details').addEventListener('toggle', fillTable);

export function showFacts(source) {
  const { run } = source;
  document.title = `${run.title} – fluidtex`;
  find('#title').textContent = run.title;
  find('#summary').textContent = listOf(run).join(' · ');
  find('#warnings').hidden = run.warnings.length === 0;
  find('#warnings ul').replaceChildren(...run.warnings.map((warning) => cell('li', warning)));
  find('#scene').textContent = run.scene;
  find('#looks').style.setProperty('--aspect', run.aspect ?? 16 / 9);
  shown = run.frames;
  fillTable();
  const video = find('video');
  find('#film').hidden = !run.video;
  if (!run.video) return;
  const address = source.video();
  if (video.getAttribute('src') !== address) {
    video.src = address;
    video.poster = run.pictures.length
      ? source.picture(run.pictures[Math.floor(run.pictures.length / 2)])
      : '';
  }
  find('#film .note').textContent =
    source.live || run.video.embedded
      ? ''
      : `The video is too large for this page: it is shown from the file ${run.video.name} beside it.`;
}

// How far a run is that goes on. reached: whether `fluidtex view` still answers.
export function showState(run, reached) {
  const state = find('#state');
  state.hidden = false;
  const done = run.frames.at(-1)?.frame ?? 0;
  const text = !reached
    ? 'fluidtex view no longer answers: what is shown is the last that was known.'
    : done === 0
      ? 'No frame is done yet.'
      : done < run.total
        ? `Frame ${done} of ${run.total} is done.`
        : `All ${run.total} frames are done.`;
  if (state.textContent !== text) state.textContent = text;
}
