// The controls, and show(), which brings the picture in line with `current`.

const currentFrame = () => data.frames[current.frame];

function clockText(frame) {
  return frameWords(frame) + (current.scale === 1 ? "" : ", displacements × " + short(current.scale));
}

function show() {
  const frame = currentFrame();
  const field = blockField();
  const range = rangeOf(field, frame);
  moveSurface(frame);
  colourSurface(field, frame, range);
  styleSurface();
  placeJoints(frame);
  placeForces(frame);
  placeActions(frame);
  placeAllVectors(frame);
  placeSection(field, range);
  element("force-note").textContent = forceNote(frame);
  element("clock").textContent = clockText(frame);
  showRange(mainField(), rangeOf(mainField(), frame));
  render();
  noteAddress();
}

/// The range in the two fields of the control, in the unit of the legend.
function showRange(field, range) {
  const own = current.range === "own";
  element("own-range").hidden = !range;
  for (const [id, k] of [["low", 0], ["high", 1]]) {
    const input = element(id);
    input.disabled = !own;
    if (!range || document.activeElement === input) continue;
    const {name, factor} = unitFor(field.unit, Math.max(Math.abs(range[0]), Math.abs(range[1])));
    input.value = short(range[k] / factor);
    input.dataset.factor = factor;
    element("range-unit").textContent = name;
  }
}

function showFrame(index) {
  if (index !== current.frame && (current.picked.contact || current.picked.joint !== undefined)) current.picked = {};
  current.frame = index;
  element("slider").value = index;
  updatePicked();
  show();
  for (const plot of plots) plot.draw();
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

// ---- ties between controls and `current` --------------------------------------------------------------------

const positive = (input) => Math.max(0, Number(input.value) || 0);

/// [id of the control, member of `current`, how to read it]
const TIES = [
  ["field", "field"], ["range", "range"], ["units", "units"], ["joints", "joints"], ["vectors", "vectors"],
  ["section", "section"], ["theme", "theme"], ["contact-colour", "points"],
  ["scale", "scale", positive], ["force-scale", "forceScale", positive], ["section-at", "sectionAt", (input) => Number(input.value)],
  ["edges", "edges", "checked"], ["sub-faces", "subFaces", "checked"], ["see-through", "seeThrough", "checked"],
  ["open-contacts", "openContacts", "checked"], ["arrows", "arrows", "checked"], ["chain", "chain", "checked"],
  ["thrust", "thrust", "checked"], ["loads", "loads", "checked"], ["supports", "supports", "checked"],
  ["bolts", "bolts", "checked"], ["water", "water", "checked"], ["crosses", "crosses", "checked"], ["marks-shown", "marks", "checked"],
];

/// Puts the state into the controls.
function syncControls() {
  for (const [id, member, read] of TIES) {
    if (read === "checked") element(id).checked = current[member];
    else if (id !== "section-at") element(id).value = current[member];
  }
  for (const number of [1, 2]) {
    element("plot-" + number + "-group").value = current["y" + number];
    element("plot-" + number + "-x").value = current["x" + number];
  }
  fillRelative();
  syncSection();
}

/// The range of the slider is that of the axis.
function syncSection() {
  const [low, high] = sectionWay();
  const slider = element("section-at");
  Object.assign(slider, {min: low, max: high, step: (high - low) / 200, disabled: current.section === "none"});
  slider.value = current.sectionAt;
  element("section-place").textContent = current.section === "none" ? "" : current.section.slice(-1) + " = "
    + coordinateText(current.sectionAt + data.origin["xyz".indexOf(current.section.slice(-1))]) + " m";
}

function afterChange(member) {
  // Limits apply to the quantity coloured when they were entered.
  if (["field", "joints", "relative"].includes(member)) Object.assign(current, {low: null, high: null});
  if (member === "section") {
    const [low, high] = sectionWay();
    current.sectionAt = 0.5 * (low + high);
  }
  if (member.startsWith("section")) syncSection();
  if (member === "theme") setTheme();
  if (member === "units" || member === "theme") for (const number of [1, 2]) showPlot(number);
  if (member === "units" || member === "relative") showSummary();
  updatePicked();
  show();
}

function tieControls() {
  const options = (id, entries) => element(id).replaceChildren(...entries.map(([value, label]) => new Option(label, value)));
  options("field", Object.entries(fields).map(([key, field]) => [key, field.label]));
  options("joints", [["none", "not shown"], ...jointFieldKeys().map((key) => [key, JOINT_FIELDS[key].label])]);
  options("range", Object.entries(RANGE_NAMES));
  options("vectors", [["none", "none"], ["displacement", "displacement"], ...(data.velocity ? [["velocity", "velocity"]] : [])]);
  element("joints").disabled = !hasJoints();
  element("crosses").disabled = !data.stress;
  for (const key of ["loads", "supports", "bolts", "water"]) element(key).disabled = !hasActions(key);
  for (const [id, member, read] of TIES) {
    const control = element(id);
    const change = () => {
      current[member] = read === "checked" ? control.checked : read ? read(control) : control.value;
      afterChange(member);
    };
    control.addEventListener("change", change);
    if (control.type === "range") control.addEventListener("input", change);
  }
  element("relative").addEventListener("change", ({target}) =>
    showRelativeTo(target.value === "none" ? null : Number(target.value)));
  for (const [id, member] of [["low", "low"], ["high", "high"]]) {
    element(id).addEventListener("change", ({target}) => {
      const value = Number(target.value) * Number(target.dataset.factor || 1);
      current[member] = target.value === "" || !Number.isFinite(value) ? null : value;
      show();
    });
  }
  syncControls();
}

function lookAtView(name) {
  Object.assign(current, {view: name, parallel: PARALLEL_VIEWS.includes(name), from: new THREE.Vector3(...VIEWS[name]),
    at: null, zoom: 1});
  lookFrom(current.from);
  render();
  noteAddress();
}

/// Frame nearest to a value of a member, "time" or "step".
function frameNearest(member, value) {
  const distance = (frame) => Math.abs(frame[member] - value);
  return data.frames.reduce((best, frame, k) => (distance(frame) < distance(data.frames[best]) ? k : best), 0);
}

/// What a run tells of: [words, index of a frame]. Times of stages start anew, so that only runs without them have falls and
/// peaks here.
function eventsOfRun(summary) {
  if (!summary) return [];
  const events = [["start", 0]];
  for (const {step, name} of summary.states || []) events.push([name, frameNearest("step", step)]);
  for (const {name, steps} of summary.stages || []) events.push(["end of stage " + name, frameNearest("step", steps)]);
  if (!summary.stages) {
    for (const {block, time} of ((summary.verdict || {}).fallen || []).slice(0, 20))
      events.push(["t = " + short(time) + " s: " + block + " falls", frameNearest("time", time)]);
    for (const [column, {least, largest}] of Object.entries(data.isStatic ? {} : summary.peaks || {}))
      for (const [which, peak] of [["least", least], ["largest", largest]])
        if (peak) events.push(["t = " + short(peak.time) + " s: " + which + " " + column, frameNearest("time", peak.time)]);
  }
  return [...events, ["end", data.frames.length - 1]];
}

function tieEvents() {
  const events = eventsOfRun(data.summary);
  const select = element("events");
  select.hidden = events.length < 3;
  select.replaceChildren(new Option("jump to", ""), ...events.map(([text, frame]) => new Option(text, frame)));
  select.addEventListener("change", () => {
    if (select.value !== "") showFrame(Number(select.value));
    select.value = "";
    noteAddress();
  });
}

function tieStage() {
  tieEvents();
  element("slider").max = data.frames.length - 1;
  element("slider").addEventListener("input", (event) => showFrame(Number(event.target.value)));
  element("play").addEventListener("click", play);
  element("home").addEventListener("click", () => lookAtView("start"));
  for (const button of document.querySelectorAll("[data-view]"))
    button.addEventListener("click", () => lookAtView(button.dataset.view));
  document.addEventListener("keydown", (event) => {
    if (event.target.matches("input, select, button")) return;
    if (event.code === "Space") play();
    else if (event.code === "ArrowRight") showFrame(Math.min(current.frame + 1, data.frames.length - 1));
    else if (event.code === "ArrowLeft") showFrame(Math.max(current.frame - 1, 0));
    else return;
    event.preventDefault();
  });
  window.addEventListener("resize", () => {
    resize();
    lookFrom(current.from);
    render();
  });
  window.addEventListener("hashchange", followAddress);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => afterChange("theme"));
  controls.addEventListener("change", renderTurning);
  controls.addEventListener("start", beginTurning);
  controls.addEventListener("end", endTurning);
  pickOnClick(element("canvas"));
}

function setTheme() {
  document.documentElement.dataset.theme = themeName();
  stage.background = new THREE.Color(theme().background);
}
