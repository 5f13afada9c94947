"""Fragility analyses, as by `ashlar fragility`."""

import csv
import json
import pathlib

import numpy

from ._pictures import _command


def _numbers(values):
    """An array of numbers, nan where there is none; texts if one is no number."""
    try:
        return numpy.array([float(value) if value else numpy.nan for value in values])
    except ValueError:
        return numpy.array(values, dtype=object)


class Fragility:
    """Results of a fragility analysis: its runs, and the curve of each limit.

    runs: columns of fragility.csv by name, an array each. limits: for each limit a dictionary of fragility.json with limit,
    median, dispersion, confidence, fit, curve. median, dispersion, confidence are those of the first limit; None where there is none.
    """

    def __init__(self, folder):
        """folder: the results of `ashlar fragility`."""
        self.folder = pathlib.Path(folder)
        self.results = json.loads((self.folder / "fragility.json").read_text(encoding="utf-8"))
        with open(self.folder / "fragility.csv", newline="", encoding="utf-8") as table:
            names, *rows = list(csv.reader(table))
        self.runs = {name: _numbers(column) for name, column in zip(names, zip(*rows))}
        self.limits = self.results["limits"]

    @property
    def median(self):
        return self.results["median"]

    @property
    def dispersion(self):
        return self.results["dispersion"]

    @property
    def confidence(self):
        return self.results["confidence"]

    def to_pandas(self):
        """A pandas.DataFrame with a row for each run. Raises ImportError without pandas."""
        import pandas  # type: ignore[import]
        return pandas.DataFrame(self.runs)

    def curve(self, limit=0):
        """Arrays of the fitted curve: intensity, probability, low, high; empty without a fit. limit: its number or text."""
        found = next((one for number, one in enumerate(self.limits) if limit in (number, one["limit"])), None)
        if found is None:
            raise KeyError(f"no limit {limit!r}, one of {[one['limit'] for one in self.limits]} is needed")
        return {name: numpy.array([numpy.nan if point[name] is None else point[name] for point in found["curve"]])
                for name in ("intensity", "probability", "low", "high")}

    def _repr_svg_(self):
        picture = self.folder / "fragility.svg"
        return picture.read_text(encoding="utf-8") if picture.exists() else None

    def __repr__(self):
        return "\n".join(f"{one['limit']}: {one['meaning']}" for one in self.limits)


def fragility(scene, records, scales, limits=("collapse",), out=None, intensity="pga", vary=None, samples=None, seed=None,
              confidence=None, after=None, jobs=None, frames=False, overrides=(), force=False):
    """Runs a scene with each record of a folder at each scale, and fits a fragility curve to each limit.

    scene: a path. records: a folder. scales: factors, or a text "0.1:0.1:1.0". limits: texts as "storey.drift > 0.02", one or
    several. vary: random values by key, {"contact.friction_angle": "normal(32, 2)"}, with samples. The other arguments
    are the options of `ashlar fragility`. A repeated call keeps runs and continues others.
    Returns a Fragility. Raises ValueError for wrong arguments, RuntimeError if runs fail; what has run is kept.
    """
    folder = pathlib.Path(out) if out is not None else pathlib.Path(f"{pathlib.Path(scene).stem}.fragility")
    listed = scales if isinstance(scales, str) else ",".join(repr(float(scale)) for scale in scales)
    arguments = ["fragility", str(scene), "--records", str(records), "--scales", listed, "--out", str(folder),
                 "--intensity", intensity, "--quiet"]
    for limit in [limits] if isinstance(limits, str) else limits:
        arguments += ["--limit", limit]
    for key, value in (vary or {}).items():
        arguments += ["--vary", f"{key}={value}"]
    for override in [overrides] if isinstance(overrides, str) else overrides:
        arguments += ["--set", override]
    for name, value in (("samples", samples), ("seed", seed), ("confidence", confidence), ("after", after), ("jobs", jobs)):
        if value is not None:
            arguments += [f"--{name}", str(value)]
    arguments += ["--frames"] * bool(frames) + ["--force"] * bool(force)
    _command(arguments)
    return Fragility(folder)
