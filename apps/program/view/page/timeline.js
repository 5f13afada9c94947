// The axis under the slider: round times of the run, and its events as marks.

/// What the axis counts: times of a motion, steps of all else. Times of stages start anew.
function axisOfRun() {
  const frames = data.frames;
  const time = (data.isStatic || (data.summary && data.summary.stages)) ? null : frames.map((frame) => frame.time);
  return time && time[time.length - 1] > time[0] ? {values: time, unit: " s"} : {values: frames.map((frame) => frame.step), unit: ""};
}

/// Place of a value between frames, 0 to 1. @param values of frames, not decreasing
function placeOnAxis(values, value) {
  const last = values.length - 1;
  const next = values.findIndex((of) => of >= value);
  if (next <= 0 || last === 0) return next < 0 ? 1 : 0;
  const share = (value - values[next - 1]) / (values[next] - values[next - 1]);
  return (next - 1 + share) / last;
}

function showAxis() {
  const axis = element("time-axis");
  axis.hidden = data.frames.length < 2;
  if (axis.hidden) return;
  const {values, unit} = axisOfRun();
  const ticks = roundTicks(values[0], values[values.length - 1], 6);
  const at = (node, place) => {
    node.style.left = 100 * place + "%";
    return node;
  };
  const labels = ticks.map((tick, k) => {
    const label = document.createElement("span");
    label.textContent = (unit === "" && k === 0 ? "step " : "") + tickText(tick, ticks) + unit;
    return at(label, placeOnAxis(values, tick));
  });
  const marks = eventsOfRun(data.summary).slice(1, -1).map(([text, frame]) => {
    const mark = document.createElement("button");
    Object.assign(mark, {title: text, className: "event"});
    mark.setAttribute("aria-label", text);
    mark.addEventListener("click", () => showFrame(frame));
    return at(mark, frame / (data.frames.length - 1));
  });
  axis.replaceChildren(...labels, ...marks);
}
