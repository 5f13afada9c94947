"""Frames of a run, read by meshio, compared with the simulation."""
import re
import xml.etree.ElementTree as ElementTree

import meshio
import numpy as np
import pytest

import ashlar


def read(frame):
    """meshio does not support texts in a file: it reads frames without the block names, their only texts."""
    copy = frame.with_suffix(".plain.vtu")
    copy.write_bytes(re.sub(rb"<FieldData>.*?</FieldData>", b"", frame.read_bytes(), count=1, flags=re.DOTALL))
    return meshio.read(copy)


def frames(folder, series):
    return [folder / item.get("file") for item in ElementTree.parse(folder / f"{series}.pvd").iter("DataSet")]


@pytest.mark.parametrize("order", [0, 1, 3, 6])
def test_meshio_reads_every_frame(tmp_path, order):
    sim = ashlar.Scene.from_dict({
        "analysis": {"end_time": 0.02, "time_step": 1e-3, "gravity": [0, 0, -10]},
        "contact": {"friction_angle": 30},
        "material": [{"name": "stone", "density": 2000, "young_modulus": 1e7, "poisson_ratio": 0.2}],
        "output": {"every": 10},
        "block": [
            {"name": "floor", "fixed": True, "box": {"min": [-1, -1, -1], "max": [2, 2, 0]}},
            {"name": "cube", "material": "stone", "order": order, "box": {"min": [0, 0, 0], "max": [1, 1, 1]},
             "velocity": [1, 0, 0]},
        ],
    }).simulation()
    sim.record(tmp_path / "out")
    sim.run()
    blocks = [read(frame) for frame in frames(tmp_path / "out", "blocks")]
    assert len(blocks) == 3
    frame = blocks[-1]
    moved = frame.point_data["displacement"]
    undeformed = frame.points - moved
    floor = undeformed[:, 2] < -0.5
    assert floor.sum() >= 4 and not moved[floor].any()
    top = undeformed[:, 2] > 0.5
    assert top.sum() >= 4
    cube = sim.blocks["cube"]
    assert moved[top] == pytest.approx(cube.displacements(undeformed[top]), abs=1e-12)
    assert frame.point_data["velocity"][top] == pytest.approx(cube.velocities(undeformed[top]), abs=1e-9)
    stress = cube.stress(undeformed[top])[:, [0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]  # xx yy zz xy yz xz
    assert frame.point_data["stress"][top] == pytest.approx(stress, abs=1e-3)
    contacts = read(frames(tmp_path / "out", "contacts")[-1])
    assert contacts.point_data["area"].sum() == pytest.approx(sim.contacts()["area"].sum(), rel=1e-12)
    assert np.isfinite(contacts.points).all() and len(contacts.points) == len(sim.contacts())
    joints = read(frames(tmp_path / "out", "joints")[-1])
    assert sum(len(cells) for cells in joints.cells) == len(joints.cell_data["opening"][0])


def test_single_precision_halves_fields_and_keeps_places(tmp_path):
    def last_frames(precision):
        sim = ashlar.Scene.from_dict({
            "analysis": {"end_time": 0.02, "time_step": 1e-3, "gravity": [0, 0, -10]}, "contact": {"friction_angle": 30},
            "material": [{"name": "stone", "density": 2000, "young_modulus": 1e7, "poisson_ratio": 0.2}],
            "output": {"every": 10, "precision": precision},
            "block": [{"name": "floor", "fixed": True, "box": {"min": [-1, -1, -1], "max": [2, 2, 0]}},
                      {"name": "cube", "material": "stone", "box": {"min": [0, 0, 0], "max": [1, 1, 1]},
                       "velocity": [1, 0, 0]}]}).simulation()
        folder = tmp_path / precision
        sim.record(folder)
        sim.run()
        return {series: read(frames(folder, series)[-1]) for series in ("blocks", "contacts", "joints")}

    exact, rounded = last_frames("double"), last_frames("single")
    assert (rounded["blocks"].points == exact["blocks"].points).all()
    for series in ("contacts", "joints"):
        assert rounded[series].points.dtype == np.float32
        assert (rounded[series].points == exact[series].points.astype(np.float32)).all()
    for series, frame in rounded.items():
        for name, values in frame.point_data.items():
            told = exact[series].point_data[name]
            assert values.dtype == (np.float32 if told.dtype == np.float64 else told.dtype), name
            assert (values == told.astype(values.dtype)).all(), name
