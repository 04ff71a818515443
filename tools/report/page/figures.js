// The plots, each of one or several lines over the frames. `of`: the value of a frame's record
// (docs/reference/files.md); null where it is not known. stacked: lines are drawn on top of each other.

const line = (name, of) => ({ name, of });
const key = (name, what) => line(name, (frame) => frame[what]);
const stage = (name) => line(name, (frame) => frame.seconds?.[name]);

export const kPlots = [
  {
    title: 'Volume',
    unit: 'm³',
    lines: [
      key('volume', 'volume'),
      line('with the deficit', (frame) => (frame.deficit == null ? null : frame.volume + frame.deficit)),
    ],
  },
  { title: 'Volume deficit', unit: 'm³', lines: [key('Volume deficit', 'deficit')] },
  { title: 'Points', unit: '', lines: [key('Points', 'vertices')] },
  { title: 'Substeps', unit: '', lines: [key('Substeps', 'substeps')] },
  {
    title: 'Motion that the velocities explain',
    unit: '1 is all',
    lines: [key('Motion that the velocities explain', 'explained')],
  },
  { title: 'Renewed', unit: 'share of the points', lines: [key('Renewed', 'renewed')] },
  { title: 'Likeness', unit: '1: as like as the exemplar to itself', lines: [key('Likeness', 'likeness')] },
  { title: 'Pops', unit: 'change of colour', lines: [key('Pops', 'pop')] },
  {
    title: 'Time',
    unit: 's a frame',
    stacked: true,
    lines: ['simulate', 'prepare', 'transport', 'synthesize', 'render', 'write'].map(stage),
  },
  {
    title: 'Memory',
    unit: 'GB, largest so far',
    lines: [line('Memory', (frame) => (frame.peak_rss == null ? null : frame.peak_rss / 1e9))],
  },
];

// What only `fluidtex measure` knows.
export const kMeasured = ['Likeness', 'Pops'];
