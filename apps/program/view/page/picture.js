// Pictures for `ashlar picture` and `ashlar movie`: #picture&size=800x600&frame=3, or &frames=0:7.

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
  renderer.setPixelRatio(1);
  renderer.setSize(width, height, false);
  setLineResolution(width, height);
  setFrame(framing(width, height, {heading: 36, player: 12}));
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

/// @return the present view as a PNG in base64
function drawnPicture(width, height) {
  show();
  const picture = document.createElement("canvas");
  Object.assign(picture, {width, height});
  const context = picture.getContext("2d");
  context.drawImage(element("canvas"), 0, 0);
  drawMarks(context);
  context.font = "14px system-ui, sans-serif";
  const note = forceNote(currentFrame());
  const clock = clockText(currentFrame());
  drawText(context, clock, 16, 22);
  const free = width - 48 - context.measureText(clock).width;
  if (note && free > 120) {
    context.textAlign = "right";
    drawText(context, fittingText(context, note, free), width - 12, 22);
    context.textAlign = "left";
  }
  return picture.toDataURL("image/png").split(",")[1];
}
