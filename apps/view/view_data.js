// The page of `ashlar view`, first part: what view_file.cpp wrote, and the fields and colours made of it.
//
// The parts are one script; in reading order: view_data.js (data, fields, legend), view_scene.js (surface, contacts,
// camera), view_panels.js (picked things, plots, summary), view_page.js (what is chosen, controls, pictures, start).
"use strict";

const STRESS_NAMES = ["xx", "yy", "zz", "xy", "yz", "xz"];
const CONTACT_NUMBERS = 15;
// Light where there is little: dark blocks would hide their edges and their shading.
const SEQUENTIAL = ["#ffffd9", "#edf8b1", "#c7e9b4", "#7fcdbb", "#41b6c4", "#1d91c0", "#225ea8", "#253494", "#081d58"];
const DIVERGING = ["#3b4cc0", "#7b9ff9", "#c0d4f5", "#eeeeee", "#f5c4ac", "#ee8468", "#b40426"];
const element = (id) => document.getElementById(id);

// ---- data -------------------------------------------------------------------------------------------------

function decode(base64, Type) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return new Type(bytes.buffer);
}

/// One frame: views into the floats that view_file.cpp wrote in this order.
function decodeFrame(head, line, scene) {
  const floats = decode(line, Float32Array);
  let at = 0;
  const take = (count) => floats.subarray(at, (at += count));
  const frame = {...head, displacement: take(3 * scene.points)};
  if (scene.velocity) frame.velocity = take(3 * scene.points);
  if (scene.stress) frame.stress = take(6 * scene.points);
  frame.contacts = decodeContacts(take(CONTACT_NUMBERS * head.contacts));
  return frame;
}

function decodeContacts(floats) {
  const contacts = [];
  for (let i = 0; i < floats.length; i += CONTACT_NUMBERS) {
    const vector = (k) => new THREE.Vector3(floats[i + k], floats[i + k + 1], floats[i + k + 2]);
    contacts.push({place: vector(0), force: vector(3), normal: vector(6), gap: floats[i + 9],
      area: floats[i + 10], type: floats[i + 11], state: floats[i + 12], a: floats[i + 13], b: floats[i + 14]});
  }
  return contacts;
}

function decodeCells(integers) {
  const cells = [];
  for (let i = 0; i < integers.length;) {
    const corners = integers.subarray(i + 4, i + 4 + integers[i + 3]);
    cells.push({block: integers[i], order: integers[i + 1], face: integers[i + 2], corners});
    i += 4 + corners.length;
  }
  return cells;
}

function decodeHistory(history) {
  const floats = decode(history.data, Float32Array);
  const width = history.columns.length;
  const values = {};
  history.columns.forEach((name, k) => {
    values[name] = Array.from({length: floats.length / width}, (_, row) => floats[row * width + k]);
  });
  return {columns: history.columns, values};
}

function loadData() {
  const scene = JSON.parse(element("scene").textContent);
  const lines = element("frames").textContent.trim().split("\n");
  const given = scene.summary && scene.summary.scene ? scene.summary.scene : {};
  const data = {...scene, reference: decode(scene.reference, Float32Array)};
  data.cells = decodeCells(decode(scene.cells, Int32Array));
  data.frames = scene.frames.map((head, k) => decodeFrame(head, lines[k], scene));
  data.history = decodeHistory(scene.history);
  data.blocks = blocksOf(data.cells, given.block || []);
  return data;
}

function blocksOf(cells, given) {
  const blocks = [];
  for (const {block, order} of cells) {
    if (blocks[block]) continue;
    const {name = "block " + block, material = ""} = given[block] || {};
    blocks[block] = {name, material, order, fixed: order === 0};
  }
  return blocks;
}

// ---- fields -----------------------------------------------------------------------------------------------

const lengthAt = (values, p) => Math.hypot(values[3 * p], values[3 * p + 1], values[3 * p + 2]);

function vonMises(s, p) {
  const [xx, yy, zz, xy, yz, xz] = s.subarray(6 * p, 6 * p + 6);
  const normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2;
  return Math.sqrt(0.5 * normal + 3 * (xy * xy + yz * yz + xz * xz));
}

const pressure = (s, p) => -(s[6 * p] + s[6 * p + 1] + s[6 * p + 2]) / 3;

/// key: {label, unit, at(frame, point)} for numbers, {label, category(block)} for kinds.
function fieldsOf(data) {
  const fields = {displacement: {label: "displacement", unit: "m", at: (f, p) => lengthAt(f.displacement, p)}};
  if (data.velocity) fields.velocity = {label: "velocity", unit: "m/s", at: (f, p) => lengthAt(f.velocity, p)};
  if (data.stress) {
    fields.von_mises = {label: "von Mises stress", unit: "Pa", at: (f, p) => vonMises(f.stress, p)};
    fields.pressure = {label: "pressure", unit: "Pa", signed: true, at: (f, p) => pressure(f.stress, p)};
    STRESS_NAMES.forEach((name, k) => {
      fields["stress_" + name] = {label: "stress " + name, unit: "Pa", signed: true,
        at: (f, p) => f.stress[6 * p + k]};
    });
  }
  fields.block = {label: "block", category: (block) => block, name: (block) => data.blocks[block].name};
  fields.order = {label: "order", category: (block) => data.blocks[block].order,
    name: (order) => (order === 0 ? "fixed" : "order " + order)};
  return fields;
}

/// Least and largest value on blocks that are not fixed; signed fields are shown evenly about zero.
function rangeOf(field, frames) {
  let [low, high] = [Infinity, -Infinity];
  const isFixed = new Uint8Array(data.points);
  surface.source.forEach((point, k) => { isFixed[point] = data.blocks[surface.block[k]].fixed ? 1 : 0; });
  for (const frame of frames) {
    for (let p = 0; p < data.points; ++p) {
      if (isFixed[p]) continue;
      const value = field.at(frame, p);
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  if (low > high) return [0, 1];
  if (field.signed) [low, high] = [-Math.max(-low, high), Math.max(-low, high)];
  return low < high ? [low, high] : [low, low + (Math.abs(low) || 1)];
}

function rangeOfAll(field) {
  if (!field.range) field.range = rangeOf(field, data.frames);
  return field.range;
}

const isWhole = (field) => field.category !== undefined;
const categoryColour = (k) => new THREE.Color().setHSL((0.58 + 0.381966 * k) % 1, 0.5, 0.6);

function scaleColour(stops, share) {
  const at = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const k = Math.min(Math.floor(at), stops.length - 2);
  return new THREE.Color(stops[k]).lerp(new THREE.Color(stops[k + 1]), at - k);
}

/// 256 colours in the lower row, the grey of fixed blocks in the upper one.
function colourTexture(colourOf) {
  const texels = new Uint8Array(2 * 256 * 4).fill(255);
  for (let k = 0; k < 256; ++k) {
    const colour = colourOf(k);
    texels.set([255 * colour.r, 255 * colour.g, 255 * colour.b], 4 * k);
    texels.set([200, 200, 200], 4 * (256 + k));
  }
  const texture = new THREE.DataTexture(texels, 256, 2, THREE.RGBAFormat);
  texture.magFilter = THREE.NearestFilter;
  texture.minFilter = THREE.NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

function textureOf(field) {
  if (!field.texture) {
    const stops = field.signed ? DIVERGING : SEQUENTIAL;
    field.texture = colourTexture(isWhole(field) ? categoryColour : (k) => scaleColour(stops, k / 255));
  }
  return field.texture;
}

function colourSurface(field, frame, range) {
  const uv = meshes.mesh.geometry.attributes.uv;
  surface.source.forEach((point, k) => {
    const block = surface.block[k];
    if (isWhole(field)) {
      uv.setXY(k, (field.category(block) % 256 + 0.5) / 256, 0.25);
    } else {
      const share = (field.at(frame, point) - range[0]) / (range[1] - range[0]);
      uv.setXY(k, (0.5 + 255 * Math.min(Math.max(share, 0), 1)) / 256, data.blocks[block].fixed ? 0.75 : 0.25);
    }
  });
  uv.needsUpdate = true;
  meshes.mesh.material.map = textureOf(field);
  meshes.mesh.material.needsUpdate = true;
}

/// Four digits at most, thousands as exponents of three.
function short(value) {
  if (!Number.isFinite(value)) return String(value);
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e5) return String(Number(value.toPrecision(4)));
  return value.toExponential(2).replace("e+", "e");
}

function drawLegend(canvas, field, range) {
  const context = canvas.getContext("2d");
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.font = "13px system-ui, sans-serif";
  context.fillStyle = "#222";
  if (isWhole(field)) drawCategories(context, field, canvas.height);
  else drawScale(context, field, range, canvas.height);
}

function drawScale(context, field, range, height) {
  context.fillText(field.label + " (" + field.unit + ")", 0, 14);
  const [top, bottom] = [28, height - 10];
  const stops = field.signed ? DIVERGING : SEQUENTIAL;
  for (let y = top; y < bottom; ++y) {
    context.fillStyle = scaleColour(stops, (bottom - y) / (bottom - top)).getStyle();
    context.fillRect(0, y, 16, 1.5);
  }
  context.fillStyle = "#222";
  for (let k = 0; k <= 4; ++k) {
    const y = bottom + (top - bottom) * k / 4;
    context.fillText(short(range[0] + (range[1] - range[0]) * k / 4), 22, y + 4);
  }
}

function drawCategories(context, field, height) {
  const kinds = [...new Set(data.blocks.map((_, block) => field.category(block)))].sort((a, b) => a - b);
  const shown = kinds.slice(0, 12);
  let y = height - 20 * shown.length - (kinds.length > shown.length ? 20 : 0);
  context.fillText(field.label, 0, y - 6);
  for (const kind of shown) {
    context.fillStyle = categoryColour(kind).getStyle();
    context.fillRect(0, y, 14, 14);
    context.fillStyle = "#222";
    context.fillText(field.name(kind), 20, y + 12, 165);
    y += 20;
  }
  if (kinds.length > shown.length) context.fillText("and " + (kinds.length - shown.length) + " more", 20, y + 12);
}
