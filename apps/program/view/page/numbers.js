// The page of `ashlar view`, first part: numbers as packed_numbers.cpp packs them.
//
// The parts of the page are one script. In reading order: numbers, data (data of the page), units, fields and their
// colours, surface (blocks), relative (displacements relative to one), legend, joints, forces, actions (loads, supports,
// bolts, water), vectors, section, camera, marks (axes and scale bar), blocks (their list), key_blocks, pick, plots, answer,
// summary, address, controls, timeline, picture, start.
// `current` (address.js) is the state that the user can change; show() (controls.js) updates the picture for it.
"use strict";

const element = (id) => document.getElementById(id);

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/// The bytes of a zlib stream in base64.
async function inflated(base64) {
  const stream = new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/// Decodes data written by PackedNumbers, in the same order.
class NumberReader {
  constructor(bytes, at = 0) {
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.at = at;
  }

  float() {
    this.at += 4;
    return this.view.getFloat32(this.at - 4, true);
  }

  /// Whole numbers of 16 bits that were written as differences, low bytes first.
  words(count, Type = Uint16Array) {
    const words = new Type(count);
    let last = 0;
    for (let i = 0; i < count; ++i) {
      last = last + this.bytes[this.at + i] + 256 * this.bytes[this.at + count + i] & 0xffff;
      words[i] = last;
    }
    this.at += 2 * count;
    return words;
  }

  /// @return (#n x components), tuple after tuple
  reals(count, components = 1) {
    const largest = this.float();
    const words = this.words(count * components, Int16Array);
    const values = new Float32Array(count * components);
    for (let c = 0, k = 0; c < components; ++c) {
      for (let i = c; i < values.length; i += components, ++k) {
        const share = words[k] / 32767;
        values[i] = words[k] === -32768 ? NaN : Math.sign(share) * largest * share * share;
      }
    }
    return values;
  }

  /// @return (#n x 3), m
  points(count) {
    const box = Array.from({length: 6}, () => this.float());
    const words = this.words(3 * count);
    const points = new Float32Array(3 * count);
    for (let k = 0; k < 3; ++k) {
      const [low, high] = [box[2 * k], box[2 * k + 1]];
      for (let i = 0; i < count; ++i) points[3 * i + k] = low + (high - low) * words[k * count + i] / 65535;
    }
    return points;
  }

  /// @param spans [first point, point after the last] of each block. @return (#points x 3), m; nan of absent blocks
  displacements(spans, count) {
    const means = Array.from({length: 3 * spans.length}, () => this.float());
    const exponents = this.words(spans.length, Int16Array);
    const words = this.words(3 * count, Int16Array);
    const values = new Float32Array(3 * count);
    spans.forEach(([first, end], s) => {
      const unit = 2 ** exponents[s] / 32767;
      for (let i = first; i < end; ++i)
        for (let k = 0; k < 3; ++k) values[3 * i + k] = means[3 * s + k] + unit * words[k * count + i];
    });
    return values;
  }
}

/// Bytes used by displacements(spans, count) and reals(count, components).
const bytesOfDisplacements = (spans, count) => 14 * spans.length + 6 * count;
const bytesOfReals = (count, components = 1) => 4 + 2 * count * components;
