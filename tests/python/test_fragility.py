"""Fragility analyses from Python."""
import math

import ashlar
import numpy as np
import pytest

SCENE = """
analysis = { end_time = 0.1, time_step = 1e-3 }
contact = { friction_angle = 30 }
material = [{ name = "rock", density = 2000, young_modulus = 1e9, poisson_ratio = 0.2 }]
measure = [{ name = "table", block = "table", point = [0, 0, 0] }]
[[block]]
name = "table"
material = "rock"
box = { min = [-1, -1, -0.2], max = [1, 1, 0] }
[[block.fix]]
plane = { point = [0, 0, 0], normal = [0, 0, 1] }
acceleration_history = { file = "any.csv", time = "t", values = ["a", "", ""] }
[[block.fix]]
plane = { point = [0, 0, -0.2], normal = [0, 0, 1] }
acceleration_history = { file = "any.csv", time = "t", values = ["a", "", ""] }
[[block]]
name = "cube"
material = "rock"
order = 0
box = { min = [5, 0, 0], max = [6, 1, 1] }
"""


@pytest.fixture(name="scene")
def scene_of_records(tmp_path):
    (tmp_path / "scene.toml").write_text(SCENE)
    (tmp_path / "records").mkdir()
    for name, value in (("a", 1), ("b", 2)):
        (tmp_path / "records" / f"{name}.csv").write_text(f"t,a\n0,{value}\n0.1,{value}\n")
    return tmp_path / "scene.toml"


def test_runs_and_curves(scene, tmp_path):
    # The table moves by a s t^2 / 2, 0.005 a s at the end: by more than 0.0151 from 4 m/s^2 on, not with 3.
    result = ashlar.fragility(scene, tmp_path / "records", [1, 2, 3, 4], limits=["table.ux > 0.0151", "collapse"],
                              out=tmp_path / "out", after=0, jobs=1)
    assert result.median == pytest.approx(math.sqrt(12.0))
    assert result.dispersion is None
    assert result.confidence["median"] == [pytest.approx(3.0), pytest.approx(4.0)]
    assert [one["fit"] for one in result.limits] == ["separated", "all survive"]
    assert list(result.runs["record"]) == 4 * ["a.csv"] + 4 * ["b.csv"]
    assert np.array_equal(result.runs["pga"], [1, 2, 3, 4, 2, 4, 6, 8])
    assert np.array_equal(result.runs["table.ux > 0.0151"], result.runs["pga"] > 3.5)
    assert result.curve("collapse")["intensity"].size == 0
    assert "median between 3 and 4" in repr(result)
    with pytest.raises(KeyError, match="no limit 2"):
        result.curve(2)
    assert ashlar.Fragility(tmp_path / "out").median == result.median


def test_data_frame(scene, tmp_path):
    pandas = pytest.importorskip("pandas")
    result = ashlar.fragility(str(scene), str(tmp_path / "records"), "1:1:2", out=tmp_path / "out", after=0, jobs=1)
    frame = result.to_pandas()
    assert isinstance(frame, pandas.DataFrame)
    assert len(frame) == 4
    assert frame["collapse"].sum() == 0


def test_faults_are_exceptions(scene, tmp_path):
    with pytest.raises(ValueError, match="there is no such folder"):
        ashlar.fragility(scene, tmp_path / "none", [1])
