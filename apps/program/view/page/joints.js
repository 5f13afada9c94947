// The contact faces of blocks, coloured by their forces. Seen edge-on a face is a line: its rim is drawn with
// some pixels' width, so that an arch seen from the front shows its joints too.

function buildJoints() {
  const corners = Math.max(1, ...data.frames.map((frame) => frame.head.corners));
  // A face of n corners is n - 2 triangles: 3 n points are enough.
  const geometry = new THREE.BufferGeometry();
  for (const name of ["position", "color"])
    geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(9 * corners), 3));
  const faces = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({vertexColors: THREE.VertexColors,
    side: THREE.DoubleSide, transparent: true, opacity: 0.95}));
  const rims = wideLines(3.5);
  faces.frustumCulled = false;
  faces.renderOrder = 1;
  rims.renderOrder = 2;
  return {faces, rims};
}

/// Lines of some pixels' width, which WebGL does not draw. @see setWideLines
function wideLines(width, colour = "#ffffff", inFront = false) {
  const material = new THREE.LineMaterial({linewidth: width, color: colour,
    vertexColors: colour === "#ffffff" ? THREE.VertexColors : THREE.NoColors, depthTest: !inFront, transparent: inFront});
  const lines = new THREE.LineSegments2(new THREE.LineSegmentsGeometry(), material);
  lines.frustumCulled = false;
  lines.visible = false;
  return lines;
}

/// @param places, colours flat lists, two ends for each line
function setWideLines(lines, places, colours) {
  lines.visible = places.length > 0;
  if (!lines.visible) return;
  lines.geometry.dispose();
  lines.geometry = new THREE.LineSegmentsGeometry();
  lines.geometry.setPositions(places);
  if (colours) lines.geometry.setColors(colours);
}

const jointIsHidden = (joint) => current.hidden.has(joint.a) && current.hidden.has(joint.b);

function placeJoints(frame) {
  const field = JOINT_FIELDS[current.joints];
  joints.faces.visible = field !== undefined;
  if (!field) return setWideLines(joints.rims, []);
  const all = frame.joints;
  const values = field.of(all);
  const range = rangeOf(field, frame);
  const enlarge = enlargement(frame);
  const {position, color} = joints.faces.geometry.attributes;
  const [rims, rimColours] = [[], []];
  let count = 0;
  for (let face = 0; face < all.count; ++face) {
    if (jointIsHidden({a: all.a[face], b: all.b[face]})) continue;
    const colour = jointColour(field, values[face], range);
    const corners = [];
    for (let k = all.start[face]; k < all.start[face + 1]; ++k) {
      const place = new THREE.Vector3().fromArray(all.places, 3 * k);
      corners.push(enlarge ? enlarge(place, all.a[face], all.b[face]) : place);
    }
    corners.forEach((corner, k) => {
      const next = corners[(k + 1) % corners.length];
      if (isKept(corner) && isKept(next)) {
        rims.push(corner.x, corner.y, corner.z, next.x, next.y, next.z);
        for (let end = 0; end < 2; ++end) rimColours.push(colour.r, colour.g, colour.b);
      }
      if (k < 2) return;
      for (const place of [corners[0], corners[k - 1], corner]) {
        position.setXYZ(count, place.x, place.y, place.z);
        color.setXYZ(count, colour.r, colour.g, colour.b);
        count += 1;
      }
    });
  }
  position.needsUpdate = color.needsUpdate = true;
  joints.faces.geometry.setDrawRange(0, count);
  setWideLines(joints.rims, rims, rimColours);
}

/// True if any frame has joints: false for versions before 0.2.
const hasJoints = () => data.frames.some((frame) => frame.head.joints > 0);
