// Reads what tools/report/packed_mesh.h describes.
import { MeshoptDecoder } from 'meshoptimizer/decoder';

const kVertexBytes = 16;

export async function unpack(bytes) {
  await MeshoptDecoder.ready;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const [vertices, indices, vertexBytes, indexBytes] = [0, 4, 8, 12].map((at) => view.getUint32(at, true));
  const [x, y, z, step, mostAge, mostSpeed] = [16, 20, 24, 28, 32, 36].map((at) => view.getFloat32(at, true));
  const kHead = 40;
  const packed = new Uint8Array(vertices * kVertexBytes);
  MeshoptDecoder.decodeVertexBuffer(
    packed,
    vertices,
    kVertexBytes,
    bytes.subarray(kHead, kHead + vertexBytes),
  );
  const index = new Uint32Array(indices);
  MeshoptDecoder.decodeIndexBuffer(
    new Uint8Array(index.buffer),
    indices,
    4,
    bytes.subarray(kHead + vertexBytes, kHead + vertexBytes + indexBytes),
  );

  const corner = new Uint16Array(packed.buffer);
  const position = new Float32Array(3 * vertices);
  const color = new Uint8Array(4 * vertices);
  const figures = {
    age: new Float32Array(vertices),
    trust: new Float32Array(vertices),
    speed: new Float32Array(vertices),
  };
  for (let v = 0; v < vertices; ++v) {
    const words = 8 * v,
      at = kVertexBytes * v;
    position[3 * v] = x + step * corner[words];
    position[3 * v + 1] = y + step * corner[words + 1];
    position[3 * v + 2] = z + step * corner[words + 2];
    for (let c = 0; c < 4; ++c) color[4 * v + c] = packed[at + 8 + c];
    figures.age[v] = packed[at + 12] / 255;
    figures.trust[v] = packed[at + 13] / 255;
    figures.speed[v] = packed[at + 14] / 255;
  }
  return { index, position, color, figures, most: { age: mostAge, trust: 1, speed: mostSpeed } };
}
