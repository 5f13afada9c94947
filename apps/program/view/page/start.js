// Last part: libraries and data are unpacked, everything is built and shown. Names that all parts share are set here.

let data, fields, surface, meshes, joints, forces, vectors, actions, section, outline, modelBox, sceneBox, sceneRadius;
let camera, cameras, controls, renderer, stage;
const current = {};
const plots = [];
const frameSize = {width: 1, height: 1, left: 0, top: 0, bottom: 0, legend: {x: 0, y: 0, width: 1, height: 1, flat: false},
  marks: {x: 0, y: 0, width: 1, height: 1}};
const sharpness = {full: 1, turning: 1, isTurning: false, isStarted: false, lastMilliseconds: 0};

/// three.js and Chart.js, each as if it stood in the page.
async function runLibraries() {
  const texts = await Promise.all(element("libraries").textContent.trim().split("\n").map(inflated));
  for (const bytes of texts) {
    const script = document.createElement("script");
    script.textContent = new TextDecoder().decode(bytes);
    document.head.append(script);
  }
}

function buildRenderer() {
  try {
    const made = new THREE.WebGLRenderer({canvas: element("canvas"), antialias: true, preserveDrawingBuffer: true});
    made.localClippingEnabled = true;
    return made;
  } catch (error) {
    complain("This browser shows no WebGL, which the blocks need; plots and tables work.");
    return null;
  }
}

function complain(text) {
  element("message").hidden = false;
  element("message").textContent = text;
}

function build() {
  fields = fieldsOf(data);
  cameras = buildCameras();
  camera = cameras.perspective;
  outline = outlineOfScene();
  modelBox = new THREE.Box3().setFromPoints(outline);
  sceneRadius = 0.5 * modelBox.getSize(new THREE.Vector3()).length();
  outline.push(...outlineOfActions());
  sceneBox = new THREE.Box3().setFromPoints(outline);
  surface = buildSurface(data.cells);
  meshes = buildMeshes(surface);
  joints = buildJoints();
  forces = buildForces();
  vectors = buildVectors();
  actions = buildActions();
  section = buildSection();
  renderer = buildRenderer();
  controls = new THREE.OrbitControls(camera, element("canvas"));
}

async function start() {
  await runLibraries();
  await loadData();
  choosePlots();
  choosePlots.usual = {x1: current.x1, x2: current.x2, y1: current.y1, y2: current.y2};
  resetState();
  build();
  stage = buildStage();
  const wishes = readAddress();
  if (wishes.has("picture")) return makePicture(wishes);
  const title = titleOfRun();
  document.title = title + " - Ashlar";
  element("title").textContent = title;
  tieControls();
  tieStage();
  tieBlockList();
  showAxis();
  showKeyBlocks();
  showSummary();
  setTheme();
  element("clock").textContent = clockText(currentFrame());
  resize();
  lookFrom(current.from);
  buildPlots();
  sharpness.isStarted = true;
  showFrame(current.frame);
}

/// The page counts as loading until all is shown: a headless browser, which prints the page once it is loaded,
/// waits for it. A frame within the page that is being written keeps the page loading; a timer would have to guess the time.
async function startWhileLoading() {
  const wait = document.createElement("iframe");
  wait.hidden = true;
  document.body.append(wait);
  wait.contentDocument.open();
  try {
    if (typeof DecompressionStream === "undefined")
      return complain("This browser is too old to unpack the page: Chromium 80, Firefox 113 or Safari 16.4 is needed.");
    await start();
  } catch (error) {
    complain("The page cannot be shown: " + error.message);
    throw error;
  } finally {
    if (wait.contentDocument) wait.contentDocument.close();
  }
}

const started = startWhileLoading();
