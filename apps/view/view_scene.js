// The page of `ashlar view`, second part: the blocks, the contacts and the camera as three.js draws them.

const CONTACT_TYPES = ["face-face", "vertex-face", "edge-edge"];
const CONTACT_STATES = ["open", "locked", "sliding"];
const TYPE_COLOURS = ["#1b6fd0", "#d62976", "#e8890c"];
const STATE_COLOURS = ["#8a8a8a", "#1a9641", "#e8590c"];

// ---- surface ----------------------------------------------------------------------------------------------

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
    // All points of a block that is not there are one: nothing is drawn of it.
    if (Number.isNaN(place.x)) place.fromArray(data.reference);
    places.setXYZ(k, place.x, place.y, place.z);
  });
  places.needsUpdate = true;
  geometry.computeVertexNormals();
}

// ---- contacts ---------------------------------------------------------------------------------------------

/// So many contacts that arrows and large points would hide the blocks; the user can still switch the arrows on.
function crowded() {
  const closed = data.frames.map((frame) => frame.contacts.filter((contact) => contact.state !== 0).length);
  return Math.max(...closed) > 500;
}

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
  const points = new THREE.Points(geometry, new THREE.PointsMaterial({size: crowded() ? 3 : 6, sizeAttenuation: false,
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
/// proportion to it, up to a third.
function placeArrows(list) {
  const unit = sceneRadius / 3 * current.forceScale / usualForce();
  const up = new THREE.Vector3(0, 0, 1);
  list.forEach((contact, k) => {
    const size = contact.force.length();
    const turn = new THREE.Quaternion().setFromUnitVectors(up, contact.force.clone().divideScalar(size));
    const length = Math.min(unit * size, 2 / 3 * sceneRadius);
    const width = Math.min(0.4 * sceneRadius, 2 * length);
    const matrix = new THREE.Matrix4().compose(contact.place, turn, new THREE.Vector3(width, width, length));
    for (const arrow of contacts.arrows) arrow.setMatrixAt(k, matrix);
  });
  for (const arrow of contacts.arrows) {
    arrow.count = list.length;
    arrow.visible = list.length > 0;
    arrow.instanceMatrix.needsUpdate = true;
  }
}

/// {name, colour} of the kinds of contacts that the colours of the points tell apart.
function contactKinds() {
  if (current.contactColour === "none") return [];
  const [names, colours] = current.contactColour === "type" ? [CONTACT_TYPES, TYPE_COLOURS]
    : [CONTACT_STATES, STATE_COLOURS];
  return names.map((name, k) => ({name, colour: colours[k]}));
}

/// What the points and arrows of a frame stand for, in words.
function contactNote(frame) {
  if (current.contactColour === "none") return "";
  if (current.scale !== 1) return "not shown where displacements are enlarged";
  const visible = visibleContacts(frame);
  const largest = Math.max(0, ...visible.map((contact) => contact.force.length()));
  const forces = current.forces && largest > 0 ? ", largest force " + short(largest) + " N" : "";
  return visible.length + (visible.length === 1 ? " contact point" : " contact points") + forces;
}

function showContactLegend(frame) {
  const kinds = contactKinds().map(({name, colour}) => {
    const entry = document.createElement("span");
    const dot = document.createElement("i");
    dot.style.background = colour;
    entry.append(dot, name);
    return entry;
  });
  const note = document.createElement("div");
  note.textContent = contactNote(frame);
  element("contact-legend").replaceChildren(...kinds, note);
}

/// For pictures: kinds that the frame has, then the note, one below the other and flush right.
function drawContactLegend(context, frame, right, top) {
  const visible = visibleContacts(frame);
  if (visible.length === 0) return;
  const kinds = contactKinds().filter((_, k) =>
    visible.some((contact) => (current.contactColour === "type" ? contact.type : contact.state) === k));
  context.font = "13px system-ui, sans-serif";
  context.textAlign = "right";
  const note = contactNote(frame);
  const width = context.measureText(note).width + 8;
  context.fillStyle = "#ffffffb0";
  context.fillRect(right - width + 4, top - 15, width, 19 * (kinds.length + 1));
  let y = top;
  for (const {name, colour} of kinds) {
    context.fillStyle = colour;
    context.beginPath();
    context.arc(right - 5, y - 4, 5, 0, 2 * Math.PI);
    context.fill();
    context.fillStyle = "#222";
    context.fillText(name, right - 16, y);
    y += 19;
  }
  context.fillStyle = "#222";
  context.fillText(note, right, y);
}

// ---- camera -----------------------------------------------------------------------------------------------

/// Points around all that is to be seen: those of fixed blocks, the corners of a box around the way of each other one
/// that does not fly off to more than half the scene's own size.
function outlineOfScene() {
  const boxes = data.blocks.map(() => new THREE.Box3());
  const place = new THREE.Vector3();
  const expandBy = (frame) => surface.source.forEach((point, k) => {
    placeOf(frame, point, 1, place);
    if (!Number.isNaN(place.x)) boxes[surface.block[k]].expandByPoint(place);
  });
  expandBy(data.frames[0]);
  const box = boxes.reduce((all, part) => all.union(part), new THREE.Box3());
  const most = box.clone().expandByScalar(0.5 * box.getSize(place).length());
  data.frames.forEach(expandBy);
  const outline = [];
  surface.source.forEach((point, k) => {
    if (!data.blocks[surface.block[k]].fixed) return;
    const place = placeOf(data.frames[0], point, 1, new THREE.Vector3());
    if (!Number.isNaN(place.x)) outline.push(place);
  });
  const ways = boxes.filter((part, block) => !data.blocks[block].fixed && most.containsBox(part));
  outline.push(...ways.flatMap(cornersOf));
  return outline.length > 0 ? outline : cornersOf(box);
}

function cornersOf(box) {
  return [0, 1, 2, 3, 4, 5, 6, 7].map((k) => new THREE.Vector3(k & 1 ? box.max.x : box.min.x,
    k & 2 ? box.max.y : box.min.y, k & 4 ? box.max.z : box.min.z));
}

/// Where to look and from how far so that the scene fills what the legend, the heading and the player leave free.
/// @param toEye unit vector; right, up those of the picture
function fitted(toEye, right, up) {
  const margin = 0.96;
  const tangent = margin * Math.tan(0.5 * THREE.Math.degToRad(camera.fov));
  const {width, height, side, ends} = frameSize;
  const [horizontal, vertical] = [tangent * (width - side) / height, tangent * (height - ends) / height];
  const target = sceneBox.getCenter(new THREE.Vector3());
  let distance = 0;
  // What is near looks larger: its middle in the picture is not that of the box. Each round moves the target there.
  for (let round = 0; round < 4; ++round) {
    const seen = outline.map((point) => {
      const offset = point.clone().sub(target);
      return {x: offset.dot(right), y: offset.dot(up), z: offset.dot(toEye)};
    });
    distance = seen.reduce((most, {x, y, z}) =>
      Math.max(most, z + Math.max(Math.abs(x) / horizontal, Math.abs(y) / vertical)), 0);
    if (round === 3) break;
    const middle = (key) => {
      const [low, high] = seen.reduce(([least, most], p) =>
        [Math.min(least, p[key] / (distance - p.z)), Math.max(most, p[key] / (distance - p.z))], [Infinity, -Infinity]);
      return 0.5 * (low + high) * distance;
    };
    const [across, upward] = [middle("x"), middle("y")];
    target.addScaledVector(right, across).addScaledVector(up, upward);
  }
  return {target, distance};
}

/// Looks at the middle of the scene, or at `current.at`, `current.zoom` times as near as to see all.
function lookFrom(direction) {
  const toEye = direction.clone().normalize();
  camera.position.copy(toEye);
  camera.lookAt(0, 0, 0);
  camera.updateMatrixWorld();
  const [right, up] = [0, 1].map((k) => new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, k));
  const view = fitted(toEye, right, up);
  const distance = view.distance / current.zoom;
  camera.near = 0.01 * Math.min(sceneRadius, distance);
  camera.far = distance + 100 * sceneRadius;
  controls.target.copy(current.at || view.target);
  camera.position.copy(controls.target).addScaledVector(toEye, distance);
  camera.updateProjectionMatrix();
  controls.update();
}

/// The scene is drawn in the middle of what the legend on the left leaves free.
/// @param size width and height of the canvas; side, ends: pixels for legend, heading and player
function setFrame(size) {
  Object.assign(frameSize, size);
  const {width, height, side} = frameSize;
  camera.aspect = width / height;
  camera.setViewOffset(width, height, -side / 2, 0, width, height);
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
  const {clientWidth: width, clientHeight: height} = element("stage");
  if (renderer) {
    renderer.setPixelRatio(window.devicePixelRatio);
    renderer.setSize(width, height, false);
  }
  setFrame({width, height, side: Math.min(140, 0.25 * width), ends: Math.min(130, 0.3 * height)});
  render();
}

function render() {
  if (renderer) renderer.render(stage, camera);
}
