// Camera: fits the scene into the picture, named views, light and dark.

const THEMES = {
  light: {background: "#ffffff", text: "#1f2328", edge: "#222222", faintEdge: "#8a8a8a", vector: "#5b2a86"},
  dark: {background: "#14171c", text: "#e8eaed", edge: "#05070a", faintEdge: "#7d8590", vector: "#d0b3ff"},
};

const prefersDark = () => window.matchMedia("(prefers-color-scheme: dark)").matches;
const themeName = () => (current.theme === "auto" ? (prefersDark() ? "dark" : "light") : current.theme);
const theme = () => THEMES[themeName()];

/// Directions to the eye. From above, y is up in the picture.
const VIEWS = {
  start: [0.55, -1, 0.45], front: [0, -1, 0], back: [0, 1, 0], left: [-1, 0, 0], right: [1, 0, 0],
  top: [0, -1e-4, 1], iso: [1, -1, 0.82],
};

/// Views in which parallel lines stay parallel, so that lengths can be measured; the others are perspectives.
const PARALLEL_VIEWS = ["front", "back", "left", "right", "top"];

/// Points around the visible scene: those of fixed blocks, and the corners of a box around the path of each other
/// block that does not fly off by more than half the scene's own size.
function outlineOfScene() {
  const boxes = data.blocks.map(() => new THREE.Box3());
  const place = new THREE.Vector3();
  const expandBy = (frame) => {
    for (let p = 0; p < data.points; ++p) {
      if (data.blockOfPoint[p] < 0 || Number.isNaN(frame.displacement[3 * p])) continue;
      boxes[data.blockOfPoint[p]].expandByPoint(placeOf(frame, p, 1, place));
    }
  };
  expandBy(data.frames[0]);
  const box = boxes.reduce((all, part) => all.union(part), new THREE.Box3());
  const most = box.clone().expandByScalar(0.5 * box.getSize(place).length());
  data.frames.forEach(expandBy);
  const outline = [];
  for (let p = 0; p < data.points; ++p) {
    if (data.blockOfPoint[p] < 0 || !data.blocks[data.blockOfPoint[p]].fixed) continue;
    const point = placeOf(data.frames[0], p, 1, new THREE.Vector3());
    if (!Number.isNaN(point.x)) outline.push(point);
  }
  const ways = boxes.filter((part, block) => !part.isEmpty() && !data.blocks[block].fixed && most.containsBox(part));
  outline.push(...ways.flatMap(cornersOf));
  return outline.length > 0 ? outline : cornersOf(box);
}

function cornersOf(box) {
  return [0, 1, 2, 3, 4, 5, 6, 7].map((k) => new THREE.Vector3(k & 1 ? box.max.x : box.min.x,
    k & 2 ? box.max.y : box.min.y, k & 4 ? box.max.z : box.min.z));
}

const FIT_MARGIN = 0.94;

/// Pixels across and upwards that legend, heading and player leave free.
function freePixels() {
  const {width, height, left, top, bottom} = frameSize;
  return [Math.max(width - left - 12, 40), Math.max(height - top - bottom, 40)];
}

/// The same for a parallel view. @return half of the height of the picture, m, in place of the distance
function fittedParallel(right, up) {
  const [horizontal, vertical] = freePixels();
  const extent = (axis) => outline.reduce(([low, high], point) => {
    const at = point.dot(axis);
    return [Math.min(low, at), Math.max(high, at)];
  }, [Infinity, -Infinity]);
  const [across, upward] = [extent(right), extent(up)];
  const target = sceneBox.getCenter(new THREE.Vector3());
  const shift = ([low, high], axis) => target.addScaledVector(axis, 0.5 * (low + high) - target.dot(axis));
  shift(across, right);
  shift(upward, up);
  const metresOfPixel = Math.max((across[1] - across[0]) / horizontal, (upward[1] - upward[0]) / vertical) / FIT_MARGIN;
  return {target, half: 0.5 * metresOfPixel * frameSize.height};
}

/// Target and distance at which the scene fills the area left free by legend, heading and player.
/// @param toEye unit vector; right, up those of the picture
function fitted(toEye, right, up) {
  const {height} = frameSize;
  const tangent = FIT_MARGIN * Math.tan(0.5 * THREE.Math.degToRad(camera.fov));
  const [horizontal, vertical] = freePixels().map((pixels) => tangent * pixels / height);
  const target = sceneBox.getCenter(new THREE.Vector3());
  let distance = 0;
  // Near parts appear larger: the centre of the box is not the centre in the picture. Each iteration corrects the
  // target.
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

/// View of the whole scene from the present direction: {target, distance}, for a parallel view {target, half}.
function wholeView(toEye) {
  const [right, up] = [0, 1].map((k) => new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, k));
  return camera.isOrthographicCamera ? fittedParallel(right, up) : fitted(toEye, right, up);
}

/// Selects the kind of camera requested by `current`.
function chooseCamera() {
  const wanted = current.parallel ? cameras.parallel : cameras.perspective;
  wanted.add(cameras.lamp);
  if (wanted === camera) return;
  camera = wanted;
  controls.object = camera;
  setFrame(frameSize);
}

/// Radii of the scene to the eye of a parallel view, where the distance has no influence on sizes.
const PARALLEL_DISTANCE = 20;

/// Looks at the centre of the scene, or at `current.at`, magnified by `current.zoom`.
function lookFrom(direction) {
  const toEye = direction.clone().normalize();
  chooseCamera();
  camera.position.copy(toEye);
  camera.lookAt(0, 0, 0);
  camera.updateMatrixWorld();
  const view = wholeView(toEye);
  const distance = view.half ? PARALLEL_DISTANCE * sceneRadius : view.distance / current.zoom;
  camera.near = 0.01 * Math.min(sceneRadius, distance);
  camera.far = distance + 100 * sceneRadius;
  if (view.half) Object.assign(camera, {half: view.half, zoom: current.zoom});
  if (view.half) setFrame(frameSize);
  controls.target.copy(current.at || view.target);
  camera.position.copy(controls.target).addScaledVector(toEye, distance);
  camera.updateProjectionMatrix();
  controls.update();
}

/// Stores the user's rotation, translation and zoom in `current`.
function noteView() {
  const toEye = camera.position.clone().sub(controls.target);
  const distance = toEye.length();
  current.from = toEye.divideScalar(distance);
  current.at = controls.target.clone();
  camera.updateMatrixWorld();
  const whole = wholeView(current.from);
  current.zoom = whole.half ? whole.half * camera.zoom / camera.half : whole.distance / distance;
}

/// The scene is drawn in the centre of the free area.
/// @param size width and height of the canvas, and its margins: left, top, bottom; pixels
function setFrame(size) {
  Object.assign(frameSize, size);
  const {width, height, left, top, bottom} = frameSize;
  if (camera.isOrthographicCamera) {
    const [across, upward] = [camera.half * width / height, camera.half];
    Object.assign(camera, {left: -across, right: across, bottom: -upward, top: upward});
  } else camera.aspect = width / height;
  camera.setViewOffset(width, height, -0.5 * left, 0.5 * (bottom - top), width, height);
}

/// Margins for legend, heading and player: in a narrow picture the legend lies above the scene. Axes and scale bar are
/// below the legend, in a narrow picture below the scene, which the model leaves free unless the picture is low.
function framing(width, height, {heading, player}) {
  const flat = width < 560;
  const flatHeight = Math.min(88, 0.25 * height);
  const column = Math.min(190, 0.3 * width);
  const marks = {x: flat ? width - 190 : 8, y: height - player - 76, width: 182, height: 76};
  const legendHeight = flat ? flatHeight : height - heading - player - 76;
  const area = {x: 16, y: heading, width: flat ? width - 32 : column, height: legendHeight, flat};
  const band = flat && height > 400 ? 76 : 28;
  return {width, height, legend: area, marks, left: flat ? 0 : Math.min(190, 0.25 * width), top: heading + (flat ? flatHeight : 0),
    bottom: player + (flat ? band : 12)};
}

function buildCameras() {
  const lamp = new THREE.DirectionalLight("#ffffff", 0.4);
  lamp.position.set(-0.4, 0.6, 1);
  const cameras = {perspective: new THREE.PerspectiveCamera(35, 1, 0.1, 1000), parallel: new THREE.OrthographicCamera(), lamp};
  cameras.parallel.half = 1;
  for (const kind of ["perspective", "parallel"]) cameras[kind].up.set(0, 0, 1);
  return cameras;
}

function buildStage() {
  const stage = new THREE.Scene();
  stage.background = new THREE.Color(theme().background);
  stage.add(new THREE.HemisphereLight("#ffffff", "#b0b0b8", 0.85));
  stage.add(cameras.perspective, cameras.parallel, meshes.mesh, meshes.edges, meshes.innerEdges, meshes.selection, joints.faces, joints.rims,
    section.caps, section.outlines, ...forces.arrows, ...forces.bars, ...forces.ties, forces.thrust, forces.points,
    ...vectors.arrows, ...vectors.pressed, ...vectors.pulled,
    ...partsOfActions());
  return stage;
}

/// Lines of some pixels' width need to know the picture's size.
function setLineResolution(width, height) {
  for (const lines of [joints.rims, forces.thrust, ...linesOfActions()]) lines.material.resolution.set(width, height);
}

function resize() {
  const {clientWidth: width, clientHeight: height} = element("stage");
  sharpness.full = window.devicePixelRatio;
  if (renderer) {
    renderer.setPixelRatio(sharpness.full);
    renderer.setSize(width, height, false);
  }
  const marks = element("marks");
  Object.assign(marks, {width: width * sharpness.full, height: height * sharpness.full});
  setLineResolution(width, height);
  const heading = element("heading").offsetHeight + 22;
  setFrame(framing(width, height, {heading, player: 64}));
  render();
}

function render() {
  if (!sharpness.isStarted) return;
  if (renderer) renderer.render(stage, camera);
  const marks = element("marks");
  const context = marks.getContext("2d");
  context.setTransform(sharpness.full, 0, 0, sharpness.full, 0, 0);
  context.clearRect(0, 0, frameSize.width, frameSize.height);
  drawMarks(context);
}

// ---- turning ----------------------------------------------------------------------------------------------

/// If a picture takes longer than a thirtieth of a second, as without a graphics card, fewer pixels and no edges are
/// drawn during rotation, and all of them when it ends.
const SLOW = 1000 / 30;

function renderTurning() {
  if (!renderer || !sharpness.isTurning) return render();
  const start = performance.now();
  render();
  // Reading a pixel waits for the end of drawing.
  const context = renderer.getContext();
  context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, new Uint8Array(4));
  const took = performance.now() - start;
  sharpness.lastMilliseconds = took;
  const wanted = Math.min(1, Math.max(0.25, sharpness.turning * Math.sqrt(SLOW / Math.max(took, 1))));
  if (took > SLOW || (took < 0.5 * SLOW && sharpness.turning < 1)) setTurningSharpness(wanted);
  return undefined;
}

function setTurningSharpness(share) {
  sharpness.turning = share;
  renderer.setPixelRatio(sharpness.full * share);
  meshes.edges.visible = current.edges && share > 0.5;
}

function beginTurning() {
  sharpness.isTurning = true;
}

function endTurning() {
  sharpness.isTurning = false;
  if (sharpness.turning < 1) {
    setTurningSharpness(1);
    render();
  }
  noteView();
  noteAddress();
}
