"""Models of COMPAS: forces by hand, and results in the form of its files."""
import json
import math
import sys
import types

import numpy as np
import pytest

import ashlar
import ashlar.compas

FACES = {"0": [0, 2, 3, 1], "1": [4, 5, 7, 6], "2": [0, 1, 5, 4], "3": [2, 6, 7, 3], "4": [0, 4, 6, 2], "5": [1, 3, 7, 5]}


def box(low, high, degrees=0.0):
    """A mesh of COMPAS: a box turned about y."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    vertices = {}
    for k in range(8):
        x, y, z = ((high if k >> axis & 1 else low)[axis] for axis in range(3))
        vertices[str(k)] = {"x": c * x + s * z, "y": y, "z": c * z - s * x}
    return {"dtype": "compas.datastructures/Mesh", "data": {"vertex": vertices, "face": FACES}}


def assembly(degrees):
    """A block of 2 m^3 on a slope that falls along x."""
    nodes = {"0": {"block": box((-3, -2, -1), (3, 2, 0), degrees), "is_support": True},
             "1": {"block": box((-1, -1, 0), (1, 1, 0.5), degrees)}}
    graph = {"node": nodes, "edge": {"0": {}, "1": {}}, "adjacency": {"0": {}, "1": {}}, "max_node": 1}
    return {"dtype": "compas_assembly.datastructures/Assembly",
            "data": {"attributes": {}, "graph": {"dtype": "compas.datastructures/Graph", "data": graph}}}


def problem(displacement):
    """A support, 4, that moves, and a block on it, 7; the edge is from the upper block to the lower one."""
    def element(mesh):
        return {"dtype": "compas_dem.elements/Block",
                "data": {"transformation": None, "material": "m", "geometry": mesh, "is_support": False}}

    graph = {"node": {"4": {"element": "a"}, "7": {"element": "b"}}, "edge": {"7": {"4": {"contacts": []}}}}
    model = {"elements": {"a": element(box((-3, -2, -1), (3, 2, 0))), "b": element(box((-1, -1, 0), (1, 1, 0.5)))},
             "materials": {"m": {"dtype": "compas_dem.material/Stone", "data": {"name": "Stone", "density": 2000}}},
             "graph": graph}
    conditions = {"gravity": True, "g": 10.0, "body_forces": [], "point_loads": [], "surface_loads": [],
                  "displacements": [{"block_index": 4, "translation": displacement, "rotation": [0, 0, 0]}]}
    contact = {"contact_model": {"data": {"phi": 35.0, "mu": 0.7, "c": None, "t_c": None}}, "joint_model": None}
    return {"dtype": "compas_dem.problem/Problem",
            "data": {"name": "p", "model": {"dtype": "compas_dem.models/BlockModel", "data": model},
                     "boundary_conditions": {"data": conditions}, "contact_properties": {"data": contact}}}


def test_forces_on_a_slope(tmp_path):
    angle = 20.0
    (tmp_path / "slope.json").write_text(json.dumps(assembly(angle)))
    answer = ashlar.compas.solve(tmp_path / "slope.json")
    assert answer.status == "equilibrium"
    assert any("friction is not in the file" in note for note in answer.left_out)
    answer.write(tmp_path / "results.json")
    written = json.loads((tmp_path / "results.json").read_text())
    graph = written["data"]["graph"]["data"]
    np.testing.assert_allclose(graph["node"]["1"]["transformation"]["data"]["matrix"], np.eye(4), atol=1e-6)
    (interface,) = graph["edge"]["0"]["1"]["interfaces"]
    data = interface["data"]
    frame = {axis: np.array(data["frame"]["data"][axis]) for axis in ("xaxis", "yaxis")}
    normal = np.cross(frame["xaxis"], frame["yaxis"])
    sine, cosine = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    # From the support to the block; the weight of 2400 kg/m^3 along and across the slope.
    np.testing.assert_allclose(normal, [sine, 0, cosine], atol=1e-9)
    weight = 2400 * 9.81 * 2
    assert all(force["c_nn"] == 0 for force in data["forces"])
    assert sum(force["c_np"] for force in data["forces"]) == pytest.approx(weight * cosine, rel=1e-6)
    on_block = sum((force["c_np"] - force["c_nn"]) * normal + force["c_u"] * frame["xaxis"] + force["c_v"] * frame["yaxis"]
                   for force in data["forces"])
    np.testing.assert_allclose(on_block, [0, 0, weight], atol=1e-5 * weight)
    # Moments of the points about the centroid of the block vanish.
    places = np.array([point["data"] for point in data["points"]])
    centre = np.array([0.25 * sine, 0, 0.25 * cosine])
    forces = [(force["c_np"] - force["c_nn"]) * normal + force["c_u"] * frame["xaxis"] + force["c_v"] * frame["yaxis"]
              for force in data["forces"]]
    np.testing.assert_allclose(np.cross(places - centre, forces).sum(axis=0), 0, atol=1e-5 * weight)
    assert data["size"] == pytest.approx(4.0, rel=1e-6)
    assert graph["adjacency"] == {"0": {"1": None}, "1": {"0": None}}


def test_a_steep_slope_moves():
    answer = ashlar.compas.solve(assembly(35.0))
    assert answer.status == "moving"
    assert answer.message


def test_a_problem_has_its_results_at_nodes_and_edges():
    answer = ashlar.compas.solve(problem([0.1, 0, 0]))
    assert answer.status == "equilibrium"
    graph = answer.to_dict()["data"]["model"]["data"]["graph"]
    moved = np.eye(4)
    moved[0, 3] = 0.1
    for node in ("4", "7"):
        np.testing.assert_allclose(graph["node"][node]["transformation"]["data"]["matrix"], moved, atol=1e-6)
    edge = graph["edge"]["7"]["4"]
    assert edge["contacts"] == [] and "4" not in graph["edge"]
    # On the first block of the edge, the upper one: its weight of 4000 kg.
    np.testing.assert_allclose(edge["force"], [0, 0, 4e4], atol=1)
    assert edge["force_magnitude"] == pytest.approx(4e4, rel=1e-4)
    assert sum(edge["force_normal"]) == pytest.approx(4e4, rel=1e-4)
    assert edge["face_contact"] and set(edge["status"]) <= {"stick", "slide"}
    frame = edge["contact_data"]["data"]["frame"]["data"]
    np.testing.assert_allclose(np.cross(frame["xaxis"], frame["yaxis"]), [0, 0, -1], atol=1e-9)
    json.dumps(graph)


def test_supports_may_be_named():
    values = assembly(0.0)
    del values["data"]["graph"]["data"]["node"]["0"]["is_support"]
    with pytest.raises(ValueError, match="support"):
        ashlar.compas.solve(values)
    assert ashlar.compas.solve(values, fixed=[0]).status == "equilibrium"


def test_files_that_are_no_models_are_refused(tmp_path):
    (tmp_path / "bad.json").write_text("{")
    with pytest.raises(ValueError, match="bad.json:1:2: error: text is no JSON"):
        ashlar.compas.solve(tmp_path / "bad.json")
    with pytest.raises(ValueError, match="is a compas.geometry/Frame"):
        ashlar.compas.solve({"dtype": "compas.geometry/Frame", "data": {"point": [0, 0, 0]}})


class Graph:
    """As far as solve_problem goes."""

    def __init__(self, nodes):
        self.values = {node: {} for node in nodes}
        self.edges = {}

    def nodes(self):
        return iter(self.values)

    def node_attribute(self, node, name, value):
        self.values[node][name] = value

    def has_edge(self, edge):
        return edge in self.edges

    def add_edge(self, u, v):
        self.edges[u, v] = {}

    def edge_attribute(self, edge, name, value):
        self.edges[edge][name] = value


def test_a_problem_in_memory_has_its_results_set(monkeypatch):
    stand_in = types.ModuleType("compas")
    stand_in.json_dumps = lambda value: json.dumps(value.values)
    stand_in.json_loads = json.loads
    monkeypatch.setitem(sys.modules, "compas", stand_in)
    graph = Graph([4, 7])
    in_memory = types.SimpleNamespace(values=problem([0, 0, 0]), model=types.SimpleNamespace(graph=graph))
    assert ashlar.compas.solve_problem(in_memory).status == "equilibrium"
    np.testing.assert_allclose(graph.values[7]["transformation"]["data"]["matrix"], np.eye(4), atol=1e-6)
    np.testing.assert_allclose(graph.edges[7, 4]["force"], [0, 0, 4e4], atol=1)
    assert "contacts" not in graph.edges[7, 4]
