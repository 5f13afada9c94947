// The answer of a run in words, and the words for its frames.

/// True if the status is the result; false if it only indicates a result in the summary, which its message then
/// repeats.
const isAnswered = ({status}) => ["completed", "equilibrium", "moving"].includes(status);

const titleOfRun = () => (data.summary && data.summary.title) || data.name;

const FACTORS = {factor_of_safety: "factor of safety", load_factor: "load factor"};
const factorKey = (summary) => Object.keys(FACTORS).find((key) => summary && summary[key]);

/// {moving: names of the blocks that move, mode: how the first one does, if known}
function movingOf(summary) {
  const factor = summary[factorKey(summary)];
  const list = factor ? factor.moving || [] : summary.moving || [];
  return {moving: list.map((block) => block.block || block), mode: factor ? factor.mode : undefined};
}

/// "3 of 12 blocks move: a, b, c", "block a moves"
function motionText(summary) {
  const {moving, mode} = movingOf(summary);
  if (moving.length === 0) return "";
  if (moving.length === 1) return "block " + moving[0] + " " + (mode || "moves");
  const all = data.blocks.filter(({absent, fixed}) => !absent && !fixed).length;
  return moving.length + " of " + all + " blocks move: " + namesText(moving, 3);
}

/// "between 2.61 and 2.63", "1.21 (released)"
function factorText({lower, upper, proven}) {
  const known = (factor) => factor !== null && factor !== undefined;
  if (!known(lower) && !known(upper)) return "not found";
  if (!known(lower)) return "below " + short(upper) + ", where blocks move";
  if (!known(upper)) return "above " + short(lower) + ", where all stands";
  if (proven === false) return "at least " + short(lower) + " (at " + short(upper) + " neither rest nor motion was found)";
  return "between " + short(lower) + " and " + short(upper);
}

/// "factor of safety between 1.209 and 1.215: block wedge slides on one face"
function factorAnswer(summary) {
  const key = factorKey(summary);
  const factor = summary[key];
  const motion = motionText(summary);
  const unlike = (other, than) => other && than && Math.abs(other - than) > 0.02 * than;
  return FACTORS[key] + " " + factorText(factor) + (motion ? ": " + motion : "")
    + (unlike(factor.released, factor.lower) ? "; " + short(factor.released) + " if joints do not wedge" : "")
    + (unlike(factor.associated, factor.upper) ? "; " + short(factor.associated) + " if joints dilate" : "");
}

/// The first line of the summary.
function answerText(summary) {
  if (!summary) return "not finished";
  if (factorKey(summary)) return factorAnswer(summary);
  const verdict = summary.verdict && summary.message ? ": " + summary.message : "";
  const words = {completed: "completed at t = " + short(summary.time) + " s" + verdict, equilibrium: "stands: static equilibrium",
    moving: "does not stand: " + (motionText(summary) || "no equilibrium"), "not converged": "no answer: did not converge",
    failed: "failed", interrupted: "interrupted"};
  if (data.isStatic && summary.status === "completed") return summary.message || "completed";
  const far = (summary.displaced || []).length;
  return (words[summary.status] || String(summary.status)) + (summary.status === "equilibrium" && far > 0
    ? ", but " + far + (far === 1 ? " block" : " blocks") + " went far" : "");
}

/// Words for a frame of a static analysis. @param summary may be null
function staticWords(frame, summary) {
  const state = ((summary && summary.states) || []).find(({step}) => step === frame.step);
  if (state) return state.name;
  const key = factorKey(summary);
  const isLast = frame === data.frames[data.frames.length - 1];
  if (key && isLast) return FACTORS[key] + " " + factorText(summary[key]);
  if (key) return "motion beyond the " + FACTORS[key] + ", iteration " + frame.step;
  if (isLast && summary && summary.status === "equilibrium") return "static equilibrium";
  if (isLast && summary && summary.status === "moving") return "no equilibrium";
  return (frame.step === 0 ? "as placed" : "iteration " + frame.step);
}

/// "t = 0.95 s", "static equilibrium", "load factor between 1.915 and 2"; in stages after the name of the stage.
function frameWords(frame) {
  const stage = data.stages ? data.stages[stageOf(frame) - 1] : undefined;
  if (!stage) return data.isStatic ? staticWords(frame, data.summary) : "t = " + short(frame.time) + " s";
  const told = data.summary && data.summary.stages ? data.summary.stages[stageOf(frame) - 1] : null;
  const next = data.frames[data.frames.indexOf(frame) + 1];
  const isLast = !next || stageOf(next) !== stageOf(frame);
  const words = stage.analysis === "dynamic" ? "t = " + short(frame.time) + " s"
    : !isLast || !told ? "iteration " + frame.step
      : told.status === "equilibrium" ? "static equilibrium" : told.status === "moving" ? "no equilibrium" : told.status;
  return "stage " + stage.name + ": " + words;
}
