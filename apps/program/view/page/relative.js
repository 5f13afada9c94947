// Displacements relative to a block: those of a frame less the rigid motion, translation and rotation, of that block.
//
// With X the points of the block and x = X + u their places, c and c' the means of both, the rigid motion nearest to
// them (least squares) maps Y to c' + R (Y - c); R is the orthogonal factor of H = sum (x - c') (X - c)^T. A point Y
// with displacement u is shown with u - (c' + R (Y - c) - Y), in the axes of the scene. `current.relative` is the
// number of the block; null: displacements are shown as they are.

/// The orthogonal factor of a matrix of positive determinant: Newton's iteration R <- (g R + (g R)^-T) / 2, with the
/// factor g that makes the determinant 1 (Higham 1986). The unit matrix where points lie in a plane.
function orthogonalFactor(matrix) {
  let factor = matrix.clone();
  factor.multiplyScalar(1 / Math.max(...factor.elements.map(Math.abs)));
  for (let round = 0; round < 40; ++round) {
    const determinant = factor.determinant();
    if (!(determinant > 0)) return new THREE.Matrix3();
    factor.multiplyScalar(determinant ** (-1 / 3));
    const inverse = new THREE.Matrix3().getInverse(factor).transpose();
    const next = factor.elements.map((value, k) => 0.5 * (value + inverse.elements[k]));
    const change = Math.max(...next.map((value, k) => Math.abs(value - factor.elements[k])));
    factor = new THREE.Matrix3().fromArray(next);
    if (change < 1e-14) break;
  }
  return factor;
}

/// The rigid motion of a block in a frame: {from: c, to: c', turn: R}; null: the block is not there.
function rigidMotion(frame, block) {
  const points = pointsOfBlocks()[block];
  if (points.length === 0 || Number.isNaN(frame.displacement[3 * points[0]])) return null;
  const [from, to] = [new THREE.Vector3(), new THREE.Vector3()];
  const [before, after] = [new THREE.Vector3(), new THREE.Vector3()];
  const read = (p) => {
    before.fromArray(data.reference, 3 * p);
    after.fromArray(frame.displacement, 3 * p).add(before);
  };
  for (const p of points) {
    read(p);
    from.add(before);
    to.add(after);
  }
  from.divideScalar(points.length);
  to.divideScalar(points.length);
  const sum = new Float64Array(9);
  for (const p of points) {
    read(p);
    const [x, X] = [after.sub(to).toArray(), before.sub(from).toArray()];
    for (let i = 0; i < 3; ++i) for (let k = 0; k < 3; ++k) sum[3 * i + k] += x[i] * X[k];
  }
  return {from, to, turn: orthogonalFactor(new THREE.Matrix3().set(...sum))};
}

/// Displacements of a frame relative to a block. @return (#points x 3), m
function relativeDisplacements(frame, block) {
  const motion = rigidMotion(frame, block);
  if (!motion) return frame.displacement;
  const values = new Float32Array(frame.displacement);
  const [place, moved] = [new THREE.Vector3(), new THREE.Vector3()];
  for (let p = 0; p < data.points; ++p) {
    place.fromArray(data.reference, 3 * p);
    moved.copy(place).sub(motion.from).applyMatrix3(motion.turn).add(motion.to).sub(place);
    values[3 * p] -= moved.x;
    values[3 * p + 1] -= moved.y;
    values[3 * p + 2] -= moved.z;
  }
  return values;
}

/// The displacements used for colours and for enlarged pictures of a frame.
function shownDisplacement(frame) {
  if (current.relative === null) return frame.displacement;
  if (!frame.relative || frame.relative.block !== current.relative)
    frame.relative = {block: current.relative, values: relativeDisplacements(frame, current.relative)};
  return frame.relative.values;
}

/// " relative to base", or nothing; for a frame without the block a note.
function relativeWords(frame) {
  if (current.relative === null) return "";
  const {name} = data.blocks[current.relative];
  return shownDisplacement(frame) === frame.displacement ? " (" + name + " is not there)" : " relative to " + name;
}

/// Name of a field in a frame.
const labelOf = (field, frame) => field.label + (field.isDisplacement ? relativeWords(frame) : "");

/// {value, block, place} of the largest displacement shown in a frame, of blocks that are not fixed; null: none.
function largestShownDisplacement(frame) {
  const shown = shownDisplacement(frame);
  let [most, at] = [-1, -1];
  for (let p = 0; p < data.points; ++p) {
    const block = data.blockOfPoint[p];
    if (block < 0 || data.blocks[block].fixed || !(lengthAt(shown, p) > most)) continue;
    [most, at] = [lengthAt(shown, p), p];
  }
  if (at < 0) return null;
  return {value: most, block: data.blocks[data.blockOfPoint[at]].name, place: placeOf(frame, at, 1, new THREE.Vector3()).toArray().map((x, k) => x + data.origin[k])};
}

// ---- the control ------------------------------------------------------------------------------------------

/// Blocks that the control offers: all where there are few, else the base, the present one and the first ones.
function fillRelative() {
  const wanted = [data.relative_to, current.relative].filter((block) => block !== null);
  const there = data.blocks.map((_, k) => k).filter((k) => !data.blocks[k].absent).slice(0, MOST_LISTED);
  const blocks = [...new Set([...wanted, ...there])];
  element("relative").replaceChildren(new Option("nothing (absolute)", "none"),
    ...blocks.map((block) => new Option(data.blocks[block].name, block)));
  element("relative").value = current.relative === null ? "none" : current.relative;
}

function showRelativeTo(block) {
  current.relative = block;
  fillRelative();
  afterChange("relative");
}
