// The blocks as three.js draws them: their surfaces and edges.

/// Edges between faces at smaller angles are not drawn: they would show all triangles of a curved face, or of a face
/// that is flat up to rounding.
const FEATURE_ANGLE = 20;

/// Normal of a cell in its undeformed place, of unit length: the mean one of its triangles.
function normalOf(cell) {
  const [normal, p, q] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
  const from = new THREE.Vector3().fromArray(data.reference, 3 * cell.corners[0]);
  for (let k = 2; k < cell.corners.length; ++k) {
    p.fromArray(data.reference, 3 * cell.corners[k - 1]).sub(from);
    q.fromArray(data.reference, 3 * cell.corners[k]).sub(from);
    normal.add(p.cross(q));
  }
  return normal.normalize();
}

/// Points are split where faces meet, so that shading is smooth inside a curved face and breaks at its edges.
/// source: point of each render point; triangles, their blocks; edges between faces, those at small angles,
/// and those inside faces.
function buildSurface(cells) {
  const surface = {source: [], block: [], triangles: [], triangleBlock: [], edges: [], smoothEdges: [], innerEdges: []};
  const smooth = Math.cos(THREE.Math.degToRad(FEATURE_ANGLE));
  const renderPoints = new Map();
  const sides = new Map();
  const points = data.points;
  const renderPoint = (cell, point) => {
    const key = cell.face * points + point;
    let known = renderPoints.get(key);
    if (known === undefined) {
      known = surface.source.length;
      renderPoints.set(key, known);
      surface.source.push(point);
      surface.block.push(cell.block);
    }
    return known;
  };
  for (const cell of cells) {
    const normal = normalOf(cell);
    const corners = Array.from(cell.corners, (point) => renderPoint(cell, point));
    for (let k = 2; k < corners.length; ++k) {
      surface.triangles.push(corners[0], corners[k - 1], corners[k]);
      surface.triangleBlock.push(cell.block);
    }
    corners.forEach((corner, k) => {
      const next = (k + 1) % corners.length;
      const [p, q] = [cell.corners[k], cell.corners[next]];
      const key = Math.min(p, q) * points + Math.max(p, q);
      const known = sides.get(key);
      if (known) {
        known.kind = known.face === cell.face ? "innerEdges" : known.normal.dot(normal) > smooth ? "smoothEdges" : "edges";
      } else sides.set(key, {ends: [corner, corners[next]], face: cell.face, block: cell.block, normal, kind: "edges"});
    });
  }
  for (const side of sides.values()) surface[side.kind].push(side);
  return surface;
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
    innerEdges: edgeLines([...surface.innerEdges, ...surface.smoothEdges], places, "#777777"),
    selection: edgeLines([], places, "#ff00aa")};
}

/// @return place of a point of a frame; the displayed displacements are enlarged, so that their reference stays in
/// place
function placeOf(frame, point, scale, into) {
  const i = 3 * point;
  const {reference} = data;
  const {displacement: by} = frame;
  into.set(reference[i] + by[i], reference[i + 1] + by[i + 1], reference[i + 2] + by[i + 2]);
  if (scale === 1) return into;
  const shown = shownDisplacement(frame);
  into.x += (scale - 1) * shown[i];
  into.y += (scale - 1) * shown[i + 1];
  into.z += (scale - 1) * shown[i + 2];
  return into;
}

function moveSurface(frame) {
  const geometry = meshes.mesh.geometry;
  const places = geometry.attributes.position;
  const [to, from, by, more] = [places.array, data.reference, frame.displacement, current.scale - 1];
  const shown = shownDisplacement(frame);
  for (let k = 0; k < surface.source.length; ++k) {
    const i = 3 * surface.source[k];
    // All points of a hidden or absent block coincide, so that it is not drawn.
    const gone = current.hidden.has(surface.block[k]) || Number.isNaN(by[i]);
    for (let c = 0; c < 3; ++c) to[3 * k + c] = gone ? from[c] : from[i + c] + by[i + c] + more * shown[i + c];
  }
  places.needsUpdate = true;
  geometry.computeVertexNormals();
}

function colourSurface(field, frame, range) {
  const uv = meshes.mesh.geometry.attributes.uv;
  for (let k = 0; k < surface.source.length; ++k) {
    const [u, v] = textureAt(field, frame, surface.source[k], surface.block[k], range);
    uv.array[2 * k] = u;
    uv.array[2 * k + 1] = v;
  }
  uv.needsUpdate = true;
  meshes.mesh.material.map = textureOf(field);
  meshes.mesh.material.needsUpdate = true;
}

/// Blocks are transparent if they would hide items between or in them.
function styleSurface() {
  const glass = current.seeThrough || current.joints !== "none";
  Object.assign(meshes.mesh.material, {transparent: glass, opacity: current.joints !== "none" ? 0.12 : glass ? 0.35 : 1,
    depthWrite: !glass, side: glass ? THREE.DoubleSide : THREE.FrontSide});
  meshes.edges.visible = current.edges;
  meshes.innerEdges.visible = current.subFaces;
  meshes.edges.material.color.set(current.joints !== "none" ? theme().faintEdge : theme().edge);
  meshes.innerEdges.material.color.set(theme().faintEdge);
}

// ---- blocks as wholes -------------------------------------------------------------------------------------

/// Mean place of the points of each block in a frame, with displacements enlarged; null for absent blocks.
function blockCentres(frame) {
  const centres = data.blocks.map(() => null);
  const counts = new Float64Array(data.blocks.length);
  const place = new THREE.Vector3();
  for (let p = 0; p < data.points; ++p) {
    const block = data.blockOfPoint[p];
    if (block < 0 || Number.isNaN(frame.displacement[3 * p])) continue;
    placeOf(frame, p, current.scale, place);
    if (centres[block]) centres[block].add(place);
    else centres[block] = place.clone();
    counts[block] += 1;
  }
  return centres.map((centre, block) => centre && centre.divideScalar(counts[block]));
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

/// Displacement of joints and forces, which are at the true places of blocks, for enlarged displacements: (scale - 1)
/// times the displacement there, approximated as affine in each block (least squares over its points) and averaged
/// between the two.
function enlargement(frame) {
  if (current.scale === 1) return null;
  const maps = data.blocks.map(() => undefined);
  const pointsOf = pointsOfBlocks();
  const mapOf = (block) => {
    if (maps[block] === undefined) maps[block] = data.blocks[block].fixed && current.relative === null ? null : affineMotion(frame, pointsOf[block]);
    return maps[block];
  };
  return (place, a, b) => {
    const moved = place.clone();
    for (const map of [mapOf(a), mapOf(b)]) if (map) moved.addScaledVector(map(place), 0.5 * (current.scale - 1));
    return moved;
  };
}

function pointsOfBlocks() {
  if (!data.pointsOfBlocks) {
    data.pointsOfBlocks = data.blocks.map(() => []);
    data.blockOfPoint.forEach((block, p) => { if (block >= 0) data.pointsOfBlocks[block].push(p); });
  }
  return data.pointsOfBlocks;
}

/// u(x) = mean + G (x - centre) with G of least squares, x being present places. @return function of x, or null
function affineMotion(frame, points) {
  const centre = new THREE.Vector3(), mean = new THREE.Vector3(), x = new THREE.Vector3(), u = new THREE.Vector3();
  const shown = shownDisplacement(frame);
  const displacement = (p) => u.fromArray(shown, 3 * p);
  for (const p of points) {
    centre.add(placeOf(frame, p, 1, x));
    mean.add(displacement(p));
  }
  centre.divideScalar(points.length);
  mean.divideScalar(points.length);
  if (Number.isNaN(mean.x)) return null;
  const spread = new Float64Array(9), motion = new Float64Array(9);
  for (const p of points) {
    const from = placeOf(frame, p, 1, x).sub(centre).toArray();
    const by = displacement(p).sub(mean).toArray();
    for (let i = 0; i < 3; ++i) {
      for (let k = 0; k < 3; ++k) {
        spread[3 * i + k] += from[i] * from[k];
        motion[3 * i + k] += by[i] * from[k];
      }
    }
  }
  const inverse = new THREE.Matrix3().getInverse(new THREE.Matrix3().set(...spread));
  const gradient = new THREE.Matrix3().multiplyMatrices(new THREE.Matrix3().set(...motion), inverse);
  return (place) => place.clone().sub(centre).applyMatrix3(gradient).add(mean);
}
