// Vectors of displacement and velocity, and crosses of principal stresses.
//
// In a block of order 1 (or rigid) there is one of each, at its middle: motion is affine there and stress is constant.
// Others have several over the surface, about a twenty-fifth of the scene apart.

// Compression is black: the colours of stresses are blue there.
const PRESSED_COLOUR = "#111111";
const PULLED_COLOUR = "#d0021b";
const MOST_VECTORS = 4000;

function buildVectors() {
  return {arrows: copiesOf(arrowShapes(), "#ffffff", MOST_VECTORS),
    pressed: copiesOf(barShapes(), PRESSED_COLOUR, 3 * MOST_VECTORS),
    pulled: copiesOf(barShapes(), PULLED_COLOUR, 3 * MOST_VECTORS)};
}

/// Lists of points over which a vector or a stress is averaged, chosen once.
function vectorSeats() {
  if (data.seats) return data.seats;
  const spacing = 2 * sceneRadius / 25;
  const taken = new Set();
  const seats = [];
  pointsOfBlocks().forEach((points, block) => {
    if (points.length === 0 || data.blocks[block].fixed) return;
    if (data.blocks[block].order <= 1) {
      seats.push({block, points});
      return;
    }
    for (const p of points) {
      const cell = block + ":" + [0, 1, 2].map((k) => Math.floor(data.reference[3 * p + k] / spacing)).join();
      if (taken.has(cell)) continue;
      taken.add(cell);
      seats.push({block, points: [p]});
    }
  });
  const every = Math.ceil(seats.length / MOST_VECTORS);
  data.seats = seats.filter((_, k) => k % every === 0);
  return data.seats;
}

/// Mean over the points of a seat. @return array of the components
function meanOver(points, values, components) {
  const mean = new Float64Array(components);
  for (const p of points) for (let c = 0; c < components; ++c) mean[c] += values[components * p + c] / points.length;
  return mean;
}

/// Seats that are visible, with their places.
function visibleSeats(frame) {
  const place = new THREE.Vector3();
  return vectorSeats().filter(({block, points}) =>
    !current.hidden.has(block) && !Number.isNaN(frame.displacement[3 * points[0]])).map(({block, points}) => {
    const middle = new THREE.Vector3();
    for (const p of points) middle.add(placeOf(frame, p, current.scale, place));
    return {block, points, place: middle.divideScalar(points.length)};
  }).filter(({place}) => isKept(place));
}

function placeVectors(frame, seats) {
  const values = current.vectors === "none" ? null
    : current.vectors === "displacement" ? shownDisplacement(frame) : frame.velocity;
  if (!values) return placeCopies(vectors.arrows, []);
  const list = seats.map(({points, place}) => ({from: place, along: new THREE.Vector3(...meanOver(points, values, 3))}));
  const largest = list.reduce((most, {along}) => Math.max(most, along.length()), 0);
  vectors.largest = largest;
  for (const part of vectors.arrows) part.material.color.set(theme().vector);
  const shown = list.filter(({along}) => along.length() > 0.001 * largest);
  for (const arrow of shown) {
    arrow.along.multiplyScalar(sceneRadius / 4 / largest);
    arrow.width = Math.min(0.35 * sceneRadius, 2 * arrow.along.length());
  }
  placeCopies(vectors.arrows, shown);
}

/// Directions of the principal stresses: of a symmetric matrix by Jacobi's rotations.
/// @return [{value, axis}] three of them
function principalAxes(s) {
  const m = [[s[0], s[3], s[5]], [s[3], s[1], s[4]], [s[5], s[4], s[2]]];
  const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  for (let sweep = 0; sweep < 8; ++sweep) {
    for (const [i, k] of [[0, 1], [0, 2], [1, 2]]) {
      if (m[i][k] === 0) continue;
      const angle = 0.5 * Math.atan2(2 * m[i][k], m[i][i] - m[k][k]);
      const [c, d] = [Math.cos(angle), Math.sin(angle)];
      const turn = (rows) => rows.forEach((row) => { [row[i], row[k]] = [c * row[i] + d * row[k], c * row[k] - d * row[i]]; });
      turn(m);
      [m[i], m[k]] = [m[i].map((x, j) => c * x + d * m[k][j]), m[k].map((x, j) => c * x - d * m[i][j])];
      turn(axes);
    }
  }
  return [0, 1, 2].map((k) => ({value: m[k][k], axis: new THREE.Vector3(axes[0][k], axes[1][k], axes[2][k])}));
}

function placeCrosses(frame, seats) {
  const bars = [];
  if (current.crosses && data.stress) {
    const all = seats.map(({points, place}) => ({place, axes: principalAxes(meanOver(points, frame.stress, 6))}));
    const largest = all.reduce((most, {axes}) => Math.max(most, ...axes.map(({value}) => Math.abs(value))), 0);
    vectors.largestStress = largest;
    for (const {place, axes} of all) {
      for (const {value, axis} of axes) {
        if (!(Math.abs(value) > 0.01 * largest)) continue;
        const along = axis.multiplyScalar(sceneRadius / 5 * Math.abs(value) / largest);
        bars.push({from: place.clone().addScaledVector(along, -0.5), along, width: 0.008 * sceneRadius, value});
      }
    }
  }
  placeCopies(vectors.pressed, bars.filter(({value}) => value < 0));
  placeCopies(vectors.pulled, bars.filter(({value}) => value > 0));
}

function placeAllVectors(frame) {
  const seats = current.vectors !== "none" || current.crosses ? visibleSeats(frame) : [];
  placeVectors(frame, seats);
  placeCrosses(frame, seats);
}

function vectorKinds() {
  const kinds = [];
  if (vectors.arrows[0].count > 0) {
    const unit = current.vectors === "velocity" ? "m/s" : "m";
    const words = current.vectors === "displacement" ? relativeWords(currentFrame()) : "";
    kinds.push({name: current.vectors + words + ", longest " + quantity(vectors.largest, unit), colour: theme().vector});
  }
  if (vectors.pressed[0].count + vectors.pulled[0].count > 0) {
    kinds.push({name: "principal compression", colour: PRESSED_COLOUR}, {name: "principal tension", colour: PULLED_COLOUR},
      {name: "longest " + quantity(vectors.largestStress, "Pa")});
  }
  return kinds;
}
