// The data of the page, as written by view_file.cpp and view_frames.cpp.

const CONTACT_TYPES = ["face-face", "vertex-face", "edge-edge"];
const STATES = ["open", "locked", "sliding"];
const STRESS_NAMES = ["xx", "yy", "zz", "xy", "yz", "xz"];

/// Real values of the faces of joints, in the order of the page.
const JOINT_REALS = () => ["opening", "slip", "normal", "shear", "area", ...(data.water_pressure ? ["water"] : []),
  ...(data.fracture_energy ? ["fracture"] : [])];

const vectorAt = (values, k) => new THREE.Vector3().fromArray(values, 3 * k);

/// One frame. Its parts are decoded at the first access: a page of a hundred frames opens at once.
class Frame {
  constructor(head, bytes) {
    Object.assign(this, {index: head.index, step: head.step, time: head.time, head, bytes, parts: {}});
    const {points, spans} = data;
    let at = bytesOfDisplacements(spans, points);
    this.starts = {displacement: 0};
    const follow = (name, size) => {
      this.starts[name] = at;
      at += size;
    };
    if (data.velocity) follow("velocity", bytesOfReals(points, 3));
    if (data.stress) follow("stress", bytesOfReals(points, 6));
    const {joints, corners, links} = head;
    const {bolts = 0, loads = 0, supports = 0, support_corners: ofSupports = 0} = head;
    follow("joints", joints > 0 ? 8 * joints + JOINT_REALS().length * bytesOfReals(joints) + 24 + 6 * corners : 0);
    follow("links", links > 0 ? 6 * links + bytesOfReals(links, 3) + 24 + 6 * links : 0);
    follow("bolts", bolts > 0 ? 4 * bolts + bytesOfReals(bolts) + 24 + 12 * bolts : 0);
    follow("loads", loads > 0 ? 2 * loads + bytesOfReals(loads, 3) + 24 + 6 * loads : 0);
    follow("supports", supports > 0 ? 6 * supports + 24 + 6 * ofSupports : 0);
    follow("contacts", 0);
  }

  part(name, read) {
    if (!(name in this.parts)) this.parts[name] = read(new NumberReader(this.bytes, this.starts[name]));
    return this.parts[name];
  }

  get displacement() { return this.part("displacement", (reader) => reader.displacements(data.spans, data.points)); }
  get velocity() { return this.part("velocity", (reader) => reader.reals(data.points, 3)); }
  get stress() { return this.part("stress", (reader) => reader.reals(data.points, 6)); }

  /// Contact faces. start, end: corners of a face; places (#corners x 3); the rest by face
  get joints() {
    return this.part("joints", (reader) => {
      const {joints: count, corners} = this.head;
      const joints = {count, start: new Uint32Array(count + 1)};
      if (count === 0) {
        for (const name of ["state", "broken", "a", "b", "water", "fracture", ...JOINT_REALS(), "places"])
          joints[name] = new Float32Array(0);
        return joints;
      }
      reader.words(count).forEach((size, k) => { joints.start[k + 1] = joints.start[k] + size; });
      const states = reader.words(count);
      joints.state = states.map((state) => state % 3);
      joints.broken = states.map((state) => (state >= 3 ? 1 : 0));
      [joints.a, joints.b] = [reader.words(count), reader.words(count)];
      for (const name of JOINT_REALS()) joints[name] = reader.reals(count);
      joints.places = reader.points(corners);
      return joints;
    });
  }

  /// Lines of bolts: {ends, axial (N), state, bolt}
  get bolts() {
    return this.part("bolts", (reader) => {
      const count = this.head.bolts || 0;
      if (count === 0) return [];
      const [state, bolt] = [0, 1].map(() => reader.words(count));
      const [axial, places] = [reader.reals(count), reader.points(2 * count)];
      return Array.from(state, (_, k) => ({ends: [vectorAt(places, 2 * k), vectorAt(places, 2 * k + 1)], axial: axial[k],
        state: state[k], bolt: bolt[k]}));
    });
  }

  /// Loads: {block, force (N), place}
  get loads() {
    return this.part("loads", (reader) => {
      const count = this.head.loads || 0;
      if (count === 0) return [];
      const block = reader.words(count);
      const [force, place] = [reader.reals(count, 3), reader.points(count)];
      return Array.from(block, (_, k) => ({block: block[k], force: vectorAt(force, k), place: vectorAt(place, k)}));
    });
  }

  /// Triangles of supported faces and supported points: {held (1: x, 2: y, 4: z), block, corners}
  get supports() {
    return this.part("supports", (reader) => {
      const count = this.head.supports || 0;
      if (count === 0) return [];
      const [held, block, sizes] = [0, 1, 2].map(() => reader.words(count));
      const places = reader.points(this.head.support_corners);
      let at = 0;
      return Array.from(held, (_, k) => {
        const corners = Array.from({length: sizes[k]}, (_unused, i) => vectorAt(places, at + i));
        at += sizes[k];
        return {held: held[k], block: block[k], corners};
      });
    });
  }

  /// One force for each pair of blocks, on the first one: {a, b, state, force, place}
  get links() {
    return this.part("links", (reader) => {
      const count = this.head.links;
      if (count === 0) return [];
      const [a, b, state] = [0, 1, 2].map(() => reader.words(count));
      const [force, place] = [reader.reals(count, 3), reader.points(count)];
      return Array.from(a, (_, k) => ({a: a[k], b: b[k], state: state[k], force: vectorAt(force, k),
        place: vectorAt(place, k)}));
    });
  }

  /// Contact points; none if there were too many for the page (head.contacts is their number)
  get contacts() {
    return this.part("contacts", (reader) => {
      const count = this.head.points;
      if (count === 0) return [];
      const [type, state, a, b] = [0, 1, 2, 3].map(() => reader.words(count));
      const [force, normal] = [reader.reals(count, 3), reader.reals(count, 3)];
      const [gap, area, place] = [reader.reals(count), reader.reals(count), reader.points(count)];
      return Array.from(type, (_, k) => ({place: vectorAt(place, k), force: vectorAt(force, k), normal: vectorAt(normal, k),
        gap: gap[k], area: area[k], type: type[k], state: state[k], a: a[k], b: b[k]}));
    });
  }
}

function decodeCells(bytes) {
  const integers = new Int32Array(bytes.buffer);
  const cells = [];
  for (let i = 0; i < integers.length;) {
    const corners = integers.subarray(i + 4, i + 4 + integers[i + 3]);
    cells.push({block: integers[i], order: integers[i + 1], face: integers[i + 2], corners});
    i += 4 + corners.length;
  }
  return cells;
}

function decodeHistory({columns, about, rows}, bytes) {
  const reader = new NumberReader(bytes);
  const values = {};
  for (const name of columns) values[name] = Array.from({length: rows}, () => reader.float());
  return {columns, about, rows, values};
}

/// Runs of points of one block, for PackedNumbers::add_displacements.
function spansOf(blockOfPoint) {
  const spans = [];
  blockOfPoint.forEach((block, i) => {
    if (i === 0 || block !== blockOfPoint[i - 1]) spans.push([i, i]);
    spans[spans.length - 1][1] = i + 1;
  });
  return spans;
}

/// @param fixed numbers of the fixed blocks; others of order 0 are rigid
function blocksOf(cells, given, fixed) {
  const blocks = [];
  const still = new Set(fixed);
  for (const {block, order} of cells) {
    if (blocks[block]) continue;
    const {name, material = ""} = given[block] || {};
    blocks[block] = {name: name || "block " + block, material, order, fixed: still.has(block)};
  }
  // Blocks without a frame, of a staged analysis.
  for (let k = 0; k < blocks.length; ++k)
    blocks[k] = blocks[k] || {name: (given[k] || {}).name || "block " + k, material: "", order: 0, fixed: true, absent: true};
  return blocks;
}

async function loadData() {
  const scene = JSON.parse(element("scene").textContent);
  const [reference, cells, history] = await Promise.all([scene.reference, scene.cells, scene.history.data].map(inflated));
  data = {...scene, reference: new Float32Array(reference.buffer)};
  data.cells = decodeCells(cells);
  data.blockOfPoint = new Int32Array(data.points).fill(-1);
  for (const {block, corners} of data.cells) for (const point of corners) data.blockOfPoint[point] = block;
  data.spans = spansOf(data.blockOfPoint);
  data.history = decodeHistory(scene.history, history);
  addRunTime(data.history);
  addPush(data.history, data.summary);
  data.blocks = blocksOf(data.cells, scene.blocks, scene.fixed);
  data.isStatic = ["static", "factor-of-safety", "capacity", "thrust", "pushover"].includes(scene.analysis);
  const lines = element("frames").textContent.trim().split("\n");
  const bytes = await Promise.all(lines.map(inflated));
  data.frames = scene.frames.map((head, k) => new Frame(head, bytes[k]));
}
