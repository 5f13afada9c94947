// The user's selection: a block, a joint, a contact point.

/// @param x, y pixels from the upper left corner of the canvas. A contact within its dot has priority, then the
/// nearest item, and a joint before the blocks that hide it.
function pick(x, y) {
  const {clientWidth: width, clientHeight: height} = element("canvas");
  const contact = contactAt(x, y, width, height);
  if (contact) return {contact};
  const caster = new THREE.Raycaster();
  caster.setFromCamera(new THREE.Vector2(2 * x / width - 1, 1 - 2 * y / height), camera);
  const joint = jointAt(caster);
  if (joint !== null) return {joint};
  meshes.mesh.geometry.computeBoundingSphere();
  const hit = caster.intersectObject(meshes.mesh).find(({point}) => isKept(point));
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

/// Number of the face of a joint, null: none is shown there. Triangles of faces are in the order of placeJoints.
function jointAt(caster) {
  if (current.joints === "none") return null;
  joints.faces.geometry.computeBoundingSphere();
  const hit = caster.intersectObject(joints.faces)[0];
  if (!hit) return null;
  const all = currentFrame().joints;
  let triangles = 0;
  for (let face = 0; face < all.count; ++face) {
    if (jointIsHidden({a: all.a[face], b: all.b[face]})) continue;
    triangles += all.start[face + 1] - all.start[face] - 2;
    if (hit.faceIndex < triangles) return face;
  }
  return null;
}

const orderText = ({fixed, order}) => (fixed ? "fixed" : order === 0 ? "0 (rigid)" : String(order));

function rowsOfBlock(index) {
  const block = data.blocks[index];
  const rows = [["block", block.name], ["order", orderText(block)], ["material", block.material || "-"]];
  if (!current.hidden.has(index) && surface.triangleBlock.includes(index)) rows.push(["centre (m)", pointText(centreOf(index))]);
  if (current.picked.place) rows.push(["clicked at (m)", pointText(current.picked.place)]);
  const field = blockField();
  if (!isWhole(field) && current.picked.face)
    rows.push([labelOf(field, currentFrame()) + " near", quantity(field.at(currentFrame(), surface.source[current.picked.face.a]), field.unit)]);
  return rows;
}

function rowsOfJoint(face) {
  const all = currentFrame().joints;
  const [normal, shear, area] = [all.normal[face], all.shear[face], all.area[face]];
  return [["joint", data.blocks[all.a[face]].name + " on " + data.blocks[all.b[face]].name],
    ["state", STATES[all.state[face]] + (all.broken[face] ? ", has lost its strength" : "")],
    ["opening", quantity(all.opening[face], "m")], ["slip", quantity(all.slip[face], "m")],
    ["normal stress", quantity(normal, "Pa")], ["shear stress", quantity(shear, "Pa")],
    ["area", short(area) + " m²"], ["normal, shear force", quantity(normal * area, "N") + ", " + quantity(shear * area, "N")]];
}

function rowsOfContact(contact) {
  const normalForce = contact.force.dot(contact.normal);
  const shear = contact.force.clone().addScaledVector(contact.normal, -normalForce).length();
  return [["contact", data.blocks[contact.a].name + " on " + data.blocks[contact.b].name],
    ["type", CONTACT_TYPES[contact.type]], ["state", STATES[contact.state]],
    ["gap", quantity(contact.gap, "m")], ["force on " + data.blocks[contact.a].name + " (N)", vectorText(contact.force)],
    ["normal, shear (N)", short(normalForce) + ", " + short(shear)],
    ["area (m²)", short(contact.area)], ["place (m)", pointText(contact.place)]];
}

function fillTable(table, rows) {
  table.replaceChildren(...rows.map(([name, value]) => {
    const row = document.createElement("tr");
    if (value === undefined) row.className = "group";
    for (const text of value === undefined ? [name] : [name, value]) row.insertCell().textContent = text;
    return row;
  }));
}

/// Updates table and marked edges for the selection; the picture is drawn later.
function updatePicked() {
  const {block, contact, joint} = current.picked;
  const rows = contact ? rowsOfContact(contact) : joint !== undefined ? rowsOfJoint(joint)
    : block !== undefined ? rowsOfBlock(block) : [];
  fillTable(element("picked"), rows);
  element("hint").hidden = rows.length > 0;
  element("picked-buttons").hidden = block === undefined;
  const chosen = block === undefined ? [] : [...surface.edges, ...surface.smoothEdges].filter((edge) => edge.block === block);
  meshes.selection.geometry.setIndex(edgeIndex(chosen));
  meshes.selection.visible = chosen.length > 0;
}

function showPicked() {
  updatePicked();
  showBlockList();
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
