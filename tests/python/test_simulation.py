"""Scenes and simulations from Python, against values derived by hand."""
import decimal
import fractions
import json
import os
import pickle
import signal
import threading
import time

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


def test_natural_values_stand_for_those_of_a_scene(tmp_path):
    stone = dict(CUBE["material"][0], density=decimal.Decimal("2000"), young_modulus=np.float32(2**30))
    floor = dict(CUBE["block"][0], fixed=np.bool_(True))
    cube = dict(CUBE["block"][1], box={"min": (0, 0, 0), "max": np.array([1, 1, 1], dtype=np.int8)}, order=np.uint8(2))
    made = ashlar.Scene.from_dict(dict(CUBE, material=(stone,), block=[floor, cube])).to_dict()
    assert made["material"][0]["density"] == 2000 and made["material"][0]["young_modulus"] == 2**30
    assert made["block"][0]["fixed"] is True and made["block"][1]["order"] == 2
    mesh = tmp_path / "cube.obj"
    mesh.write_text("\n".join(["v 0 0 0", "v 1 0 0", "v 0 1 0", "v 0 0 1", "f 1 3 2", "f 1 2 4", "f 1 4 3", "f 2 3 4"]))
    stones = [CUBE["block"][0], {"name": "cube", "material": "stone", "mesh": {"file": mesh}}]
    assert ashlar.Scene.from_dict(dict(CUBE, block=stones)).simulation().blocks["cube"].volume == pytest.approx(1 / 6)


@pytest.mark.parametrize("key, value, fault, said", [
    ("density", None, TypeError, "material.0.density: None has no place"),
    ("density", 1j, TypeError, "material.0.density: a value of type complex"),
    ("density", b"2000", TypeError, "material.0.density: a value of type bytes"),
    ("density", np.datetime64("2026-01-01"), TypeError, "material.0.density: a value of type datetime.date"),
    ("density", 2**63, ValueError, "material.0.density: 9223372036854775808 is out of the range"),
    ("density", decimal.Decimal("1e-400"), ValueError, "material.0.density: 1E-400 is out of the range of double"),
    ("density", decimal.Decimal("1e400"), ValueError, "material.0.density: 1E.400 is out of the range of double"),
    ("density", fractions.Fraction(10**400), ValueError, "material.0.density: 1000.* is out of the range of double"),
    ("density", fractions.Fraction(1, 10**400), ValueError, "material.0.density: 1/1000.* is out of the range of double"),
    ("name", "\udc80", ValueError, "material.0.name: .* is no text in UTF-8"),
    (1, 2.0, TypeError, "material.0: a key is a text, not 1"),
    ("density", 2**53 + 1, ashlar.SceneError, "whole number is not exact in double precision .9007199254740993"),
    ("density", True, ashlar.SceneError, "density"),
    ("density", "heavy", ashlar.SceneError, "density"),
    ("density", [2000], ashlar.SceneError, "density"),
])
def test_other_values_are_refused_by_their_key(key, value, fault, said):
    with pytest.raises(fault, match=said):
        ashlar.Scene.from_dict(dict(CUBE, material=[{**CUBE["material"][0], key: value}]))


def test_a_scene_is_a_dictionary():
    for nothing in (None, [CUBE], "analysis"):
        with pytest.raises(TypeError, match="a scene is a dictionary"):
            ashlar.Scene.from_dict(nothing)
    with pytest.raises(TypeError, match="not one text"):
        ashlar.Scene("", "s.toml", "analysis.time_step=1")


def test_points_outside_a_block_are_refused_unless_asked_for():
    cube = scene().simulation().blocks["cube"]
    corners = [[0, 0, 0], [1, 1, 1], [1, 0.5, 0.5], [0.5, 0.5, 0.5]]
    assert np.array_equal(cube.positions(corners), corners)
    with pytest.raises(ValueError, match=r"point \(1.25, 0.5, 0.5\) is not of block cube: it is 0.25 m outside"):
        cube.displacements([[0.5, 0.5, 0.5], [1.25, 0.5, 0.5]])
    with pytest.raises(ValueError, match="finite coordinates"):
        cube.stress([[0.5, 0.5, np.nan]])
    # At rest in its place the map is the identity, outside too.
    assert cube.positions([[1.25, 0.5, 0.5]], extrapolate=True)[0] == pytest.approx([1.25, 0.5, 0.5], abs=1e-12)


def staged():
    blocks = [CUBE["block"][0], CUBE["block"][1], dict(CUBE["block"][1], name="upper", translate=[0, 0, 1])]
    return ashlar.Scene.from_dict(dict(CUBE, block=blocks, stage=[
        {"name": "settle", "analysis": {"end_time": 0.01}},
        {"name": "excavate", "remove": ["upper"], "analysis": {"end_time": 0.01}},
    ]))


def test_removed_blocks_do_not_answer():
    sim = staged().simulation()
    upper, cube = sim.blocks["upper"], sim.blocks["cube"]
    assert upper.present and upper.positions([[0.5, 0.5, 1.5]]).shape == (1, 3)
    sim.run()
    assert sim.stage == 2 and cube.present and not upper.present
    assert upper.volume == pytest.approx(1)
    for answer in (lambda: upper.positions([[0.5, 0.5, 1.5]]), lambda: upper.stress([[0.5, 0.5, 1.5]]),
                   lambda: upper.coefficients):
        with pytest.raises(RuntimeError, match=r"block upper is not there in stage 2 \(excavate\)"):
            answer()


def test_the_summary_tells_the_stages(tmp_path):
    sim = staged().simulation()
    sim.run()
    sim.write(tmp_path / "python")
    summaries = [json.loads((tmp_path / "python" / "summary.json").read_text()),
                 ashlar.run(staged(), tmp_path / "program")]
    for summary in summaries:
        assert [stage["name"] for stage in summary["stages"]] == ["settle", "excavate"]
        assert [stage["status"] for stage in summary["stages"]] == ["completed", "completed"]
        assert [stage["steps"] for stage in summary["stages"]] == [10, 20]
    assert summaries[0]["stages"] == summaries[1]["stages"]


def test_the_summary_tells_the_time_inside_the_run(tmp_path):
    start = time.monotonic()
    sim = scene(end_time=0.01).simulation()
    sim.record(tmp_path / "out")
    sim.run(callback=lambda s: time.sleep(0.02))
    elapsed = time.monotonic() - start
    seconds = json.loads((tmp_path / "out" / "summary.json").read_text())["wall_seconds"]
    assert 0 < seconds["setup"] < seconds["total"] and 0 < seconds["output"] < seconds["total"]
    # The waiting time of the caller after each of the ten steps is not part of the run; the rest is within the elapsed time.
    assert seconds["total"] < elapsed - 9 * 0.02


def test_a_simulation_that_has_failed_says_so_again(tmp_path):
    # 2000 kg at 200 m/s press springs of 20 E / size by 200 sqrt(2000 / 2e10) = 0.06 m, where 1e-3 m are allowed.
    blocks = [CUBE["block"][0], dict(CUBE["block"][1], translate=[0, 0, 0.1], velocity=[0, 0, -200])]
    contact = {"friction_angle": 30, "allowed_depth": 1e-3, "restitution": "springs"}
    sim = ashlar.Scene.from_dict(dict(CUBE, block=blocks, contact=contact)).simulation()
    with pytest.raises(RuntimeError) as first:
        sim.run()
    assert sim.status == "failed" and sim.message == str(first.value)
    for again in (sim.step, sim.run):
        with pytest.raises(RuntimeError) as caught:
            again()
        assert str(caught.value) == str(first.value)
    assert np.isfinite(sim.blocks["cube"].positions([[0.5, 0.5, 0.6]])).all()
    sim.write(tmp_path / "out")
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["status"] == "failed"


def tilted(**analysis):
    """The cube on a floor tilted by 30 degrees, by gravity; friction of tan(phi) = 1.2 tan(30)."""
    stone = dict(CUBE["block"][1], box={"min": [-2, -2, 0], "max": [2, 2, 1]})
    floor = dict(CUBE["block"][0], box={"min": [-9, -9, -1], "max": [9, 9, 0]})
    return ashlar.Scene.from_dict(dict(
        CUBE, block=[floor, stone], contact={"friction_angle": float(np.degrees(np.arctan(1.2 * np.tan(np.pi / 6))))},
        analysis={"gravity": [5, 0, -10 * np.cos(np.pi / 6)], **analysis}))


@pytest.mark.parametrize("method", ["limit", "elastic"])
def test_a_search_has_its_answer_in_the_summary(tmp_path, method):
    searched = tilted(type="factor-of-safety", method=method)
    sim = searched.simulation()
    assert len(sim.history["time"]) == 0
    seen = []
    assert sim.run(callback=lambda s: seen.append(s.steps)) == "completed"
    found = sim.summary["factor_of_safety"]
    assert found["method"] == method and found["lower"] <= 1.2 <= found["upper"] <= 1.2 * 1.02
    assert ashlar.run(searched, tmp_path / "out")["factor_of_safety"] == found
    if method == "elastic":
        assert len(seen) > sum(trial["iterations"] for trial in found["trials"])
    with pytest.raises(RuntimeError, match="loads of a search"):
        tilted(type="factor-of-safety").simulation().set_load_factor("cube", 0, 1)


def test_a_recorded_run_is_resumed(tmp_path):
    whole = scene(end_time=0.02).simulation()
    whole.run()
    first = scene(end_time=0.01).simulation()
    first.record(tmp_path / "out")
    assert first.run() == "completed"
    del first
    second = scene(end_time=0.02).simulation(resume=tmp_path / "out")
    assert second.steps == 10 and second.run() == "completed"
    assert np.array_equal(second.history["energy.elastic"], whole.history["energy.elastic"][10:])
    table = np.genfromtxt(tmp_path / "out" / "history.csv", delimiter=",", names=True, deletechars="")
    assert np.array_equal(table["energy.elastic"], whole.history["energy.elastic"])
    # As the program does, once the folder is free.
    del second
    assert ashlar.run(scene(end_time=0.03), tmp_path / "out", resume=True)["steps"] == 30
    for bad, fault in ((scene(end_time=0.02), "before the time"), (scene(time_step=2e-3), "another scene")):
        with pytest.raises((ValueError, RuntimeError), match=fault):
            bad.simulation(resume=tmp_path / "out")
    with pytest.raises(RuntimeError):
        scene().simulation(resume=tmp_path / "none")


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


def test_ctrl_c_ends_a_run_between_two_steps():
    sim = scene(end_time=1e6).simulation()  # longer than anybody waits
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        sim.run()
    steps = len(sim.history["time"])
    sim.step()
    assert len(sim.history["time"]) == steps + 1


def test_a_scene_runs_where_nothing_can_be_written(tmp_path):
    (tmp_path / "scenes").mkdir()
    (tmp_path / "scenes" / "s.toml").write_text(ashlar.Scene.from_dict(CUBE).text)
    loaded = ashlar.Scene.load(tmp_path / "scenes" / "s.toml", ["analysis.end_time=0.002"])
    summary = ashlar.run(loaded, tmp_path / "out")
    assert summary["status"] == "completed" and summary["steps"] == 2
    # Nothing is written beside the scene, which may be in a folder of the system's.
    assert os.listdir(tmp_path / "scenes") == ["s.toml"]


def test_a_scene_keeps_its_text_when_its_file_changes(tmp_path):
    loaded = ashlar.Scene.from_dict(dict(CUBE, title="mine"), folder=tmp_path)
    (tmp_path / "scene.toml").write_text("no scene")
    assert ashlar.run(loaded, tmp_path / "out", ["analysis.end_time=0.002"])["title"] == "mine"


def test_a_dash_is_a_file_not_the_standard_input_of_the_interpreter(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ValueError, match="cannot|no such"):
        ashlar.run("-", tmp_path / "out")
    (tmp_path / "-").write_text(scene(end_time=0.002).text)
    assert ashlar.run("-", tmp_path / "out")["status"] == "completed"


@pytest.mark.parametrize("threads", [0, -5])
def test_threads_are_one_or_more(tmp_path, threads):
    with pytest.raises(ValueError, match="threads"):
        ashlar.run(scene(), tmp_path / "out", threads=threads)
    with pytest.raises(ValueError, match="threads"):
        scene().simulation(threads=threads)


def test_what_is_no_time_and_no_point_is_refused():
    sim = scene().simulation()
    with pytest.raises(ValueError, match="nan"):
        sim.run(until=float("nan"))
    assert sim.steps == 0
    with pytest.raises(TypeError, match="complex"):
        sim.blocks["cube"].positions(np.array([[0.5 + 1j, 0.5, 0.5]]))
    with pytest.raises(ValueError, match="shape"):
        sim.blocks["cube"].positions([1.0, 2.0, 3.0])
    assert sim.blocks["cube"].positions([(0, 0, 1)]).tolist() == [[0, 0, 1]]


def test_objects_of_the_extension_are_made_by_it_alone():
    sim = scene().simulation()
    for made in (ashlar.Block, type(sim._core), type(scene()._core)):
        with pytest.raises(TypeError, match="made by ashlar"):
            made.__new__(made)
    bad = ashlar._core.load("nonsense", "s.toml", [])
    with pytest.raises(ValueError, match="errors"):
        bad.json()


def test_runs_in_threads_give_signals_back(tmp_path):
    caught = []
    before = signal.signal(signal.SIGTERM, lambda number, frame: caught.append(number))
    short, long = scene(end_time=0.01), scene(end_time=0.1)
    threads = [threading.Thread(target=ashlar.run, args=(of, tmp_path / str(k)))
               for k, of in enumerate((short, long))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    os.kill(os.getpid(), signal.SIGTERM)
    time.sleep(0.01)
    signal.signal(signal.SIGTERM, before)
    assert caught == [signal.SIGTERM]
