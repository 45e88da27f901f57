// SPDX-License-Identifier: MIT
// A tube as GLB whose texture is red below the middle of its length, and blue above.
import { deflateSync } from "node:zlib";

function checksum(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type), data]), out = Buffer.alloc(body.length + 8);
  out.writeUInt32BE(data.length, 0);
  body.copy(out, 4);
  out.writeUInt32BE(checksum(body), body.length + 4);
  return out;
}

/// Rows of pixels of 3 bytes.
function png(rows) {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(rows[0].length, 0);
  header.writeUInt32BE(rows.length, 4);
  header.set([8, 2], 8);
  const pixels = Buffer.concat(rows.map((row) => Buffer.from([0, ...row.flat()])));
  return Buffer.concat([Buffer.from("89504e470d0a1a0a", "hex"), chunk("IHDR", header), chunk("IDAT", deflateSync(pixels)),
                        chunk("IEND", Buffer.alloc(0))]);
}

export function textured_tube({ columns = 24, rows = 81, length = 8 } = {}) {
  const positions = [], uvs = [], triangles = [];
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column <= columns; ++column) {
      const beta = 2 * Math.PI * column / columns;
      positions.push(Math.cos(beta), Math.sin(beta), length * row / (rows - 1));
      uvs.push(column / columns, 1 - row / (rows - 1));  // glTF's v points down: the last row of pixels is at the base
    }
  }
  for (let row = 0; row + 1 < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      const a = row * (columns + 1) + column, b = a + columns + 1;
      triangles.push(a, a + 1, b, b, a + 1, b + 1);
    }
  }
  const red = [220, 20, 20], blue = [20, 20, 220];
  const image = png([blue, blue, red, red].map((color) => [color, color]));
  const parts = [Buffer.from(new Float32Array(positions).buffer), Buffer.from(new Float32Array(uvs).buffer),
                 Buffer.from(new Uint32Array(triangles).buffer), Buffer.concat([image, Buffer.alloc(-image.length & 3)])];
  let offset = 0;
  const views = parts.map((part) => ({ buffer: 0, byteOffset: (offset += part.length) - part.length, byteLength: part.length }));
  const json = {
    asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0, TEXCOORD_0: 1 }, indices: 2, material: 0 }] }],
    materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }],
    textures: [{ source: 0 }], images: [{ bufferView: 3, mimeType: "image/png" }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: positions.length / 3, type: "VEC3", min: [-1, -1, 0], max: [1, 1, length] },
      { bufferView: 1, componentType: 5126, count: uvs.length / 2, type: "VEC2" },
      { bufferView: 2, componentType: 5125, count: triangles.length, type: "SCALAR" }],
    bufferViews: views, buffers: [{ byteLength: offset }],
  };
  const padded = (bytes, fill) => Buffer.concat([bytes, Buffer.alloc(-bytes.length & 3, fill)]);
  const framed = (type, bytes) => {
    const head = Buffer.alloc(8);
    head.writeUInt32LE(bytes.length, 0);
    head.write(type, 4, "latin1");
    return Buffer.concat([head, bytes]);
  };
  const chunks = Buffer.concat([framed("JSON", padded(Buffer.from(JSON.stringify(json)), 0x20)), framed("BIN\0", padded(Buffer.concat(parts), 0))]);
  const header = Buffer.alloc(12);
  header.write("glTF", 0, "latin1");
  header.writeUInt32LE(2, 4);
  header.writeUInt32LE(12 + chunks.length, 8);
  return Buffer.concat([header, chunks]);
}
