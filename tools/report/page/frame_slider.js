// Slider over the frames, and the picture of the one that it is at.

const find = (selector) => document.querySelector(selector);

// The last of ascending `frames` that is not after `frame`, else the first.
export const nearest = (frames, frame) => frames.findLast((f) => f <= frame) ?? frames[0];

export class FrameSlider {
  #source;
  #onFrame;
  #frames = []; // those that the slider can be at
  #timer = 0;
  #slider = find('#slider');

  // onFrame(frame): called whenever the slider is at another frame.
  constructor(source, onFrame) {
    this.#source = source;
    this.#onFrame = onFrame;
    this.#slider.addEventListener('input', () => {
      this.#stop();
      this.#show();
    });
    find('#play').addEventListener('click', () => (this.#timer ? this.#stop() : this.#play()));
  }

  // The source has other frames now. Who looks at the last one goes on to look at the last.
  update() {
    const slider = this.#slider;
    const atEnd = Number(slider.value) === Number(slider.max);
    this.#frames = this.#source.run.frames.map((frame) => frame.frame);
    slider.max = Math.max(0, this.#frames.length - 1);
    if (atEnd && this.#source.live) slider.value = slider.max;
    find('#looks').hidden = this.#frames.length === 0;
    this.#show();
  }

  goTo(frame) {
    this.#stop();
    this.#slider.value = this.#frames.indexOf(nearest(this.#frames, frame));
    this.#show();
  }

  #show() {
    const frame = this.#frames[this.#slider.value];
    if (frame === undefined) return;
    const { run } = this.#source;
    const record = run.frames[this.#slider.value];
    find('#frame').textContent = `Frame ${frame}, ${record.time.toFixed(2)} s`;
    this.#slider.setAttribute('aria-valuetext', `frame ${frame}`);
    this.#showPicture(frame);
    this.#onFrame(frame);
  }

  #showPicture(frame) {
    const { pictures } = this.#source.run;
    find('#picture').hidden = pictures.length === 0;
    if (pictures.length === 0) return;
    const shown = nearest(pictures, frame);
    const image = find('#picture img');
    const address = this.#source.picture(shown);
    if (image.getAttribute('src') !== address) image.src = address;
    image.alt = `Picture of frame ${shown}`;
    find('#picture figcaption').textContent = `Picture of frame ${shown}`;
  }

  #play() {
    const slider = this.#slider;
    if (Number(slider.value) === Number(slider.max)) slider.value = 0;
    this.#timer = setInterval(
      () => {
        if (Number(slider.value) === Number(slider.max)) return this.#stop();
        slider.value = Number(slider.value) + 1;
        this.#show();
      },
      1000 / Math.min(30, this.#source.run.rate),
    );
    this.#tellPlaying();
  }

  #stop() {
    clearInterval(this.#timer);
    this.#timer = 0;
    this.#tellPlaying();
  }

  #tellPlaying() {
    const button = find('#play');
    button.textContent = this.#timer ? 'Pause' : 'Play';
    button.setAttribute('aria-pressed', String(this.#timer !== 0));
  }
}
