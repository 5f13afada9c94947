// Actions on the blocks besides contact: loads, supports, bolts and water.
//
// A load is an arrow whose tip is at the centre of its faces, or at its point; all arrows of a run have one scale. A
// support has strokes out of its faces: inclined ones where all components are held, upright ones where some are free;
// a held point is the tip of a cone. Bolts are seen through the blocks.

const LOAD_COLOUR = "#7a2fb5";
const HELD_COLOUR = "#3d4654";
const ROLLER_COLOUR = "#0b7285";
const WATER_COLOUR = "#2f80ed";
const RUPTURED_COLOUR = "#111111";
const ALL_HELD = 7;
/// Loads of at least half the largest one have a number, unless there are more than MOST_LABELS of them.
const MOST_LABELS = 8;
const MOST_STROKES = 6000;

const coneShapes = () => [new THREE.ConeBufferGeometry(0.35, 1, 16).rotateX(Math.PI / 2).translate(0, 0, 0.5)];

function buildActions() {
  const strokes = {held: wideLines(2, HELD_COLOUR), roller: wideLines(2, ROLLER_COLOUR)};
  const most = mostOf("supports");
  const plane = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial({color: WATER_COLOUR,
    side: THREE.DoubleSide, transparent: true, opacity: 0.22, depthWrite: false}));
  Object.assign(plane, {frustumCulled: false, renderOrder: 2, visible: false});
  return {arrows: copiesOf(arrowShapes(), LOAD_COLOUR, mostOf("loads")), strokes,
    cones: {held: copiesOf(coneShapes(), HELD_COLOUR, most, false), roller: copiesOf(coneShapes(), ROLLER_COLOUR, most, false)},
    bolts: wideLines(5, "#ffffff", true), casing: wideLines(7.5, "#222222", true), water: plane, shore: wideLines(1.6, WATER_COLOUR), labels: []};
}

/// Lines of some pixels' width among them.
const linesOfActions = () => [actions.strokes.held, actions.strokes.roller, actions.casing, actions.bolts, actions.shore];
const partsOfActions = () => [...actions.arrows, ...actions.cones.held, ...actions.cones.roller, actions.water,
  ...linesOfActions()];

// ---- loads ------------------------------------------------------------------------------------------------

/// The largest load of the run, N.
function largestLoad() {
  if (data.largestLoad === undefined) {
    data.largestLoad = data.frames.reduce((most, frame) =>
      frame.loads.reduce((size, {force}) => Math.max(size, force.length()), most), 0);
  }
  return data.largestLoad;
}

const lengthOfLargestLoad = () => sceneRadius / 3.5 * current.forceScale;

function placeLoads(frame, enlarge) {
  const shown = current.loads ? frame.loads.filter(({block, place}) => !current.hidden.has(block) && isKept(place)) : [];
  const drawn = shown.filter(({force}) => force.length() > 0.001 * largestLoad());
  const arrows = drawn.map(({force, place, block}) => {
    const tip = enlarge ? enlarge(place, block, block) : place;
    const along = force.clone().multiplyScalar(lengthOfLargestLoad() / largestLoad());
    return {from: tip.clone().sub(along), along, width: Math.min(0.45 * sceneRadius, 1.6 * along.length()), size: force.length()};
  });
  placeCopies(actions.arrows, arrows);
  const large = arrows.filter(({size}) => size >= 0.5 * largestLoad());
  actions.labels = large.length <= MOST_LABELS ? large : [];
}

// ---- supports ---------------------------------------------------------------------------------------------

/// Points of a triangle on a square grid of its plane, which is the same for all triangles of a plane; its centre if
/// there is none.
function gridPoints([a, b, c], normal, spacing) {
  const across = new THREE.Vector3(Math.abs(normal.x) > 0.9 ? 0 : 1, Math.abs(normal.x) > 0.9 ? 1 : 0, 0)
    .projectOnPlane(normal).normalize();
  const axes = [across, normal.clone().cross(across)];
  const [p, q, r] = [a, b, c].map((corner) => axes.map((axis) => corner.dot(axis)));
  const double = (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]);
  const points = [];
  if (double === 0) return {points, axes};
  const range = (k) => [Math.ceil(Math.min(p[k], q[k], r[k]) / spacing), Math.floor(Math.max(p[k], q[k], r[k]) / spacing)];
  const [columns, rows] = [range(0), range(1)];
  for (let i = columns[0]; i <= columns[1]; ++i) {
    for (let j = rows[0]; j <= rows[1]; ++j) {
      const [x, y] = [i * spacing - p[0], j * spacing - p[1]];
      const s = (x * (r[1] - p[1]) - y * (r[0] - p[0])) / double;
      const t = (y * (q[0] - p[0]) - x * (q[1] - p[1])) / double;
      if (s >= 0 && t >= 0 && s + t <= 1)
        points.push(a.clone().addScaledVector(b.clone().sub(a), s).addScaledVector(c.clone().sub(a), t));
    }
  }
  if (points.length === 0) points.push(a.clone().add(b).add(c).divideScalar(3));
  return {points, axes};
}

const normalOfCorners = ([a, b, c]) => b.clone().sub(a).cross(c.clone().sub(a)).normalize();

/// A base that is held above and below, so that it moves as a whole, shows the supports below only.
function withoutHeldTops(supports) {
  const facing = (support, sign) => support.corners.length === 3 && sign * normalOfCorners(support.corners).z > 0.7;
  const below = new Set(supports.filter((support) => facing(support, -1)).map(({block}) => block));
  return supports.filter((support) => !(below.has(support.block) && facing(support, 1)));
}

/// Distance of strokes: no more of them than MOST_STROKES.
function strokeSpacing(triangles) {
  const area = triangles.reduce((sum, {corners: [a, b, c]}) =>
    sum + 0.5 * b.clone().sub(a).cross(c.clone().sub(a)).length(), 0);
  return Math.max(sceneRadius / 24, Math.sqrt(area / MOST_STROKES));
}

function placeSupports(frame, enlarge) {
  const strokes = {held: [], roller: []}, cones = {held: [], roller: []};
  const shown = current.supports ? frame.supports.filter(({block, corners}) => !current.hidden.has(block) && isKept(corners[0])) : [];
  const moved = withoutHeldTops(shown).map((support) => (enlarge ? {...support,
    corners: support.corners.map((corner) => enlarge(corner, support.block, support.block))} : support));
  const spacing = strokeSpacing(moved.filter(({corners}) => corners.length === 3));
  const reach = sceneRadius / 40;
  for (const {held, corners} of moved) {
    const kind = held === ALL_HELD ? "held" : "roller";
    if (corners.length < 3) {
      const along = new THREE.Vector3(0, 0, 2 * reach);
      cones[kind].push({from: corners[0].clone().sub(along), along, width: 2 * reach});
      continue;
    }
    const normal = normalOfCorners(corners);
    const {points, axes} = gridPoints(corners, normal, spacing);
    const away = normal.clone();
    if (kind === "held") away.add(axes[0]).add(axes[1].clone().multiplyScalar(0.5)).normalize();
    for (const point of points)
      strokes[kind].push(point.x, point.y, point.z, ...point.clone().addScaledVector(away, reach).toArray());
  }
  for (const kind of ["held", "roller"]) {
    setWideLines(actions.strokes[kind], strokes[kind]);
    placeCopies(actions.cones[kind], cones[kind]);
  }
  actions.kindsHeld = [...new Set(shown.map(({held}) => held))];
}

/// "supports", "supports held in z"
function supportKinds() {
  return (actions.kindsHeld || []).map((held) => (held === ALL_HELD ? {name: "supports", colour: HELD_COLOUR}
    : {name: "supports held in " + ["x", "y", "z"].filter((_, k) => held & 2 ** k).join(", "), colour: ROLLER_COLOUR}));
}

// ---- bolts ------------------------------------------------------------------------------------------------

/// Range of the axial force over the run, N: from 0 if compression is below a twentieth of the tension.
function boltRange() {
  if (data.boltRange === undefined) {
    let [low, high] = [0, 0];
    for (const frame of data.frames) for (const {axial} of frame.bolts) [low, high] = [Math.min(low, axial), Math.max(high, axial)];
    const negligible = -low < 0.05 * high;
    const size = Math.max(-low, high) || 1;
    data.boltRange = negligible ? [0, size] : [-size, size];
  }
  return data.boltRange;
}

const BOLT_RUPTURED = 3;
const boltField = () => ({label: "axial force", unit: "N", signed: boltRange()[0] < 0});

function placeBolts(frame) {
  const places = [], colours = [];
  const [low, high] = boltRange();
  for (const {ends, axial, state} of current.bolts ? frame.bolts : []) {
    if (!isKept(ends[0]) || !isKept(ends[1])) continue;
    const colour = state === BOLT_RUPTURED ? new THREE.Color(RUPTURED_COLOUR)
      : scaleColour(stopsOf(boltField()), (axial - low) / (high - low));
    places.push(...ends[0].toArray(), ...ends[1].toArray());
    colours.push(...colour.toArray(), ...colour.toArray());
  }
  // Dark rims show pale bolts on pale blocks.
  setWideLines(actions.casing, places);
  setWideLines(actions.bolts, places, colours);
  [actions.casing.renderOrder, actions.bolts.renderOrder] = [3, 4];
}

// ---- water ------------------------------------------------------------------------------------------------

/// Number of the stage of a frame, from 1; 0: the run has none.
function stageOf(frame) {
  const stages = data.history.values.stage;
  return stages && stages.length > 0 ? Math.round(stages[rowOfFrame(frame)]) : 0;
}

/// The planes of water of a frame: the last one of each name.
function waterLevels(frame) {
  const stage = stageOf(frame);
  const levels = new Map();
  for (const level of data.water || []) if (level.stage <= stage) levels.set(level.name, level);
  return [...levels.values()].filter(({normal}) => normal && normal[2] !== 0);
}

/// Corners of a level over the scene.
function cornersOfLevel({point, normal}) {
  const {min, max} = modelBox;
  const corner = (x, y) => [x, y, point[2] - (normal[0] * (x - point[0]) + normal[1] * (y - point[1])) / normal[2]];
  return [corner(min.x, min.y), corner(max.x, min.y), corner(max.x, max.y), corner(min.x, max.y)];
}

function placeWater(frame) {
  const levels = current.water ? waterLevels(frame) : [];
  const places = [], shore = [];
  for (const level of levels) {
    const corners = cornersOfLevel(level);
    for (const k of [0, 1, 2, 0, 2, 3]) places.push(...corners[k]);
    corners.forEach((from, k) => shore.push(...from, ...corners[(k + 1) % 4]));
  }
  actions.water.visible = places.length > 0;
  actions.water.geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  setWideLines(actions.shore, shore);
}

// ---- all --------------------------------------------------------------------------------------------------

function placeActions(frame) {
  const enlarge = enlargement(frame);
  placeLoads(frame, enlarge);
  placeSupports(frame, enlarge);
  placeBolts(frame);
  placeWater(frame);
}

/// Points that a view of the whole scene shows besides the model: tails of loads and corners of water, in the first and
/// the last frame.
function outlineOfActions() {
  const frames = [data.frames[0], data.frames[data.frames.length - 1]];
  const tails = frames.flatMap((frame) => frame.loads).map(({force, place}) =>
    place.clone().addScaledVector(force, -sceneRadius / 3.5 / (largestLoad() || 1)));
  const levels = frames.flatMap(waterLevels).flatMap(cornersOfLevel).map((corner) => new THREE.Vector3(...corner));
  return [...tails, ...levels];
}

/// Entries of the legend.
function actionKinds(frame) {
  const kinds = [];
  if (actions.arrows[0].count > 0) {
    const bar = roundBar(lengthOfLargestLoad() / largestLoad() / lengthOfPixel(), 100);
    if (bar) kinds.push({name: "load " + quantity(bar.force, "N"), colour: LOAD_COLOUR, bar: bar.pixels});
  }
  kinds.push(...supportKinds());
  if (actions.bolts.visible) {
    kinds.push({name: "axial force of bolts", scale: {field: boltField(), range: boltRange()}});
    if (frame.bolts.some(({state}) => state === BOLT_RUPTURED)) kinds.push({name: "ruptured bolts", colour: RUPTURED_COLOUR});
  }
  if (actions.water.visible) kinds.push({name: "water level", colour: WATER_COLOUR});
  return kinds;
}

/// The size of each load at the tail of its arrow.
function drawLoadLabels(context) {
  context.font = "bold 12px system-ui, sans-serif";
  context.textAlign = "center";
  for (const {from, size} of actions.labels) {
    const at = from.clone().project(camera);
    if (Math.abs(at.x) > 1 || Math.abs(at.y) > 1) continue;
    drawText(context, quantity(size, "N"), (at.x + 1) / 2 * frameSize.width, (1 - at.y) / 2 * frameSize.height - 6);
  }
  context.textAlign = "left";
}

/// Parts of the run that the controls can show.
const hasActions = (key) => (key === "water" ? (data.water || []).some(({normal}) => normal) : data.frames.some((frame) => frame.head[key] > 0));
