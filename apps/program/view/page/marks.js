// Items drawn over the scene: legend, axes, scale bar.

/// The three axes in the present view, beside the model.
function drawAxes(context, {x: left, y: top, height}) {
  const size = 24;
  const [x, y] = [left + 36, top + height - 38];
  const toCamera = new THREE.Quaternion().copy(camera.quaternion).inverse();
  const axes = [["x", "#c92a2a"], ["y", "#2b8a3e"], ["z", "#1864ab"]].map(([name, colour], k) => {
    const seen = new THREE.Vector3(...[0, 1, 2].map((c) => (c === k ? 1 : 0))).applyQuaternion(toCamera);
    return {name, colour, seen};
  }).sort((a, b) => a.seen.z - b.seen.z);
  context.font = "bold 12px system-ui, sans-serif";
  context.textAlign = "center";
  for (const {name, colour, seen} of axes) {
    const [toX, toY] = [x + size * seen.x, y - size * seen.y];
    context.lineWidth = 2.5;
    context.strokeStyle = colour;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(toX, toY);
    context.stroke();
    if (Math.hypot(seen.x, seen.y) > 0.15) drawText(context, name, x + (size + 9) * seen.x, y - (size + 9) * seen.y + 4);
  }
  context.textAlign = "left";
}

/// Width of a pixel, m, in a perspective at the centre of the scene.
function lengthOfPixel() {
  if (camera.isOrthographicCamera) return 2 * camera.half / camera.zoom / frameSize.height;
  const distance = camera.position.distanceTo(controls.target);
  return 2 * distance * Math.tan(0.5 * THREE.Math.degToRad(camera.fov)) / frameSize.height;
}

/// A round length at its scale at the centre of the scene; nearer objects appear larger.
function drawScaleBar(context, {x: left, y: top, width, height}) {
  const metresOfPixel = lengthOfPixel();
  const length = roundBelow(metresOfPixel * (width - 84));
  const pixels = length / metresOfPixel;
  const [x, y] = [left + 80, top + height - 12];
  context.fillStyle = theme().text;
  context.fillRect(x, y, pixels, 2);
  for (const end of [x, x + pixels - 1.5]) context.fillRect(end, y - 4, 1.5, 10);
  context.font = LEGEND_FONT;
  context.textAlign = "center";
  drawText(context, lengthText(length), x + 0.5 * pixels, y - 6);
  context.textAlign = "left";
}

/// A length in the unit in which it is a short number: 5 mm, 20 cm, 2 m, 1 km.
function lengthText(length) {
  const [name, factor] = current.units === "si" ? ["m", 1]
    : [["km", 1e3], ["m", 1], ["cm", 1e-2], ["mm", 1e-3], ["µm", 1e-6]].find(([, unit]) => length >= 0.999 * unit)
      || ["µm", 1e-6];
  return short(length / factor) + " " + name;
}

function drawMarks(context) {
  drawLegend(context, currentFrame(), frameSize.legend);
  drawLoadLabels(context);
  if (!current.marks) return;
  // A low picture has no room beside the model.
  if (frameSize.height >= 300) drawAxes(context, frameSize.marks);
  drawScaleBar(context, frameSize.marks);
}
