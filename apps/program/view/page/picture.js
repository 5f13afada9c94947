// Pictures for `ashlar picture` and `ashlar movie`: #picture&size=800x600&frame=3, or &frames=0:7.

/// Pixels of the heading: a low picture has no title.
const headingOfPicture = (height) => (height < 300 ? 36 : 60);

/// Leaves only a text in the page for the program that reads it: pictures, or the reason for their absence.
function leaveText(id, content) {
  const text = document.createElement("pre");
  text.id = id;
  text.textContent = content;
  document.documentElement.replaceChildren(text);
}

/// Requested items that cannot be drawn; empty: none.
function faultOf(wishes) {
  if (!renderer) return "the browser has no WebGL";
  if (wishes.get("color") && !(wishes.get("color") in fields))
    return "the run has no " + wishes.get("color") + " (output.fields)";
  if (current.joints !== "none" && !hasJoints()) return "the run has no contact faces (joints.pvd)";
  if (current.joints === "water" && !data.water_pressure) return "the run has no water in joints ([[water]])";
  if (current.joints === "fracture" && !data.fracture_energy) return "the run has no joints with fracture_energy";
  if (current.vectors === "velocity" && !data.velocity) return "the run has no velocity (output.fields)";
  const unknown = ["hide", "only"].flatMap((key) => (wishes.get(key) || "").split(","))
    .find((name) => name !== "" && blockCalled(name) < 0);
  if (unknown) return "the run has no block " + unknown;
  if (current.crosses && !data.stress) return "the run has no stress (output.fields)";
  return "";
}

function makePicture(wishes) {
  const fault = faultOf(wishes);
  if (fault) return leaveText("fault", fault);
  const [width, height] = wishes.get("size").split("x").map(Number);
  sharpness.full = Number(wishes.get("sharpness") || 1);
  renderer.setPixelRatio(sharpness.full);
  renderer.setSize(width, height, false);
  setLineResolution(width, height);
  setFrame(framing(width, height, {heading: headingOfPicture(height), player: 12}));
  setTheme();
  lookFrom(current.from);
  sharpness.isStarted = true;
  const [first, last] = (wishes.get("frames") || "").split(":").map(Number);
  if (!wishes.has("frames")) return leaveText("picture", drawnPicture(width, height));
  const pictures = [];
  data.frames.forEach((frame, k) => {
    if (frame.index < first || frame.index > last) return;
    current.frame = k;
    pictures.push(frame.index + " " + drawnPicture(width, height));
  });
  leaveText("pictures", pictures.join("\n"));
}

/// Title of the run, and below it the words for the frame and a note on its forces.
function drawHeading(context, width, heading) {
  context.font = "600 17px system-ui, sans-serif";
  if (heading > 40) drawText(context, fittingText(context, titleOfRun(), width - 32), 16, 24);
  context.font = "14px system-ui, sans-serif";
  const note = forceNote(currentFrame());
  const clock = fittingText(context, clockText(currentFrame()), width - 32);
  drawText(context, clock, 16, heading - 15);
  const free = width - 48 - context.measureText(clock).width;
  if (!note || free <= 120) return;
  context.textAlign = "right";
  drawText(context, fittingText(context, note, free), width - 12, heading - 15);
  context.textAlign = "left";
}

/// @return the present view as a PNG in base64
function drawnPicture(width, height) {
  show();
  const picture = document.createElement("canvas");
  Object.assign(picture, {width: width * sharpness.full, height: height * sharpness.full});
  const context = picture.getContext("2d");
  context.drawImage(element("canvas"), 0, 0);
  context.setTransform(sharpness.full, 0, 0, sharpness.full, 0, 0);
  drawMarks(context);
  drawHeading(context, width, headingOfPicture(height));
  return picture.toDataURL("image/png").split(",")[1];
}
