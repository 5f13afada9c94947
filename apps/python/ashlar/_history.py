"""The history of a run: columns with their units."""

import html

# Names of columns in earlier versions.
_FORMER = {"energy.refound_gained": "energy.redetection_gained", "energy.refound_lost": "energy.redetection_lost"}


class History(dict):
    """The columns of history.csv by name: numpy arrays with a value for the start and each step."""

    def __init__(self, columns, about):
        """columns: arrays by name. about: {"unit", "measure", "group", "meaning"} of each, as in history.units.json."""
        super().__init__(columns)
        self.about = about

    def __missing__(self, name):
        if name not in _FORMER:
            raise KeyError(name)
        import warnings
        warnings.warn(f"the column {name} is called {_FORMER[name]} now", DeprecationWarning, stacklevel=2)
        return self[_FORMER[name]]

    def _unit(self, name):
        return self.about.get(name, {}).get("unit", "")

    @property
    def units(self):
        """Unit of each column by name: "m", "N", "1" for numbers without one."""
        return {name: self._unit(name) for name in self}

    def to_pandas(self, units=False):
        """A pandas.DataFrame of all columns, indexed by step; attrs["units"] has their units.

        units: True writes them into the names of the columns: "tip.uz (m)". Raises ImportError without pandas.
        """
        import pandas  # type: ignore[import]
        frame = pandas.DataFrame({name: values for name, values in self.items() if name != "step"},
                                 index=pandas.Index(self["step"].astype(int), name="step"))
        if units:
            frame = frame.rename(columns={name: f"{name} ({self._unit(name)})" for name in frame.columns})
        frame.attrs["units"] = self.units
        return frame

    def _repr_html_(self):
        """Columns with units, and their first and last values."""
        rows = "".join(f"<tr><td>{html.escape(name)}</td><td>{html.escape(self._unit(name))}</td>"
                       f"<td>{values[0]:.6g}</td><td>{values[-1]:.6g}</td></tr>" for name, values in self.items() if len(values))
        return f"<table><tr><th>column</th><th>unit</th><th>first</th><th>last</th></tr>{rows}</table>"

    def __repr__(self):
        rows = len(next(iter(self.values()), ()))
        return f"<ashlar.History: {len(self)} columns of {rows} values: {', '.join(self)}>"
