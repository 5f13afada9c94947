// Forces between blocks: contact points with their forces; one bar for each joint; the line of thrust.

const FORCE_COLOUR = "#c00018";
const TENSION_COLOUR = "#1f5fd8";
const THRUST_COLOUR = "#c00018";

/// Above this number, or if the page lacks some, contact points are off, because they would hide the blocks. The user
/// can switch them on.
const isCrowded = () => data.frames.some((frame) => frame.head.contacts > data.few_points);

/// Contact points are shown unless there are more of them in any frame.
const MOST_USUAL_POINTS = 60;

function discTexture() {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 32;
  const context = canvas.getContext("2d");
  context.fillStyle = "#fff";
  context.arc(16, 16, 14, 0, 2 * Math.PI);
  context.fill();
  return new THREE.CanvasTexture(canvas);
}

/// Copies of unit shapes along z, each with a matrix of its own. @see placeCopies
function copiesOf(shapes, colour, most, inFront = true) {
  const copies = shapes.map((shape) => new THREE.InstancedMesh(shape, new THREE.MeshBasicMaterial({color: colour,
    depthTest: !inFront, transparent: inFront}), Math.max(1, most)));
  for (const mesh of copies) Object.assign(mesh, {frustumCulled: false, renderOrder: inFront ? 3 : 0});
  return copies;
}

/// @param list {from, along (vector from end to end), width}
function placeCopies(copies, list) {
  const up = new THREE.Vector3(0, 0, 1);
  const [matrix, turn, size] = [new THREE.Matrix4(), new THREE.Quaternion(), new THREE.Vector3()];
  list.forEach(({from, along, width}, k) => {
    const length = along.length();
    turn.setFromUnitVectors(up, along.clone().divideScalar(length));
    matrix.compose(from, turn, size.set(width, width, length));
    for (const mesh of copies) mesh.setMatrixAt(k, matrix);
  });
  for (const mesh of copies) {
    mesh.count = list.length;
    mesh.visible = list.length > 0;
    mesh.instanceMatrix.needsUpdate = true;
  }
}

/// Unit arrow along z: the shaft ends where the head begins.
function arrowShapes() {
  return [new THREE.CylinderBufferGeometry(0.015, 0.015, 0.8, 8).rotateX(Math.PI / 2).translate(0, 0, 0.4),
    new THREE.ConeBufferGeometry(0.05, 0.2, 12).rotateX(Math.PI / 2).translate(0, 0, 0.9)];
}

const barShapes = () => [new THREE.CylinderBufferGeometry(0.5, 0.5, 1, 8).rotateX(Math.PI / 2).translate(0, 0, 0.5)];

const mostOf = (key) => Math.max(1, ...data.frames.map((frame) => frame.head[key]));

function buildForces() {
  const most = mostOf("points");
  const geometry = new THREE.BufferGeometry();
  for (const name of ["position", "color"])
    geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(3 * most), 3));
  const points = new THREE.Points(geometry, new THREE.PointsMaterial({size: isCrowded() ? 3 : 6, sizeAttenuation: false,
    vertexColors: THREE.VertexColors, depthTest: false, transparent: true, alphaTest: 0.5, map: discTexture()}));
  points.renderOrder = 2;
  points.frustumCulled = false;
  const links = mostOf("links");
  return {points, arrows: copiesOf(arrowShapes(), FORCE_COLOUR, most), bars: copiesOf(barShapes(), FORCE_COLOUR, links),
    ties: copiesOf(barShapes(), TENSION_COLOUR, links), thrust: wideLines(4, THRUST_COLOUR, true)};
}

// ---- points -----------------------------------------------------------------------------------------------

function visibleContacts(frame) {
  if (current.points === "none") return [];
  return frame.contacts.filter((contact) =>
    (current.openContacts || contact.state !== 0) && !jointIsHidden(contact) && isKept(contact.place));
}

function contactColour(contact) {
  return current.points === "type" ? TYPE_COLOURS[contact.type] : STATE_COLOURS[contact.state];
}

function placeContacts(frame) {
  const visible = visibleContacts(frame);
  const enlarge = enlargement(frame);
  const {position, color} = forces.points.geometry.attributes;
  const arrows = [];
  visible.forEach((contact, k) => {
    const colour = new THREE.Color(contactColour(contact));
    const place = enlarge ? enlarge(contact.place, contact.a, contact.b) : contact.place;
    position.setXYZ(k, place.x, place.y, place.z);
    color.setXYZ(k, colour.r, colour.g, colour.b);
    if (current.arrows && contact.force.lengthSq() > 0) arrows.push(arrowOf(contact.force, place));
  });
  position.needsUpdate = color.needsUpdate = true;
  forces.points.geometry.setDrawRange(0, visible.length);
  placeCopies(forces.arrows, arrows);
}

/// Median over the frames of the largest force in each: an impact must not make all others vanish.
function usualForce(key) {
  const name = "usual_" + key;
  if (data[name] === undefined) {
    const largest = data.frames.map((frame) => frame[key].reduce((most, {force}) => Math.max(most, force.length()), 0));
    const sorted = largest.filter((force) => force > 0).sort((a, b) => a - b);
    data[name] = sorted[Math.floor(sorted.length / 2)] || 1;
  }
  return data[name];
}

/// The usual force is as long as a sixth of the scene, others are in proportion to it, up to a third.
function forceLength(force, usual) {
  return Math.min(sceneRadius / 3 * current.forceScale * force.length() / usual, 2 / 3 * sceneRadius);
}

/// A round force and the length of its bar or arrow in pixels at the centre of the scene, for the legend.
/// @param most pixels
function forceScaleBar(usual, most, factor = 1) {
  return roundBar(factor * sceneRadius / 3 * current.forceScale / usual / lengthOfPixel(), most);
}

function roundBar(pixelsOfNewton, most) {
  if (!(pixelsOfNewton > 0) || !Number.isFinite(pixelsOfNewton)) return null;
  const force = roundBelow(most / pixelsOfNewton);
  return {force, pixels: force * pixelsOfNewton};
}

/// The force on the first block of a contact.
function arrowOf(force, place) {
  const length = forceLength(force, usualForce("contacts"));
  return {from: place, along: force.clone().setLength(length), width: Math.min(0.4 * sceneRadius, 2 * length)};
}

// ---- joints -----------------------------------------------------------------------------------------------

/// Links with their places and the sign of their force, for blocks that are not hidden.
function visibleLinks(frame) {
  const enlarge = enlargement(frame);
  const centres = blockCentres(frame);
  return frame.links.filter((link) => !jointIsHidden(link) && isKept(link.place)).map((link) => {
    const place = enlarge ? enlarge(link.place, link.a, link.b) : link.place;
    // Compression pushes a block away from the joint. A support may be larger than all others: the other block
    // decides.
    const from = data.blocks[link.a].fixed ? link.b : link.a;
    const sign = from === link.a ? 1 : -1;
    const presses = !centres[from] || sign * link.force.dot(centres[from].clone().sub(place)) >= 0;
    return {...link, place, presses};
  });
}

/// How far a block reaches from a place in a direction of unit length, m.
function reachOf(block, frame, place, direction) {
  const at = new THREE.Vector3();
  return pointsOfBlocks()[block].reduce((most, p) =>
    Math.max(most, placeOf(frame, p, 1, at).sub(place).dot(direction)), 0);
}

/// Factor on the lengths of bars with which nine of ten stay within their blocks, at most 1, for all frames alike. It is
/// chosen in the first frame whose forces are as large as usual; forces below a twentieth of the largest do not count.
function chainFactor() {
  if (data.chainFactor !== undefined) return data.chainFactor;
  const usual = usualForce("links");
  const largest = (frame) => frame.links.reduce((most, {force}) => Math.max(most, force.length()), 0);
  const frame = data.frames.find((candidate) => largest(candidate) >= 0.999 * usual);
  data.chainFactor = 1;
  if (!frame) return 1;
  const half = (force) => 0.5 * sceneRadius / 3 * force.length() / usual;
  const shares = frame.links.filter(({force}) => force.length() > 0.05 * largest(frame)).map(({a, b, force, place}) => {
    const direction = force.clone().normalize();
    const along = Math.max(reachOf(a, frame, place, direction), reachOf(b, frame, place, direction));
    const against = direction.clone().negate();
    return Math.min(along, Math.max(reachOf(a, frame, place, against), reachOf(b, frame, place, against))) / half(force);
  }).sort((x, y) => x - y);
  data.chainFactor = Math.min(1, Math.max(0.05, shares[Math.floor(0.1 * shares.length)] || 1));
  return data.chainFactor;
}

/// A bar for each joint, along the force, equally long to both sides: the force acts on both blocks.
function placeChain(links) {
  const usual = usualForce("links") / chainFactor();
  const bars = links.map((link) => {
    const along = link.force.clone().setLength(forceLength(link.force, usual));
    return {from: link.place.clone().addScaledVector(along, -0.5), along, width: 0.012 * sceneRadius,
      presses: link.presses};
  });
  placeCopies(forces.bars, current.chain ? bars.filter((bar) => bar.presses) : []);
  placeCopies(forces.ties, current.chain ? bars.filter((bar) => !bar.presses) : []);
}

/// Lines from joint to joint through each moving block: straight for two joints, through the mean of their places
/// weighted with the forces for more.
function thrustLines(links) {
  const ofBlock = new Map();
  for (const link of links) {
    for (const block of [link.a, link.b]) {
      if (data.blocks[block].fixed) continue;
      if (!ofBlock.has(block)) ofBlock.set(block, []);
      ofBlock.get(block).push(link);
    }
  }
  const lines = [];
  const add = (p, q) => lines.push(p.x, p.y, p.z, q.x, q.y, q.z);
  for (const list of ofBlock.values()) {
    if (list.length === 2) add(list[0].place, list[1].place);
    if (list.length < 3) continue;
    const middle = new THREE.Vector3();
    let sum = 0;
    for (const {force, place} of list) {
      middle.addScaledVector(place, force.length());
      sum += force.length();
    }
    middle.divideScalar(sum);
    for (const {place} of list) add(place, middle);
  }
  return lines;
}

function placeForces(frame) {
  placeContacts(frame);
  const links = current.chain || current.thrust ? visibleLinks(frame) : [];
  placeChain(links);
  setWideLines(forces.thrust, current.thrust ? thrustLines(links) : []);
}

// ---- descriptions ---------------------------------------------------------------------------------------------

/// {name, colour} of points, bars and lines in a frame.
function forceKinds(frame) {
  const kinds = [];
  if (current.points !== "none") {
    const visible = visibleContacts(frame);
    const [names, colours] = current.points === "type" ? [CONTACT_TYPES, TYPE_COLOURS] : [STATES, STATE_COLOURS];
    names.forEach((name, k) => {
      if (visible.some((contact) => (current.points === "type" ? contact.type : contact.state) === k))
        kinds.push({name: name + " contacts", colour: colours[k]});
    });
  }
  const lengths = (usual, what, colour, factor = 1) => {
    const bar = forceScaleBar(usual, 100, factor);
    if (bar) kinds.push({name: what + quantity(bar.force, "N"), colour, bar: bar.pixels});
  };
  if (current.arrows && forces.arrows[0].count > 0) lengths(usualForce("contacts"), "contact force ", FORCE_COLOUR);
  if (current.chain && frame.links.length > 0)
    lengths(usualForce("links"), "joint force ", forces.bars[0].count > 0 ? FORCE_COLOUR : TENSION_COLOUR, chainFactor());
  if (current.chain && forces.bars[0].count > 0) kinds.push({name: "pressing joints", colour: FORCE_COLOUR});
  if (current.chain && forces.ties[0].count > 0) kinds.push({name: "pulling joints", colour: TENSION_COLOUR});
  if (current.thrust && forces.thrust.visible) kinds.push({name: "line of thrust", colour: THRUST_COLOUR});
  return kinds;
}

/// Description of the points and forces shown.
function forceNote(frame) {
  const largest = (list) => list.reduce((most, {force}) => Math.max(most, force.length()), 0);
  const notes = [];
  if (current.points !== "none" && frame.head.points < frame.head.contacts) {
    notes.push(frame.head.contacts + " contact points, too many for this page (ashlar view --points)");
  } else if (current.points !== "none") {
    const visible = visibleContacts(frame);
    const force = current.arrows && visible.length > 0 ? ", largest force " + quantity(largest(visible), "N") : "";
    notes.push(visible.length + (visible.length === 1 ? " contact point" : " contact points") + force);
  }
  if (current.thrust && !forces.thrust.visible) notes.push("no line of thrust: no free block has forces in two joints");
  if (current.chain && frame.links.length > 0) notes.push("largest joint force " + quantity(largest(frame.links), "N"));
  return notes.join("; ");
}
