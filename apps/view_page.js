// The page of `ashlar view`: shows the frames, the contacts and the history of one run.
//
// In reading order: data (what view_file.cpp wrote), surface (render points, triangles, edges), fields and their
// colours, contacts, camera, picking, plots, summary, controls, pictures. `current` is all that the user can
// change; show() brings the picture in line with it. The part of the address behind # chooses what is shown
// first: #frame=12&color=velocity&from=1,-2,0.5 and, for `ashlar picture`, picture&size=800x600.
"use strict";

const STRESS_NAMES = ["xx", "yy", "zz", "xy", "yz", "xz"];
const CONTACT_TYPES = ["face-face", "vertex-face", "edge-edge"];
const CONTACT_STATES = ["open", "locked", "sliding"];
const TYPE_COLOURS = ["#1b6fd0", "#d62976", "#e8890c"];
const STATE_COLOURS = ["#8a8a8a", "#1a9641", "#e8590c"];
const CONTACT_NUMBERS = 15;
// Light where there is little: dark blocks would hide their edges and their shading.
const SEQUENTIAL = ["#ffffd9", "#edf8b1", "#c7e9b4", "#7fcdbb", "#41b6c4", "#1d91c0", "#225ea8", "#253494", "#081d58"];
const DIVERGING = ["#3b4cc0", "#7b9ff9", "#c0d4f5", "#eeeeee", "#f5c4ac", "#ee8468", "#b40426"];
const element = (id) => document.getElementById(id);

// ---- data ------------------------------------------------------------------------------------------------

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

// ---- surface ---------------------------------------------------------------------------------------------

/// Points are split where faces meet, so that shading is smooth inside a curved face and breaks at its rim.
/// source: point of each render point; triangles, their blocks; edges between faces and inside them.
function buildSurface(cells) {
  const surface = {source: [], block: [], triangles: [], triangleBlock: [], edges: [], innerEdges: []};
  const renderPoints = new Map();
  const sides = new Map();
  for (const cell of cells) {
    const corners = Array.from(cell.corners, (point) => renderPoint(surface, renderPoints, cell, point));
    for (let k = 2; k < corners.length; ++k) {
      surface.triangles.push(corners[0], corners[k - 1], corners[k]);
      surface.triangleBlock.push(cell.block);
    }
    addSides(sides, cell, corners);
  }
  for (const side of sides.values()) (side.inner ? surface.innerEdges : surface.edges).push(side);
  return surface;
}

function renderPoint(surface, renderPoints, cell, point) {
  const key = point + ":" + cell.face;
  if (!renderPoints.has(key)) {
    renderPoints.set(key, surface.source.length);
    surface.source.push(point);
    surface.block.push(cell.block);
  }
  return renderPoints.get(key);
}

function addSides(sides, cell, corners) {
  const count = corners.length;
  for (let k = 0; k < count; ++k) {
    const [p, q] = [cell.corners[k], cell.corners[(k + 1) % count]];
    const key = Math.min(p, q) + ":" + Math.max(p, q);
    const known = sides.get(key);
    if (known) known.inner = known.face === cell.face;
    else sides.set(key, {ends: [corners[k], corners[(k + 1) % count]], face: cell.face, block: cell.block});
  }
}

function edgeIndex(edges) {
  return new THREE.BufferAttribute(new Uint32Array(edges.flatMap((edge) => edge.ends)), 1);
}

function edgeLines(edges, places, colour) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", places);
  geometry.setIndex(edgeIndex(edges));
  const lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({color: colour}));
  lines.frustumCulled = false;
  return lines;
}

function buildMeshes(surface) {
  const count = surface.source.length;
  const places = new THREE.BufferAttribute(new Float32Array(3 * count), 3);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", places);
  geometry.setAttribute("uv", new THREE.BufferAttribute(new Float32Array(2 * count), 2));
  geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(surface.triangles), 1));
  const material = new THREE.MeshLambertMaterial({side: THREE.DoubleSide, polygonOffset: true,
    polygonOffsetFactor: 1, polygonOffsetUnits: 1});
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  return {mesh, edges: edgeLines(surface.edges, places, "#222222"),
    innerEdges: edgeLines(surface.innerEdges, places, "#777777"),
    selection: edgeLines([], places, "#ff00aa")};
}

/// @return place of a point of a frame with displacements enlarged
function placeOf(frame, point, scale, into) {
  const i = 3 * point;
  return into.set(data.reference[i] + scale * frame.displacement[i],
    data.reference[i + 1] + scale * frame.displacement[i + 1],
    data.reference[i + 2] + scale * frame.displacement[i + 2]);
}

function moveSurface(frame, scale) {
  const geometry = meshes.mesh.geometry;
  const places = geometry.attributes.position;
  const place = new THREE.Vector3();
  surface.source.forEach((point, k) => {
    placeOf(frame, point, scale, place);
    places.setXYZ(k, place.x, place.y, place.z);
  });
  places.needsUpdate = true;
  geometry.computeVertexNormals();
}

// ---- fields ----------------------------------------------------------------------------------------------

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

// ---- contacts --------------------------------------------------------------------------------------------

function discTexture() {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 32;
  const context = canvas.getContext("2d");
  context.fillStyle = "#fff";
  context.arc(16, 16, 14, 0, 2 * Math.PI);
  context.fill();
  return new THREE.CanvasTexture(canvas);
}

function buildContacts() {
  const most = Math.max(1, ...data.frames.map((frame) => frame.contacts.length));
  const geometry = new THREE.BufferGeometry();
  for (const name of ["position", "color"])
    geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(3 * most), 3));
  const points = new THREE.Points(geometry, new THREE.PointsMaterial({size: 6, sizeAttenuation: false,
    vertexColors: THREE.VertexColors, depthTest: false, transparent: true, alphaTest: 0.5, map: discTexture()}));
  // Unit arrow along z: the shaft ends where the head begins.
  const shaft = new THREE.CylinderBufferGeometry(0.015, 0.015, 0.8, 8).rotateX(Math.PI / 2).translate(0, 0, 0.4);
  const head = new THREE.ConeBufferGeometry(0.05, 0.2, 12).rotateX(Math.PI / 2).translate(0, 0, 0.9);
  const arrows = [shaft, head].map((shape) =>
    new THREE.InstancedMesh(shape, new THREE.MeshBasicMaterial({color: "#c00018", depthTest: false,
      transparent: true}), most));
  points.renderOrder = 2;
  for (const item of [points, ...arrows]) item.frustumCulled = false;
  return {points, arrows};
}

/// Contacts lie on the true places of blocks: they are hidden where displacements are enlarged.
function visibleContacts(frame) {
  if (current.scale !== 1 || current.contactColour === "none") return [];
  return frame.contacts.filter((contact) => current.openContacts || contact.state !== 0);
}

function contactColour(contact) {
  return current.contactColour === "type" ? TYPE_COLOURS[contact.type] : STATE_COLOURS[contact.state];
}

function placeContacts(frame) {
  const visible = visibleContacts(frame);
  const {position, color} = contacts.points.geometry.attributes;
  visible.forEach((contact, k) => {
    const colour = new THREE.Color(contactColour(contact));
    position.setXYZ(k, contact.place.x, contact.place.y, contact.place.z);
    color.setXYZ(k, colour.r, colour.g, colour.b);
  });
  position.needsUpdate = color.needsUpdate = true;
  contacts.points.geometry.setDrawRange(0, visible.length);
  placeArrows(current.forces ? visible.filter((contact) => contact.force.lengthSq() > 0) : []);
}

/// Median over the frames of the largest force in each: an impact must not make all other arrows vanish.
function usualForce() {
  if (data.usualForce === undefined) {
    const largest = data.frames.map((frame) => Math.max(0, ...frame.contacts.map((c) => c.force.length())));
    const sorted = largest.filter((force) => force > 0).sort((a, b) => a - b);
    data.usualForce = sorted[Math.floor(sorted.length / 2)] || 1;
  }
  return data.usualForce;
}

/// Forces on the first block of a contact. The usual force is as long as a sixth of the scene, others are in
/// proportion to it, up to half the scene.
function placeArrows(list) {
  const unit = sceneSphere.radius / 3 * current.forceScale / usualForce();
  const up = new THREE.Vector3(0, 0, 1);
  list.forEach((contact, k) => {
    const size = contact.force.length();
    const turn = new THREE.Quaternion().setFromUnitVectors(up, contact.force.clone().divideScalar(size));
    const length = Math.min(unit * size, sceneSphere.radius);
    const width = Math.min(0.4 * sceneSphere.radius, 2 * length);
    const matrix = new THREE.Matrix4().compose(contact.place, turn, new THREE.Vector3(width, width, length));
    for (const arrow of contacts.arrows) arrow.setMatrixAt(k, matrix);
  });
  for (const arrow of contacts.arrows) {
    arrow.count = list.length;
    arrow.visible = list.length > 0;
    arrow.instanceMatrix.needsUpdate = true;
  }
}

function showContactLegend() {
  const [names, colours] = current.contactColour === "type" ? [CONTACT_TYPES, TYPE_COLOURS]
    : [CONTACT_STATES, STATE_COLOURS];
  const shown = current.contactColour === "none" ? [] : names;
  element("contact-legend").replaceChildren(...shown.map((name, k) => {
    const entry = document.createElement("span");
    const dot = document.createElement("i");
    dot.style.background = colours[k];
    entry.append(dot, name);
    return entry;
  }));
}

// ---- camera ----------------------------------------------------------------------------------------------

/// Around the blocks of all frames, but not around what flies off to more than half the scene's own size.
function sphereOfScene() {
  const boxOf = (frame) => {
    const box = new THREE.Box3();
    const place = new THREE.Vector3();
    for (let p = 0; p < data.points; ++p) box.expandByPoint(placeOf(frame, p, 1, place));
    return box;
  };
  const first = boxOf(data.frames[0]);
  const all = data.frames.reduce((box, frame) => box.union(boxOf(frame)), first.clone());
  const most = first.clone().expandByScalar(0.5 * first.getSize(new THREE.Vector3()).length());
  return all.intersect(most).getBoundingSphere(new THREE.Sphere());
}

function lookFrom(direction) {
  const distance = sceneSphere.radius / Math.sin(0.5 * THREE.Math.degToRad(camera.fov)) *
    Math.max(1, 1 / camera.aspect);
  camera.near = 0.01 * sceneSphere.radius;
  camera.far = distance + 100 * sceneSphere.radius;
  controls.target.copy(sceneSphere.center);
  camera.position.copy(sceneSphere.center).addScaledVector(direction.clone().normalize(), 0.9 * distance);
  camera.updateProjectionMatrix();
  controls.update();
}

function buildStage() {
  const stage = new THREE.Scene();
  stage.background = new THREE.Color("#ffffff");
  stage.add(new THREE.HemisphereLight("#ffffff", "#b0b0b8", 0.85));
  const lamp = new THREE.DirectionalLight("#ffffff", 0.4);
  lamp.position.set(-0.4, 0.6, 1);
  camera.add(lamp);
  stage.add(camera, meshes.mesh, meshes.edges, meshes.innerEdges, meshes.selection,
    ...contacts.arrows, contacts.points);
  return stage;
}

function resize() {
  const {clientWidth, clientHeight} = element("stage");
  renderer.setPixelRatio(window.devicePixelRatio);
  renderer.setSize(clientWidth, clientHeight, false);
  camera.aspect = clientWidth / clientHeight;
  camera.updateProjectionMatrix();
  render();
}

function render() {
  if (renderer) renderer.render(stage, camera);
}

// ---- picking ---------------------------------------------------------------------------------------------

/// @param x, y pixels from the upper left corner of the canvas. A contact within its dot comes before blocks.
function pick(x, y) {
  const {clientWidth: width, clientHeight: height} = element("canvas");
  const contact = contactAt(x, y, width, height);
  if (contact) return {contact};
  const caster = new THREE.Raycaster();
  caster.setFromCamera(new THREE.Vector2(2 * x / width - 1, 1 - 2 * y / height), camera);
  meshes.mesh.geometry.computeBoundingSphere();
  const hit = caster.intersectObject(meshes.mesh)[0];
  return hit ? {block: surface.triangleBlock[hit.faceIndex], place: hit.point, face: hit.face} : {};
}

function contactAt(x, y, width, height) {
  let [nearest, least] = [null, 7];
  for (const contact of visibleContacts(currentFrame())) {
    const screen = contact.place.clone().project(camera);
    const distance = Math.hypot((screen.x + 1) * width / 2 - x, (1 - screen.y) * height / 2 - y);
    if (distance < least) [nearest, least] = [contact, distance];
  }
  return nearest;
}

/// Centre of volume of a closed surface: tetrahedra from its triangles to the origin of its own points.
function centreOf(block) {
  const places = meshes.mesh.geometry.attributes.position;
  const corner = (k) => new THREE.Vector3().fromBufferAttribute(places, surface.triangles[k]);
  const origin = corner(3 * surface.triangleBlock.indexOf(block));
  const sum = new THREE.Vector3();
  let volume = 0;
  surface.triangleBlock.forEach((owner, t) => {
    if (owner !== block) return;
    const [a, b, c] = [0, 1, 2].map((k) => corner(3 * t + k).sub(origin));
    const part = a.dot(b.clone().cross(c));
    sum.addScaledVector(a.add(b).add(c), part / 4);
    volume += part;
  });
  return volume === 0 ? origin : origin.addScaledVector(sum, 1 / volume);
}

const vectorText = (v) => [v.x, v.y, v.z].map(short).join(", ");

function rowsOfBlock(index) {
  const block = data.blocks[index];
  const rows = [["block", block.name], ["order", block.fixed ? "fixed" : block.order],
    ["material", block.material || "-"], ["centre (m)", vectorText(centreOf(index))]];
  if (current.picked.place) rows.push(["clicked at (m)", vectorText(current.picked.place)]);
  const field = fields[current.field];
  if (!isWhole(field) && current.picked.face) {
    const value = field.at(currentFrame(), surface.source[current.picked.face.a]);
    rows.push([field.label + " near (" + field.unit + ")", short(value)]);
  }
  return rows;
}

function rowsOfContact(contact) {
  const normalForce = contact.force.dot(contact.normal);
  const shear = contact.force.clone().addScaledVector(contact.normal, -normalForce).length();
  return [["contact", data.blocks[contact.a].name + " on " + data.blocks[contact.b].name],
    ["type", CONTACT_TYPES[contact.type]], ["state", CONTACT_STATES[contact.state]],
    ["gap (m)", short(contact.gap)], ["force on " + data.blocks[contact.a].name + " (N)", vectorText(contact.force)],
    ["normal, shear (N)", short(normalForce) + ", " + short(shear)],
    ["area (m²)", short(contact.area)], ["place (m)", vectorText(contact.place)]];
}

function showPicked() {
  const {block, contact} = current.picked;
  const rows = contact ? rowsOfContact(contact) : block !== undefined ? rowsOfBlock(block) : [];
  fillTable(element("picked"), rows);
  element("hint").hidden = rows.length > 0;
  const chosen = [...surface.edges].filter((edge) => edge.block === block);
  meshes.selection.geometry.setIndex(edgeIndex(chosen));
  meshes.selection.visible = chosen.length > 0;
  render();
}

function pickOnClick(canvas) {
  let start = {x: 0, y: 0};
  canvas.addEventListener("mousedown", (event) => { start = {x: event.offsetX, y: event.offsetY}; });
  canvas.addEventListener("click", (event) => {
    if (Math.hypot(event.offsetX - start.x, event.offsetY - start.y) > 4) return;
    current.picked = pick(event.offsetX, event.offsetY);
    showPicked();
  });
}

// ---- plots -----------------------------------------------------------------------------------------------

/// name of a group: {unit, columns}; measures first.
function plotGroups(columns) {
  const groups = {};
  const add = (name, unit, list) => { if (list.length > 0) groups[name] = {unit, columns: list}; };
  for (const column of columns.filter((name) => name.endsWith(".ux"))) {
    const measure = column.slice(0, -3);
    const parts = (list) => list.map((part) => measure + part).filter((name) => columns.includes(name));
    add(measure + ": displacement", "m", parts([".ux", ".uy", ".uz"]));
    add(measure + ": position", "m", parts([".x", ".y", ".z"]));
    add(measure + ": velocity", "m/s", parts([".vx", ".vy", ".vz"]));
    add(measure + ": stress", "Pa", parts(STRESS_NAMES.map((name) => ".s" + name)));
  }
  const starting = (start) => columns.filter((name) => name.startsWith(start));
  add("energies", "J", starting("energy."));
  add("contacts", "points", starting("contacts."));
  add("step size", "s", columns.filter((name) => name === "dt"));
  add("penetration", "m", starting("penetration."));
  add("open-close iterations", "", starting("open_close."));
  add("momentum", "N s", starting("momentum."));
  add("angular momentum", "N m s", starting("angular_momentum."));
  return groups;
}

function datasetOf(column, k, group) {
  const times = data.history.values.time;
  const name = group.columns.length > 1 ? column.slice(column.lastIndexOf(".") + 1) : column;
  const colour = "#" + categoryColour(k).offsetHSL(0, 0.2, -0.15).getHexString();
  return {label: name, data: data.history.values[column].map((y, row) => ({x: times[row], y})),
    borderColor: colour, backgroundColor: colour, borderWidth: 1.5, pointRadius: 0};
}

/// A line at the time of the frame shown.
const cursor = {
  id: "cursor",
  afterDraw(chart) {
    const {ctx: context, chartArea: area, scales} = chart;
    const x = scales.x.getPixelForValue(currentFrame().time);
    context.save();
    context.strokeStyle = "#c00018";
    context.beginPath();
    context.moveTo(x, area.top);
    context.lineTo(x, area.bottom);
    context.stroke();
    context.restore();
  },
};

function axis(title) {
  return {type: "linear", title: {display: title !== "", text: title}, ticks: {maxTicksLimit: 6}};
}

function buildPlot(canvas, select, groups, chosen) {
  const chart = new Chart(canvas, {type: "line", data: {datasets: []}, plugins: [cursor],
    options: {animation: false, parsing: false, maintainAspectRatio: false, interaction: {mode: "nearest", axis: "x"},
      scales: {x: axis("time (s)"), y: axis("")}, plugins: {legend: {labels: {boxWidth: 10, boxHeight: 2}}},
      onClick: (event) => showFrame(frameNear(chart.scales.x.getValueForPixel(event.x)))}});
  const showGroup = () => {
    const group = groups[select.value];
    chart.data.datasets = group.columns.map((column, k) => datasetOf(column, k, group));
    const times = data.history.values.time;
    Object.assign(chart.options.scales.x, {min: times[0], max: times[times.length - 1]});
    chart.options.scales.y.title = {display: group.unit !== "", text: group.unit};
    chart.update();
  };
  fillSelect(select, Object.keys(groups).map((name) => [name, name]), chosen);
  select.addEventListener("change", showGroup);
  showGroup();
  return chart;
}

function buildPlots() {
  const groups = plotGroups(data.history.columns);
  const first = Object.keys(groups)[0];
  return [buildPlot(element("plot-1"), element("plot-1-group"), groups, first),
    buildPlot(element("plot-2"), element("plot-2-group"), groups, "energies" in groups ? "energies" : first)];
}

function frameNear(time) {
  let nearest = 0;
  data.frames.forEach((frame, k) => {
    if (Math.abs(frame.time - time) < Math.abs(data.frames[nearest].time - time)) nearest = k;
  });
  return nearest;
}

// ---- summary ---------------------------------------------------------------------------------------------

function fillTable(table, rows) {
  table.replaceChildren(...rows.map(([name, value]) => {
    const row = document.createElement("tr");
    if (value === undefined) row.className = "group";
    for (const text of value === undefined ? [name] : [name, value]) row.insertCell().textContent = text;
    return row;
  }));
}

const words = (key) => key.replaceAll("_", " ");
const valueText = (value) => (typeof value === "number" ? short(value) : String(value));

/// Numbers and texts as rows, tables of them as groups; the scene itself is left out.
function summaryRows(summary) {
  if (!summary) return [["status", "not finished: no summary.json"]];
  const rows = [];
  const groups = [];
  for (const [key, value] of Object.entries(summary)) {
    if (key === "scene" || key === "title") continue;
    if (key === "automatic") {
      if (value.length > 0) groups.push(["chosen automatically"]);
      for (const choice of value) groups.push([choice.key, short(choice.value) + " " + choice.unit]);
    } else if (key === "rejected_steps") {
      rows.push(["rejected steps", valueText(value.count)]);
    } else if (value !== null && typeof value === "object" && !Array.isArray(value)) {
      groups.push([words(key)], ...Object.entries(value).map(([name, part]) => [words(name), valueText(part)]));
    } else if (!Array.isArray(value)) {
      rows.push([words(key), valueText(value)]);
    }
  }
  return [...rows, ...groups];
}

// ---- controls --------------------------------------------------------------------------------------------

const currentFrame = () => data.frames[current.frame];

function clockText(frame) {
  return "t = " + short(frame.time) + " s, step " + frame.step;
}

function show() {
  const frame = currentFrame();
  const field = fields[current.field];
  const range = isWhole(field) ? null : current.ownRange ? rangeOf(field, [frame]) : rangeOfAll(field);
  moveSurface(frame, current.scale);
  colourSurface(field, frame, range);
  placeContacts(frame);
  meshes.innerEdges.visible = current.subFaces;
  Object.assign(meshes.mesh.material, {transparent: current.seeThrough, opacity: current.seeThrough ? 0.35 : 1,
    depthWrite: !current.seeThrough});
  drawLegend(element("legend"), field, range);
  element("clock").textContent = clockText(frame);
  render();
}

function showFrame(index) {
  if (index !== current.frame && current.picked.contact) current.picked = {};
  current.frame = index;
  element("slider").value = index;
  show();
  showPicked();
  for (const plot of plots) plot.draw();
}

function fillSelect(select, entries, chosen) {
  select.replaceChildren(...entries.map(([value, label]) => new Option(label, value, false, value === chosen)));
}

function play() {
  if (current.timer) {
    clearInterval(current.timer);
    current.timer = null;
  } else {
    const pause = Math.min(Math.max(8000 / data.frames.length, 33), 500);
    current.timer = setInterval(() => showFrame((current.frame + 1) % data.frames.length), pause);
  }
  element("play").textContent = current.timer ? "⏸" : "▶";
}

/// Ties a control to a member of `current`. @param read value of the control
function tie(id, member, read) {
  element(id).addEventListener("change", (event) => {
    current[member] = read(event.target);
    showContactLegend();
    show();
    showPicked();
  });
}

function tieControls() {
  const checked = (box) => box.checked;
  const positive = (input) => Math.max(0, Number(input.value) || 0);
  fillSelect(element("field"), Object.entries(fields).map(([key, field]) => [key, field.label]), current.field);
  tie("field", "field", (select) => select.value);
  tie("own-range", "ownRange", checked);
  tie("scale", "scale", positive);
  tie("sub-faces", "subFaces", checked);
  tie("see-through", "seeThrough", checked);
  tie("contact-colour", "contactColour", (select) => select.value);
  tie("open-contacts", "openContacts", checked);
  tie("forces", "forces", checked);
  tie("force-scale", "forceScale", positive);
  element("slider").max = data.frames.length - 1;
  element("slider").addEventListener("input", (event) => showFrame(Number(event.target.value)));
  element("play").addEventListener("click", play);
  element("home").addEventListener("click", () => { lookFrom(current.from); render(); });
  document.addEventListener("keydown", (event) => {
    if (event.code !== "Space" || event.target.matches("input, select, button")) return;
    event.preventDefault();
    play();
  });
  window.addEventListener("resize", resize);
  controls.addEventListener("change", render);
  pickOnClick(element("canvas"));
}

// ---- start and pictures ----------------------------------------------------------------------------------

function readAddress() {
  const wishes = new URLSearchParams(location.hash.slice(1));
  const frame = data.frames.findIndex((candidate) => String(candidate.index) === wishes.get("frame"));
  if (frame >= 0) current.frame = frame;
  if (wishes.get("color") in fields) current.field = wishes.get("color");
  const from = (wishes.get("from") || "").split(",").map(Number);
  if (from.length === 3 && from.every(Number.isFinite) && from.some((x) => x !== 0))
    current.from = new THREE.Vector3(...from);
  return wishes;
}

/// Leaves nothing in the page but a text for the program that reads it: one picture, or why there is none.
function leaveText(id, content) {
  const text = document.createElement("pre");
  text.id = id;
  text.textContent = content;
  document.documentElement.replaceChildren(text);
}

function makePicture(wishes) {
  if (!renderer) return leaveText("fault", "the browser has no WebGL");
  if (wishes.get("color") && !(wishes.get("color") in fields))
    return leaveText("fault", "the run has no " + wishes.get("color") + " (output.fields)");
  const [width, height] = wishes.get("size").split("x").map(Number);
  const legend = element("legend");
  legend.height = Math.min(legend.height, Math.max(height - 50, 1));
  renderer.setPixelRatio(1);
  renderer.setSize(width, height, false);
  camera.aspect = width / height;
  lookFrom(current.from);
  show();
  const picture = document.createElement("canvas");
  Object.assign(picture, {width, height});
  const context = picture.getContext("2d");
  context.drawImage(element("canvas"), 0, 0);
  context.drawImage(legend, 12, height - legend.height - 12);
  context.font = "14px system-ui, sans-serif";
  context.fillStyle = "#222";
  context.fillText(clockText(currentFrame()), 12, 22);
  leaveText("picture", picture.toDataURL("image/png").split(",")[1]);
}

function buildRenderer() {
  try {
    return new THREE.WebGLRenderer({canvas: element("canvas"), antialias: true, preserveDrawingBuffer: true});
  } catch (error) {
    element("message").hidden = false;
    element("message").textContent = "This browser shows no WebGL, which the blocks need; plots and tables work.";
    return null;
  }
}

const data = loadData();
const fields = fieldsOf(data);
const current = {frame: 0, field: "displacement", ownRange: false, scale: 1, subFaces: false, seeThrough: false,
  contactColour: "state", openContacts: false, forces: true, forceScale: 1, picked: {}, timer: null,
  from: new THREE.Vector3(0.55, -1, 0.45)};
const surface = buildSurface(data.cells);
const meshes = buildMeshes(surface);
const contacts = buildContacts();
const camera = new THREE.PerspectiveCamera(35, 1, 0.1, 1000);
camera.up.set(0, 0, 1);
const sceneSphere = sphereOfScene();
const renderer = buildRenderer();
const controls = new THREE.OrbitControls(camera, element("canvas"));
const stage = buildStage();
let plots = [];

function start() {
  const wishes = readAddress();
  if (wishes.has("picture")) return makePicture(wishes);
  const title = (data.summary && data.summary.title) || data.name;
  document.title = title + " - Ashlar";
  element("title").textContent = title;
  tieControls();
  showContactLegend();
  fillTable(element("summary"), summaryRows(data.summary));
  resize();
  lookFrom(current.from);
  plots = buildPlots();
  showFrame(current.frame);
}

start();
