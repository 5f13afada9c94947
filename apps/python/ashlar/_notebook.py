"""For notebooks: the table of a scene, and a progress bar of a run (tqdm, as a widget where ipywidgets is)."""

import contextlib
import html
import importlib.metadata
import importlib.util
import sys


def _row(name, value):
    return f"<tr><th style='text-align: left'>{html.escape(name)}</th><td style='text-align: left'>{html.escape(value)}</td></tr>"


def _motion(analysis):
    if analysis["type"] != "dynamic":
        return analysis["type"]
    return f"dynamic, {analysis['end_time']:g} s in steps of {analysis['time_step']:g} s"


def scene_table(values, simulation, warnings):
    """A scene as a table of HTML: what is computed, its blocks and materials, and warnings.

    values: Scene.to_dict(); simulation: None if it cannot be built.
    """
    rows = [_row("analysis", _motion(values["analysis"]))]
    if simulation is not None:
        blocks = [simulation.blocks[name] for name in simulation.blocks]
        free = [block for block in blocks if not block.fixed]
        orders = sorted({block.order for block in free})
        rows.append(_row("blocks", f"{len(free)} free, {len(blocks) - len(free)} fixed; order "
                                   f"{', '.join(map(str, orders)) or '-'}; {sum(block.mass for block in free):.4g} kg"))
    rows += [_row("material", f"{one['name']}: {one['density']:g} kg/m\N{SUPERSCRIPT THREE}, "
                              f"Young's modulus {one['young_modulus']:g} Pa") for one in values["material"]]
    rows += [_row("warning", fault["message"]) for fault in warnings]
    title = html.escape(values.get("title", ""))
    return f"<b>{title}</b><table>{''.join(rows)}</table>"


def in_notebook():
    """True if a kernel runs this process."""
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    return hasattr(shell, "kernel")


def _has_widgets():
    """Older ipywidgets, as Debian 12 has them, do not work with its kernels."""
    try:
        return int(importlib.metadata.version("ipywidgets").partition(".")[0]) >= 7
    except (importlib.metadata.PackageNotFoundError, ValueError):
        return False


def _end_of(simulation, values, until):
    """The time (s) at which a run ends; None where it is not known: statics, searches, stages."""
    if values["analysis"]["type"] != "dynamic" or simulation.stage:
        return None
    end = values["analysis"]["end_time"]
    return end if until is None else min(end, until)


class _Bar:
    def __init__(self, bar, simulation, timed):
        self._bar, self._simulation, self._timed = bar, simulation, timed

    def update(self):
        if not self._timed and self._simulation.stage:
            self._bar.set_description(f"stage {self._simulation.stage}", refresh=False)
        self._bar.update((self._simulation.time if self._timed else self._simulation.steps) - self._bar.n)


class _NoBar:
    def update(self):
        pass


@contextlib.contextmanager
def progress_bar(simulation, values, until, wanted):
    """Gives an object whose update() shows the present state of a simulation.

    values: a function that returns Scene.to_dict(). wanted: True, False, or None: in a notebook, where tqdm is there.
    Raises ImportError if it is wanted and tqdm is missing.
    """
    if wanted is None:
        wanted = in_notebook() and importlib.util.find_spec("tqdm") is not None
    if not wanted:
        yield _NoBar()
        return
    if in_notebook() and _has_widgets():
        from tqdm.notebook import tqdm  # type: ignore[import]
    else:
        from tqdm.std import tqdm  # type: ignore[import]
    end = _end_of(simulation, values(), until)
    shape = "{l_bar}{bar}| {n:.4g} of {total:.4g} s [{elapsed}<{remaining}]" if end else "{desc}{n:.0f} steps [{elapsed}]"
    with tqdm(total=end, initial=simulation.time if end else simulation.steps, bar_format=shape) as bar:
        yield _Bar(bar, simulation, bool(end))
