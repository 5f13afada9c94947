// Numbers for readers: units of a suitable size, ticks at 1, 2, 5, few digits.

/// Engineers' units by SI unit, with the size from which each is used.
const ENGINEERING = {
  "m": [["mm", 1e-3, 0], ["m", 1, 1]],
  "N": [["N", 1, 0], ["kN", 1e3, 100], ["MN", 1e6, 1e7]],
  "Pa": [["Pa", 1, 0], ["kPa", 1e3, 100], ["MPa", 1e6, 1e5], ["GPa", 1e9, 1e10]],
  "J": [["J", 1, 0], ["kJ", 1e3, 1e4], ["MJ", 1e6, 1e7]],
};

/// @param size of the largest value to be shown. @return {name, factor}: a value over the factor is in that unit
function unitFor(unit, size) {
  if (current.units === "si" || !(unit in ENGINEERING)) return {name: unit, factor: 1};
  const fitting = ENGINEERING[unit].filter(([, , from]) => Math.abs(size) >= from);
  const [name, factor] = fitting.length > 0 ? fitting[fitting.length - 1] : ENGINEERING[unit][0];
  return {name, factor};
}

/// Four digits at most, thousands as exponents.
function short(value) {
  if (!Number.isFinite(value)) return String(value);
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e6) return String(Number(value.toPrecision(4)));
  return value.toExponential(2).replace(/\.?0*e\+?/, "e");
}

/// "12.5 mm"
function quantity(value, unit) {
  const {name, factor} = unitFor(unit, value);
  return short(value / factor) + (name ? " " + name : "");
}

const vectorText = (v) => [v.x, v.y, v.z].map(short).join(", ");

/// Round numbers between two others: whole multiples of 1, 2 or 5 times a power of ten. @param about how many
function roundTicks(low, high, about = 5) {
  const rough = (high - low) / about;
  if (!(rough > 0) || !Number.isFinite(rough)) return [low];
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= 0.75 * rough);
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) ticks.push(Number((k * step).toPrecision(12)));
  return ticks;
}

/// A tick with enough digits to distinguish it from the next one.
function tickText(tick, ticks) {
  if (tick === 0 || ticks.length < 2) return short(tick);
  const largest = Math.max(...ticks.map(Math.abs));
  const digits = Math.ceil(Math.log10(largest / Math.abs(ticks[1] - ticks[0]))) + 1;
  return digits <= 4 ? short(tick) : String(Number(tick.toPrecision(Math.min(digits, 12))));
}

/// The round number, 1, 2 or 5 times a power of ten, next below a size.
function roundBelow(size) {
  const power = 10 ** Math.floor(Math.log10(size));
  return power * [5, 2, 1].find((factor) => factor * power <= size * (1 + 1e-9));
}
