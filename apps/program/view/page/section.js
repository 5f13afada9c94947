// A plane that cuts the blocks open: three.js clips the part before it, the cut faces are filled here. A fill by
// stencil would have one colour for all blocks; these have that of each block's field.
//
// Each triangle of a surface that the plane crosses gives a segment between two of its sides. A side has one neighbour
// triangle, so that the segments chain to closed loops by the numbers of their sides alone; corners on the plane count as
// before it. Loops of opposite orientation are holes.

const SECTION_AXES = {x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1]};
const INSIDE_COLOUR = "#b9b2a6";

function buildSection() {
  const geometry = new THREE.BufferGeometry();
  const caps = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({side: THREE.DoubleSide,
    vertexColors: THREE.VertexColors, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1}));
  const outlines = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: "#222222"}));
  for (const item of [caps, outlines]) Object.assign(item, {frustumCulled: false, visible: false});
  return {caps, outlines, plane: new THREE.Plane()};
}

/// The plane n . x = at, n out of the visible part; null: there is none.
function sectionPlane() {
  if (current.section === "none") return null;
  const [axis, sign] = [current.section.slice(-1), current.section.startsWith("-") ? -1 : 1];
  const normal = new THREE.Vector3(...SECTION_AXES[axis]).multiplyScalar(sign);
  return {normal, at: sign * current.sectionAt};
}

/// True if a place is in the visible part.
function isKept(place) {
  const cut = sectionPlane();
  return !cut || place.dot(cut.normal) <= cut.at;
}

/// Items that the plane cuts.
function clipAll() {
  const cut = sectionPlane();
  // three.js keeps the side of the normal.
  if (cut) section.plane.set(cut.normal.clone().negate(), cut.at);
  const planes = cut ? [section.plane] : [];
  for (const item of [meshes.mesh, meshes.edges, meshes.innerEdges, meshes.selection, joints.faces])
    item.material.clippingPlanes = planes;
}

/// Loops of a block's surface in the plane: lists of the results of `crossing` for the two ends of a side.
/// @param heights of a point over the plane
function loopsOf(triangles, heights, crossing) {
  const next = new Map();
  for (const [p, q, r] of triangles) {
    const corners = [p, q, r];
    const inside = corners.map((point) => heights(point) < 0);
    const count = inside.filter(Boolean).length;
    if (count === 0 || count === 3) continue;
    // The corner that is alone on its side; the segment runs so that what is inside lies to its left, seen against the
    // plane's normal.
    const k = inside.findIndex((value) => value === (count === 1));
    const sides = [[corners[k], corners[(k + 1) % 3]], [corners[k], corners[(k + 2) % 3]]];
    const [from, to] = count === 1 ? sides : [sides[1], sides[0]];
    next.set(crossing(from), crossing(to));
  }
  const loops = [];
  while (next.size > 0) {
    const [first] = next.keys();
    const loop = [];
    for (let at = first; next.has(at);) {
      loop.push(at);
      const following = next.get(at);
      next.delete(at);
      at = following;
    }
    if (loop.length > 2) loops.push(loop);
  }
  return loops;
}

const signedArea = (loop) => loop.reduce((sum, p, k) => {
  const q = loop[(k + 1) % loop.length];
  return sum + 0.5 * (p.x * q.y - p.y * q.x);
}, 0);

function isInside(point, loop) {
  let inside = false;
  loop.forEach((p, k) => {
    const q = loop[(k + 1) % loop.length];
    if ((p.y > point.y) !== (q.y > point.y) && point.x < (q.x - p.x) * (point.y - p.y) / (q.y - p.y) + p.x) inside = !inside;
  });
  return inside;
}

/// @param loops of 2-D points that also have a place and a colour. @return triangles of such points
function filled(loops) {
  const total = loops.map(signedArea);
  // The largest loop has the outward orientation.
  const largest = total.reduce((most, area) => (Math.abs(area) > Math.abs(most) ? area : most), 0);
  const outer = loops.filter((_, k) => total[k] * largest > 0);
  const holes = loops.filter((_, k) => total[k] * largest < 0);
  return outer.flatMap((loop) => {
    const own = holes.filter((hole) => isInside(hole[0], loop));
    // It removes a last point equal to the first one.
    const triangles = THREE.ShapeUtils.triangulateShape(loop, own);
    const all = [...loop, ...own.flat()];
    return triangles.map((triangle) => triangle.map((k) => all[k]));
  });
}

function trianglesOfBlocks() {
  if (!data.trianglesOfBlocks) {
    data.trianglesOfBlocks = data.blocks.map(() => []);
    for (const {block, corners} of data.cells)
      for (let k = 2; k < corners.length; ++k)
        data.trianglesOfBlocks[block].push([corners[0], corners[k - 1], corners[k]]);
  }
  return data.trianglesOfBlocks;
}

/// Colour at a point of a block. Inside blocks of order 2 and more values are not known: these are filled with grey.
function sectionColour(field, range, block, point) {
  if (isWhole(field)) return categoryColour(field, field.category(block));
  if (data.blocks[block].fixed) return new THREE.Color(FIXED_COLOUR);
  if (data.blocks[block].order > 1) return new THREE.Color(INSIDE_COLOUR);
  return scaleColour(stopsOf(field), (field.at(currentFrame(), point) - range[0]) / (range[1] - range[0]));
}

function cutBlock(block, cut, axes, field, range) {
  const frame = currentFrame();
  const place = new THREE.Vector3();
  const heights = new Map();
  const height = (point) => {
    if (!heights.has(point)) heights.set(point, placeOf(frame, point, current.scale, place).dot(cut.normal) - cut.at);
    return heights.get(point);
  };
  const crossings = new Map();
  const crossing = ([p, q]) => {
    const key = Math.min(p, q) * data.points + Math.max(p, q);
    if (!crossings.has(key)) {
      const share = height(p) / (height(p) - height(q));
      const from = placeOf(frame, p, current.scale, new THREE.Vector3());
      const at = from.lerp(placeOf(frame, q, current.scale, place), share);
      const colour = sectionColour(field, range, block, p).lerp(sectionColour(field, range, block, q), share);
      crossings.set(key, Object.assign(new THREE.Vector2(at.dot(axes[0]), at.dot(axes[1])), {place: at, colour}));
    }
    return crossings.get(key);
  };
  return loopsOf(trianglesOfBlocks()[block], height, crossing);
}

function placeSection(field, range) {
  const cut = sectionPlane();
  clipAll();
  section.caps.visible = section.outlines.visible = cut !== null;
  if (!cut) return;
  const across = new THREE.Vector3(Math.abs(cut.normal.x) > 0.5 ? 0 : 1, Math.abs(cut.normal.x) > 0.5 ? 1 : 0, 0);
  const axes = [across, cut.normal.clone().cross(across)];
  const [places, colours, lines] = [[], [], []];
  data.blocks.forEach((_, block) => {
    const points = pointsOfBlocks()[block];
    if (points.length === 0 || current.hidden.has(block) || Number.isNaN(currentFrame().displacement[3 * points[0]])) return;
    const loops = cutBlock(block, cut, axes, field, range);
    for (const loop of loops)
      loop.forEach((p, k) => lines.push(...p.place.toArray(), ...loop[(k + 1) % loop.length].place.toArray()));
    if (loops.length === 0) return;
    for (const p of filled(loops).flat()) {
      places.push(p.place.x, p.place.y, p.place.z);
      colours.push(p.colour.r, p.colour.g, p.colour.b);
    }
  });
  for (const [item, name, values] of [[section.caps, "position", places], [section.caps, "color", colours],
    [section.outlines, "position", lines]])
    item.geometry.setAttribute(name, new THREE.Float32BufferAttribute(values, 3));
  section.outlines.material.color.set(theme().edge);
}

/// Ends of the range of the plane.
function sectionWay() {
  const axis = current.section.slice(-1);
  return current.section === "none" ? [0, 1] : [modelBox.min[axis], modelBox.max[axis]];
}

const sectionIsPartlyGrey = (field) => current.section !== "none" && !isWhole(field)
  && data.blocks.some((block) => block.order > 1);
