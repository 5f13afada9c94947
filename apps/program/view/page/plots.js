// The history: columns of history.csv against time, iteration or any other one; export as a picture or a table.

// Okabe and Ito's colours, distinct also without colour vision, then darker ones.
const CURVE_COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f", "#7f3c8d",
  "#8a8a00", "#a02c2c", "#5c5c5c"];

/// What the run says of a column: {unit, measure, group, meaning}; results of earlier versions have no such file.
const columnOf = (name) => OWN_COLUMNS[name] || (data.history.about || {})[name] || {};
const unitOfColumn = (name) => {
  const {unit} = columnOf(name);
  return !unit || unit === "1" ? "" : unit.replace("^2", "²");
};

/// name of a group: {unit, columns, change: true if differences from the first row are shown}; measures first.
function plotGroups(columns) {
  const groups = {};
  const add = (name, column) => {
    if (!(name in groups)) groups[name] = {unit: unitOfColumn(column), columns: []};
    groups[name].columns.push(column);
  };
  const grouped = columns.filter((name) => columnOf(name).group);
  for (const name of grouped.filter((column) => columnOf(column).measure))
    add(columnOf(name).measure + ": " + columnOf(name).group, name);
  // Most runs have no damping, many no loads: constant columns only crowd the plot.
  const changes = (name) => data.history.values[name].some((value, _, all) => value !== all[0]);
  for (const name of grouped.filter((column) => !columnOf(column).measure))
    if (columnOf(name).group !== "energies" || changes(name)) add(columnOf(name).group, name);
  if (groups.energies) groups.energies.change = true;
  if (groups.contacts) groups.contacts.unit = "points";
  for (const column of columns) groups[column] = {unit: unitOfColumn(column), columns: [column], single: true};
  return groups;
}

/// Row of the history that is nearest to a frame.
function rowOfFrame(frame) {
  const steps = data.history.values.step;
  let nearest = 0;
  steps.forEach((step, row) => { if (Math.abs(step - frame.step) < Math.abs(steps[nearest] - frame.step)) nearest = row; });
  return nearest;
}

/// The time since the start of a run in stages, whose `time` starts anew in each: a column that the page adds.
const RUN_TIME = "time of the run";
function addRunTime({columns, values}) {
  if (!columns.includes("stage") || !columns.includes("time")) return;
  let before = 0;
  values[RUN_TIME] = values.time.map((time, row) => {
    if (row > 0 && values.stage[row] !== values.stage[row - 1]) before += values.time[row - 1];
    return before + time;
  });
  columns.splice(columns.indexOf("time") + 1, 0, RUN_TIME);
}

/// The curve of a pushover, by step: columns that the page adds from the states of the summary.
const PUSH_DISPLACEMENT = "displacement of the control";
const PUSH_MULTIPLIER = "multiplier";
function addPush({columns, values}, summary) {
  const states = ((summary && summary.states) || []).filter(({multiplier}) => multiplier !== undefined);
  if (states.length === 0 || !columns.includes("step")) return;
  const byStep = new Map(states.map((state) => [state.step, state]));
  const column = (key) => Array.from(values.step, (step) => (byStep.has(step) ? byStep.get(step)[key] : NaN));
  values[PUSH_DISPLACEMENT] = column("displacement");
  values[PUSH_MULTIPLIER] = column("multiplier");
  columns.splice(columns.indexOf("step") + 1, 0, PUSH_DISPLACEMENT, PUSH_MULTIPLIER);
}

const OWN_COLUMNS = {[RUN_TIME]: {unit: "s"}, [PUSH_DISPLACEMENT]: {unit: "m"}, [PUSH_MULTIPLIER]: {unit: "1"}};

/// The column that curves are drawn against unless the user chooses another one: static analyses have no time.
function usualColumn() {
  const {columns} = data.history;
  const allStatic = data.stages && data.stages.length > 0 ? data.stages.every(({analysis}) => analysis !== "dynamic") : data.isStatic;
  if (allStatic && columns.includes("step")) return "step";
  return columns.includes(RUN_TIME) ? RUN_TIME : "time";
}
const columnLabel = (name) => (name === "step" && data.isStatic ? "iteration" : name);

function labelWithUnit(name, unit) {
  return unit ? name + " (" + unit + ")" : name;
}

const cursor = {
  id: "cursor",
  /// A line at the frame shown.
  afterDraw(chart) {
    const {ctx: context, chartArea: area, scales, ashlar} = chart;
    if (!ashlar || !area) return;
    const x = scales.x.getPixelForValue(ashlar.xValues[rowOfFrame(currentFrame())]);
    if (!(x >= area.left - 1 && x <= area.right + 1)) return;
    context.save();
    context.strokeStyle = "#e03131";
    context.beginPath();
    context.moveTo(x, area.top);
    context.lineTo(x, area.bottom);
    context.stroke();
    context.restore();
  },
};

function axis(title) {
  return {type: "linear", title: {display: title !== "", text: title},
    ticks: {maxTicksLimit: 6, includeBounds: false, callback: (value) => short(Number(value.toPrecision(12)))}};
}

/// Content of a plot: [{label, x, y}] with units. @return {curves, xValues, xTitle, yTitle}
function curvesOf(group, xColumn) {
  const {values} = data.history;
  const scaled = (list, unit) => {
    const largest = list.reduce((most, column) =>
      column.reduce((size, value) => (Number.isFinite(value) ? Math.max(size, Math.abs(value)) : size), most), 0);
    const {name, factor} = unitFor(unit, largest);
    return {name, lists: list.map((column) => column.map((value) => value / factor))};
  };
  const x = scaled([values[xColumn]], unitOfColumn(xColumn));
  const y = scaled(group.columns.map((column) =>
    (group.change ? values[column].map((value) => value - values[column][0]) : values[column])), group.unit);
  const shorter = (column) => (group.columns.length > 1 ? column.slice(column.lastIndexOf(".") + 1) : column);
  const curves = group.columns.map((column, k) => ({label: shorter(column).replaceAll("_", " "), y: y.lists[k]}));
  const yTitle = group.change ? labelWithUnit("change since the start", y.name) : y.name;
  return {curves, xValues: x.lists[0], xTitle: labelWithUnit(columnLabel(xColumn), x.name), yTitle};
}

function colourChart(chart) {
  const {text} = theme();
  const grid = themeName() === "dark" ? "#3a404a" : "#e3e5e8";
  for (const scale of Object.values(chart.options.scales))
    Object.assign(scale, {grid: {color: grid}, title: {...scale.title, color: text}, ticks: {...scale.ticks, color: text}});
  chart.options.plugins.legend.labels.color = text;
}

/// @param number 1 or 2
function showPlot(number) {
  const chart = plots[number - 1];
  const group = plotGroups.all[current["y" + number]] || Object.values(plotGroups.all)[0];
  const made = curvesOf(group, current["x" + number]);
  chart.ashlar = {...made, name: current["y" + number]};
  chart.data.datasets = made.curves.map(({label, y}, k) => {
    const colour = CURVE_COLOURS[k % CURVE_COLOURS.length];
    return {label, data: y.map((value, row) => ({x: made.xValues[row], y: value})), borderColor: colour,
      backgroundColor: colour, borderWidth: 1.8, pointRadius: 0};
  });
  Object.assign(chart.options.scales, {x: axis(made.xTitle), y: axis(made.yTitle)});
  const along = made.xValues.filter(Number.isFinite);
  Object.assign(chart.options.scales.x, {min: Math.min(...along), max: Math.max(...along)});
  colourChart(chart);
  chart.update();
}

function buildPlot(number) {
  const chart = new Chart(element("plot-" + number), {type: "line", data: {datasets: []}, plugins: [cursor],
    options: {animation: false, parsing: false, maintainAspectRatio: false, interaction: {mode: "nearest", axis: "x"},
      scales: {x: axis(""), y: axis("")},
      plugins: {legend: {labels: {boxWidth: 10, boxHeight: 2, padding: 6, font: {size: 11}}}},
      onClick: (event) => showFrame(frameAtX(chart, chart.scales.x.getValueForPixel(event.x)))}});
  const ySelect = element("plot-" + number + "-group"), xSelect = element("plot-" + number + "-x");
  const names = Object.keys(plotGroups.all);
  const section = (label, list) => {
    const section = document.createElement("optgroup");
    section.label = label;
    section.append(...list.map((name) => new Option(columnLabel(name), name)));
    return section;
  };
  const isSingle = (name) => plotGroups.all[name].single;
  ySelect.replaceChildren(section("groups", names.filter((name) => !isSingle(name))), section("columns", names.filter(isSingle)));
  xSelect.replaceChildren(...data.history.columns.map((name) => new Option(columnLabel(name), name)));
  for (const [select, key] of [[ySelect, "y" + number], [xSelect, "x" + number]]) {
    select.value = current[key];
    select.addEventListener("change", () => {
      current[key] = select.value;
      showPlot(number);
      noteAddress();
    });
  }
  element("plot-" + number + "-png").addEventListener("click", () => savePlotPicture(chart));
  element("plot-" + number + "-csv").addEventListener("click", () => savePlotTable(chart));
  return chart;
}

function choosePlots() {
  plotGroups.all = plotGroups(data.history.columns);
  const names = Object.keys(plotGroups.all);
  const first = names[0];
  const second = first !== "energies" && "energies" in plotGroups.all ? "energies" : names[1] || first;
  Object.assign(current, {x1: usualColumn(), x2: usualColumn(), y1: first, y2: second});
  if (data.history.columns.includes(PUSH_MULTIPLIER)) Object.assign(current, {x1: PUSH_DISPLACEMENT, y1: PUSH_MULTIPLIER});
}

function buildPlots() {
  plots.push(buildPlot(1), buildPlot(2));
  for (const number of [1, 2]) showPlot(number);
}

/// The frame whose row has an abscissa nearest to x.
function frameAtX(chart, x) {
  let nearest = 0;
  const at = (k) => chart.ashlar.xValues[rowOfFrame(data.frames[k])];
  data.frames.forEach((_, k) => { if (Math.abs(at(k) - x) < Math.abs(at(nearest) - x)) nearest = k; });
  return nearest;
}

// ---- export -----------------------------------------------------------------------------------------

function save(name, address) {
  const link = document.createElement("a");
  Object.assign(link, {href: address, download: name});
  link.click();
}

const fileName = (chart, suffix) => (data.name + "_" + chart.ashlar.name).replace(/[^\w.-]+/g, "_") + suffix;

/// The plot on its background, which the canvas itself does not contain.
function plotPicture(chart) {
  const picture = document.createElement("canvas");
  Object.assign(picture, {width: chart.canvas.width, height: chart.canvas.height});
  const context = picture.getContext("2d");
  context.fillStyle = theme().background;
  context.fillRect(0, 0, picture.width, picture.height);
  context.drawImage(chart.canvas, 0, 0);
  return picture.toDataURL("image/png");
}

/// Rows as they are drawn, in the units of the axes, as CSV.
function plotTable(chart) {
  const {curves, xValues, xTitle, yTitle} = chart.ashlar;
  const quoted = (text) => '"' + text.replaceAll('"', '""') + '"';
  const unit = (yTitle.match(/\(([^)]*)\)$/) || [null, yTitle])[1];
  const head = [xTitle, ...curves.map(({label}) => labelWithUnit(label, unit))].map(quoted).join(",");
  return [head, ...xValues.map((x, row) => [x, ...curves.map(({y}) => y[row])].join(","))].join("\n") + "\n";
}

const savePlotPicture = (chart) => save(fileName(chart, ".png"), plotPicture(chart));

function savePlotTable(chart) {
  const address = URL.createObjectURL(new Blob([plotTable(chart)], {type: "text/csv"}));
  save(fileName(chart, ".csv"), address);
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}
