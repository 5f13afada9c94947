// Legend of the colours, drawn on the picture: a scale with round ticks, or a list of kinds.

const LEGEND_FONT = "13px system-ui, sans-serif";

/// Text that is legible on any background.
function drawText(context, text, x, y, colour = theme().text) {
  context.lineJoin = "round";
  context.lineWidth = 3;
  context.strokeStyle = theme().background;
  context.strokeText(text, x, y);
  context.fillStyle = colour;
  context.fillText(text, x, y);
}

/// Text wrapped to a width in pixels, unless a word is wider. @return position of the next line
function drawWrapped(context, text, x, y, width) {
  let line = "";
  for (const word of text.split(" ")) {
    const longer = line ? line + " " + word : word;
    if (line && context.measureText(longer).width > width) {
      drawText(context, fittingText(context, line, width), x, y);
      y += 16;
      line = word;
    } else line = longer;
  }
  drawText(context, fittingText(context, line, width), x, y);
  return y + 16;
}

/// @return text cut so that it is not wider than some pixels
function fittingText(context, text, width) {
  if (context.measureText(text).width <= width) return text;
  let length = text.length;
  while (length > 1 && context.measureText(text.slice(0, length) + "…").width > width) length -= 1;
  return text.slice(0, length) + "…";
}

function gradientOf(context, field, from, to) {
  const gradient = context.createLinearGradient(...from, ...to);
  const stops = stopsOf(field);
  stops.forEach((colour, k) => gradient.addColorStop(k / (stops.length - 1), colour));
  return gradient;
}

/// Unit of a scale and its ticks: [{share of the way up, text}].
function scaleOf(field, range, about) {
  const unit = unitFor(field.unit, Math.max(Math.abs(range[0]), Math.abs(range[1])));
  const [low, high] = range.map((value) => value / unit.factor);
  const ticks = roundTicks(low, high, about);
  return {unit: unit.name, ticks: ticks.map((tick) => ({share: (tick - low) / (high - low), text: tickText(tick, ticks)}))};
}

const scaleTitle = (field, range) => labelOf(field, currentFrame()) + (field.unit ? " (" + scaleOf(field, range, 5).unit + ")" : "");

function drawUprightScale(context, field, range, {x, y, width, height}) {
  const below = drawWrapped(context, scaleTitle(field, range), x, y + 12, width);
  const [top, bottom] = [below - 2, y + height - 8];
  context.fillStyle = gradientOf(context, field, [0, bottom], [0, top]);
  context.fillRect(x, top, 16, bottom - top);
  for (const {share, text} of scaleOf(field, range, Math.max(2, Math.min(6, (bottom - top) / 28))).ticks) {
    const at = bottom + (top - bottom) * share;
    context.fillStyle = theme().text;
    context.fillRect(x + 13, Math.round(at) - 0.5, 5, 1);
    drawText(context, text, x + 22, at + 4);
  }
}

function drawFlatScale(context, field, range, {x, y, width}) {
  drawText(context, fittingText(context, scaleTitle(field, range), width), x, y + 12);
  context.fillStyle = gradientOf(context, field, [x, 0], [x + width, 0]);
  context.fillRect(x, y + 18, width, 9);
  context.textAlign = "center";
  for (const {share, text} of scaleOf(field, range, width / 80).ticks) {
    const half = 0.5 * context.measureText(text).width;
    context.fillStyle = theme().text;
    context.fillRect(Math.round(x + share * width) - 0.5, y + 24, 1, 5);
    drawText(context, text, Math.min(Math.max(x + share * width, x + half), x + width - half), y + 41);
  }
  context.textAlign = "left";
}

/// A bar of a colour and the quantity of its length, below it. @return place of the next item
function drawLengthKind(context, {name, colour, bar}, {x, y}) {
  context.fillStyle = colour;
  context.fillRect(x, y + 4, bar, 4);
  drawText(context, name, x, y + 22);
  return y + 32;
}

const SMALL_SCALE = 100;

/// A small scale from the least to the largest value, below its name. @return place of the next item
function drawSmallScale(context, {name, scale: {field, range}}, {x, y, width}) {
  const below = drawWrapped(context, name, x, y + 13, width) - 10;
  context.fillStyle = gradientOf(context, field, [x, 0], [x + SMALL_SCALE, 0]);
  context.fillRect(x, below, SMALL_SCALE, 8);
  drawText(context, short(range[0] / unitFor(field.unit, range[1]).factor) + " to " + quantity(range[1], field.unit), x, below + 22);
  return below + 32;
}

/// Names with a mark of their colour, one below the other. @return position of the next item
function drawKinds(context, kinds, {x, y, width}) {
  for (const {name, colour, bar, scale} of kinds) {
    if (bar || scale) {
      y = bar ? drawLengthKind(context, {name, colour, bar}, {x, y}) : drawSmallScale(context, {name, scale}, {x, y, width});
      continue;
    }
    if (colour) {
      context.fillStyle = colour;
      context.fillRect(x, y + 2, 12, 12);
    }
    y = drawWrapped(context, name, x + (colour ? 18 : 0), y + 13, width - 18) - 10;
  }
  return y;
}

/// The same side by side, in as many lines as are needed.
function drawKindsInLines(context, kinds, {x, y, width}) {
  let at = x;
  for (const {name, colour: plain, bar, scale} of kinds) {
    const mark = scale ? 60 : bar || 12;
    const words = scale ? name + ", " + short(scale.range[0]) + " to " + quantity(scale.range[1], scale.field.unit) : name;
    const text = fittingText(context, words, width - mark - 6);
    const colour = plain || scale !== undefined;
    const size = context.measureText(text).width + (colour ? mark + 4 : 0);
    if (at > x && at + size > x + width) [at, y] = [x, y + 18];
    if (colour) {
      context.fillStyle = scale ? gradientOf(context, scale.field, [at, 0], [at + mark, 0]) : plain;
      context.fillRect(at, y + (bar ? 6 : 2), mark, bar ? 4 : 12);
    }
    drawText(context, text, at + (colour ? mark + 4 : 0), y + 13);
    at += size + 12;
  }
}

/// Kinds of blocks, as many as fit.
function categoryKinds(field, most) {
  if (field.plain) return [];
  const kinds = [...new Set(data.blocks.filter((block) => !block.absent).map((block) =>
    field.category(data.blocks.indexOf(block))))].sort((a, b) => a - b);
  const shown = kinds.slice(0, most).map((kind) =>
    ({name: field.name(kind), colour: categoryColour(field, kind).getStyle()}));
  if (kinds.length > most) shown.push({name: "and " + (kinds.length - most) + " more"});
  return shown;
}

/// Legend of the picture: a scale {field, range} if there is one, and kinds {name, colour}.
function legendParts(frame, most) {
  const scales = [], kinds = [];
  const field = mainField();
  if (field.kinds) {
    const states = new Set(field.of(frame.joints));
    field.kinds.forEach((name, k) => { if (states.has(k)) kinds.push({name: name + " joints", colour: STATE_COLOURS[k]}); });
  } else if (isWhole(field)) kinds.push(...categoryKinds(field, most));
  else scales.push({field, range: rangeOf(field, frame)});
  if (sectionIsPartlyGrey(blockField()))
    kinds.push({name: "cut, order > 1: no values inside", colour: INSIDE_COLOUR});
  kinds.push(...forceKinds(frame), ...actionKinds(frame), ...vectorKinds());
  return {scales, kinds};
}

/// @param area pixels that the scene leaves free: on the left, or above it in a narrow picture (area.flat)
function drawLegend(context, frame, area) {
  context.font = LEGEND_FONT;
  context.textAlign = "left";
  const {scales, kinds} = legendParts(frame, Math.max(1, Math.floor(area.height / 19) - 2));
  const [scale] = scales;
  if (area.flat) {
    if (scale) drawFlatScale(context, scale.field, scale.range, area);
    drawKindsInLines(context, kinds, {...area, y: area.y + (scale ? 48 : 0)});
    return;
  }
  const below = kinds.reduce((sum, {bar, scale: small, name}) =>
    sum + (bar ? 32 : small ? 48 : context.measureText(name).width > area.width - 18 ? 38 : 22), 0);
  const height = Math.min(area.height - Math.min(below, 0.5 * area.height), 300);
  if (scale) drawUprightScale(context, scale.field, scale.range, {...area, height});
  drawKinds(context, kinds, {...area, y: area.y + (scale ? height + 4 : 0)});
}
