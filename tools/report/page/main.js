// The page of a run: it shows what the source (source.js) holds, and is brought up to date while the run goes
// on.
import { showFacts, showState } from './facts.js';
import { FrameSlider } from './frame_slider.js';
import { MeshView } from './mesh_view.js';
import { Plots } from './plots.js';
import { openSource } from './source.js';

const kPoll = 2000; // ms between two looks at a run that goes on

const source = await openSource();
const plots = new Plots();
const mesh = new MeshView(source);
const slider = new FrameSlider(source, (frame) => {
  mesh.show(frame);
  plots.mark(frame);
});
plots.onPick = (frame) => slider.goTo(frame);

function showAll() {
  showFacts(source);
  plots.show(source.run);
  mesh.update();
  slider.update();
}

async function poll() {
  const before = source.run.frames.length;
  try {
    if (await source.refresh()) {
      // A run that took the place of the one before has other files of the same names.
      if (source.run.frames.length < before) return location.reload();
      showAll();
    }
    showState(source.run, true);
  } catch {
    showState(source.run, false);
  }
  setTimeout(poll, kPoll);
}

showAll();
if (source.live) {
  showState(source.run, true);
  setTimeout(poll, kPoll);
}
