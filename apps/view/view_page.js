// The page of `ashlar view`, last part. `current` is all that the user can change; show() brings the picture in line
// with it. The part of the address behind # chooses what is shown first, e.g. #frame=12&color=velocity&from=1,-2,0.5
// (see readAddress), and for `ashlar picture` picture&size=800x600.

// ---- controls ---------------------------------------------------------------------------------------------

const currentFrame = () => data.frames[current.frame];

function clockText(frame) {
  const scale = current.scale === 1 ? "" : ", displacements × " + short(current.scale);
  return "t = " + short(frame.time) + " s, step " + frame.step + scale;
}

function show() {
  const frame = currentFrame();
  const field = fields[current.field];
  const range = isWhole(field) ? null : current.ownRange ? rangeOf(field, [frame]) : rangeOfAll(field);
  moveSurface(frame, current.scale);
  colourSurface(field, frame, range);
  placeContacts(frame);
  meshes.edges.visible = current.edges;
  meshes.innerEdges.visible = current.subFaces;
  Object.assign(meshes.mesh.material, {transparent: current.seeThrough, opacity: current.seeThrough ? 0.35 : 1,
    depthWrite: !current.seeThrough});
  drawLegend(element("legend"), field, range);
  showContactLegend(frame);
  element("clock").textContent = clockText(frame);
  render();
}

function showFrame(index) {
  if (index !== current.frame && current.picked.contact) current.picked = {};
  current.frame = index;
  element("slider").value = index;
  show();
  showPicked();
  for (const plot of plots) plot.draw();
}

function fillSelect(select, entries, chosen) {
  select.replaceChildren(...entries.map(([value, label]) => new Option(label, value, false, value === chosen)));
}

function play() {
  if (current.timer) {
    clearInterval(current.timer);
    current.timer = null;
  } else {
    const pause = Math.min(Math.max(8000 / data.frames.length, 33), 500);
    current.timer = setInterval(() => showFrame((current.frame + 1) % data.frames.length), pause);
  }
  element("play").textContent = current.timer ? "⏸" : "▶";
}

/// Ties a control to a member of `current`. @param read value of the control
function tie(id, member, read) {
  element(id).addEventListener("change", (event) => {
    current[member] = read(event.target);
    show();
    showPicked();
  });
}

function tieControls() {
  const checked = (box) => box.checked;
  const positive = (input) => Math.max(0, Number(input.value) || 0);
  fillSelect(element("field"), Object.entries(fields).map(([key, field]) => [key, field.label]), current.field);
  tie("field", "field", (select) => select.value);
  element("own-range").checked = current.ownRange;
  element("scale").value = current.scale;
  element("contact-colour").value = current.contactColour;
  element("forces").checked = current.forces;
  tie("own-range", "ownRange", checked);
  tie("scale", "scale", positive);
  tie("edges", "edges", checked);
  tie("sub-faces", "subFaces", checked);
  tie("see-through", "seeThrough", checked);
  tie("contact-colour", "contactColour", (select) => select.value);
  tie("open-contacts", "openContacts", checked);
  tie("forces", "forces", checked);
  tie("force-scale", "forceScale", positive);
  element("slider").max = data.frames.length - 1;
  element("slider").addEventListener("input", (event) => showFrame(Number(event.target.value)));
  element("play").addEventListener("click", play);
  element("home").addEventListener("click", () => {
    Object.assign(current, {at: null, zoom: 1});
    lookFrom(current.from);
    render();
  });
  document.addEventListener("keydown", (event) => {
    if (event.code !== "Space" || event.target.matches("input, select, button")) return;
    event.preventDefault();
    play();
  });
  window.addEventListener("resize", resize);
  controls.addEventListener("change", render);
  pickOnClick(element("canvas"));
}

// ---- start and pictures -----------------------------------------------------------------------------------

function vectorOf(text) {
  const numbers = (text || "").split(",").map(Number);
  return numbers.length === 3 && numbers.every(Number.isFinite) ? new THREE.Vector3(...numbers) : null;
}

/// What the part of the address behind # asks for: frame, color (a field), range=frame (colours over the values of the
/// frame alone), from (direction to the eye), at (point looked at), zoom, scale (of displacements), contacts (state,
/// type or none) and arrows=none.
function readAddress() {
  const wishes = new URLSearchParams(location.hash.slice(1));
  const frame = data.frames.findIndex((candidate) => String(candidate.index) === wishes.get("frame"));
  if (frame >= 0) current.frame = frame;
  if (wishes.get("color") in fields) current.field = wishes.get("color");
  current.ownRange = wishes.get("range") === "frame";
  const from = vectorOf(wishes.get("from"));
  if (from && from.lengthSq() > 0) current.from = from;
  current.at = vectorOf(wishes.get("at"));
  if (Number(wishes.get("zoom")) > 0) current.zoom = Number(wishes.get("zoom"));
  const shown = wishes.get("contacts");
  if (["state", "type", "none"].includes(shown)) current.contactColour = shown;
  current.forces = wishes.get("arrows") !== "none" && !crowded();
  if (Number(wishes.get("scale")) > 0) current.scale = Number(wishes.get("scale"));
  return wishes;
}

/// Leaves nothing in the page but a text for the program that reads it: pictures, or why there are none.
function leaveText(id, content) {
  const text = document.createElement("pre");
  text.id = id;
  text.textContent = content;
  document.documentElement.replaceChildren(text);
}

function makePicture(wishes) {
  if (!renderer) return leaveText("fault", "the browser has no WebGL");
  if (wishes.get("color") && !(wishes.get("color") in fields))
    return leaveText("fault", "the run has no " + wishes.get("color") + " (output.fields)");
  const [width, height] = wishes.get("size").split("x").map(Number);
  const legend = element("legend");
  legend.height = Math.min(legend.height, Math.max(height - 50, 1));
  renderer.setPixelRatio(1);
  renderer.setSize(width, height, false);
  setFrame({width, height, side: Math.min(130, 0.25 * width), ends: Math.min(60, 0.15 * height)});
  lookFrom(current.from);
  const [first, last] = (wishes.get("frames") || "").split(":").map(Number);
  if (!wishes.has("frames")) return leaveText("picture", drawnPicture(width, height, legend));
  const pictures = [];
  data.frames.forEach((frame, k) => {
    if (frame.index < first || frame.index > last) return;
    current.frame = k;
    pictures.push(frame.index + " " + drawnPicture(width, height, legend));
  });
  leaveText("pictures", pictures.join("\n"));
}

/// @return what is shown now as a PNG in base64
function drawnPicture(width, height, legend) {
  show();
  const picture = document.createElement("canvas");
  Object.assign(picture, {width, height});
  const context = picture.getContext("2d");
  context.drawImage(element("canvas"), 0, 0);
  context.fillStyle = "#ffffffb0";
  context.fillRect(4, height - legend.height - 16, 130, legend.height + 8);
  context.drawImage(legend, 12, height - legend.height - 12);
  context.font = "14px system-ui, sans-serif";
  context.fillStyle = "#222";
  context.fillText(clockText(currentFrame()), 12, 22);
  drawContactLegend(context, currentFrame(), width - 12, 22);
  return picture.toDataURL("image/png").split(",")[1];
}

function buildRenderer() {
  try {
    return new THREE.WebGLRenderer({canvas: element("canvas"), antialias: true, preserveDrawingBuffer: true});
  } catch (error) {
    element("message").hidden = false;
    element("message").textContent = "This browser shows no WebGL, which the blocks need; plots and tables work.";
    return null;
  }
}

const data = loadData();
const fields = fieldsOf(data);
const current = {frame: 0, field: "displacement", ownRange: false, scale: 1, subFaces: false, seeThrough: false,
  edges: true, contactColour: "state", openContacts: false, forces: true, forceScale: 1, picked: {}, timer: null,
  from: new THREE.Vector3(0.55, -1, 0.45), at: null, zoom: 1};
const surface = buildSurface(data.cells);
const meshes = buildMeshes(surface);
const contacts = buildContacts();
const camera = new THREE.PerspectiveCamera(35, 1, 0.1, 1000);
camera.up.set(0, 0, 1);
const outline = outlineOfScene();
const sceneBox = new THREE.Box3().setFromPoints(outline);
const sceneRadius = 0.5 * sceneBox.getSize(new THREE.Vector3()).length();
const frameSize = {width: 1, height: 1, side: 0, ends: 0};
const renderer = buildRenderer();
const controls = new THREE.OrbitControls(camera, element("canvas"));
const stage = buildStage();
let plots = [];

function start() {
  const wishes = readAddress();
  if (wishes.has("picture")) return makePicture(wishes);
  const title = (data.summary && data.summary.title) || data.name;
  document.title = title + " - Ashlar";
  element("title").textContent = title;
  tieControls();
  fillTable(element("summary"), summaryRows(data.summary));
  resize();
  lookFrom(current.from);
  plots = buildPlots();
  showFrame(current.frame);
}

start();
