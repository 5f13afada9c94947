// State that the user can change, and its text in the address behind #: a view can be sent as a link, and
// `ashlar picture` requests views in this form. apps/docs/reference/page.md lists the keys.

/// Members of `current` that the address contains as words or numbers: key of the address, member, and the values that it may
/// have (a list of words, "number", "positive" or "text").
const YES = ["yes", "no"];
const ADDRESS_KEYS = [
  ["range", "range", ["run", "frame", "percentile", "own"]], ["low", "low", "number"], ["high", "high", "number"],
  ["units", "units", ["engineering", "si"]], ["scale", "scale", "positive"], ["parallel", "parallel", YES], ["edges", "edges", YES],
  ["subfaces", "subFaces", YES], ["glass", "seeThrough", YES],
  ["joints", "joints", ["none", "opening", "slip", "state", "normal", "shear", "water", "fracture"]],
  ["loads", "loads", YES], ["supports", "supports", YES], ["bolts", "bolts", YES], ["water", "water", YES],
  ["contacts", "points", ["state", "type", "none"]], ["open", "openContacts", YES], ["arrows", "arrows", [...YES, "none"]],
  ["chain", "chain", YES], ["thrust", "thrust", YES], ["forcescale", "forceScale", "positive"],
  ["vectors", "vectors", ["none", "displacement", "velocity"]], ["crosses", "crosses", YES],
  ["theme", "theme", ["auto", "light", "dark"]], ["marks", "marks", YES],
  ["x1", "x1", "text"], ["y1", "y1", "text"], ["x2", "x2", "text"], ["y2", "y2", "text"],
];

/// Default state.
function usualState() {
  const few = !isCrowded();
  const fewPoints = mostOf("contacts") <= MOST_USUAL_POINTS;
  return {frame: data.frames.length - 1, field: "displacement", range: "run", low: null, high: null,
    units: "engineering", scale: 1, relative: data.relative_to, parallel: false, edges: true, subFaces: false, seeThrough: false, joints: "none",
    points: fewPoints ? "state" : "none", openContacts: false, arrows: false, chain: few, thrust: false, forceScale: 1,
    loads: true, supports: true, bolts: true, water: true,
    vectors: "none", crosses: false, section: "none", sectionAt: 0, hidden: new Set(), theme: "auto", marks: true,
    from: null, at: null, zoom: 1, picked: {}, timer: null};
}

function vectorOf(text) {
  const numbers = (text || "").split(",").map(Number);
  return numbers.length === 3 && numbers.every(Number.isFinite) ? new THREE.Vector3(...numbers) : null;
}

function readKey(text, kind) {
  if (text === null) return undefined;
  if (kind === "text") return text;
  if (Array.isArray(kind)) return kind.includes(text) ? text : undefined;
  const number = Number(text);
  return text !== "" && Number.isFinite(number) && (kind === "number" || number > 0) ? number : undefined;
}

function readSection(text) {
  const [, side, at] = /^(-?[xyz]),([-+.\de]+)$/.exec(text || "") || [];
  if (side && Number.isFinite(Number(at))) Object.assign(current, {section: side, sectionAt: Number(at)});
}

/// Number of a block given by number or name in the address; -1: there is none.
function blockCalled(text) {
  const named = data.blocks.findIndex((block) => block.name === text);
  return named < 0 && /^\d+$/.test(text) && Number(text) in data.blocks ? Number(text) : named;
}

function readHidden(wishes) {
  const numbers = (key) => wishes.get(key).split(",").map(blockCalled).filter((k) => k >= 0);
  if (wishes.has("hide")) current.hidden = new Set(numbers("hide"));
  if (!wishes.has("only")) return;
  const only = new Set(numbers("only"));
  current.hidden = new Set(data.blocks.map((_, k) => k).filter((k) => !only.has(k)));
}

/// Reference of displacements: a block by name or number, or "none".
function readRelative(text) {
  if (text === null) return;
  const block = blockCalled(text);
  if (block >= 0 || text === "none") current.relative = block >= 0 ? block : null;
}

/// Updates `current` from the address. @return its keys
function readAddress() {
  const wishes = new URLSearchParams(location.hash.slice(1));
  const frame = data.frames.findIndex((candidate) => String(candidate.index) === wishes.get("frame"));
  if (frame >= 0) current.frame = frame;
  if (wishes.get("color") in fields) current.field = wishes.get("color");
  for (const [key, member, kind] of ADDRESS_KEYS) {
    const value = readKey(wishes.get(key), kind);
    if (value !== undefined) current[member] = kind === YES || key === "arrows" ? value === "yes" : value;
  }
  // No points, or points without forces, imply no bars unless these are requested.
  if (!wishes.has("chain") && (wishes.get("arrows") === "none" || wishes.get("contacts") === "none")) current.chain = false;
  const from = wishes.get("from") in VIEWS ? new THREE.Vector3(...VIEWS[wishes.get("from")]) : vectorOf(wishes.get("from"));
  if (from && from.lengthSq() > 0) current.from = from;
  if (!wishes.has("parallel")) current.parallel = PARALLEL_VIEWS.includes(wishes.get("from"));
  readRelative(wishes.get("relative"));
  current.at = vectorOf(wishes.get("at")) || current.at;
  if (Number(wishes.get("zoom")) > 0) current.zoom = Number(wishes.get("zoom"));
  readSection(wishes.get("section"));
  readHidden(wishes);
  return wishes;
}

const rounded = (vector) => vector.toArray().map((x) => Number(x.toPrecision(5))).join(",");

/// The address of the present state: its differences from the default.
function addressOf() {
  const usual = {...usualState(), ...choosePlots.usual};
  const address = new URLSearchParams();
  if (current.frame !== usual.frame) address.set("frame", currentFrame().index);
  if (current.field !== usual.field) address.set("color", current.field);
  for (const [key, member, kind] of ADDRESS_KEYS) {
    const value = current[member];
    if (value !== usual[member] && value !== null)
      address.set(key, kind === YES || key === "arrows" ? (value ? "yes" : "no") : value);
  }
  if (current.relative !== usual.relative) address.set("relative", current.relative === null ? "none" : current.relative);
  if (current.points === "none" && current.chain) address.set("chain", "yes");
  if (current.section !== "none") address.set("section", current.section + "," + Number(current.sectionAt.toPrecision(6)));
  const hidden = [...current.hidden];
  const shown = data.blocks.map((_, k) => k).filter((k) => !current.hidden.has(k));
  if (hidden.length > shown.length) address.set("only", shown.join());
  else if (hidden.length > 0) address.set("hide", hidden.join());
  if (current.at) {
    address.set("from", rounded(current.from));
    address.set("at", rounded(current.at));
    address.set("zoom", Number(current.zoom.toPrecision(4)));
  } else if (current.view !== "start") address.set("from", current.view);
  return address.toString().replaceAll("%2C", ",");
}

/// Writes the address with a delay: not for each pixel of a slider's motion.
function noteAddress() {
  clearTimeout(noteAddress.timer);
  // A page within a notebook has no address of its own.
  if (location.protocol === "about:") return;
  noteAddress.timer = setTimeout(() => {
    noteAddress.written = addressOf();
    history.replaceState(null, "", noteAddress.written ? "#" + noteAddress.written : location.pathname + location.search);
  }, 250);
}

/// A link entered into the address of the open page.
function followAddress() {
  if (location.hash.slice(1) === noteAddress.written) return;
  resetState();
  readAddress();
  setTheme();
  syncControls();
  lookFrom(current.from);
  showFrame(current.frame);
  for (const number of [1, 2]) showPlot(number);
}

function resetState() {
  Object.assign(current, usualState(), choosePlots.usual, {view: "start", from: new THREE.Vector3(...VIEWS.start)});
}
