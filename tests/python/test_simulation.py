"""Scenes and simulations from Python, against values derived by hand."""
import pickle
import threading

import numpy as np
import pytest

import ashlar

CUBE = {
    "analysis": {"end_time": 0.5, "time_step": 1e-3, "gravity": [0, 0, -10]},
    "contact": {"friction_angle": 30},
    "material": [{"name": "stone", "density": 2000, "young_modulus": 1e9, "poisson_ratio": 0.0}],
    "block": [
        {"name": "floor", "fixed": True, "box": {"min": [-1, -1, -1], "max": [2, 2, 0]}},
        {"name": "cube", "material": "stone", "box": {"min": [0, 0, 0], "max": [1, 1, 1]}},
    ],
}


def scene(**analysis):
    changed = dict(CUBE, analysis={**CUBE["analysis"], **analysis})
    return ashlar.Scene.from_dict(changed)


def resting():
    values = {key: value for key, value in CUBE.items() if key != "analysis"}
    return ashlar.Scene.from_dict({"analysis": {"type": "static", "gravity": [0, 0, -10]}, **values})


def test_a_block_falls_freely():
    values = dict(CUBE, block=[dict(CUBE["block"][0]), dict(CUBE["block"][1], translate=[0, 0, 5])])
    sim = ashlar.Scene.from_dict(values).simulation()
    assert sim.run(until=0.25) == "running"
    assert sim.time == pytest.approx(0.25, abs=1e-12) and sim.steps == 250
    # Newmark's dda is first order: g t^2 / 2 and g t dt / 2 more.
    place = sim.blocks["cube"].positions([[0.5, 0.5, 5.5]])
    assert place.shape == (1, 3)
    assert place[0] == pytest.approx([0.5, 0.5, 5.5 - 0.5 * 10 * 0.25**2], abs=10 * 0.25 * 1e-3)
    assert sim.blocks["cube"].velocities([[0.5, 0.5, 5.5]])[0] == pytest.approx([0, 0, -2.5], abs=1e-9)
    assert sim.run() == "completed"
    assert sim.time == pytest.approx(0.5, abs=1e-12)
    assert sim.step() is False


def test_the_floor_bears_the_weight():
    sim = resting().simulation(threads=2)
    assert sim.run() == "equilibrium"
    contacts = sim.contacts()
    assert contacts.dtype["force"].shape == (3,)
    assert np.abs(contacts["force"].sum(axis=0)) == pytest.approx([0, 0, 2000 * 10], abs=1e-2)
    assert contacts["area"].sum() == pytest.approx(1, abs=1e-3)
    # An affine cube has its mean stress.
    stress = sim.blocks["cube"].stress([[0.5, 0.5, 0.5], [0, 0, 1]])
    assert stress.shape == (2, 3, 3)
    assert stress[0, 2, 2] == pytest.approx(-10e3, rel=1e-4)
    assert sim.blocks["cube"].displacements([[0, 0, 1]])[0, 2] == pytest.approx(-1e-5, rel=1e-3)


def test_blocks_have_their_sizes():
    sim = scene().simulation()
    assert list(sim.blocks) == ["floor", "cube"] and len(sim.blocks) == 2 and "cube" in sim.blocks
    cube = sim.blocks["cube"]
    assert (cube.name, cube.order, cube.fixed) == ("cube", 1, False)
    assert cube.volume == pytest.approx(1, rel=1e-15) and cube.mass == pytest.approx(2000, rel=1e-15)
    assert cube.vertices.shape == (8, 3) and cube.triangles.shape == (12, 3)
    assert cube.coefficients.shape == (4, 3)
    with pytest.raises(KeyError):
        sim.blocks["sphere"]
    with pytest.raises(ValueError):
        cube.positions([0, 0, 0])


def test_the_history_is_that_of_the_file(tmp_path):
    sim = scene(end_time=0.02).simulation()
    sim.run()
    history = sim.history
    assert history["step"].tolist() == list(range(21))
    assert history["time"][-1] == sim.time
    sim.write(tmp_path / "out")
    table = np.genfromtxt(tmp_path / "out" / "history.csv", delimiter=",", names=True, deletechars="")
    for name in table.dtype.names:
        assert np.array_equal(table[name], history[name]), name
    assert (tmp_path / "out" / "summary.json").exists() and (tmp_path / "out" / "blocks.pvd").exists()


def test_a_step_is_the_programs(tmp_path):
    sim = scene(end_time=0.05).simulation()
    sim.run()
    summary = ashlar.run(scene(end_time=0.05), tmp_path / "out")
    assert summary["status"] == "completed" and summary["steps"] == 50
    table = np.genfromtxt(tmp_path / "out" / "history.csv", delimiter=",", names=True, deletechars="")
    assert np.array_equal(table["energy.elastic"], sim.history["energy.elastic"])
    with pytest.raises(ValueError, match="holds results|--force|results"):
        ashlar.run(scene(end_time=0.05), tmp_path / "out")
    assert ashlar.run(scene(end_time=0.05), tmp_path / "out", force=True)["steps"] == 50


def test_a_callback_sees_each_step_and_can_stop():
    seen = []
    sim = scene().simulation()
    sim.run(callback=lambda s: (seen.append(s.time), len(seen) < 3)[1])
    assert sim.steps == 3 and len(seen) == 3


def test_faults_have_their_places(tmp_path):
    path = tmp_path / "s.toml"
    path.write_text("[analysis]\nend_time = 1\ntime_stp = 1\n")
    with pytest.raises(ashlar.SceneError) as caught:
        ashlar.Scene.load(path)
    faults = [(fault["line"], fault["column"]) for fault in caught.value.faults]
    assert (3, 1) in faults
    assert "did you mean time_step?" in str(caught.value)
    assert caught.value.faults[0]["file"] == str(path)
    assert pickle.loads(pickle.dumps(caught.value)).faults == caught.value.faults
    with pytest.raises(OSError):
        ashlar.Scene.load(tmp_path / "none.toml")


def test_scenes_can_be_pickled_and_overridden(tmp_path):
    path = tmp_path / "s.toml"
    path.write_text(scene().text)
    loaded = ashlar.Scene.load(path, overrides=["analysis.time_step=2e-3"])
    again = pickle.loads(pickle.dumps(loaded))
    assert again.to_dict() == loaded.to_dict()
    assert again.to_dict()["analysis"]["time_step"] == 2e-3


def test_arrays_stand_for_lists():
    block = dict(CUBE["block"][1], box={"min": np.zeros(3), "max": np.array([1, 1, 2])}, order=np.int64(2))
    made = ashlar.Scene.from_dict(dict(CUBE, block=[CUBE["block"][0], block]))
    assert made.to_dict()["block"][1]["box"]["max"] == [1, 1, 2]
    assert made.simulation().blocks["cube"].order == 2


def test_other_threads_run_while_it_computes():
    done = threading.Event()
    sims = [scene(end_time=0.05).simulation() for _ in range(2)]
    threads = [threading.Thread(target=sim.run) for sim in sims]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    done.set()
    assert np.array_equal(sims[0].history["energy.elastic"], sims[1].history["energy.elastic"])
