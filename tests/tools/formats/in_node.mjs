// node in_node.mjs FILE: a .glb through Khronos' validator and glTF Transform, or a .usda through TinyUSDZ. Prints
// what is there. Run in a folder into which the readers may be fetched. Exits with 77 where they cannot be.
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { fetchPackages } from './packages.mjs';

const file = process.argv[2];
const bytes = new Uint8Array(readFileSync(file));
const require = fetchPackages();
const load = (name) => import(pathToFileURL(require.resolve(name)));

const range = (points) => {
  const low = [Infinity, Infinity, Infinity], high = low.map((x) => -x);
  points.forEach((x, i) => { low[i % 3] = Math.min(low[i % 3], x); high[i % 3] = Math.max(high[i % 3], x); });
  return { low, high };
};

async function inGltf() {
  const validator = require('gltf-validator');
  const beside = async (uri) => new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri))));
  const { issues } = await validator.validateBytes(bytes, { externalResourceFunction: beside });
  const { NodeIO } = await load('@gltf-transform/core');
  const document = await new NodeIO().read(file);
  const root = document.getRoot();
  const node = root.listNodes()[0], primitive = root.listMeshes()[0].listPrimitives()[0];
  const points = primitive.getAttribute('POSITION').getArray(), matrix = node.getWorldMatrix();
  const placed = [];
  for (let v = 0; v < points.length; v += 3)
    for (let k = 0; k < 3; ++k)
      placed.push(matrix[k] * points[v] + matrix[4 + k] * points[v + 1] + matrix[8 + k] * points[v + 2] + matrix[12 + k]);
  const attributes = {};
  for (const name of primitive.listSemantics()) attributes[name] = Array.from(primitive.getAttribute(name).getArray());
  const picture = root.listTextures()[0];
  return {
    errors: issues.numErrors, warnings: issues.numWarnings, messages: issues.messages, attributes,
    indices: Array.from(primitive.getIndices().getArray()), picture: picture?.getSize(), ...range(placed),
  };
}

// Its WebAssembly wants to be in a browser.
async function tinyUsd() {
  const wasmBinary = readFileSync(join(dirname(require.resolve('tinyusdz')), 'tinyusdz.wasm'));
  const url = pathToFileURL(require.resolve('tinyusdz'));
  process.type = 'renderer';
  globalThis.window = {};
  return (await import(url)).default({ wasmBinary });
}

async function inUsd() {
  const usd = await tinyUsd();
  const loader = new usd.TinyUSDZLoaderNative();
  const text = new TextDecoder().decode(bytes);
  if (/^def Xform "liquid" \(/m.test(text)) {
    if (!loader.loadAsLayerFromBinary(bytes, file)) throw new Error(loader.error());
    return { layer: loader.layerToString(), references: loader.extractReferencesAssetPaths() };
  }
  if (!loader.loadFromBinary(bytes, file)) throw new Error(loader.error());
  const mesh = loader.getMesh(0), p = mesh.points;
  let area = 0;
  for (let t = 0; t < mesh.faceVertexIndices.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * mesh.faceVertexIndices[t + k]);
    const u = [0, 1, 2].map((k) => p[b + k] - p[a + k]), v = [0, 1, 2].map((k) => p[c + k] - p[a + k]);
    area += 0.5 * Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  }
  const texture = loader.getMaterial(mesh.materialId)?.diffuseColorTextureId;
  const picture = texture === undefined ? null : loader.getImage(loader.getTexture(texture).textureImageId).uri;
  return { ...range(p), area, st: Array.from(mesh.texcoords ?? []), picture };
}

const found = file.endsWith('.glb') ? await inGltf() : await inUsd();
process.stdout.write('\nFOUND\n' + JSON.stringify(found) + '\n');
