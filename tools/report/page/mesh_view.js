// The textured mesh of a frame, to be turned.
import {
  BufferAttribute,
  BufferGeometry,
  DirectionalLight,
  DoubleSide,
  HemisphereLight,
  Mesh,
  MeshStandardMaterial,
  PerspectiveCamera,
  Scene,
  Spherical,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { nearest } from './frame_slider.js';
import { rounded } from './format.js';
import { unpack } from './packed_mesh.js';

const find = (selector) => document.querySelector(selector);
const kTurn = Math.PI / 24; // by one press of an arrow key
const kWait = 80; // ms that the slider has to rest

// Linear value of a byte of sRGB.
const kLinear = Float32Array.from({ length: 256 }, (_, byte) => {
  const c = byte / 255;
  return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
});

// From dark blue to yellow, even in lightness; sRGB bytes.
const kRamp = [
  [48, 18, 92],
  [38, 84, 140],
  [33, 145, 140],
  [94, 201, 98],
  [253, 231, 37],
];

function rampColor(value) {
  const at = Math.min(Math.max(value, 0), 1) * (kRamp.length - 1);
  const low = Math.min(Math.floor(at), kRamp.length - 2);
  return [0, 1, 2].map((c) => kRamp[low][c] + (at - low) * (kRamp[low + 1][c] - kRamp[low][c]));
}

function colorsOf(mesh, what) {
  const count = mesh.color.length / 4;
  const colors = new Float32Array(4 * count);
  for (let v = 0; v < count; ++v) {
    const from =
      what === 'texture' ? mesh.color.subarray(4 * v, 4 * v + 4) : rampColor(mesh.figures[what][v]);
    for (let c = 0; c < 3; ++c) colors[4 * v + c] = kLinear[Math.round(from[c])];
    colors[4 * v + 3] = what === 'texture' ? mesh.color[4 * v + 3] / 255 : 1;
  }
  return colors;
}

export class MeshView {
  #source;
  #canvas = find('#mesh canvas');
  #select = find('#mesh select');
  #renderer = null;
  #scene = new Scene();
  #camera = new PerspectiveCamera();
  #controls;
  #geometry = new BufferGeometry();
  #material = new MeshStandardMaterial({ vertexColors: true, roughness: 0.55, side: DoubleSide });
  #mesh = null; // as unpacked
  #shown = 0; // frame of it
  #wanted = 0;
  #timer = 0;

  constructor(source) {
    this.#source = source;
    try {
      this.#renderer = new WebGLRenderer({ canvas: this.#canvas, antialias: true, alpha: true });
    } catch {
      this.#canvas.hidden = true;
      this.#say('This browser has no WebGL, which the mesh is drawn by.');
      return;
    }
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#camera.up.set(0, 0, 1);
    const light = new DirectionalLight(0xffffff, 2.2);
    light.position.set(-0.6, 0.8, 1);
    this.#camera.add(light);
    const sky = new HemisphereLight(0xffffff, 0x8a8578, 1.9);
    sky.position.set(0, 0, 1);
    this.#scene.add(this.#camera, sky, new Mesh(this.#geometry, this.#material));
    this.#takeInput();
    new ResizeObserver(() => this.#draw()).observe(this.#canvas);
    this.#select.addEventListener('change', () => this.#color());
  }

  // The source has other meshes now.
  update() {
    find('#mesh').hidden = this.#source.run.meshes.length === 0;
  }

  // Soon shows the mesh of the frame, or of the nearest before that there is one of.
  show(frame) {
    const { meshes } = this.#source.run;
    if (!this.#renderer || meshes.length === 0) return;
    this.#wanted = nearest(meshes, frame);
    clearTimeout(this.#timer);
    if (this.#wanted !== this.#shown)
      this.#timer = setTimeout(() => this.#load(this.#wanted), this.#shown ? kWait : 0);
  }

  async #load(frame) {
    try {
      const mesh = await unpack(await this.#source.mesh(frame));
      if (frame !== this.#wanted) return;
      this.#mesh = mesh;
    } catch {
      this.#say(`The mesh of frame ${frame} could not be read.`);
      return;
    }
    if (this.#shown === 0) this.#lookFromCamera();
    this.#shown = frame;
    this.#geometry.dispose();
    this.#geometry.setIndex(new BufferAttribute(this.#mesh.index, 1));
    this.#geometry.setAttribute('position', new BufferAttribute(this.#mesh.position, 3));
    this.#geometry.deleteAttribute('normal'); // else its length would be that of the mesh before
    this.#geometry.computeVertexNormals();
    this.#geometry.computeBoundingSphere();
    this.#color();
  }

  #color() {
    if (!this.#mesh) return;
    const what = this.#select.value;
    this.#geometry.setAttribute('color', new BufferAttribute(colorsOf(this.#mesh, what), 4));
    this.#material.transparent =
      what === 'texture' && this.#mesh.color.some((byte, n) => n % 4 === 3 && byte < 255);
    this.#material.needsUpdate = true;
    const unit = { age: ' s', trust: '', speed: ' m/s' }[what];
    const scale = what === 'texture' ? '' : `, dark 0 to bright ${rounded(this.#mesh.most[what])}${unit}`;
    this.#say(`Mesh of frame ${this.#shown}${scale}`);
    this.#draw();
  }

  // As the scene's camera does in the first picture.
  #lookFromCamera() {
    const { from, at, fov } = this.#source.run.camera;
    this.#camera.fov = fov;
    this.#camera.position.set(...from);
    this.#controls.target.set(...at);
    const distance = this.#controls.getDistance();
    this.#camera.near = distance / 100;
    this.#camera.far = distance * 100;
    this.#controls.update();
  }

  #takeInput() {
    const controls = new OrbitControls(this.#camera, this.#canvas);
    this.#controls = controls;
    this.#canvas.style.touchAction = 'pan-y'; // a finger that moves up and down still scrolls the page
    controls.enableZoom = false; // so does the wheel, until the mesh was clicked
    this.#canvas.addEventListener('focus', () => (controls.enableZoom = true));
    this.#canvas.addEventListener('blur', () => (controls.enableZoom = false));
    this.#canvas.addEventListener('pointerdown', () => this.#canvas.focus({ preventScroll: true }));
    controls.addEventListener('change', () => this.#draw());
    this.#canvas.addEventListener('keydown', (event) => {
      const [sideways, up] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[
        event.key
      ] ?? [0, 0];
      if (!sideways && !up) return;
      event.preventDefault();
      this.#turn(sideways * kTurn, up * kTurn);
    });
  }

  #turn(sideways, up) {
    // three.js's spherical coordinates turn around y, the page's meshes stand on z.
    const offset = this.#camera.position.clone().sub(this.#controls.target);
    const place = new Spherical().setFromVector3(new Vector3(offset.x, offset.z, -offset.y));
    place.theta += sideways;
    place.phi += up;
    place.makeSafe();
    const turned = new Vector3().setFromSpherical(place);
    this.#camera.position.set(turned.x, -turned.z, turned.y).add(this.#controls.target);
    this.#controls.update();
  }

  #draw() {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (!this.#mesh || !width || !height) return;
    this.#renderer.setSize(width, height, false);
    this.#camera.aspect = width / height;
    this.#camera.updateProjectionMatrix();
    this.#renderer.render(this.#scene, this.#camera);
  }

  #say(text) {
    find('#mesh .what').textContent = text;
  }
}
