// The summary: first the main results, then counts.

const words = (key) => key.replaceAll("_", " ");
const valueText = (value) => (typeof value === "number" ? short(value) : String(value));

const STATUS_WORDS = {
  completed: "completed", equilibrium: "stands: equilibrium was found", moving: "moves: there is no equilibrium",
  "not converged": "not converged: no answer", failed: "failed", interrupted: "interrupted",
};

/// A coordinate rounded to a hundred-thousandth of the scene.
const roundedPlace = (x) => Math.round(x / (1e-5 * sceneRadius)) * 1e-5 * sceneRadius;

const placedText = ({value, block, place}, unit) =>
  quantity(value, unit) + " in " + block + " at (" + place.map((x) => short(roundedPlace(x))).join(", ") + ") m";

function namesText(names) {
  const shown = names.slice(0, 5).join(", ");
  return names.length > 5 ? shown + " and " + (names.length - 5) + " more" : shown;
}

/// "between 2.61 and 2.63"
function factorText({lower, upper}) {
  if (lower === null || lower === undefined) return "below " + short(upper) + ": moves even there";
  if (upper === null || upper === undefined) return "above " + short(lower) + ": stands even there";
  return "between " + short(lower) + " and " + short(upper);
}

/// "3 blocks: a, b, c"
const countedNames = (names) => (names.length === 0 ? ""
  : names.length + (names.length === 1 ? " block: " : " blocks: ") + namesText(names));

/// True if the status is the result; false if it only indicates a result in the summary, which its message then
/// repeats.
const isAnswered = ({status}) => ["completed", "equilibrium", "moving"].includes(status);

/// Rows of the main results: the factor of a search, otherwise the stability of the model.
function answerRows(summary) {
  if (!summary) return [["status", "not finished: no summary.json"]];
  const rows = [];
  const add = (name, value) => { if (value !== null && value !== undefined && value !== "") rows.push([name, value]); };
  const moving = summary.moving || [];
  for (const [key, name] of [["factor_of_safety", "factor of safety"], ["load_factor", "load factor"]]) {
    if (!summary[key]) continue;
    add(name, factorText(summary[key]));
    add("moves then", countedNames((summary[key].moving || []).map((block) => block.block || block)));
  }
  add("status", STATUS_WORDS[summary.status] || String(summary.status));
  if (!isAnswered(summary)) add("message", summary.message);
  add("moves", countedNames(moving.map(({block}) => block)));
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
    ["largest_compression", "largest compression", "Pa"], ["largest_tension", "largest tension", "Pa"]])
    if (key in summary) add(name, summary[key] ? placedText(summary[key], unit) : "none");
  const broken = summary.broken;
  if (broken && broken.of_area > 0)
    add("broken joints", broken.pairs === 0 ? "none" : short(broken.area) + " of " + short(broken.of_area)
      + " m² with strength, between " + broken.pairs + " pairs of blocks");
  const deepest = summary.deepest;
  if (deepest) add("deepest penetration", quantity(deepest.value, "m") + ", " + deepest.blocks.join(" in "));
  return rows;
}

const ANSWERED = ["scene", "title", "status", "message", "moving", "displaced", "largest_displacement", "largest_compression",
  "largest_tension", "broken", "deepest", "factor_of_safety", "load_factor"];

/// All other numbers and texts as rows, tables of them as groups.
function counterRows(summary) {
  const rows = summary && isAnswered(summary) && summary.message ? [["message", summary.message]] : [];
  const groups = [];
  for (const [key, value] of Object.entries(summary || {})) {
    if (ANSWERED.includes(key)) continue;
    if (key === "automatic") {
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
  fillTable(element("answers"), answerRows(data.summary));
  fillTable(element("counters"), counterRows(data.summary));
}
