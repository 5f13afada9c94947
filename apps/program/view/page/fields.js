// Colours of blocks and joints: values, their ranges, colours.

// Both begin and end with colours different from those of unlit blocks and supports.
const SEQUENTIAL = ["#bfe6a8", "#7fcdbb", "#41b6c4", "#1d91c0", "#225ea8", "#2b2f8f", "#3a1a6e"];
const DIVERGING = ["#3b4cc0", "#7b9ff9", "#c0d4f5", "#f6f2e4", "#f5c4ac", "#ee8468", "#b40426"];
const STATE_COLOURS = ["#8a8f98", "#1a9641", "#e8590c", "#b5179e"];
const TYPE_COLOURS = ["#1b6fd0", "#d62976", "#e8890c"];
const FIXED_COLOUR = "#a4abb5";
const STONE_COLOUR = "#d9cfbd";

// ---- values -----------------------------------------------------------------------------------------------

const lengthAt = (values, p) => Math.hypot(values[3 * p], values[3 * p + 1], values[3 * p + 2]);

function vonMises(s, p) {
  const i = 6 * p;
  const normal = (s[i] - s[i + 1]) ** 2 + (s[i + 1] - s[i + 2]) ** 2 + (s[i + 2] - s[i]) ** 2;
  return Math.sqrt(0.5 * normal + 3 * (s[i + 3] ** 2 + s[i + 4] ** 2 + s[i + 5] ** 2));
}

const pressure = (s, p) => -(s[6 * p] + s[6 * p + 1] + s[6 * p + 2]) / 3;

/// Principal stresses from the largest (tension positive) to the least: roots of the characteristic polynomial by
/// cosines of a third of an angle (Smith 1961).
function principal(s, p) {
  const [xx, yy, zz, xy, yz, xz] = [s[6 * p], s[6 * p + 1], s[6 * p + 2], s[6 * p + 3], s[6 * p + 4], s[6 * p + 5]];
  const mean = (xx + yy + zz) / 3;
  const [a, b, c] = [xx - mean, yy - mean, zz - mean];
  const q = Math.sqrt((a * a + b * b + c * c + 2 * (xy * xy + yz * yz + xz * xz)) / 6);
  if (!(q > 0)) return [mean, mean, mean];
  const determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
  const angle = Math.acos(Math.min(Math.max(determinant / (2 * q ** 3), -1), 1)) / 3;
  const [first, last] = [mean + 2 * q * Math.cos(angle), mean + 2 * q * Math.cos(angle + 2 * Math.PI / 3)];
  return [first, 3 * mean - first - last, last];
}

/// key: {label, unit, at(frame, point)} for numbers, {label, category(block)} for kinds.
function fieldsOf(data) {
  const fields = {};
  const add = (key, label, unit, at, signed = false) => { fields[key] = {label, unit, at, signed}; };
  add("displacement", "displacement", "m", (f, p) => lengthAt(shownDisplacement(f), p));
  ["x", "y", "z"].forEach((axis, k) =>
    add("displacement_" + axis, "displacement " + axis, "m", (f, p) => shownDisplacement(f)[3 * p + k], true));
  for (const field of Object.values(fields)) field.isDisplacement = true;
  if (data.velocity) add("velocity", "velocity", "m/s", (f, p) => lengthAt(f.velocity, p));
  if (data.stress) {
    add("von_mises", "von Mises stress", "Pa", (f, p) => vonMises(f.stress, p));
    add("pressure", "pressure", "Pa", (f, p) => pressure(f.stress, p), true);
    add("sigma_1", "σ₁, largest principal stress", "Pa", (f, p) => principal(f.stress, p)[0], true);
    add("sigma_3", "σ₃, least principal stress", "Pa", (f, p) => principal(f.stress, p)[2], true);
    STRESS_NAMES.forEach((name, k) => add("stress_" + name, "stress " + name, "Pa", (f, p) => f.stress[6 * p + k], true));
  }
  fields.block = {label: "block", category: (block) => block, name: (block) => data.blocks[block].name};
  // Kind 0 is that of fixed blocks, 1 that of rigid ones.
  fields.order = {label: "order", category: (block) => (data.blocks[block].fixed ? 0 : data.blocks[block].order + 1),
    name: (kind) => (kind === 0 ? "fixed" : kind === 1 ? "order 0 (rigid)" : "order " + (kind - 1))};
  fields.stone = {label: "stone", category: (block) => (data.blocks[block].fixed ? 1 : 0), plain: true};
  return fields;
}

/// Colours of the faces of joints: values by face.
const JOINT_FIELDS = {
  opening: {label: "opening", unit: "m", of: (joints) => joints.opening, fromZero: true},
  slip: {label: "slip", unit: "m", of: (joints) => joints.slip},
  normal: {label: "normal stress, compression +", unit: "Pa", of: (joints) => joints.normal},
  shear: {label: "shear stress", unit: "Pa", of: (joints) => joints.shear},
  water: {label: "water pressure", unit: "Pa", of: (joints) => joints.water, fromZero: true},
  fracture: {label: "fracture energy dissipated", unit: "J/m²", of: (joints) => joints.fracture, fromZero: true},
  state: {label: "state of joints", kinds: [...STATES, "broken"],
    of: (joints) => joints.state.map((state, k) => (joints.broken[k] ? 3 : state))},
};

/// Keys of those that the run has.
const jointFieldKeys = () => Object.keys(JOINT_FIELDS).filter(
  (key) => (key !== "water" || data.water_pressure) && (key !== "fracture" || data.fracture_energy));

/// Blocks are transparent, in one colour, where coloured joints are shown.
const blockField = () => fields[current.joints === "none" ? current.field : "stone"];
const mainField = () => JOINT_FIELDS[current.joints] || fields[current.field];

const isWhole = (field) => field.category !== undefined;

// ---- ranges -----------------------------------------------------------------------------------------------

/// Lengths below this share of the scene are rounding errors.
const LENGTH_NOISE = 1e-12;
const withoutNoise = (value, unit) => (unit === "m" && Math.abs(value) < LENGTH_NOISE * sceneRadius ? 0 : value);

/// Range of some values: symmetric about zero for signed ones, from zero for those that count from zero (an opening
/// below zero is the depth of a closed joint); never empty.
function roundedOff(field, low, high) {
  if (!(low <= high)) return [0, 1];
  [low, high] = [withoutNoise(low, field.unit), withoutNoise(high, field.unit)];
  if (field.fromZero) [low, high] = [0, Math.max(0, high)];
  if (field.signed) [low, high] = [-Math.max(-low, high), Math.max(-low, high)];
  return low < high ? [low, high] : [low, low + (Math.abs(low) || (field.unit === "m" ? 1e-3 : 1))];
}

/// The values of a field in a frame, without those of supports.
function valuesOf(field, frame) {
  if (field.of) return field.of(frame.joints);
  const values = new Float32Array(data.points);
  let count = 0;
  for (let p = 0; p < data.points; ++p) {
    const block = data.blockOfPoint[p];
    if (block >= 0 && !data.blocks[block].fixed) values[count++] = field.at(frame, p);
  }
  return values.subarray(0, count);
}

function rangeOver(field, frames) {
  let [low, high] = [Infinity, -Infinity];
  for (const frame of frames) {
    for (const value of valuesOf(field, frame)) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return roundedOff(field, low, high);
}

const PERCENTILES = [2, 98];

function percentileRange(field, frame) {
  const sorted = Float32Array.from(valuesOf(field, frame)).filter(Number.isFinite).sort();
  const [low, high] = PERCENTILES.map((share) => sorted[Math.round(share / 100 * (sorted.length - 1))]);
  return roundedOff(field, low, high);
}

/// The range of the colours, as chosen by the user.
function rangeOf(field, frame) {
  if (field.kinds || isWhole(field)) return null;
  const run = () => {
    if (!field.range || field.rangeRelative !== current.relative)
      Object.assign(field, {range: rangeOver(field, data.frames), rangeRelative: current.relative});
    return field.range;
  };
  if (current.range === "frame") return rangeOver(field, [frame]);
  if (current.range === "percentile") return percentileRange(field, frame);
  if (current.range !== "own" || field !== mainField()) return run();
  const [low, high] = [current.low === null ? run()[0] : current.low, current.high === null ? run()[1] : current.high];
  return low < high ? [low, high] : [low, low + (Math.abs(low) || 1)];
}

const RANGE_NAMES = {run: "of the run", frame: "of this frame", percentile: PERCENTILES.join(" to ") + " % of this frame",
  own: "own"};

// ---- colours ----------------------------------------------------------------------------------------------

function categoryColour(field, k) {
  if (field.plain) return new THREE.Color(k === 1 ? FIXED_COLOUR : STONE_COLOUR);
  return new THREE.Color().setHSL((0.58 + 0.381966 * k) % 1, 0.5, 0.6);
}

function scaleColour(stops, share) {
  const at = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const k = Math.min(Math.floor(at), stops.length - 2);
  return new THREE.Color(stops[k]).lerp(new THREE.Color(stops[k + 1]), at - k);
}

const stopsOf = (field) => (field.signed ? DIVERGING : SEQUENTIAL);

/// Place of a value in the texture's row, 0 to 1.
function shareOf(value, range) {
  const share = (value - range[0]) / (range[1] - range[0]);
  return (0.5 + 255 * Math.min(Math.max(share, 0), 1)) / 256;
}

/// 256 colours in the lower row, that of fixed blocks in the upper one.
function colourTexture(colourOf) {
  const texels = new Uint8Array(2 * 256 * 4).fill(255);
  const fixed = new THREE.Color(FIXED_COLOUR);
  for (let k = 0; k < 256; ++k) {
    const colour = colourOf(k);
    texels.set([255 * colour.r, 255 * colour.g, 255 * colour.b], 4 * k);
    texels.set([255 * fixed.r, 255 * fixed.g, 255 * fixed.b], 4 * (256 + k));
  }
  const texture = new THREE.DataTexture(texels, 256, 2, THREE.RGBAFormat);
  texture.magFilter = THREE.NearestFilter;
  texture.minFilter = THREE.NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

function textureOf(field) {
  if (!field.texture) {
    const colour = isWhole(field) ? (k) => categoryColour(field, k) : (k) => scaleColour(stopsOf(field), k / 255);
    field.texture = colourTexture(colour);
  }
  return field.texture;
}

/// Place in the texture of a point of a block.
function textureAt(field, frame, point, block, range) {
  if (isWhole(field)) return [(field.category(block) % 256 + 0.5) / 256, 0.25];
  const value = field.at(frame, point);
  return [Number.isFinite(value) ? shareOf(value, range) : 0, data.blocks[block].fixed ? 0.75 : 0.25];
}

function jointColour(field, value, range) {
  if (field.kinds) return new THREE.Color(STATE_COLOURS[value]);
  return scaleColour(stopsOf(field), (value - range[0]) / (range[1] - range[0]));
}
