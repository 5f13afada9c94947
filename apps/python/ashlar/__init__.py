"""Ashlar: high-order 3-D discontinuous deformation analysis.

    import ashlar
    scene = ashlar.Scene.load("slope.toml")
    sim = scene.simulation(threads=2)
    sim.run(until=0.5)
    print(sim.history["time"][-1], sim.blocks["stone"].positions([[0, 0, 0]]))

Units are SI, angles degrees, arrays are numpy's. Points of a block are those of the placed, undeformed block. Other Python
threads run while Ashlar computes, and Ctrl-C ends a run between two steps.
"""

import collections as _collections
import json as _json
import os as _os
import pathlib as _pathlib
import sys as _sys
import tempfile as _tempfile

try:
    import numpy as _numpy
except ModuleNotFoundError as _fault:
    raise ImportError(f"ashlar needs numpy, which this Python has not ({_sys.executable}): the one of Debian, /usr/bin/python3, "
                      "has it with the package python3-numpy") from _fault

from . import _core
from . import _notebook
from . import keys
from ._fragility import Fragility, fragility
from ._history import History
from ._pictures import Page, page, picture
from ._toml import to_toml as _to_toml

__version__ = _core.version.split()[1] if len(_core.version.split()) > 1 else _core.version
__all__ = ["Block", "Bolt", "Fragility", "History", "Page", "Scene", "SceneError", "Simulation", "blocks", "contacts",
           "fragility", "integrate", "keys", "page", "picture", "run", "schema"]


Block = _core.Block

Bolt = _collections.namedtuple("Bolt", ["axial_force", "shear_force", "state"])
Bolt.__doc__ = """A bolt or prop: its largest axial force by amount (N, tension positive), its largest shear force at a joint (N),
and its worst state so far, a word as in summary.json. Forces are nan before it is installed."""


class SceneError(ValueError):
    """A scene has errors. `faults`: a list of dictionaries with file, line, column, message and severity."""

    def __init__(self, faults):
        self.faults = [fault for fault in faults if fault["severity"] == "error"]
        super().__init__("\n".join(
            f"{fault['file']}:{fault['line']}:{fault['column']}: {fault['message']}" for fault in self.faults))

    def __reduce__(self):
        return (SceneError, (self.faults,))


class Scene:
    """A checked scene, created by Scene.load, by Scene.from_dict or from tables; can be pickled.

        ashlar.Scene(analysis=keys.Analysis(type="static"), material=[keys.Material(name="rock", ...)], block=[...])

    tables: keys of a scene with tables of ashlar.keys or dictionaries; None is left out. text: a scene as TOML, in place of
    tables. file: its name, for messages and as base of relative paths. Raises SceneError.
    """

    def __init__(self, text=None, file="scene.toml", overrides=(), **tables):
        if (text is None) == (not tables):
            raise TypeError("a scene is made from its text or from tables: one of both is needed")
        if text is None:
            text = _to_toml(keys.to_dict({key: value for key, value in tables.items() if value is not None}))
        if isinstance(overrides, str):
            raise TypeError('overrides are a list of texts "key.path=value", not one text')
        self._text, self._file, self._overrides = text, str(file), list(overrides)
        self._core = _core.load(text, self._file, self._overrides)
        if not self._core.good:
            raise SceneError(self._core.faults())

    @classmethod
    def load(cls, path, overrides=()):
        """Reads a scene file. overrides: texts "key.path=value", as of --set. Raises SceneError, OSError."""
        return cls(_pathlib.Path(path).read_text(encoding="utf-8"), path, overrides)

    @classmethod
    def from_dict(cls, values, folder="."):
        """A scene from a dictionary with the keys of a scene file, or with tables of ashlar.keys. Numpy arrays and tuples are accepted as lists, numpy
        numbers as numbers, paths as texts.

        folder: base of relative paths of the scene. Raises SceneError, whose lines are those of `text`; TypeError or
        ValueError, with the key ("block.0.box.min"), for values that a scene file cannot have, such as None.
        """
        return cls(_to_toml(keys.to_dict(values)), _os.path.join(str(folder), "scene.toml"))

    @property
    def text(self):
        """The scene as TOML."""
        return self._text

    @property
    def warnings(self):
        """Warnings of implausible values, in the form of SceneError.faults."""
        return self._core.faults()

    def to_dict(self):
        """The scene as used: every key, with defaults."""
        return _json.loads(self._core.json())

    def simulation(self, threads=1, resume=None):
        """A simulation at its start. It passes through all stages of a staged analysis. The search of a scene that seeks a
        factor, thrust or movements (analysis.type) is performed by the first steps; `summary` has the answer.

        resume: the result folder of an earlier run of this scene (`record`, `ashlar run`), which is continued from its
        checkpoint, into the same folder; the history begins there. Raises ValueError or RuntimeError if it cannot be.
        """
        return Simulation(self, threads, resume)

    def picture(self, path=None, **options):
        """Draws the blocks as placed: see ashlar.picture. Returns the PNG as bytes, or the path it is written to."""
        return self._placed().picture(path, **options)

    def show(self, height=640):
        """The page of the blocks as placed, which a notebook shows: see ashlar.page."""
        return self._placed().show(height)

    def _placed(self):
        """A simulation at its start, without the equilibrium that initial_state asks for."""
        if self.to_dict()["analysis"]["initial_state"] == "as-placed":
            return self.simulation()
        return Scene(self._text, self._file, [*self._overrides, "analysis.initial_state=as-placed"]).simulation()

    def _repr_html_(self):
        try:
            simulation = self._placed()
        except (RuntimeError, ValueError):
            simulation = None
        table = _notebook.scene_table(self.to_dict(), simulation, self.warnings)
        return table if simulation is None else table + simulation.show()._repr_html_()

    def __getstate__(self):
        return self._text, self._file, self._overrides

    def __setstate__(self, state):
        self.__init__(*state)

    def __repr__(self):
        return f"<ashlar.Scene {self._file}>"


class _Blocks:
    """The blocks of a simulation by name."""

    def __init__(self, core):
        self._core = core

    def __getitem__(self, name):
        return self._core.block(name)

    def __iter__(self):
        return iter(self._core.names())

    def __len__(self):
        return len(self._core.names())

    def __contains__(self, name):
        return name in self._core.names()

    def keys(self):
        """Names, in the order of the scene."""
        return self._core.names()


class Simulation:
    """A run, step by step, created by Scene.simulation."""

    def __init__(self, scene, threads=1, resume=None):
        self._scene = scene
        self._core = _core.simulation(scene._core, threads, None if resume is None else str(resume))

    def step(self):
        """Takes one step, or one iteration of a static analysis or of a search. Returns False at the end of the run.

        Raises RuntimeError if the step fails: the state is then that before the step and can be read and written, the
        status is failed, and each further call raises the same again.
        """
        return self._core.step()

    def run(self, until=None, callback=None, progress=None):
        """Steps until a time (s), or to the end. callback(simulation) is called after each step; the run stops if it
        returns False. progress: True shows a bar (tqdm), False none; None: one in a notebook where tqdm is there.
        Returns the status. Raises RuntimeError like step, ImportError if a bar is asked for without tqdm."""
        if until is not None and until != until:
            raise ValueError(f"until is no time ({until}), s are needed")
        if self.status == "failed":
            self._core.step()
        with _notebook.progress_bar(self, self._scene.to_dict, until, progress) as bar:
            while self.status == "running" and (until is None or self.time < until * (1 - 1e-12)):
                self._core.step()
                bar.update()
                may_continue = callback(self) if callback is not None else None
                # numpy's False is not the same object as Python's.
                if may_continue is not None and not may_continue:
                    break
        return self.status

    @property
    def status(self):
        """running, completed, failed; of a static analysis running, equilibrium, moving, not converged."""
        return self._core.status

    @property
    def time(self):
        """Time in the present stage, s."""
        return self._core.time

    @property
    def steps(self):
        """Number of accepted steps."""
        return self._core.steps

    @property
    def history(self):
        """The columns of history.csv by name: a History, numpy arrays with a value for the start and each step. Its `units`
        and to_pandas() name their units."""
        return History(self._core.history(), _json.loads(self._core.history_units()))

    @property
    def blocks(self):
        """Blocks by name: simulation.blocks["name"]; those of all stages (see Block.present)."""
        return _Blocks(self._core)

    @property
    def bolts(self):
        """Bolts and props by name: {"bolt.1": Bolt(axial_force, shear_force, state)}; those of all stages."""
        return {name: Bolt(*values) for name, *values in self._core.bolts()}

    @property
    def message(self):
        """The motion found, or the reason of a failure; may be empty."""
        return self._core.message

    @property
    def summary(self):
        """The content of summary.json for the present state, a dictionary; after a search with factor_of_safety, load_factor
        or thrust. status is interrupted before the end of the run."""
        return _json.loads(self._core.summary())

    @property
    def error(self):
        """Estimated error, `error` of summary.json: of the orders of blocks {"estimate", "by", "blocks", ...}, in an
        equilibrium of a static analysis also "measures", by name, or with analysis.accuracy {"accuracy", "estimate", "by",
        "measures", "orders", ..., "advice"}; None where nothing is estimated. Orders of all blocks are estimated here, which
        may take longer than the run; those of the summary take at most 5 % of it."""
        return _json.loads(self._core.errors())

    @property
    def stage(self):
        """Number of the present stage, from 1; 0 for a scene without stages."""
        return self._core.stage

    def set_load_factor(self, block, load, factor):
        """Multiplies a load of a block by a factor on top of its history, from the next step on.

        load: its number among the [[block.load]] of the block, from 0. Raises KeyError, IndexError, ValueError.
        """
        self._core.set_load_factor(block, load, factor)

    def contacts(self):
        """The contact points of the last step as a structured array: a, b (numbers of the blocks), place, normal, force on
        a (3 each; m, 1, N), gap (m), area (m^2), type, state (0 open, 1 locked, 2 sliding)."""
        return self._core.contacts()

    def record(self, folder):
        """Writes each further step into a new result folder, as `ashlar run` does: frames as output asks, checkpoints, and
        the summary at the end."""
        self._core.record(str(folder))

    def write(self, folder):
        """Writes the history, the present state and a summary as a result folder; replaces an existing one."""
        self._core.write(str(folder))

    def picture(self, path=None, **options):
        """Draws the present state: see ashlar.picture. Returns the PNG as bytes, or the path it is written to."""
        with _tempfile.TemporaryDirectory() as folder:
            self.write(folder)
            return picture(folder, path, **options)

    def show(self, height=640, relative_to=None):
        """The page of the present state and the history, which a notebook shows: see ashlar.page."""
        with _tempfile.TemporaryDirectory() as folder:
            self.write(folder)
            return page(folder, height, relative_to)

    def _repr_html_(self):
        return self.show()._repr_html_()

    def __repr__(self):
        count = len(self.blocks)
        stage = f" of stage {self.stage}" if self.stage else ""
        return (f"<ashlar.Simulation {self._scene._file}: {self.status} after {self.steps} steps, t = {self.time:.6g} s{stage}, "
                f"{count} block{'' if count == 1 else 's'}>")


def run(scene, out, overrides=(), threads=1, resume=False, force=False):
    """Runs a scene (a path or a Scene) like `ashlar run`. Returns the summary, a dictionary.

    Raises ValueError for bad input, RuntimeError for a failed run (its summary is in the folder), KeyboardInterrupt.
    """
    if threads < 1:
        raise ValueError(f"threads are too few ({threads}), 1 or more are needed")
    file, text = scene, None
    if isinstance(scene, Scene):
        file, text, overrides = scene._file, scene._text, [*scene._overrides, *overrides]
    # To the program "-" is standard input.
    file = _os.path.join(".", "-") if str(file) == "-" else str(file)
    status, told = _core.run(file, text, str(out), list(overrides), threads, resume, force)
    if status == 2:
        raise ValueError(told)
    if status == 130:
        raise KeyboardInterrupt(told)
    if status != 0:
        raise RuntimeError(told)
    return _json.loads((_pathlib.Path(out) / "summary.json").read_text(encoding="utf-8"))


def _mesh_file(mesh, folder, name):
    """The path of a mesh: the given path, or that of a pair (points (n, 3), triangles (m, 3)) written as OFF."""
    if isinstance(mesh, (str, _os.PathLike)):
        return str(mesh)
    points, triangles = (_numpy.asarray(part) for part in mesh)
    lines = [f"OFF\n{len(points)} {len(triangles)} 0"]
    lines += [" ".join(repr(float(x)) for x in point) for point in points]
    lines += ["3 " + " ".join(str(int(i)) for i in triangle) for triangle in triangles]
    path = _os.path.join(folder, name)
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")
    return path


def contacts(a, b):
    """The exact contact report of two meshes, as by `ashlar contacts --json`. a, b: paths, or (points, triangles)."""
    with _tempfile.TemporaryDirectory() as folder:
        return _json.loads(_core.contacts(_mesh_file(a, folder, "a.off"), _mesh_file(b, folder, "b.off")))


def integrate(mesh, degree):
    """The integrals of x^i y^j z^k over a solid, i + j + k <= degree: {(i, j, k): value}, each the exact value rounded
    once. mesh: a path, or (points, triangles)."""
    with _tempfile.TemporaryDirectory() as folder:
        moments = _json.loads(_core.integrate(_mesh_file(mesh, folder, "mesh.off"), degree))["moments"]
    return {(entry["a"], entry["b"], entry["c"]): entry["value"] for entry in moments}


def blocks(scene, places=True):
    """The blocks of a scene (a path or a Scene): volumes, neighbours, areas, as by `ashlar blocks --json`.

    places: True adds centroid ([x, y, z], m) and box ({"min", "max"}, m) of each block.
    """
    if not isinstance(scene, Scene):
        scene = Scene.load(scene)
    report = _json.loads(scene._core.blocks_json())
    for block in [] if places else report["blocks"]:
        del block["centroid"], block["box"]
    return report


def schema():
    """The JSON schema of scenes, a dictionary."""
    return _json.loads(_core.schema())
