"""For notebooks: texts, tables with units, pages and pictures."""
import shutil
import sys

import pytest

import ashlar

from test_simulation import CUBE, scene


def test_a_simulation_says_what_it_is():
    sim = scene().simulation()
    assert repr(sim).endswith("scene.toml: running after 0 steps, t = 0 s, 2 blocks>")
    sim.run(until=0.01)
    assert "running after 10 steps, t = 0.01 s" in repr(sim)


def test_columns_have_units():
    values = dict(CUBE, measure=[{"name": "corner", "block": "cube", "point": [1, 1, 1]}, {"name": "whole", "block": "cube"},
                                 {"name": "bed", "pair": ["floor", "cube"]}, {"name": "width", "crack": {}},
                                 {"name": "storey", "drift": {"blocks": ["cube"], "heights": [0.2, 0.8]}}])
    history = ashlar.Scene.from_dict(values).simulation().history
    assert isinstance(history, dict) and all(history.units.values())
    for column, unit in (("time", "s"), ("corner.x", "m"), ("corner.uz", "m"), ("corner.vz", "m/s"), ("whole.rx", "degrees"),
                         ("corner.sxx", "Pa"), ("bed.normal_force", "N"), ("bed.area", "m^2"), ("width.mean_opening", "m"),
                         ("storey.drift", "1"), ("energy.kinetic", "J"), ("momentum.x", "N s"), ("contacts.open", "1")):
        assert history.units[column] == unit, column
    assert "columns of 1 values" in repr(history)


def test_a_history_shows_its_columns():
    sim = scene().simulation()
    sim.run(until=0.005)
    assert "<tr><td>time</td><td>s</td><td>0</td><td>0.005</td></tr>" in sim.history._repr_html_()


def test_a_history_becomes_a_table():
    pandas = pytest.importorskip("pandas")
    sim = scene().simulation()
    sim.run(until=0.005)
    table = sim.history.to_pandas()
    assert isinstance(table, pandas.DataFrame) and list(table.index) == [0, 1, 2, 3, 4, 5]
    assert table["time"].iloc[-1] == pytest.approx(0.005) and table.attrs["units"]["time"] == "s"
    assert "time (s)" in sim.history.to_pandas(units=True)


def test_a_tie_bears_the_weight_below_it():
    # A cube of 2000 kg hangs in no contact from a prop that pulls: 20 kN in it, once the fall has ended (statics).
    values = {"analysis": {"type": "static", "gravity": [0, 0, -10]}, "material": CUBE["material"],
              "block": [{"name": "roof", "fixed": True, "box": {"min": [0, 0, 3], "max": [1, 1, 4]}},
                        {"name": "cube", "material": "stone", "box": {"min": [0, 0, 0], "max": [1, 1, 1]},
                         "fix": [{"plane": {"point": [0, 0, 0], "normal": [1, 0, 0]}, "components": ["x", "y"]}]}],
              "prop": [{"name": "tie", "from": [0.5, 0.5, 3], "to": [0.5, 0.5, 1], "stiffness": 1e8, "tension": True}]}
    sim = ashlar.Scene.from_dict(values).simulation()
    sim.run()
    assert list(sim.bolts) == ["tie"]
    assert sim.bolts["tie"].axial_force == pytest.approx(20e3, rel=1e-6)
    assert sim.bolts["tie"].state == "elastic"


def test_blocks_have_places():
    cube = ashlar.blocks(scene(), places=True)["blocks"][1]
    assert cube["centroid"] == [0.5, 0.5, 0.5] and cube["box"] == {"min": [0, 0, 0], "max": [1, 1, 1]}
    assert "centroid" not in ashlar.blocks(scene(), places=False)["blocks"][1]


def test_a_scene_shows_itself():
    shown = ashlar.Scene.from_dict(dict(CUBE, title="Stone & floor"))._repr_html_()
    table = shown[:shown.index("<iframe")]
    assert "<b>Stone &amp; floor</b>" in table and "dynamic, 0.5 s in steps of 0.001 s" in table
    # A cube of 1 m^3 and 2000 kg/m^3, of order 1.
    assert "1 free, 1 fixed; order 1; 2000 kg" in table and "stone: 2000 kg/m\N{SUPERSCRIPT THREE}" in table


def test_a_scene_shows_its_blocks_as_placed():
    """Without the equilibrium of its start, which may take long."""
    found = scene(initial_state="static")
    top = [[0.5, 0.5, 1]]
    # Its weight shortens the cube by rho g h^2 / (2 E) = 1e-5 m, one of order 1 by its mean strain: as much.
    assert found.simulation().blocks["cube"].displacements(top)[0, 2] == pytest.approx(-1e-5, rel=0.01)
    assert found._placed().blocks["cube"].displacements(top)[0, 2] == 0
    assert "<iframe" in found._repr_html_() and found.show(height=200).height == 200


def test_a_run_has_a_progress_bar(capsys):
    pytest.importorskip("tqdm")
    sim = scene().simulation()
    assert sim.run(until=0.1) == "running"
    assert capsys.readouterr().err == "", "none outside a notebook"
    assert sim.run(until=0.2, progress=True) == "running"
    assert "0.2 of 0.2 s" in capsys.readouterr().err
    statics = ashlar.Scene.from_dict({**CUBE, "analysis": {"type": "static"}}).simulation()
    statics.run(progress=True)
    assert f"{statics.steps} steps" in capsys.readouterr().err


def test_a_progress_bar_needs_tqdm(monkeypatch):
    for name in ("tqdm", "tqdm.std", "tqdm.notebook"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ImportError):
        scene().simulation().run(until=0.01, progress=True)


def test_a_notebook_shows_the_page():
    shown = scene().simulation().show(height=300)
    assert shown.html.startswith("<!DOCTYPE html>") and "300px" in shown._repr_html_()
    assert "<script" not in shown._repr_html_(), "the page is text of an attribute"


def test_any_state_has_a_page(tmp_path):
    """Frames are due every few steps only."""
    sim = scene().simulation()
    for _ in range(3):
        sim.step()
        sim.write(tmp_path / "out")
        assert (tmp_path / "out" / "blocks.pvd").read_text().count("<DataSet") == 1
        assert sim.summary["frames"] == 0, "frames of a folder that the simulation records into"
    assert sim.show().html.startswith("<!DOCTYPE html>")


@pytest.mark.skipif(not any(map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), reason="no browser")
def test_a_picture_is_a_png(tmp_path):
    sim = scene().simulation()
    png = sim.picture(size="320x200", color="block", view="front")
    assert png[:8] == b"\x89PNG\r\n\x1a\n" and int.from_bytes(png[16:20], "big") == 320
    assert sim.picture(tmp_path / "cube.png", size="320x200") == tmp_path / "cube.png"
    with pytest.raises(ValueError, match="malformed size"):
        sim.picture(size="big")
