// Plots of a run's figures over its frames, drawn by uPlot. All have one cursor: the frame that is shown.
import uPlot from 'uplot';
import { kMeasured, kPlots } from './figures.js';
import { rounded } from './format.js';

const kHeight = 170; // pixels
const kColors = {
  light: ['#0f6b8f', '#c2571a', '#3d7a35', '#8a4fa3', '#b5952b', '#777777'],
  dark: ['#6cc3e6', '#f2965c', '#8fce86', '#c99be0', '#e3c765', '#aaaaaa'],
};
const kDark = matchMedia('(prefers-color-scheme: dark)');

// Columns of uPlot: frames, then one for each line, and what the legend says of them. Where lines are
// stacked, each column is the sum of those before.
function columnsOf(plot, frames) {
  const values = plot.lines.map((line) => frames.map((frame) => line.of(frame) ?? null));
  const drawn = plot.stacked
    ? values.map((_, n) =>
        frames.map((__, i) => values.slice(0, n + 1).reduce((sum, column) => sum + (column[i] ?? 0), 0)),
      )
    : values;
  return { data: [frames.map((frame) => frame.frame), ...drawn], values };
}

const isKnown = (columns) => columns.values.some((column) => column.some((value) => value != null));

function styled(plot, columns, onPick, onSize) {
  const style = getComputedStyle(document.documentElement);
  const quiet = style.getPropertyValue('--quiet').trim();
  const line = style.getPropertyValue('--line').trim();
  const colors = kColors[kDark.matches ? 'dark' : 'light'];
  const axis = {
    stroke: quiet,
    grid: { stroke: line, width: 1 },
    ticks: { stroke: line, width: 1, size: 4 },
    font: '12px system-ui, sans-serif',
  };
  return {
    height: kHeight,
    scales: { x: { time: false }, y: { range: (_, low, high) => rangeOf(low, high, plot.stacked) } },
    axes: [
      { ...axis, size: 28, incrs: [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000], gap: 2 },
      {
        ...axis,
        size: (_, texts) => 18 + 7 * Math.max(4, ...(texts ?? []).map((text) => text.length)),
        gap: 4,
        values: (_, ticks) => ticks.map((tick) => (tick === 0 ? '0' : rounded(tick))),
      },
    ],
    series: [
      {},
      ...plot.lines.map(({ name }, n) => ({
        label: name,
        stroke: colors[n],
        width: 1.5,
        fill: plot.stacked ? `${colors[n]}55` : undefined,
        spanGaps: true,
        points: { show: columns.values[n].filter((value) => value != null).length < 40, size: 4 },
        value: (_, __, ___, i) => rounded(i == null ? null : columns.values[n][i]),
      })),
    ],
    bands: plot.stacked ? plot.lines.slice(1).map((_, n) => ({ series: [n + 2, n + 1] })) : [],
    cursor: { y: false, drag: { x: false, y: false }, points: { size: 6 } },
    hooks: {
      ready: [(u) => u.over.addEventListener('click', () => onPick(u.data[0][u.cursor.idx])), onSize],
      setSize: [onSize],
    },
  };
}

// What is drawn of a line's values: some room around; all of it from 0 on where shares of a whole are
// stacked.
function rangeOf(low, high, stacked) {
  if (low == null) return [0, 1];
  if (stacked) return [0, high * 1.05 || 1];
  const room = Math.max(0.08 * (high - low), 0.02 * Math.abs(high)) || 1;
  return [low >= 0 ? Math.max(0, low - room) : low - room, high + room];
}

export class Plots {
  #drawn = []; // {plot, columns, u, box}
  #run = null;
  #frame = 0;
  onPick = () => {};

  constructor() {
    kDark.addEventListener('change', () => this.#run && this.#drawAnew());
    new ResizeObserver(() =>
      this.#drawn.forEach(({ u, box }) => u.setSize({ width: widthIn(box), height: kHeight })),
    ).observe(document.querySelector('#plots .grid'));
  }

  show(run) {
    this.#run = run;
    document.querySelector('#plots').hidden = run.frames.length === 0;
    const columns = new Map(kPlots.map((plot) => [plot, columnsOf(plot, run.frames)]));
    if (this.#drawn.length === [...columns.values()].filter(isKnown).length) {
      for (const drawn of this.#drawn) {
        Object.assign(drawn.columns, columns.get(drawn.plot));
        drawn.u.setData(drawn.columns.data);
      }
    } else {
      this.#drawAnew();
    }
    const missing = kMeasured.filter((title) => !this.#drawn.some(({ plot }) => plot.title === title));
    document.querySelector('#plots .note').textContent = missing.length
      ? `${missing.join(' and ')}: known after fluidtex measure.`
      : '';
  }

  mark(frame) {
    this.#frame = frame;
    for (const { u } of this.#drawn) this.#markIn(u);
  }

  #markIn(u) {
    const index = u.data[0].indexOf(this.#frame);
    if (index < 0) return;
    u.setCursor({ left: u.valToPos(this.#frame, 'x'), top: 0 }, true);
  }

  #drawAnew() {
    for (const { u } of this.#drawn) u.destroy();
    this.#drawn = [];
    const grid = document.querySelector('#plots .grid');
    grid.replaceChildren();
    for (const plot of kPlots) {
      const columns = columnsOf(plot, this.#run.frames);
      if (!isKnown(columns)) continue;
      const box = document.createElement('div');
      box.className = 'plot';
      const head = document.createElement('h3');
      head.textContent = `${plot.title} `;
      const unit = document.createElement('small');
      unit.textContent = plot.unit;
      head.append(unit);
      box.append(head);
      grid.append(box);
      const u = new uPlot(
        {
          ...styled(
            plot,
            columns,
            (frame) => this.onPick(frame),
            (drawn) => this.#markIn(drawn),
          ),
          width: widthIn(box),
        },
        columns.data,
        box,
      );
      u.over.addEventListener('mouseleave', () => this.#markIn(u));
      this.#drawn.push({ plot, columns, u, box });
    }
  }
}

function widthIn(box) {
  const style = getComputedStyle(box);
  return Math.max(120, box.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight));
}
