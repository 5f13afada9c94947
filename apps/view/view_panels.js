// The page of `ashlar view`, third part: what was picked, the plots of the history and the summary.

// Okabe and Ito's colours, which tell apart without colour vision, then darker ones.
const CURVE_COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#7f3c8d",
  "#6b6b00", "#a02c2c", "#5c5c5c"];

// ---- picking ----------------------------------------------------------------------------------------------

/// @param x, y pixels from the upper left corner of the canvas. A contact within its dot comes before blocks.
function pick(x, y) {
  const {clientWidth: width, clientHeight: height} = element("canvas");
  const contact = contactAt(x, y, width, height);
  if (contact) return {contact};
  const caster = new THREE.Raycaster();
  caster.setFromCamera(new THREE.Vector2(2 * x / width - 1, 1 - 2 * y / height), camera);
  meshes.mesh.geometry.computeBoundingSphere();
  const hit = caster.intersectObject(meshes.mesh)[0];
  return hit ? {block: surface.triangleBlock[hit.faceIndex], place: hit.point, face: hit.face} : {};
}

function contactAt(x, y, width, height) {
  let [nearest, least] = [null, 7];
  for (const contact of visibleContacts(currentFrame())) {
    const screen = contact.place.clone().project(camera);
    const distance = Math.hypot((screen.x + 1) * width / 2 - x, (1 - screen.y) * height / 2 - y);
    if (distance < least) [nearest, least] = [contact, distance];
  }
  return nearest;
}

/// Centre of volume of a closed surface: tetrahedra from its triangles to the origin of its own points.
function centreOf(block) {
  const places = meshes.mesh.geometry.attributes.position;
  const corner = (k) => new THREE.Vector3().fromBufferAttribute(places, surface.triangles[k]);
  const origin = corner(3 * surface.triangleBlock.indexOf(block));
  const sum = new THREE.Vector3();
  let volume = 0;
  surface.triangleBlock.forEach((owner, t) => {
    if (owner !== block) return;
    const [a, b, c] = [0, 1, 2].map((k) => corner(3 * t + k).sub(origin));
    const part = a.dot(b.clone().cross(c));
    sum.addScaledVector(a.add(b).add(c), part / 4);
    volume += part;
  });
  return volume === 0 ? origin : origin.addScaledVector(sum, 1 / volume);
}

const vectorText = (v) => [v.x, v.y, v.z].map(short).join(", ");

function rowsOfBlock(index) {
  const block = data.blocks[index];
  const rows = [["block", block.name], ["order", block.fixed ? "fixed" : block.order],
    ["material", block.material || "-"], ["centre (m)", vectorText(centreOf(index))]];
  if (current.picked.place) rows.push(["clicked at (m)", vectorText(current.picked.place)]);
  const field = fields[current.field];
  if (!isWhole(field) && current.picked.face) {
    const value = field.at(currentFrame(), surface.source[current.picked.face.a]);
    rows.push([field.label + " near (" + field.unit + ")", short(value)]);
  }
  return rows;
}

function rowsOfContact(contact) {
  const normalForce = contact.force.dot(contact.normal);
  const shear = contact.force.clone().addScaledVector(contact.normal, -normalForce).length();
  return [["contact", data.blocks[contact.a].name + " on " + data.blocks[contact.b].name],
    ["type", CONTACT_TYPES[contact.type]], ["state", CONTACT_STATES[contact.state]],
    ["gap (m)", short(contact.gap)], ["force on " + data.blocks[contact.a].name + " (N)", vectorText(contact.force)],
    ["normal, shear (N)", short(normalForce) + ", " + short(shear)],
    ["area (m²)", short(contact.area)], ["place (m)", vectorText(contact.place)]];
}

function showPicked() {
  const {block, contact} = current.picked;
  const rows = contact ? rowsOfContact(contact) : block !== undefined ? rowsOfBlock(block) : [];
  fillTable(element("picked"), rows);
  element("hint").hidden = rows.length > 0;
  const chosen = [...surface.edges].filter((edge) => edge.block === block);
  meshes.selection.geometry.setIndex(edgeIndex(chosen));
  meshes.selection.visible = chosen.length > 0;
  render();
}

function pickOnClick(canvas) {
  let start = {x: 0, y: 0};
  canvas.addEventListener("mousedown", (event) => { start = {x: event.offsetX, y: event.offsetY}; });
  canvas.addEventListener("click", (event) => {
    if (Math.hypot(event.offsetX - start.x, event.offsetY - start.y) > 4) return;
    current.picked = pick(event.offsetX, event.offsetY);
    showPicked();
  });
}

// ---- plots ------------------------------------------------------------------------------------------------

/// name of a group: {unit, columns}; measures first.
function plotGroups(columns) {
  const groups = {};
  const add = (name, unit, list) => { if (list.length > 0) groups[name] = {unit, columns: list}; };
  for (const column of columns.filter((name) => name.endsWith(".ux"))) {
    const measure = column.slice(0, -3);
    const parts = (list) => list.map((part) => measure + part).filter((name) => columns.includes(name));
    add(measure + ": displacement", "m", parts([".ux", ".uy", ".uz"]));
    add(measure + ": position", "m", parts([".x", ".y", ".z"]));
    add(measure + ": velocity", "m/s", parts([".vx", ".vy", ".vz"]));
    add(measure + ": stress", "Pa", parts(STRESS_NAMES.map((name) => ".s" + name)));
  }
  const starting = (start) => columns.filter((name) => name.startsWith(start));
  // Most runs have no damping, many no loads: what is zero all the time only crowds the plot.
  add("energies", "J", starting("energy.").filter((name) => data.history.values[name].some((value) => value !== 0)));
  add("contacts", "points", starting("contacts."));
  add("step size", "s", columns.filter((name) => name === "dt"));
  add("penetration", "m", starting("penetration."));
  add("open-close iterations", "", starting("open_close."));
  add("momentum", "N s", starting("momentum."));
  add("angular momentum", "N m s", starting("angular_momentum."));
  return groups;
}

function datasetOf(column, k, group) {
  const times = data.history.values.time;
  const name = group.columns.length > 1 ? column.slice(column.lastIndexOf(".") + 1) : column;
  const colour = CURVE_COLOURS[k % CURVE_COLOURS.length];
  return {label: name.replaceAll("_", " "), data: data.history.values[column].map((y, row) => ({x: times[row], y})),
    borderColor: colour, backgroundColor: colour, borderWidth: 1.5, pointRadius: 0};
}

/// A line at the time of the frame shown.
const cursor = {
  id: "cursor",
  afterDraw(chart) {
    const {ctx: context, chartArea: area, scales} = chart;
    const x = scales.x.getPixelForValue(currentFrame().time);
    context.save();
    context.strokeStyle = "#c00018";
    context.beginPath();
    context.moveTo(x, area.top);
    context.lineTo(x, area.bottom);
    context.stroke();
    context.restore();
  },
};

function axis(title) {
  return {type: "linear", title: {display: title !== "", text: title}, ticks: {maxTicksLimit: 6, includeBounds: false}};
}

function buildPlot(canvas, select, groups, chosen) {
  const chart = new Chart(canvas, {type: "line", data: {datasets: []}, plugins: [cursor],
    options: {animation: false, parsing: false, maintainAspectRatio: false, interaction: {mode: "nearest", axis: "x"},
      scales: {x: axis("time (s)"), y: axis("")},
      plugins: {legend: {labels: {boxWidth: 10, boxHeight: 2, padding: 6, font: {size: 11}}}},
      onClick: (event) => showFrame(frameNear(chart.scales.x.getValueForPixel(event.x)))}});
  const showGroup = () => {
    const group = groups[select.value];
    chart.data.datasets = group.columns.map((column, k) => datasetOf(column, k, group));
    const times = data.history.values.time;
    Object.assign(chart.options.scales.x, {min: times[0], max: times[times.length - 1]});
    chart.options.scales.y.title = {display: group.unit !== "", text: group.unit};
    chart.update();
  };
  fillSelect(select, Object.keys(groups).map((name) => [name, name]), chosen);
  select.addEventListener("change", showGroup);
  showGroup();
  return chart;
}

function buildPlots() {
  const groups = plotGroups(data.history.columns);
  const names = Object.keys(groups);
  const second = names[0] === "energies" ? names[1] : "energies";
  return [buildPlot(element("plot-1"), element("plot-1-group"), groups, names[0]),
    buildPlot(element("plot-2"), element("plot-2-group"), groups, second in groups ? second : names[0])];
}

function frameNear(time) {
  let nearest = 0;
  data.frames.forEach((frame, k) => {
    if (Math.abs(frame.time - time) < Math.abs(data.frames[nearest].time - time)) nearest = k;
  });
  return nearest;
}

// ---- summary ----------------------------------------------------------------------------------------------

function fillTable(table, rows) {
  table.replaceChildren(...rows.map(([name, value]) => {
    const row = document.createElement("tr");
    if (value === undefined) row.className = "group";
    for (const text of value === undefined ? [name] : [name, value]) row.insertCell().textContent = text;
    return row;
  }));
}

const words = (key) => key.replaceAll("_", " ");
const valueText = (value) => (typeof value === "number" ? short(value) : String(value));

/// Numbers and texts as rows, tables of them as groups; the scene itself is left out.
function summaryRows(summary) {
  if (!summary) return [["status", "not finished: no summary.json"]];
  const rows = [];
  const groups = [];
  for (const [key, value] of Object.entries(summary)) {
    if (key === "scene" || key === "title") continue;
    if (key === "automatic") {
      if (value.length > 0) groups.push(["chosen automatically"]);
      for (const choice of value) groups.push([choice.key, short(choice.value) + " " + choice.unit]);
    } else if (key === "rejected_steps") {
      rows.push(["rejected steps", valueText(value.count)]);
    } else if (value !== null && typeof value === "object" && !Array.isArray(value)) {
      groups.push([words(key)], ...Object.entries(value).map(([name, part]) => [words(name), valueText(part)]));
    } else if (!Array.isArray(value)) {
      rows.push([words(key), valueText(value)]);
    }
  }
  return [...rows, ...groups];
}
