// The summary: first the answer (answer.js), then the main results, then counts.

const words = (key) => key.replaceAll("_", " ");
const valueText = (value) => (typeof value === "number" ? short(value) : String(value));

/// A coordinate rounded to a hundred-thousandth of the scene, so that rounding errors are 0.
const roundedPlace = (x) => Math.round(x / (1e-5 * sceneRadius)) * 1e-5 * sceneRadius;

/// A coordinate of the user. Far from the user's origin it has the digits that tell points of the scene apart.
const coordinateText = (x) => data.origin.every((y) => y === 0) ? short(roundedPlace(x))
  : String(Number(roundedPlace(x).toPrecision(12)));

/// A point of the page in the user's coordinates.
const pointText = (v) => data.origin.every((y) => y === 0) ? vectorText(v)
  : [v.x, v.y, v.z].map((x, k) => coordinateText(x + data.origin[k])).join(", ");

const placedText = ({value, block, place}, unit) => withoutNoise(value, unit) === 0 ? "none" :
  quantity(withoutNoise(value, unit), unit) + " in " + block + " at (" + place.map(coordinateText).join(", ") + ") m";

/// Peaks that are shown: displacements, forces, openings and drifts of measures.
const PEAK_COLUMN = /\.(u[xyz]|[a-z_]*force|opening|slip|drift|largest_opening)$/;

function namesText(names, most = 5) {
  const shown = names.slice(0, most).join(", ");
  return names.length > most ? shown + " and " + (names.length - most) + " more" : shown;
}

/// Rows of the main results below the answer itself: the largest values.
function answerRows(summary) {
  if (!summary) return [];
  const rows = [];
  const add = (name, value) => { if (value !== null && value !== undefined && value !== "") rows.push([name, value]); };
  if (!isAnswered(summary)) add("message", summary.message);
  const displaced = summary.displaced || [];
  if (displaced.length > 0)
    add("went far", namesText(displaced.map(({block, distance}) => block + " (" + quantity(distance, "m") + ")")));
  if (current.relative !== null) {
    const last = data.frames[data.frames.length - 1];
    const largest = largestShownDisplacement(last);
    if (largest) add("largest displacement" + relativeWords(last), placedText(largest, "m"));
  }
  const absolute = current.relative === null ? "" : ", absolute";
  for (const [key, name, unit] of [["largest_displacement", "largest displacement" + absolute, "m"],
    ["largest_compression", "largest compression", "Pa"], ["largest_tension", "largest tension", "Pa"],
    ["largest_strain", "largest strain", ""]])
    if (summary[key]) add(name, placedText(summary[key], unit));
  const broken = summary.broken;
  if (broken && broken.of_area > 0)
    add("broken joints", broken.pairs === 0 ? "none" : short(broken.area) + " of " + short(broken.of_area)
      + " m² with strength, between " + broken.pairs + " pairs of blocks");
  for (const [column, {least, largest}] of Object.entries(summary.peaks || {})) {
    const unit = unitOfColumn(column);
    const text = (peak) => (peak ? quantity(peak.value, unit) + " at " + short(peak.time) + " s" : "none");
    if (!data.isStatic && PEAK_COLUMN.test(column)) add("peaks of " + column, text(least) + " to " + text(largest));
  }
  const deepest = summary.deepest;
  if (deepest) add("deepest penetration", quantity(withoutNoise(deepest.value, "m"), "m") + ", " + deepest.blocks.join(" in "));
  return rows;
}

const ANSWERED = ["scene", "title", "status", "message", "moving", "displaced", "largest_displacement", "largest_compression",
  "largest_tension", "largest_strain", "broken", "deepest", "factor_of_safety", "load_factor", "states", "verdict", "peaks",
  "pushover"];

const percentText = (share) => short(100 * share) + " %";

/// `error` of the summary: of the orders of blocks or of all choices, and of each measure.
function errorRows({accuracy, estimate, by = {}, measures = {}, advice, blocks_estimated: estimated, blocks_in_all: all}) {
  const rows = [["estimated error, relative"]];
  if (accuracy !== undefined) rows.push(["asked for", percentText(accuracy)]);
  if (estimate !== undefined) rows.push([accuracy !== undefined ? "largest" : "deformation of blocks", percentText(estimate)]);
  if (estimated < all) rows.push(["estimated blocks", estimated + " of " + all]);
  if (accuracy !== undefined) for (const [part, share] of Object.entries(by)) rows.push(["by " + words(part), percentText(share)]);
  for (const [name, share] of Object.entries(measures)) rows.push(["measure " + name, percentText(share)]);
  if (advice) rows.push(["advice", advice]);
  return rows;
}

/// `kinematic` of the summary: capacities, then each comparison with the demand.
function kinematicRows({demand, ...numbers}) {
  const rows = [["kinematic check"]];
  const add = (name, value) => {
    if (value !== null && typeof value === "object")
      for (const [part, inner] of Object.entries(value)) add(name + ", " + words(part), inner);
    else if (value !== null && value !== undefined) rows.push([name, valueText(value)]);
  };
  for (const [name, value] of Object.entries(numbers)) add(words(name), value);
  for (const [name, value] of Object.entries(demand || {})) add(words(name), value);
  return rows;
}

/// All other numbers and texts as rows, tables of them as groups.
function counterRows(summary) {
  const rows = [];
  const groups = [];
  for (const [key, value] of Object.entries(summary || {})) {
    if (ANSWERED.includes(key)) continue;
    if (key === "error") {
      groups.push(...errorRows(value));
    } else if (key === "kinematic") {
      groups.push(...kinematicRows(value));
    } else if (key === "automatic") {
      if (value.length > 0) groups.push(["chosen automatically"]);
      for (const choice of value) groups.push([choice.key, short(choice.value) + " " + choice.unit]);
    } else if (key === "rejected_steps") {
      rows.push(["rejected steps", valueText(value.count)]);
    } else if (key === "stages" && Array.isArray(value)) {
      groups.push(["stages"], ...value.map((stage) => [stage.name, stage.status + ", " + stage.steps + " steps"]));
    } else if (value !== null && typeof value === "object" && !Array.isArray(value)) {
      groups.push([words(key)], ...Object.entries(value).map(([name, part]) => [words(name), valueText(part)]));
    } else if (!Array.isArray(value)) {
      rows.push([words(key), valueText(value)]);
    }
  }
  return [...rows, ...groups];
}

function showSummary() {
  element("answer").textContent = answerText(data.summary);
  fillTable(element("answers"), answerRows(data.summary));
  fillTable(element("counters"), counterRows(data.summary));
}
