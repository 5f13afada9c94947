"""The history of a run: columns with their units."""

import html
import re

# Units of columns by the ends of their names, the first match counts; results.md describes the columns.
_UNITS = [
    (r"^(time|dt)$", "s"), (r"^energy\.", "J"), (r"^momentum\.", "N s"), (r"^angular_momentum\.", "N m s"),
    (r"^penetration\.", "m"), (r"^(step|stage|open_close\.iterations)$|^contacts\.", "1"),
    (r"\.drift(_[xyz])?$|\.state$", "1"), (r"\.(area|open_area)$", "m^2"), (r"_force$", "N"),
    (r"\.(opening|slip|largest_opening|mean_opening|largest_slip|u?[xyz])$", "m"), (r"\.v[xyz]$", "m/s"),
    (r"\.r[xyz]$", "degrees"), (r"\.s(xx|yy|zz|xy|yz|xz)$", "Pa"),
]


def unit_of(column):
    """The unit of a column of history.csv: "m", "N", "1" for numbers without one; "" for a name that is none."""
    return next((unit for pattern, unit in _UNITS if re.search(pattern, column)), "")


class History(dict):
    """The columns of history.csv by name: numpy arrays with a value for the start and each step."""

    @property
    def units(self):
        """Unit of each column by name."""
        return {name: unit_of(name) for name in self}

    def to_pandas(self, units=False):
        """A pandas.DataFrame of all columns, indexed by step; attrs["units"] has their units.

        units: True writes them into the names of the columns: "tip.uz (m)". Raises ImportError without pandas.
        """
        import pandas  # type: ignore[import]
        frame = pandas.DataFrame({name: values for name, values in self.items() if name != "step"},
                                 index=pandas.Index(self["step"].astype(int), name="step"))
        if units:
            frame = frame.rename(columns={name: f"{name} ({unit_of(name)})" for name in frame.columns})
        frame.attrs["units"] = {name: unit_of(name) for name in self}
        return frame

    def _repr_html_(self):
        """Columns with units, and their first and last values."""
        rows = "".join(f"<tr><td>{html.escape(name)}</td><td>{html.escape(unit_of(name))}</td>"
                       f"<td>{values[0]:.6g}</td><td>{values[-1]:.6g}</td></tr>" for name, values in self.items() if len(values))
        return f"<table><tr><th>column</th><th>unit</th><th>first</th><th>last</th></tr>{rows}</table>"

    def __repr__(self):
        rows = len(next(iter(self.values()), ()))
        return f"<ashlar.History: {len(self)} columns of {rows} values: {', '.join(self)}>"
